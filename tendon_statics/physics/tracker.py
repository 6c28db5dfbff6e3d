"""Stick and slip with memory: where the unit is, from where it was."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .admissible import angles_held, check_bend_angle
from .design import JointDesign
from .gradients import TensionGradient, root_gradient
from .load import UPRIGHT, DeadLoad, Load
from .loaded_joint import LoadedJoint
from .regime import Regime
from .roots import refine
from .slip import Slip
from .state import Equilibrium
from .tensions import Tensions, check_tensions, taut_slip

NO_GRADIENT = TensionGradient(0.0, 0.0)

STEPS = 32
"""Into which the way between two pairs of tensions is cut where its end alone may mislead"""


class StickSlipTracker:
    """Follows a unit through a sequence of tensions, with exact set-valued Coulomb friction.

    The unit stays where it is, to the last bit, for as long as friction can hold it there.
    Otherwise it slips in the direction it is driven to the next angle at which friction can, or
    to its stop. There is no smoothing and no time step, so that a constant load never makes it
    creep. A change of tensions that would slip it, and take it back, between two updates is not
    seen.

    Parameters
    ----------
    design : JointDesign
    bend_angle : float
        Where the unit is at first, in rad.

    Raises
    ------
    BendAngleError
        If the angle is not a number or lies beyond the stop.
    """

    def __init__(self, design: JointDesign, bend_angle: float = 0.0) -> None:
        self._design = design
        self.reset(bend_angle)

    @property
    def bend_angle(self) -> float:
        """Where the unit was last, in rad."""
        return self._bend_angle

    @property
    def design(self) -> JointDesign:
        """The unit's design."""
        return self._design

    def reset(self, bend_angle: float) -> None:
        """Put the unit to an angle in rad that an encoder or a homing move has told.

        Raises
        ------
        BendAngleError
            If the angle is not a number or lies beyond the stop; the old one then stays.
        """
        self._bend_angle = check_bend_angle(self._design, bend_angle)
        self._gradient: TensionGradient | None = NO_GRADIENT
        self._assured = True
        self._before: _Step | None = None

    def doubt(self) -> None:
        """Take it that the unit may have moved unseen, say while no tensions came.

        The angle stays, but is not assured until a stop or a reset tells it.
        """
        self._assured = False
        self._gradient = None
        self._before = None

    def change_design(self, design: JointDesign) -> None:
        """Go on with another design, from the same angle.

        A unit beyond the new stop is put there, and its angle is then not assured.
        """
        stop = design.max_bend_angle
        if abs(self._bend_angle) > stop:
            self._bend_angle = math.copysign(stop, self._bend_angle)
            self._assured = False
            self._gradient = None
        self._design = design
        self._before = None

    def update(self, tension_l: float, tension_s: float, load: Load = UPRIGHT) -> Equilibrium:
        """Take a new pair of tensions in N, and what acts beside them; return where the unit is.

        Raises
        ------
        TensionError
            As `solve` does; the unit then stays as it was.
        """
        tensions = check_tensions(tension_l, tension_s)
        tension_l, tension_s = tensions
        if tensions.slack_cable:
            self.doubt()
            return Equilibrium(self._design, load, Regime.SLACK, *tensions, angle_assured=False)
        slip = taut_slip(self._design, tensions, load)
        driving, probe = slip.driving(self._bend_angle)
        margin = driving.margin_at(probe)
        step = _Step(tensions, load, slip, margin)
        regime = Regime.HELD
        if not -1.0 <= margin <= 1.0:
            regime = self._move(step)
            driving, probe = slip.driving(self._bend_angle)
        self._before = step
        fields = (self._design, load, regime, tension_l, tension_s, self._bend_angle)
        return Equilibrium.of(driving, probe, (*fields, None, None, self._assured, self._gradient))

    def _move(self, step: _Step) -> Regime:
        """Let the unit slip on the way from the last tensions to these; return how it ends."""
        if self._stays_at_stop(step.margin):
            return self._come_to_stop(math.copysign(1.0, step.margin), step.slip)
        regime = Regime.HELD
        for slip in self._way(step):
            margin = slip.margin(self._bend_angle)
            if abs(margin) > 1.0:
                regime = self._slip(slip if margin > 0.0 else slip.mirrored())
        step.margin = step.slip.margin(self._bend_angle)
        if regime is Regime.DRIVEN_TO_STOP and abs(step.margin) <= 1.0:
            return Regime.SLIPPING  # driven there on the way, and held now
        return regime

    def _stays_at_stop(self, margin: float) -> bool:
        """Whether the unit is pressed against the stop at which it is, all the way to here.

        The moment changes in proportion on the way, so that it does not turn where its ends agree.
        """
        stop = math.copysign(self._design.max_bend_angle, margin)
        return self._bend_angle == stop and (
            self._before is None or self._before.margin * margin >= 0.0
        )

    def _come_to_stop(self, side: float, slip: Slip) -> Regime:
        """Put the unit to a stop; if it may have been anywhere, nothing else must hold it."""
        stop = self._design.max_bend_angle
        self._bend_angle = side * stop
        self._gradient = NO_GRADIENT
        if not self._assured:
            self._assured = not angles_held(slip, stop)
        return Regime.DRIVEN_TO_STOP

    def _slip(self, slip: Slip) -> Regime:
        """Move the unit ahead to where friction holds it; return what becomes of it.

        That is the first root from where it is: up to there it is driven on.
        """
        start, stop = slip.side * self._bend_angle, self._design.max_bend_angle
        found = slip.brackets(slip.probe(start), slip.probe(stop)) if start < stop else []
        if not found:
            return self._come_to_stop(slip.side, slip)
        landing, _ = refine(slip, found[0])
        self._bend_angle = slip.side * landing[0]
        self._gradient = root_gradient(slip, slip.point(landing), self._design.relative_lever)
        return Regime.SLIPPING

    def _way(self, step: _Step) -> list[Slip]:
        """Slip functions at which to look where the unit slips to, from the last to the new.

        If the admissible angles only get fewer on the way, looking at its end is enough: what
        holds the unit there would not have been passed by before. That is so where the slip
        function grows at every angle. Otherwise an interval may open ahead of a unit that has gone
        past, so what is in between is looked at too, taken to change in proportion.
        """
        before, design = self._before, self._design
        if before is None or (before.load == step.load and self._grows(before, step)):
            return [step.slip]
        old, new = before.load.on(design), step.load.on(design)
        between = []
        for index in range(1, STEPS):
            share = index / STEPS
            dead = DeadLoad(*_on_the_way(old, new, share))
            pair = Tensions(*_on_the_way(before.tensions, step.tensions, share))
            between.append(Slip(LoadedJoint.of(design, dead), sum(pair) - dead.size, *pair))
        return [*between, step.slip]

    def _grows(self, before: _Step, step: _Step) -> bool:
        """Whether r T g grows from one pair of tensions to the next at the angles ahead.

        By ΔT it grows with r + δ, by T with −∂K/∂T = −r (κ − w ∂κ/∂w).
        """
        side = math.copysign(1.0, step.margin)
        change_l = step.tensions.tension_l - before.tensions.tension_l
        change_s = step.tensions.tension_s - before.tensions.tension_s
        pull = self._design.relative_lever * side * (change_s - change_l)
        for slip in (before.slip, step.slip):
            ahead = slip if side > 0.0 else slip.mirrored()
            for index in range(-4, 5):
                point = ahead.at(0.25 * index * self._design.max_bend_angle)
                held = point.capacity - ahead.share * point.by_share
                if not pull >= held * (change_l + change_s):
                    return False
        return True


def _on_the_way(old: Sequence[float], new: Sequence[float], share: float) -> list[float]:
    return [before + share * (after - before) for before, after in zip(old, new, strict=True)]


@dataclass
class _Step:
    """What a tracker last saw, and the margin of the unit then."""

    tensions: Tensions
    load: Load
    slip: Slip
    margin: float
