"""What a unit's parameter file says beside its design: how its cables are measured."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..estimation.settings import Settings
from ..physics.design import JointDesign
from ..physics.design_uncertainty import DesignUncertainty
from ..physics.errors import DesignError
from ..tensions.cable_scale import CableScale
from .design_file import design_values
from .estimator_parameters import as_kept, known_names
from .known_parameters import check_parameters_of_ros, said_of_unknown
from .parameter_file import node_parameters, only_for, read_parameters
from .parameter_form import ParameterFileError
from .parameter_kinds import SettingError
from .unit_settings import settings_from


@dataclasses.dataclass(frozen=True)
class Unit:
    """A unit's design, and how its tensions are measured, as the estimator takes it."""

    settings: Settings
    parameters: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    """All that the file gives the estimator, by dotted name, as the node keeps it"""
    addressed: str = ''
    """That the file is for estimators in other places than a plain one alone, if it is"""

    @property
    def design(self) -> JointDesign:
        """The unit's design."""
        return self.settings.design

    @property
    def uncertainty(self) -> DesignUncertainty | None:
        """How well the design is known, if the file says it."""
        return self.settings.design_uncertainty

    def with_uncertainty(self, uncertainty: DesignUncertainty | None) -> Unit:
        """Return the same with another design uncertainty, say of a design that was fitted."""
        settings = dataclasses.replace(self.settings, design_uncertainty=uncertainty)
        return dataclasses.replace(self, settings=settings)

    @property
    def cable_l(self) -> CableScale:
        """How the tension of cable l follows from what is measured."""
        return self.settings.scales[0]

    @property
    def cable_s(self) -> CableScale:
        """Likewise of cable s."""
        return self.settings.scales[1]

    def get(self, name: str) -> Any:
        """Return what the file sets a parameter to; None if it does not."""
        return self.parameters.get(name)

    @property
    def unknown(self) -> list[str]:
        """What of the parameters nobody takes, and which may be meant, a sentence each."""
        return said_of_unknown(self.parameters, known_names())


def load_unit(path: str | Path, node: str = '') -> Unit:
    """Read a unit from a ROS parameter file: what the estimator takes from the same file.

    Parameters
    ----------
    node : str
        Full name of the estimator; empty: the one that the file names, or any.

    Raises
    ------
    DesignError
        If the file cannot be read, is not for that node, holds no design, or a value is not
        allowed; the text names the file, the key, the value and what is allowed.
    """
    path = Path(path)
    try:
        content = read_parameters(path)
        parameters = as_kept(node_parameters(content, node))
        design = design_values(parameters)
        if not design:
            raise DesignError(
                'there is no design in it; it stands under "/**: ros__parameters: design:"'
            )
        JointDesign.from_mapping(design)  # whose error has the key
    except ParameterFileError as error:
        # Here, for arms take NumPy, whose import a unit need not wait for.
        from .arm_file import is_arm_file

        if is_arm_file(path):
            raise DesignError(
                f'{path}: it is the file of an arm, where that of one unit is needed; what takes '
                'arms is tendon-statics arm'
            ) from None
        raise DesignError(f'{path}: {error}') from None
    except DesignError as error:
        key = f'design.{error.key}' if error.key else ''
        raise DesignError(f'{path}: {"design." if error.key else ""}{error}', key=key) from None
    try:
        check_parameters_of_ros(parameters)
        addressed = '' if node else only_for(content)
        return Unit(
            settings_from(parameters), parameters, f'{path}: {addressed}' if addressed else ''
        )
    except SettingError as error:
        raise DesignError(f'{path}: {error}', key=getattr(error.__cause__, 'key', '')) from None
