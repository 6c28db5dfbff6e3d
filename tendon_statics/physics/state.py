"""What the model says of a unit under one pair of tensions: the one result type."""

from __future__ import annotations

import math
from typing import Any

from .admissible import Interval, angles_held
from .design import JointDesign
from .design_gradients import Derivatives, SlipAnswer, answer_derivatives
from .design_uncertainty import DesignUncertainty
from .forces import ContactForces, ForceRemainder
from .gradients import TensionGradient, stddev_of
from .kept import kept
from .load import Load
from .regime import AT_ROOT, AT_STOP, Regime
from .state_basis import StateBasis


class Equilibrium(StateBasis):
    """The answer of `solve`, and of a tracker. What is not determined is None, never a number.

    All that follows from the angle is worked out when it is asked for, once: forces, pressure and
    gradients are None where there is no angle, that is while a cable is slack, and in the regime
    ``held`` of `solve`.
    """

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f'an Equilibrium cannot be changed; its {name} is what it is')

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), tuple(self)

    @property
    def is_tracked(self) -> bool:
        """Whether a tracker gave it, which remembers where the unit was."""
        return self.root_count is None

    @property
    def slip_margin(self) -> float | None:
        """M / K at the angle: ±1 at the limit of friction, beyond that only against the stop."""
        if self.bend_angle is None:
            return None
        slip, probe = self._slip_and_probe
        return slip.margin_at(probe)

    @property
    def admissible_angles(self) -> list[Interval]:
        """Where friction can hold the unit under these tensions, as `admissible_angles` has it.

        From the slip function that is there already; none while a cable is slack.
        """
        if self.regime is Regime.SLACK:
            return []
        stop = self.design.max_bend_angle
        if self.bend_angle is None:
            return angles_held(self._taut_slip, stop)
        slip, probe = self._slip_and_probe
        found_alone = self.root_count == 1 and self.regime is AT_ROOT
        return angles_held(slip, stop, [probe[0]] if found_alone else None)

    @property
    def residual(self) -> float | None:
        """(|M| − K) / (μ r) in N: 0 at a root, at the stop by how much M exceeds friction.

        With the paper's law N_m − N_f, Eq. (4).
        """
        if self.bend_angle is None:
            return None
        slip, probe = self._slip_and_probe
        return slip.residual_at(probe)

    @property
    def stable(self) -> bool | None:
        """Whether the unit comes back when pushed past the angle; False: it slides on to the stop.

        None where friction is not at its limit.
        """
        if self.regime is AT_ROOT:
            return self._slip_and_probe[1][2] < 0.0  # type: ignore[no-any-return]
        return True if self.regime is AT_STOP else None

    @kept
    def normal_force(self) -> float | None:
        """N in N; None for a tracked unit where not `branch_consistent`."""
        if not self._is_vouched_for:
            return None
        slip, probe = self._slip_and_probe
        return slip.total * slip.law.normal(probe[8], self._friction)  # type: ignore[no-any-return]

    @property
    def pressure(self) -> float | None:
        """P in Pa (per metre of contact depth if `contact_width` is left at 1 m)."""
        normal_force = self.normal_force
        return None if normal_force is None else normal_force / self.design.contact_area

    @property
    def forces(self) -> ContactForces | None:
        """The forces on the joint surface."""
        return self._details.forces if self._is_vouched_for else None

    @property
    def force_remainder(self) -> ForceRemainder | None:
        """What Eqs. (1) and (2) leave over, one by one."""
        return self._details.force_remainder if self._is_vouched_for else None

    @kept
    def branch_consistent(self) -> bool | None:
        """Whether Eqs. (1) and (2) ask for the contact force taken.

        With the paper's law they do while F sin φ > |P|, so that N < T.
        """
        if self.bend_angle is None:
            return None
        slip, probe = self._slip_and_probe
        return slip.law.consistent(probe[8], self._friction)  # type: ignore[no-any-return]

    @property
    def bend_angle_gradient(self) -> TensionGradient | None:
        """∂θ/∂T in rad/N; None also where it is infinite (two roots merging).

        Of a tracker, that of the slip that brought the unit here, while the angle is assured.
        """
        if self.is_tracked:
            return self.slip_gradient if self.angle_assured else None
        return None if self.bend_angle is None else self._details.bend_angle_gradient

    @property
    def pressure_gradient(self) -> TensionGradient | None:
        """∂p/∂T in Pa/N; None also where it is infinite."""
        return self._details.pressure_gradient if self._is_vouched_for else None

    @property
    def bend_angle_derivatives(self) -> Derivatives | None:
        """∂θ/∂x in rad per SI unit, for the tilt of the base and each number of the design.

        Of `solve`; None also where they are infinite. At the stop only the stop moves the angle.
        """
        found = self._derivatives
        return None if found is None else found[0]

    @property
    def pressure_derivatives(self) -> Derivatives | None:
        """∂p/∂x in Pa per SI unit, likewise."""
        found = self._derivatives
        return None if found is None else found[1]

    def bend_angle_stddev(
        self, tension_stddev: float, design_covariance: DesignUncertainty | None = None
    ) -> float | None:
        """Return the standard deviation of the angle in rad, to first order, None if not known.

        Parameters
        ----------
        tension_stddev : float
            Standard deviation of each tension in N, the two independent.
        design_covariance : DesignUncertainty, optional
            Of parameters of the design; without it, and of a tracker, the design is exact.
        """
        found = stddev_of(self.bend_angle_gradient, tension_stddev)
        return self._with_design(found, design_covariance, 0)

    def pressure_stddev(
        self, tension_stddev: float, design_covariance: DesignUncertainty | None = None
    ) -> float | None:
        """Return the standard deviation of the pressure in Pa in the same way."""
        found = stddev_of(self.pressure_gradient, tension_stddev)
        return self._with_design(found, design_covariance, 1)

    def _with_design(
        self, stddev: float | None, covariance: DesignUncertainty | None, which: int
    ) -> float | None:
        """Add what the design contributes to a deviation, of angle or pressure."""
        if covariance is None or self.is_tracked or stddev is None:
            return stddev
        found = self._derivatives
        return found and math.sqrt(stddev * stddev + covariance.variance(found[which]))

    def as_dict(self) -> dict[str, Any]:
        """Return all but design and load by name, ready for JSON: nested as dicts."""
        # What is there already is taken rather than asked for one by one: that saves a tenth.
        design, _, regime, tension_l, tension_s, angle, root_count, iterations, assured, _ = self
        margin = residual = consistent = None
        normal_force = forces = remainder = by_tension = pressure_by_tension = None
        if angle is not None:
            slip, probe = self._slip_and_probe
            margin, residual = slip.margin_at(probe), slip.residual_at(probe)
            consistent = self.branch_consistent
            if consistent or root_count is not None:
                normal_force, forces, remainder, by_tension, pressure_by_tension = self._details
        if root_count is None:
            by_tension = self.bend_angle_gradient
        return {
            'regime': regime._value_,  # which `value` is a detour to
            'tension_l': tension_l,
            'tension_s': tension_s,
            'bend_angle': angle,
            'angle_assured': assured,
            'slip_margin': margin,
            'pressure': normal_force and normal_force / design.contact_area,
            'normal_force': normal_force,
            'root_count': root_count,
            'iterations': iterations,
            'stable': self.stable,
            'residual': residual,
            'forces': forces and forces.as_dict(),
            'force_remainder': remainder and remainder.as_dict(),
            'branch_consistent': consistent,
            'bend_angle_gradient': by_tension and by_tension.as_dict(),
            'pressure_gradient': pressure_by_tension and pressure_by_tension.as_dict(),
        }

    @property
    def _is_vouched_for(self) -> bool:
        """Whether there is a contact force that the model stands behind."""
        if self.bend_angle is None:
            return False
        return not self.is_tracked or bool(self.branch_consistent)

    @kept
    def _derivatives(self) -> tuple[Derivatives, Derivatives] | None:
        """By tilt and design. A tracked unit has been brought here by tensions of the past."""
        if self.is_tracked or self.bend_angle is None:
            return None
        rest = (self.regime, self.tension_l, self.tension_s)

        def ask(design: JointDesign, load: Load, bend_angle: float) -> SlipAnswer:
            there = Equilibrium(design, load, *rest, bend_angle, self.root_count)
            assert there.residual is not None
            assert there.pressure is not None
            # Without μ: the moment that is missing, over r.
            return SlipAnswer(there.residual * design.friction_coefficient, there.pressure)

        return answer_derivatives(
            ask,
            *(self.design, self.load, self.bend_angle, self.tension_l + self.tension_s),
            at_stop=self.regime is AT_STOP,
        )
