"""A pair of cable tensions, and whether the model takes it."""

from __future__ import annotations

import math
import numbers
from typing import NamedTuple

from .design import JointDesign
from .errors import TensionError
from .load import UPRIGHT, Load, tension_excess
from .loaded_joint import loaded_joint
from .named import named
from .slip import Slip

NEGLIGIBLE_PULL = 1e-9
"""Share of the dead load below which cable tensions count for nothing"""

MAX_TENSION = 1e9
"""Largest tension in N that is taken; far above any cable, far below overflow."""


class Tensions(NamedTuple):
    """A pair of cable tensions in N."""

    tension_l: float
    tension_s: float

    @property
    def slack_cable(self) -> str:
        """``l`` or ``s``, the first cable without tension; empty if both are taut."""
        return 'l' if self.tension_l == 0.0 else 's' if self.tension_s == 0.0 else ''


def check_tensions(tension_l: object, tension_s: object) -> Tensions:
    """Return two tensions as floats, if each may be one; a slack cable (0 N) may.

    Raises
    ------
    TensionError
        If one is not a number, not finite, negative or above `MAX_TENSION`.
    """
    if type(tension_l) is not float:
        tension_l = _as_float('tension_l', tension_l)
    if not 0.0 <= tension_l <= MAX_TENSION:
        raise _out_of_range('tension_l', tension_l)
    if type(tension_s) is not float:
        tension_s = _as_float('tension_s', tension_s)
    if not 0.0 <= tension_s <= MAX_TENSION:
        raise _out_of_range('tension_s', tension_s)
    return named(Tensions, (tension_l, tension_s))


def check_taut(tensions: Tensions) -> Tensions:
    """Return two tensions of which neither is that of a slack cable.

    Raises
    ------
    TensionError
        If one is.
    """
    if tensions.slack_cable:
        raise TensionError(
            f'tension_{tensions.slack_cable} is 0.0 N: the cable is slack, '
            'which is outside the model'
        )
    return tensions


def taut_slip(
    design: JointDesign,
    tensions: Tensions,
    load: Load,
    side: float = 1.0,
    bend_angle: float | None = None,
) -> Slip:
    """Return the slip function of two taut cables towards cable s, or towards l for a side of −1.

    Parameters
    ----------
    bend_angle : float, optional
        The one angle in rad at which it is asked for, where the joint has to be seated; without
        it at all between the stops.

    Raises
    ------
    TensionError
        If a cable is slack, or the two do not seat the joint.
    """
    tension_l, tension_s = tensions
    if tension_l == 0.0 or tension_s == 0.0:
        check_taut(tensions)
    joint = loaded_joint(design, load)
    excess = tension_excess(design, load, joint.size, tension_l, tension_s)
    if not excess > 0.0:
        _check_that_it_presses(design, tensions, load, bend_angle)
    return Slip(joint, excess, tension_l, tension_s, side)


def _check_that_it_presses(
    design: JointDesign, tensions: Tensions, load: Load, bend_angle: float | None
) -> None:
    """Refuse tensions that the dead load exceeds, unless it presses the unit on the ball."""
    dead = load.on(design)
    least = dead.size
    if design.law.carries_more_than_cables:
        pull = dead.largest_pull(design.max_bend_angle)
        if bend_angle is not None:
            pull = design.law.seating_tension(*dead.at(bend_angle))
        least = max(pull, NEGLIGIBLE_PULL * least)
    if least == dead.size or not sum(tensions) > least:
        raise _unseated(tensions, load, least)


def _unseated(tensions: Tensions, load: Load, least: float) -> TensionError:
    """Say that a joint is not seated."""
    what = "the unit's weight" if load == UPRIGHT else 'the pull of weight and tip force'
    tension_l, tension_s = tensions
    return TensionError(
        f'tension_l + tension_s is {tension_l!r} + {tension_s!r} = {sum(tensions):.6g} N, '
        f'which must exceed {what} of {least:.6g} N'
    )


def _out_of_range(name: str, value: float) -> TensionError:
    return TensionError(f'{name} is {value!r} N, allowed is 0 to {MAX_TENSION:g} N')


def _as_float(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TensionError(f'{name} is {value!r}, which is not a number; it is taken in N')
    try:
        return float(value)
    except OverflowError:
        return math.inf
