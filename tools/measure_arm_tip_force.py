"""Measure how often the intervals of `arm_tip_force` hold the true force.

Random arms of 2 to 6 units of all laws, and the forces that all their joints can hold, come from
the tests' brute force, which shares no code with the package. Each true force is measured through
noisy tensions and noisy angles of all joints: of arms whose cables have no friction, of arms whose
designs are not quite the true ones, and of arms whose cables have friction that was used in some
way that is known at all joints, as by a tracker, or not, so that the tensions are those at the
base alone.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import random
import secrets
import sys
from pathlib import Path

import numpy as np
from measure_tip_force import DESIGN_SHARES

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'test/support'))

from arm_pushed import Pushed, joint_excesses, joints_held, random_pushed, with_used_friction

from tendon_statics import Arm, DesignUncertainty, TensionError
from tendon_statics.command_line.tables import markdown_table

TENSION_SHARE = 0.01
"""Noise of each tension, as a share of their mean"""
ANGLE_STDDEV = math.radians(0.5)
GRID = np.linspace(-1.0, 1.0, 2001)[1:-1]
CABLE_FRICTION = 0.02, 0.2
"""Range of the coefficient, where cables have friction"""

KINDS = {
    'end': 'at an end of the exact set',
    'inside': 'anywhere inside it',
    'slipping': 'at an end, while a joint is known to slip',
}
CONDITIONS = {
    'exact': 'no cable friction',
    'uncertain': 'design uncertain',
    'joints': 'friction, tensions at the joints',
    'base': 'friction, tensions at the base',
}


def main(arguments: list[str] | None = None) -> int:
    """Print the coverage as a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--arms', type=int, default=150, help='default: %(default)s')
    parser.add_argument('--draws', type=int, default=3, help='of each arm and kind of force')
    parser.add_argument('--seed', type=int, help='default: a fresh one')
    options = parser.parse_args(arguments)
    seed = secrets.randbits(32) if options.seed is None else options.seed
    found: dict[tuple[str, str], list[bool]] = {}
    for number in range(options.arms):
        draw = random.Random(f'{seed} {number}')
        for has_friction in (False, True):
            case, intervals = true_arm(draw, has_friction=has_friction)
            for condition in ('joints', 'base') if has_friction else ('exact', 'uncertain'):
                for kind in KINDS:
                    results = [
                        asked(draw, case, intervals, kind, condition) for _ in range(options.draws)
                    ]
                    known = [result for result in results if result is not None]
                    found.setdefault((kind, condition), []).extend(known)
        print(f'\r{number + 1} of {options.arms} arms', end='', file=sys.stderr)
    print(file=sys.stderr)
    rows = []
    for kind, text in KINDS.items():
        of_kind = [found[kind, condition] for condition in CONDITIONS]
        shares = [f'{100.0 * float(np.mean(of)):.1f} %' if of else '-' for of in of_kind]
        rows.append([text, *shares, str(min(map(len, of_kind)))])
    titles = (f'{text}:' for text in CONDITIONS.values())
    print(markdown_table(('true force', *titles, 'draws each, at least:'), rows))
    print(f'\n{options.arms} arms of each, level 95 %, seed {seed}')
    return 0


def true_arm(
    draw: random.Random, *, has_friction: bool = False
) -> tuple[Pushed, list[tuple[float, float]]]:
    """Draw an arm, and the forces that its joints can hold, of which there is an end."""
    while True:
        case = random_pushed(draw, friction=False)
        if has_friction:
            friction = draw.uniform(*CABLE_FRICTION)
            arm = dataclasses.replace(case.arm, cable_friction_coefficient=friction)
            case = with_used_friction(draw, case._replace(arm=arm))
        intervals = exact_set(case)
        if any(math.isfinite(end) for interval in intervals for end in interval):
            return case, intervals


def asked(
    draw: random.Random,
    case: Pushed,
    intervals: list[tuple[float, float]],
    kind: str,
    condition: str,
) -> bool | None:
    """Draw a true force and measurements; say whether the interval holds it, if there is one."""
    force = true_force(draw, intervals, 'inside' if kind == 'inside' else 'an end')
    if force is None:
        return None
    slipping = {} if kind != 'slipping' else slipping_joint(case, force)
    if slipping is None:
        return None
    return covered(draw, case, force, slipping=slipping, condition=condition)


