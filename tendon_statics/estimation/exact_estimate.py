"""What is said of a unit where the tensions are believed as they are."""

from __future__ import annotations

from ..physics import Equilibrium
from ..physics.kept import kept
from .estimate import Estimate, Interval, KnownLoad
from .settings import Settings


class ExactEstimate(Estimate):
    """One for which the tensions are believed as they are: an `Equilibrium`."""

    def __init__(self, result: Equilibrium, known: KnownLoad, settings: Settings) -> None:
        tensions = (result.tension_l, result.tension_s)
        super().__init__(known, settings, result.regime, tensions, result.bend_angle)
        self.result = result

    @property
    def exact(self) -> Equilibrium:
        """The model's answer."""
        return self.result

    @property
    def pressure(self) -> float | None:
        """P in Pa."""
        return self.result.pressure

    @property
    def pressure_stddev(self) -> float | None:
        """Its standard deviation in Pa."""
        settings = self.settings
        return self.result.pressure_stddev(settings.tension_stddev, settings.design_uncertainty)

    @property
    def normal_force(self) -> float | None:
        """N in N."""
        return self.result.normal_force

    @kept
    def slip_margin(self) -> float | None:
        """M / K at the angle."""
        return self.result.slip_margin

    @kept
    def admissible_angles(self) -> list[Interval]:
        """Where friction can hold the unit; none while a cable is slack."""
        return self.result.admissible_angles

    @property
    def branch_consistent(self) -> bool | None:
        """Whether the forces ask for the root that was taken; None where there is no angle."""
        return self.result.branch_consistent
