"""In which order the joints of an arm slip while its tensions change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ..load import UPRIGHT, Load
from .arm import Arm
from .joints import arm_margins
from .state import ArmState
from .tracker import ArmTracker

STEPS = 500
"""Into which a ramp is cut"""

SHARE_TOLERANCE = 1e-9
"""How exactly the place on the ramp is told at which a joint slips"""


class JointSlip(NamedTuple):
    """The first slip of one joint on a ramp."""

    joint: int
    """Counted from 1 at the base"""
    side: str
    """``l`` or ``s``: where it slips to"""
    share: float
    """Of the ramp, from 0 to 1; 0 if it slips under the first tensions already"""
    tensions: dict[str, float]
    """Of each cable by name in N, then"""
    bend_angle: float
    """θ in rad from which it slips"""

    def as_dict(self) -> dict[str, Any]:
        """Return it ready for JSON."""
        return self._asdict()


def arm_slip_order(
    arm: Arm,
    start: Mapping[str, float],
    end: Mapping[str, float],
    load: Load = UPRIGHT,
    *,
    bend_angles: Sequence[float] | None = None,
) -> list[JointSlip]:
    """Return which joints slip while tensions change in proportion, each with its first slip.

    The arm is followed by an `ArmTracker`. Of joints that slip at once, the one with the largest
    margin just before is first: it may have freed the others.

    Parameters
    ----------
    start, end : mapping
        Tension in N of each cable by its name, at the base.
    load : Load
        As `ArmTracker.update` takes it.
    bend_angles : sequence of float, optional
        Where the joints are at first in rad; None: the arm is straight.

    Raises
    ------
    TensionError, BendAngleError, LoadError
        As `arm_margins` does. Slack joints are refused too.
    """
    first, last = (
        dict(zip(arm.cable_names, arm.check_tensions(t), strict=True)) for t in (start, end)
    )

    def tensions(share: float) -> dict[str, float]:
        return {name: (1.0 - share) * first[name] + share * last[name] for name in first}

    tracker = ArmTracker(arm, bend_angles)
    found: list[JointSlip] = []

    def note(
        share: float, before: Sequence[float], margins: Sequence[float], new: set[int]
    ) -> None:
        for joint in sorted(new, key=lambda joint: -abs(margins[joint])):
            after = tracker.bend_angles[joint]
            side = 's' if after > before[joint] else 'l'
            found.append(JointSlip(joint + 1, side, share, tensions(share), before[joint]))

    before = tracker.bend_angles
    margins: Sequence[Any] = arm_margins(arm, before, first, load)
    tracker.update(first, load)
    note(0.0, before, margins, _moved(before, tracker, set()))
    here = 0.0
    for index in range(1, STEPS + 1):
        share = index / STEPS
        while here < share:
            seen = {slip.joint - 1 for slip in found}
            reached = share
            trial, state = _tried(tracker, tensions(reached), load)
            new = _moved(tracker.bend_angles, trial, seen)
            if new:
                low = here
                while reached - low > SHARE_TOLERANCE:
                    middle = 0.5 * (low + reached)
                    other, _ = _tried(tracker, tensions(middle), load)
                    if _moved(tracker.bend_angles, other, seen):
                        reached, trial = middle, other
                    else:
                        low = middle
                new = _moved(tracker.bend_angles, trial, seen)
                _, state = _tried(tracker, tensions(low), load)
                margins = [margin or 0.0 for margin in state.slip_margins]
            before, tracker, here = tracker.bend_angles, trial, reached
            note(here, before, margins, new)
    return found


def _tried(
    tracker: ArmTracker, tensions: dict[str, float], load: Load
) -> tuple[ArmTracker, ArmState]:
    """Return a tracker that has gone on to other tensions, and the arm's state there."""
    other = tracker.copy()
    return other, other.update(tensions, load)


def _moved(before: Sequence[float], after: ArmTracker, seen: set[int]) -> set[int]:
    """Return the joints that are elsewhere, but for those that have been seen to slip."""
    return {
        joint
        for joint, (old, new) in enumerate(zip(before, after.bend_angles, strict=True))
        if old != new and joint not in seen
    }