def slipping_joint(case: Pushed, force: float) -> dict[int, str] | None:
    """Return the joint that is at its limit under a force, and to which side; None if it lifts."""
    found = []
    for joint, (_, *excesses) in enumerate(joint_excesses(case, force), start=1):
        scale = case.arm.designs[joint - 1].ball_radius * case.scale
        found += [(abs(by) / scale, joint, to) for by, to in zip(excesses, 'sl', strict=True)]
    off, joint, to = min(found)
    return {joint: to} if off < 1e-6 else None


def exact_set(case: Pushed) -> list[tuple[float, float]]:
    """Return the forces that all joints hold: a fine grid, and halving between its points."""
    grid = case.scale * GRID / (1.0 - GRID**2)
    is_held = joints_held(case, grid).all(axis=0)
    changes = np.flatnonzero(is_held[:-1] != is_held[1:])
    low, high = grid[changes], grid[changes + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = joints_held(case, middle).all(axis=0) == is_held[changes]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    ends = [*([-math.inf] if is_held[0] else []), *low, *([math.inf] if is_held[-1] else [])]
    return [(float(a), float(b)) for a, b in zip(ends[::2], ends[1::2], strict=True)]


def true_force(draw: random.Random, intervals: list, kind: str) -> float | None:
    """Draw a force at a finite end, or inside an interval that has two."""
    interval = draw.choice(intervals)
    ends = [end for end in interval if math.isfinite(end)]
    if kind == 'inside':
        return draw.uniform(*interval) if len(ends) == 2 else None
    return draw.choice(ends) if ends else None


def covered(
    draw: random.Random,
    case: Pushed,
    force: float,
    *,
    slipping: dict[int, str] | None = None,
    condition: str = 'exact',
) -> bool | None:
    """Measure an arm that is pushed; say whether the interval holds the force."""
    stddev = TENSION_SHARE * float(np.mean([np.max(of) for of in case.tensions.values()]))
    tensions = {}
    for name, true in case.tensions.items():
        at_base = float(np.ravel(true)[0]) + draw.gauss(0.0, stddev)
        if at_base <= 0.0:
            return None
        # What friction has made of it on the way is known, or nothing of it is.
        along = at_base / np.ravel(true)[0] * np.ravel(true)
        tensions[name] = along.tolist() if condition == 'joints' else at_base
    angles = [
        min(max(angle + draw.gauss(0.0, ANGLE_STDDEV), -stop), stop)
        for angle, stop in zip(case.angles, case.arm.stops, strict=True)
    ]
    arm, uncertainties = believed(draw, case.arm) if condition == 'uncertain' else (case.arm, None)
    try:
        found = case.found(
            arm=arm,
            tensions=tensions,
            bend_angles=angles,
            slipping=slipping or {},
            tension_stddev=stddev,
            bend_angle_stddev=ANGLE_STDDEV,
            design_covariance=uncertainties,
        )
    except TensionError:
        return None
    return any(low <= force <= high for low, high in found.intervals)


def believed(draw: random.Random, arm: Arm) -> tuple[Arm, list[DesignUncertainty]]:
    """Return an arm of designs that are not quite the true ones, and how well each is known."""
    units, uncertainties = [], []
    for unit in arm.units:
        values = {name: getattr(unit.design, name) for name in DESIGN_SHARES}
        changed = {
            name: value * (1.0 + draw.gauss(0.0, DESIGN_SHARES[name]))
            for name, value in values.items()
        }
        design = dataclasses.replace(unit.design, **changed)
        units.append(dataclasses.replace(unit, design=design))
        variances = [(value * DESIGN_SHARES[name]) ** 2 for name, value in values.items()]
        covariance = tuple(map(tuple, np.diag(variances).tolist()))
        uncertainties.append(DesignUncertainty(tuple(values), covariance))
    return dataclasses.replace(arm, units=tuple(units)), uncertainties


if __name__ == '__main__':
    sys.exit(main())
