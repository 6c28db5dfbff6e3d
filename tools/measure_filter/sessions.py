"""Random sessions of a unit: what its tensions were, where it was, and what load cells said.

The truth is the exact tracker on tensions without noise, for a design that may be a little wrong.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tendon_statics import (
    DesignUncertainty,
    JointDesign,
    StickSlipTracker,
    default_design_path,
    load_design,
    slip_margin,
)
from tendon_statics.physics.draws import draw_designs

Floats = NDArray[np.float64]

PRELIMINARY = load_design(default_design_path())
UNITS = {
    'preliminary': (PRELIMINARY, 1.0),
    'hanging': (
        dataclasses.replace(
            PRELIMINARY,
            com_distance=-0.02,
            mass=0.08,
            friction_coefficient=0.4,
            contact_start_angle=math.radians(20.0),
            contact_end_angle=math.radians(50.0),
            cable_offset=0.0025,
        ),
        3.0,
    ),
    'backbone, friction circle': (
        dataclasses.replace(
            PRELIMINARY,
            friction_coefficient=0.25,
            contact_law='friction_circle',
            stiffness=0.02,
            mass=0.01,
        ),
        2.0,
    ),
    'backbone, elastic seat': (
        dataclasses.replace(
            PRELIMINARY,
            friction_coefficient=0.15,
            contact_law='elastic_seat',
            contact_start_angle=math.radians(20.0),
            contact_end_angle=math.radians(50.0),
            stiffness=0.03,
            mass=0.02,
        ),
        2.0,
    ),
}
"""Name → the unit, and the tension in N that the weaker cable keeps"""

PROGRAMS = ('ramps', 'staircases', 'cycles')
TOLERANCE = DesignUncertainty(
    ('friction_coefficient', 'cable_offset', 'mass'),
    ((0.01**2, 0.0, 0.0), (0.0, 5e-5**2, 0.0), (0.0, 0.0, 1e-3**2)),
)
"""What is known of a unit that is not quite its design"""

NOISES = (0.005, 0.01, 0.02)
"""N"""
RATES = (200.0, 500.0)
"""Hz"""


class Session(NamedTuple):
    """One session; arrays of one sample each."""

    unit: str
    program: str
    noise: float
    """Standard deviation in N"""
    design: JointDesign
    """As the filter has it"""
    uncertainty: DesignUncertainty | None
    """Of the design, from which the true one is drawn; None where the two are the same"""
    time: Floats
    bend_angle: Floats
    """True, in rad"""
    pressure: Floats
    """True, in Pa; NaN where the model stands behind none"""
    true_tension_s: Floats
    """In N"""
    tension_l: Floats
    """Measured, in N"""
    tension_s: Floats

    @property
    def samples(self) -> Iterator[tuple[float, float, float, float, float]]:
        """Time, true angle and pressure and measured tensions, sample by sample."""
        arrays = (self.time, self.bend_angle, self.pressure, self.tension_l, self.tension_s)
        return zip(*(array.tolist() for array in arrays), strict=True)


def sessions(count: int, seconds: float, seed: int) -> Iterator[Session]:
    """Yield random sessions; units, programs, noises and rates in turn."""
    random = np.random.default_rng(seed)
    kinds = [
        *itertools.product(PROGRAMS, UNITS, RATES, [None]),
        *itertools.product(PROGRAMS[:1], UNITS, RATES, [TOLERANCE]),
    ]
    for _, (program, unit, rate, uncertainty) in zip(
        range(count), itertools.cycle(kinds), strict=False
    ):
        noise = float(random.choice(NOISES))
        yield session(unit, program, noise, rate, seconds, random, uncertainty)


def session(
    unit: str,
    program: str,
    noise: float,
    rate: float,
    seconds: float,
    random: np.random.Generator,
    uncertainty: DesignUncertainty | None = None,
) -> Session:
    """Return one random session, of `PROGRAMS` or of strokes from side to side."""
    design, weak = UNITS[unit]
    drive = _drive(design, weak, program, rate, seconds, random)
    tension_l, tension_s = weak + np.maximum(-drive, 0.0), weak + np.maximum(drive, 0.0)
    true = design
    if uncertainty is not None:
        normals = random.normal(size=(len(uncertainty.parameters), 1))
        (true,) = draw_designs(design, uncertainty, normals)
    tracker = StickSlipTracker(true)
    states = [
        tracker.update(*pair) for pair in zip(tension_l.tolist(), tension_s.tolist(), strict=True)
    ]
    return Session(
        *(unit, program, noise, design, uncertainty),
        np.arange(len(drive)) / rate,
        np.array([state.bend_angle for state in states]),
        np.array([state.pressure for state in states], float),
        tension_s,
        *(cable + random.normal(0.0, noise, len(drive)) for cable in (tension_l, tension_s)),
    )


def _drive(
    design: JointDesign,
    weak: float,
    program: str,
    rate: float,
    seconds: float,
    random: np.random.Generator,
) -> Floats:
    """By how much the stronger cable exceeds the weaker in N, positive for cable s."""
    count = int(seconds * rate)
    first, last = sorted(slip_tension(design, weak, share) for share in (0.0, 0.95))
    if program == 'cycles':
        height = (last - weak) * random.uniform(1.0, 1.12)
        phase = 2.0 * math.pi * np.arange(count) / rate / random.uniform(1.5, 5.0)
        return height * np.sin(phase)
    parts, now, turn = [np.zeros(1)], 0.0, 1.0
    while sum(map(len, parts)) < count:
        if program == 'strokes':
            now = _stroke(parts, now, turn * _slipping(design, weak, last, random), rate, random)
            turn = -turn
            continue
        level = _level(design, weak, first, last, random)
        longest = 2.0 if program == 'ramps' else 0.05
        way = (
            random.uniform(0.15 * longest, longest)
            if program == 'ramps'
            else random.uniform(0.01, longest)
        )
        steps = max(1, int(way * rate))
        parts.append(now + (level - now) * np.arange(1, steps + 1) / steps)
        parts.append(np.full(int(random.uniform(0.2, 2.0) * rate), level))
        now = level
    return np.concatenate(parts)[:count]


def _stroke(
    parts: list[Floats], now: float, level: float, rate: float, random: np.random.Generator
) -> float:
    """Append a ramp to a level and a rest; return the level."""
    steps = int(random.uniform(0.3, 1.0) * rate)
    parts.append(now + (level - now) * np.arange(1, steps + 1) / steps)
    parts.append(np.full(int(random.uniform(0.1, 0.6) * rate), level))
    return level


def _slipping(design: JointDesign, weak: float, last: float, random: np.random.Generator) -> float:
    """A drive in N with which the unit slips to some angle on its way, or to its stop."""
    return float(random.uniform(1.02 * slip_tension(design, weak, 0.0), 1.1 * last) - weak)


def _level(
    design: JointDesign, weak: float, first: float, last: float, random: np.random.Generator
) -> float:
    """Where a ramp or a step ends: 1 to 10 % below slip, beyond it, or anywhere before it."""
    onset = slip_tension(design, weak, 0.0)
    kind = random.random()
    if kind < 0.35:
        strong = onset * (1.0 - random.uniform(0.01, 0.10))
    elif kind < 0.8:
        strong = random.uniform(max(onset, first), 1.1 * max(onset, last))
    else:
        strong = random.uniform(weak, onset)
    return float(random.choice([-1.0, 1.0]) * max(strong - weak, 0.0))


def slip_tension(design: JointDesign, weak: float, share: float) -> float:
    """Tension of the stronger cable in N at which the unit slips at a share of its stop."""
    low, high = weak, 30.0 * weak
    for _ in range(60):
        middle = 0.5 * (low + high)
        if slip_margin(design, weak, middle, share * design.max_bend_angle) < 1.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
