"""What an `Equilibrium` is worked out from: its fields, and its slip function at the angle."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

from .design import JointDesign
from .gradients import TensionGradient
from .kept import kept
from .load import Load
from .named import named
from .regime import AT_ROOT, AT_STOP, Regime
from .slip import Probe, Slip
from .state_details import StateDetails, state_details
from .tensions import Tensions, taut_slip

State = TypeVar('State', bound='StateBasis')


class StateFields(NamedTuple):
    """What an `Equilibrium` is made with."""

    design: JointDesign
    load: Load
    regime: Regime
    tension_l: float
    """T_l in N, as given"""
    tension_s: float
    """T_s in N, as given"""
    bend_angle: float | None = None
    """θ in rad, positive towards cable s. Of `solve` the root nearest to 0, or the stop; of a
    tracker where the unit is"""
    root_count: int | None = None
    """Of `solve`: angles between 0 and the stop, on the side of the stronger cable, at which the
    unit is about to slip"""
    iterations: int | None = None
    """Of `solve`: steps of the search for the root; 0 where there was nothing to search"""
    angle_assured: bool = True
    """Of a tracker: False once a cable has been slack, until a stop or a reset. The angle is then
    where the unit was before, which is where it is only if it has not moved meanwhile"""
    slip_gradient: TensionGradient | None = None
    """Of a tracker: ∂θ/∂T in rad/N of the slip that brought the unit here"""


class StateBasis(StateFields):
    """The fields, and what follows from them that is worked out once, when it is asked for."""

    @classmethod
    def of(cls: type[State], slip: Slip, probe: Probe, fields: tuple[Any, ...]) -> State:
        """Make one whose slip function is already there, probed at the angle.

        Parameters
        ----------
        slip : Slip
            Towards the side to which the moment drives the unit.
        fields : tuple
            All of them.
        """
        made = named(cls, fields)
        made.__dict__['_slip_and_probe'] = slip, probe
        return made

    @kept
    def _slip_and_probe(self) -> tuple[Slip, Probe]:
        """The slip function towards the side to which the moment drives, probed at the angle."""
        assert self.bend_angle is not None
        return self._taut_slip.driving(self.bend_angle)

    @property
    def _taut_slip(self) -> Slip:
        return taut_slip(self.design, Tensions(self.tension_l, self.tension_s), self.load)

    @property
    def _is_at_limit(self) -> bool:
        regime = self.regime
        return regime is AT_ROOT or regime is AT_STOP

    @property
    def _friction(self) -> float:
        """The moment that friction takes up, in units of r T."""
        probe = self._slip_and_probe[1]
        return probe[8][0] if self._is_at_limit else probe[5]  # type: ignore[no-any-return]

    @kept
    def _details(self) -> StateDetails:
        """Contact force and gradients, all at once."""
        slip, probe = self._slip_and_probe
        at_root, at_limit = self.regime is AT_ROOT, self._is_at_limit
        return state_details(slip, probe, self._friction, self.design, at_root, at_limit)
