"""What a page says of an arm in words: HTML, from plain texts that are escaped here."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape
from typing import Any

from ..physics import Regime
from .arm_time_figures import line_colours
from .arm_values import JointSaid, TipSaid, joints_said, tip_said
from .estimate_values import colour_of_regime, regime_named
from .words import (
    REGIMES,
    angle,
    bullets,
    degrees_between,
    doubts_of_all,
    headline,
    number,
    table,
)

MEANINGS = {
    Regime.SLACK: 'A joint has no tension on one side: nothing is said of any joint.',
    Regime.DRIVEN_TO_STOP: 'Pressed against the stop.',
    Regime.SLIPPING: 'Slipped to where friction holds again.',
    Regime.HELD: 'Friction holds every joint where it is.',
}
"""Regime → what it means for an arm; the first that a joint has is what is said of the whole"""

NO_ARM = (
    'The arm is not drawn: the estimator does not tell its arm_file, or that file is not on this '
    'machine.'
)

HEADS = ('', 'joint', 'regime', 'bend angle', 'can hold at', 'slip margin', 'pressure [Pa]')


def arm_state_words(estimate: Any, said: str, age: float, *, is_drawn: bool = True) -> str:
    """Say what an estimate of an arm is, and what casts doubt on it.

    Parameters
    ----------
    said, age
        As of `is_present`.
    is_drawn
        Whether the arm is known, so that it is drawn.
    """
    joints = joints_said(estimate)
    regime = _worst(joints)
    name, meaning = (REGIMES[regime][0], MEANINGS[regime]) if regime else ('unknown', '')
    concerned = [joint.name for joint in joints if regime_named(joint.regime) is regime]
    if regime in (Regime.SLIPPING, Regime.DRIVEN_TO_STOP):
        meaning = f'{", ".join(concerned)}: {meaning[0].lower()}{meaning[1:]}'
    doubts = [*_doubts(estimate, joints), *([] if is_drawn else [NO_ARM])]
    head = headline(name, meaning, regime, said, age)
    return head + table(_numbers(estimate)) + bullets(doubts)


def joints_table(estimate: Any, admissible: Any = None, *, present: bool) -> str:
    """Say where each joint is, from the base on, with the colours of its lines and its regime.

    Parameters
    ----------
    admissible
        As of `joints_said`.
    """
    joints = joints_said(estimate, admissible)
    heads = ''.join(f'<th>{head}</th>' for head in HEADS)
    rows = ''.join(
        f'<tr>{"".join(f"<td>{cell}</td>" for cell in _cells(joint, line, present=present))}</tr>'
        for joint, line in zip(joints, line_colours(len(joints)), strict=True)
    )
    return f'<div class="joints"><table><tr>{heads}</tr>{rows}</table></div>'


def _cells(joint: JointSaid, line: str, *, present: bool) -> Iterator[str]:
    yield f'<span style="color:{line}">&#9473;</span>'
    yield escape(joint.name).replace('_', '_<wbr>')
    regime = regime_named(joint.regime)
    colour = colour_of_regime(regime, present=present)
    name = REGIMES[regime][0] if regime else joint.regime
    share = f' <small>{100.0 * joint.probability:.0f}&nbsp;%</small>'
    yield (
        f'<span style="color:{colour}">&#9679;</span>&nbsp;{escape(name)}'
        f'{share if math.isfinite(joint.probability) else ""}'
    )
    yield angle(joint.angle, joint.interval, '<br>').replace(' to ', '&nbsp;to ')
    yield _bands(joint)
    yield number(joint.slip_margin, '+.3f', '')
    yield number(joint.pressure, '.0f', '')


def _bands(joint: JointSaid) -> str:
    if joint.bands is None:
        return ''
    said = '<br>'.join(map(degrees_between, joint.bands)) or 'nowhere'
    return f'<small>{said.replace(" to ", "&nbsp;to ")}</small>'


def _worst(joints: Sequence[JointSaid]) -> Regime | None:
    there = {regime_named(joint.regime) for joint in joints}
    return next((regime for regime in MEANINGS if regime in there), None)


def _numbers(estimate: Any) -> Iterator[tuple[str, str]]:
    tip = tip_said(estimate)
    yield 'tip x', _millimetres(tip['x'])
    yield 'tip z', _millimetres(tip['z'])
    yield 'tip tilt', angle(*tip['tilt'])
    for name, tension in zip(estimate.cable_names, estimate.tensions, strict=False):
        yield f'tension {escape(name)}', f'{tension:.3f} N'


def _millimetres(tip: TipSaid) -> str:
    said = number(1e3 * tip.value, '.2f', ' mm')
    if tip.interval:
        low, high = (1e3 * end for end in tip.interval)
        said += f' <small>{low:.2f} to {high:.2f} mm</small>'
    return said


def _doubts(estimate: Any, joints: Sequence[JointSaid]) -> Iterator[str]:
    known = [joint for joint in joints if math.isfinite(joint.angle)]
    yield from doubts_of_all(estimate, has_angle=bool(known))
    moved = [joint.name for joint in known if not joint.is_assured]
    if moved:
        yield f'May have moved unseen, so that the angle is not assured: {", ".join(moved)}.'
