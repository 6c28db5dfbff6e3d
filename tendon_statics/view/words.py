"""What a page says in words: HTML, from plain texts that are escaped here."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from html import escape
from typing import Any

from ..estimation.regimes import INVALID, STALE
from ..physics import Regime
from .estimate_values import (
    COVERAGE,
    GREY,
    OLD,
    angle_interval,
    colour_of_regime,
    is_present,
    pairs_of,
    regime_named,
)

REGIMES = {
    Regime.EQUILIBRIUM: (
        'equilibrium',
        'On the verge of slipping, at the angle that is given.',
    ),
    Regime.HELD: ('held', 'Friction holds the unit where it is.'),
    Regime.SLIPPING: ('slipping', 'The unit has slipped to where friction holds it again.'),
    Regime.DRIVEN_TO_STOP: (
        'driven to the stop',
        'Friction holds the unit nowhere on its way to the stop.',
    ),
    Regime.SLACK: ('slack', 'A cable carries no tension: outside the model.'),
}
"""Regime → its name and what it means"""

STYLE = """
  h2 { margin: 0 0 0.2rem; font-size: 1.7rem; }
  h2 small { font-size: 0.9rem; font-weight: normal; }
  p { margin: 0 0 0.5rem; font-size: 0.95rem; }
  table { border-collapse: collapse; font-size: 1rem; font-variant-numeric: tabular-nums; }
  th { text-align: left; font-weight: normal; color: #666; padding: 0.1rem 1rem 0.1rem 0; }
  td small { color: #666; padding-left: 0.5rem; }
  ul { margin: 0.5rem 0 0; padding-left: 1.2rem; font-size: 0.9rem; }
  b { padding: 0.1rem 0.5rem; border-radius: 4px; color: #fff; background: #777777; }
  .joints { overflow-x: auto; } .joints table { font-size: 0.8rem; }
  .joints th, .joints td { padding: 0.15rem 0.4rem 0.15rem 0; vertical-align: top; }
  .joints th { font-size: 0.7rem; } .joints small { padding: 0; }
  .level-ok { background: #00734f; } .level-warn { background: #9a6a00; }
  .level-error { background: #b34700; }
"""
"""How the words look"""

NOT_DETERMINED = 'Where in the band it is, the tensions alone do not tell.'

WITHOUT_ESTIMATE = {
    INVALID: 'The newest reading has no valid tensions.',
    STALE: 'No valid tensions come any more.',
    '': 'Nothing comes from it any more.',
}
"""What the estimator says in place of an estimate, ``''`` for nothing → what that means"""

LAST_KNOWN = 'What is drawn and listed is the last that was known.'

NO_DESIGN = 'The unit is not drawn, since the estimator does not tell its design.'

LEVELS = ('OK', 'WARN', 'ERROR', 'STALE')
"""Words for the levels of ``/diagnostics``, by their numbers"""

NOTEWORTHY = ('rate [Hz]', 'mean solve time [ms]', 'messages lost on the way', 'dropped: ')
"""Beginnings of the values of ``/diagnostics`` that a page shows, but for those that are 0"""


def nobody(domain: str, asked: str) -> str:
    """Say that there is no estimator, or not the one that was asked for."""
    what = f'The estimator {asked} is not in sight.' if asked else 'No estimator is in sight.'
    return (
        f'<h2 style="color:{GREY}">waiting</h2><p>{escape(what)} It has to run in the same '
        f'ROS domain, here {escape(domain)}: <code>ros2 run tendon_statics estimator</code></p>'
    )


def waiting(name: str, said: str) -> str:
    """Say that an estimator is there, and that no estimate came yet.

    Parameters
    ----------
    said
        ``invalid`` or ``stale``, if the estimator says so.
    """
    if said:
        return (
            f'<h2 style="color:{GREY}">{escape(said)}</h2><p>{escape(WITHOUT_ESTIMATE[said])} '
            'No estimate has come since this page was opened.</p>'
        )
    return (
        f'<h2 style="color:{GREY}">waiting</h2><p>{escape(name)} is there, but has sent no '
        'estimate yet: do tensions come, and is the node active?</p>'
    )


def state_words(estimate: Any, said: str, age: float, *, is_drawn: bool = True) -> str:
    """Say what an estimate is, and what casts doubt on it.

    Parameters
    ----------
    said, age
        As of `is_present`.
    is_drawn
        Whether the unit's design is known, so that it is drawn.
    """
    regime = regime_named(estimate.regime)
    name, meaning = REGIMES[regime] if regime else (estimate.regime, '')
    if regime is Regime.HELD and not math.isfinite(estimate.bend_angle):
        meaning += f' {NOT_DETERMINED}' if estimate.admissible_angles else ''
    doubts = [*_doubts(estimate), *([] if is_drawn else [NO_DESIGN])]
    head = headline(name, meaning, regime, said, age)
    return head + table(_numbers(estimate)) + bullets(doubts)


def headline(name: str, meaning: str, regime: Regime | None, said: str, age: float) -> str:
    """Say what is, large, and what it means; or what was, and how old it is, if it is old.

    Parameters
    ----------
    name, meaning, regime
        Of the state: how it is called, what it means, and whose colour it has.
    said, age
        As of `is_present`.
    """
    present = is_present(said, age)
    if not present:
        name, meaning = said or name, f'{WITHOUT_ESTIMATE[said]} {LAST_KNOWN}'
    colour = colour_of_regime(regime, present=present)
    old = f' <small>{age:.0f} s ago</small>' if age > OLD else ''
    return f'<h2 style="color:{colour}">{escape(name)}{old}</h2><p>{escape(meaning)}</p>'


def table(rows: Iterable[tuple[str, str]]) -> str:
    """Say values by name, in HTML that is escaped already."""
    lines = (f'<tr><th>{label}</th><td>{value}</td></tr>' for label, value in rows)
    return f'<table>{"".join(lines)}</table>'


def _numbers(estimate: Any) -> Iterator[tuple[str, str]]:
    pressure = number(estimate.pressure, '.1f', ' Pa')
    if math.isfinite(estimate.pressure) and math.isfinite(estimate.pressure_stddev):
        pressure += f' <small>± {COVERAGE * estimate.pressure_stddev:.1f}</small>'
    yield 'bend angle', angle(estimate.bend_angle, angle_interval(estimate))
    if regime_named(estimate.regime) is not Regime.SLACK:
        bands = pairs_of(list(estimate.admissible_angles))
        yield 'can hold at', ', '.join(map(degrees_between, bands)) or 'nowhere'
    yield 'pressure', pressure
    yield 'slip margin', number(estimate.slip_margin, '+.3f', '')
    if math.isfinite(estimate.consistency):
        yield 'consistency', f'{estimate.consistency:.3f}'
    yield 'tensions l, s', f'{estimate.tension_l:.3f} N, {estimate.tension_s:.3f} N'


def angle(value: float, interval: tuple[float, float] | None, between: str = ' ') -> str:
    """Say an angle in rad, and where it is believed to be."""
    said = number(math.degrees(value), '.2f', '°')
    return f'{said}{between}<small>{degrees_between(interval)}</small>' if interval else said


def degrees_between(interval: tuple[float, float]) -> str:
    """Say an interval of an angle, of which the ends are in rad."""
    low, high = map(math.degrees, interval)
    return f'{low:.1f} to {high:.1f}°'


def number(value: float, form: str, unit: str) -> str:
    """Say a number, or that there is none."""
    return f'{value:{form}}{unit}' if math.isfinite(value) else 'not determined'


def doubts_of_all(estimate: Any, *, has_angle: bool) -> Iterator[str]:
    """Say what casts doubt on an estimate of a unit and of an arm alike."""
    if not estimate.load_assured:
        yield 'No message tells the load at present; the last known load is used.'
    if has_angle and estimate.provisional:
        yield 'Provisional: later readings may revise it.'


def _doubts(estimate: Any) -> Iterator[str]:
    has_angle = math.isfinite(estimate.bend_angle)
    yield from doubts_of_all(estimate, has_angle=has_angle)
    if not has_angle:
        return
    if not estimate.angle_assured:
        yield 'The unit may have moved unseen: its angle is not assured.'
    if not estimate.branch_consistent:
        yield 'The forces ask for the other root of the model.'
    if estimate.root_count and not estimate.stable:
        yield 'Pushed past this angle, the unit slides on to the stop.'


def diagnostics_words(status: Any, age: float) -> str:
    """Say what an estimator says of itself on ``/diagnostics``."""
    if status is None:
        return '<p>Nothing came on <code>/diagnostics</code> yet.</p>'
    level = status.level[0] if isinstance(status.level, bytes) else status.level
    word = LEVELS[level] if level < len(LEVELS) else str(level)
    old = f' <small>{age:.0f} s ago</small>' if age > 3.0 else ''
    values = (
        f'{value.key}: {value.value}'
        for value in status.values
        if value.key.startswith(NOTEWORTHY) and value.value not in ('', '0')
    )
    return (
        f'<p><b class="level-{word.lower()}">{word}</b>{old} {escape(status.message)}</p>'
        f'{bullets(values)}'
    )


def bullets(texts: Iterable[str]) -> str:
    """Say one thing a line."""
    items = ''.join(f'<li>{escape(text)}</li>' for text in texts)
    return f'<ul>{items}</ul>' if items else ''
