"""The load cells of both cables, as far as a calibration may correct them."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..design import DesignParameter


class LoadCells(NamedTuple):
    """What makes true tensions of measured ones: gain · tension + bias, by cable."""

    gain_l: float = 1.0
    gain_s: float = 1.0
    bias_l: float = 0.0
    """N"""
    bias_s: float = 0.0
    """N"""

    def tensions(self, tension_l: Any, tension_s: Any) -> tuple[Any, Any]:
        """T_l and T_s in N from what was measured."""
        return self.gain_l * tension_l + self.bias_l, self.gain_s * tension_s + self.bias_s


AS_MEASURED = LoadCells()

CELL_PARAMETERS = (
    *(
        DesignParameter(
            *(f'gain_{cable}', '', '', 0.1, 10.0),
            f'true over measured tension of cable {cable}, beside the bias',
            default=1.0,
        )
        for cable in 'ls'
    ),
    *(
        DesignParameter(
            *(f'bias_{cable}', '', 'N', -100.0, 100.0),
            f'what is to be added to the measured tension of cable {cable}',
            default=0.0,
        )
        for cable in 'ls'
    ),
)
"""What `calibrate` can fit beside the parameters of the design"""
