"""The forces at the tip of an arm that friction can hold: against brute force, and properties."""

import dataclasses
import math
import random
from collections import Counter
from pathlib import Path
from statistics import NormalDist
from typing import NamedTuple

import arm_brute
import brute
import numpy as np
import pytest
from arm_pushed import joints_held, random_pushed
from arms import arm_of
from designs import PRELIMINARY
from thoroughness import some_of

from tendon_statics import (
    Arm,
    ArmError,
    ArmTracker,
    ArmUnit,
    BendAngleError,
    Cable,
    DesignUncertainty,
    Load,
    LoadError,
    Regime,
    TensionError,
    arm_margins,
    arm_tip_force,
    load_arm,
    tip_force,
    tip_force_intervals,
)
from tendon_statics.physics.arm.force_doubt import ArmDoubt

CONFIG = Path(__file__).parents[2] / 'config'
COUNT = 200
GRID = np.linspace(-1.0, 1.0, 2001)[1:-1]
EXACT = 1e-9


@pytest.fixture(scope='module')
def pushed():
    """Random arms at random angles, and lines along which they are pushed."""
    draw = random.Random(1818)
    return [random_pushed(draw) for _ in range(some_of(COUNT))]


def inside(intervals, force, slack=0.0):
    return any(low - slack <= force <= high + slack for low, high in intervals)


def finite_ends(intervals):
    return [end for interval in intervals for end in interval if math.isfinite(end)]


def bisected(holds, low, high):
    """Where a condition changes between two forces."""
    at_low = holds(low)
    while high - low > 1e-13 * max(1.0, abs(high)):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        low, high = (middle, high) if holds(middle) == at_low else (low, middle)
    return low


def test_the_sample_holds_no_and_one_interval_and_rays_and_ends_of_different_joints(pushed):
    seen, bounding = Counter(), Counter()
    for case in pushed:
        found = case.found()
        seen[min(len(found.intervals), 2)] += 1
        seen['ray'] += any(math.isinf(end) for interval in found.intervals for end in interval)
        for joints in found.bounding_joints:
            bounding.update(joints)
            seen['two joints'] += len({*joints} - {None}) == 2
    assert all(seen[kind] for kind in (0, 1, 'ray', 'two joints')), seen
    assert len(bounding) > 3, bounding


def test_every_end_is_where_sums_of_forces_and_levers_have_one(pushed):
    for case in pushed:
        found = case.found()
        grid = case.scale * GRID / (1.0 - GRID**2)
        rows = joints_held(case, grid)
        for held, intervals in zip(
            [*rows, rows.all(axis=0)], [*found.joint_intervals, found.intervals], strict=True
        ):
            wrong = held != np.any([(low <= grid) & (grid <= high) for low, high in intervals], 0)
            for end in finite_ends(intervals):
                wrong &= abs(grid - end) > 1e-6 * case.scale
            assert not wrong.any(), (case, grid[wrong], found)
        held = rows.all(axis=0)

        def holds(force, case=case):
            return bool(joints_held(case, force).all())

        for index in np.flatnonzero(held[:-1] != held[1:]):
            end = bisected(holds, *grid[index : index + 2])
            off = min(abs(end - one) for one in finite_ends(found.intervals))
            assert off < EXACT * max(1.0, abs(end)), (case, end, found)


def test_every_end_is_where_the_margins_of_the_joints_have_one():
    draw = random.Random(1820)
    compared = 0
    for _ in range(some_of(40)):
        case = random_pushed(draw)
        found = case.found()

        def margins(force, case=case):
            x, z = force * case.direction + case.load.tip_force
            load = dataclasses.replace(case.load, tip_force=(float(x), float(z)))
            try:
                return arm_margins(case.arm, case.angles, case.tensions, load)
            except TensionError:  # which asks for a seat wherever the arm may be
                return None

        def holds(force, margins=margins):
            return max(map(abs, margins(force) or (2.0,))) <= 1.0

        for force in np.linspace(-case.scale, case.scale, 40).tolist():
            if (of_joints := margins(force)) is not None:
                for margin, intervals in zip(of_joints, found.joint_intervals, strict=True):
                    assert inside(intervals, force) == (abs(margin) <= 1.0)
                compared += 1
        for ends, joints in zip(found.intervals, found.bounding_joints, strict=True):
            for end, joint in zip(ends, joints, strict=True):
                if joint is None or margins(end) is None:
                    continue
                assert abs(margins(end)[joint - 1]) == pytest.approx(1.0, abs=1e-8)
                step = 1e-6 * max(1.0, abs(end))
                if holds(end - step) != holds(end + step):
                    exact = bisected(holds, end - step, end + step)
                    assert end == pytest.approx(exact, rel=EXACT, abs=EXACT)
    assert compared > 10 * some_of(40)


@pytest.mark.parametrize('at_stop', [(), (1,)])
def test_an_arm_of_one_unit_is_the_single_unit_to_the_last_bit(at_stop):
    draw = random.Random(1821)
    for _ in range(some_of(100)):
        case = brute.random_case(draw)
        angle = draw.uniform(-1.0, 1.0) * case.design.max_bend_angle
        of, length = draw.uniform(-math.pi, math.pi), draw.uniform(0.0, 0.06)
        load = dataclasses.replace(case.load, tip_distance=length)
        line = {'direction': (math.sin(of), math.cos(of)), 'load': load}
        arm = arm_of([ArmUnit(case.design, length)])
        tensions = {'l': case.tension_l, 's': case.tension_s}
        found = arm_tip_force(arm, tensions, bend_angles=[angle], at_stop=at_stop, **line)
        single = tip_force(
            *(case.design, case.tension_l, case.tension_s),
            **{'bend_angle': angle, 'distance': length, 'at_stop': bool(at_stop), **line},
        )
        assert found.intervals == found.joint_intervals[0] == single.intervals
        assert found.bounding_joints == [
            tuple(1 if math.isfinite(end) else None for end in interval)
            for interval in single.intervals
        ]


def test_each_joint_can_only_narrow_the_set(pushed):
    for case in pushed:
        found = case.found()
        for (low, high), joints in zip(found.intervals, found.bounding_joints, strict=True):
            assert low <= high
            for one in found.joint_intervals:
                assert any(a - EXACT <= low and high <= b + EXACT for a, b in one)
            for end, joint in zip((low, high), joints, strict=True):
                assert (joint is None) == math.isinf(end)
                own = [] if joint is None else found.joint_intervals[joint - 1]
                assert joint is None or end in finite_ends(own) or low == high


def test_what_is_below_a_joint_does_not_change_what_it_tells():
    """The arm without its first unit, in that one's frame, has the sets of the others."""
    draw = random.Random(1822)
    for _ in range(some_of(60)):
        case = random_pushed(draw, friction=False)
        if len(case.arm.units) < 2:
            continue
        turn = case.angles[0]
        cables = [
            dataclasses.replace(cable, last_unit=cable.last_unit - 1)
            for cable in case.arm.cables
            if cable.last_unit > 1
        ]

        def turned(x, z, turn=turn):
            cosine, sine = math.cos(turn), math.sin(turn)
            return x * cosine - z * sine, x * sine + z * cosine

        gravity_x, _, gravity_z = case.load.gravity_direction
        gravity_x, gravity_z = turned(gravity_x, gravity_z)
        rest = arm_tip_force(
            Arm(case.arm.units[1:], cables),
            {cable.name: case.tensions[cable.name] for cable in cables},
            bend_angles=case.angles[1:],
            direction=turned(*case.direction),
            load=Load((gravity_x, 0.0, gravity_z), turned(*case.load.tip_force)),
        )
        for one, other in zip(case.found().joint_intervals[1:], rest.joint_intervals, strict=True):
            assert np.allclose(one, other, rtol=1e-8, atol=1e-9)


def test_the_reverse_direction_has_the_mirrored_set(pushed):
    for case in pushed:
        found, other = case.found(), case.found(direction=-case.direction)
        mirrored = [(-high, -low) for low, high in reversed(other.intervals)]
        assert np.allclose(found.intervals, mirrored, rtol=1e-12, atol=1e-12)


def test_the_force_asked_for_adds_to_a_known_one(pushed):
    for case in pushed:
        bare = case.found(load=dataclasses.replace(case.load, tip_force=(0.0, 0.0)))
        known = 0.1 * case.direction
        more = case.found(load=dataclasses.replace(case.load, tip_force=tuple(known)))
        for one, other in zip(bare.joint_intervals, more.joint_intervals, strict=True):
            moved = [(low - 0.1, high - 0.1) for low, high in one]
            assert np.allclose(moved, other, rtol=1e-7, atol=1e-7)


def test_within_the_set_the_arm_stays_where_it_is_and_beyond_an_end_the_joint_named_slips():
    """Asked of a tracker, whose cables remember how their friction was used."""
    draw = random.Random(1823)
    asked = Counter()
    for _ in range(some_of(60)):
        arm = arm_brute.random_arm(draw)
        base = Load.tilted(draw.choice((0.0, draw.uniform(-0.5, 0.5))))
        tracker = ArmTracker(arm)
        for _ in range(3):
            tensions = arm_brute.random_pull(draw, arm, base)
            try:
                state = tracker.update(tensions, base)
            except TensionError:
                break
        else:
            at_stop = [
                number
                for number, (angle, stop) in enumerate(
                    zip(state.bend_angles, arm.stops, strict=True), start=1
                )
                if abs(angle) == stop
            ]
            of = draw.uniform(-math.pi, math.pi)
            direction = math.sin(of), math.cos(of)
            found = arm_tip_force(
                *(arm, state.cable_tensions),
                bend_angles=state.bend_angles,
                direction=direction,
                load=base,
                at_stop=at_stop,
            )
            scale = sum(tensions.values())
            assert inside(found.intervals, 0.0, 1e-7 * scale), (state, found)

            def moved(force, tracker=tracker, tensions=tensions, base=base, direction=direction):
                other = tracker.copy()
                load = dataclasses.replace(
                    base, tip_force=(force * direction[0], force * direction[1])
                )
                other.update(tensions, load)
                before = tracker.bend_angles
                return [
                    i for i, angle in enumerate(other.bend_angles, 1) if angle != before[i - 1]
                ]

            for ends, joints in zip(found.intervals, found.bounding_joints, strict=True):
                for end, joint, out in zip(ends, joints, (-1.0, 1.0), strict=True):
                    if joint is None or ends[1] - ends[0] < 1e-3 * scale:
                        continue
                    try:
                        assert not moved(end - out * 1e-5 * scale)
                        slipping = moved(end + out * 1e-5 * scale)
                    except TensionError:
                        asked['unseated'] += 1
                        continue
                    assert joint in slipping, (found, end, joint, slipping)
                    asked['slips'] += 1
    assert asked['slips'] > some_of(40), asked


def test_tensions_at_the_joints_are_those_at_the_base_where_cables_have_no_friction():
    arm = load_arm(CONFIG / 'arm.yaml')
    arm = dataclasses.replace(arm, cable_friction_coefficient=0.0)
    at_base = {'l_mid': 1.0, 's_mid': 1.1, 'l_tip': 1.0, 's_tip': 1.3}
    line = {'bend_angles': [0.1, 0.0, -0.1, 0.1, 0.0], 'direction': (1.0, 0.0)}
    at_joints = {cable.name: (at_base[cable.name],) * cable.last_unit for cable in arm.cables}
    expected = arm_tip_force(arm, at_base, **line)
    assert arm_tip_force(arm, at_joints, **line) == expected
    mixed = {**at_base, 's_tip': np.array(at_joints['s_tip'])}
    assert arm_tip_force(arm, mixed, **line) == expected


def test_a_joint_at_its_stop_narrows_the_set_on_one_side_only():
    unit = ArmUnit(PRELIMINARY, 0.02)
    arm = arm_of([unit, unit])
    asked = {
        'bend_angles': [PRELIMINARY.max_bend_angle, 0.0],
        'direction': (1.0, 0.0),
    }
    free = arm_tip_force(arm, {'l': 1.0, 's': 1.0}, **asked)
    leaning = arm_tip_force(arm, {'l': 1.0, 's': 1.0}, at_stop=[1], **asked)
    ((low, high),), ((leaning_low, leaning_high),) = (
        found.joint_intervals[0] for found in (free, leaning)
    )
    assert leaning_low == low
    assert leaning_high > high
    assert leaning.joint_intervals[1] == free.joint_intervals[1]


UNIT = ArmUnit(PRELIMINARY, 0.02)
ARM = arm_of([UNIT, UNIT])
EVEN = {'l': 1.0, 's': 1.0}


def test_joints_that_contradict_one_another_leave_no_force():
    # The base is pulled far to one side, the tip to the other, which no one force explains.
    arm = Arm(
        [UNIT, UNIT],
        [Cable('l1', 'l', 1), Cable('s1', 's', 1), Cable('l2', 'l', 2), Cable('s2', 's', 2)],
    )
    tensions = {'l1': 1.0, 's1': 20.0, 'l2': 3.0, 's2': 1.0}
    found = arm_tip_force(arm, tensions, bend_angles=[0.0, 0.0], direction=(1.0, 0.0))
    assert all(found.joint_intervals)
    assert found.intervals == found.bounding_joints == []


@pytest.mark.parametrize(
    ('changed', 'error', 'reason'),
    [
        ({'direction': (0.0, 0.0)}, LoadError, 'length zero'),
        ({'direction': (0.0, 1.0, 0.0)}, LoadError, 'out of the plane'),
        ({'direction': (1.0, 1.0)}, LoadError, r'such as \(0.707107, 0.707107\)'),
        ({'bend_angles': (0.1,)}, BendAngleError, 'has 2 joints'),
        ({'bend_angles': (0.1, 0.6)}, BendAngleError, 'joint 2: bend_angle is 0.6'),
        ({'tensions': {'l': 1.0}}, TensionError, 'cable s is missing'),
        ({'tensions': {**EVEN, 't': 1.0}}, TensionError, "no cable 't'"),
        ({'tensions': {**EVEN, 't': (1.0, 1.0)}}, TensionError, "no cable 't'"),
        ({'tensions': {**EVEN, 's': 0.0}}, TensionError, 'joint 1 is slack'),
        ({'tensions': {**EVEN, 's': (1.0, 0.0)}}, TensionError, 'joint 2 is slack'),
        ({'tensions': {**EVEN, 's': (1.0,)}}, TensionError, 's has 1 tensions, but crosses 2'),
        ({'tensions': {**EVEN, 's': (1.0, -1.0)}}, TensionError, 's is -1.0 N, allowed'),
        ({'tensions': {**EVEN, 's': '1'}}, TensionError, "s is '1', which is not a number"),
        ({'tensions': {**EVEN, 's': math.nan}}, TensionError, 's is nan'),
        ({'load': Load(tip_force=(0.1, 0.0), tip_distance=0.01)}, LoadError, 'leave it out'),
        ({'at_stop': [3]}, ArmError, 'joints 1 to 2'),
    ],
)
def test_bad_input_is_refused_with_the_reason_in_one_line(changed, error, reason):
    good = {'tensions': EVEN, 'bend_angles': (0.1, 0.0), 'direction': (1.0, 0.0)}
    with pytest.raises(error, match=reason) as raised:
        arm_tip_force(ARM, **{**good, **changed})
    assert '\n' not in str(raised.value)


def test_each_joint_that_slips_tells_the_force_as_an_end_of_its_set():
    draw = random.Random(1824)
    arm = load_arm(CONFIG / 'arm.yaml')
    for _ in range(some_of(100)):
        pull, force = draw.uniform(1.5, 1.7), draw.uniform(-0.01, 0.01)
        load = Load(tip_force=(force, 0.0))
        state = ArmTracker(arm).update({'l_mid': 1, 's_mid': 1, 'l_tip': 1, 's_tip': pull}, load)
        assert state.regimes.count(Regime.SLIPPING) > 1
        found = arm_tip_force(
            *(arm, state.cable_tensions), bend_angles=state.bend_angles, direction=(1.0, 0.0)
        )
        assert inside(found.intervals, force, 1e-9)
        for regime, intervals in zip(state.regimes, found.joint_intervals, strict=True):
            off = min(abs(end - force) for end in finite_ends(intervals))
            assert (off < 1e-9) == (regime is Regime.SLIPPING)


def test_the_set_of_a_joint_next_to_the_tip_is_that_of_its_unit_alone():
    """Where nothing that is bent lies before it."""
    tensions = {'l': 1.0, 's': 1.9}
    found = arm_tip_force(ARM, tensions, bend_angles=(0.0, 0.1), direction=(1.0, 0.0))
    single = tip_force_intervals(
        *(PRELIMINARY, 1.0, 1.9), bend_angle=0.1, direction=(1.0, 0.0), distance=0.02
    )
    assert found.joint_intervals[1] == single


NOISE = {'tension_stddev': 0.02, 'bend_angle_stddev': 0.01}


def test_noise_widens_the_set_and_less_for_a_lower_level(pushed):
    widened = 0
    for case in pushed[: some_of(40)]:
        exact, likely, sure = (
            case.found(**more) for more in ({}, {**NOISE, 'level': 0.6}, {**NOISE, 'level': 0.99})
        )
        assert likely.joint_intervals == exact.joint_intervals
        for narrow, wide in ((exact, likely), (likely, sure)):
            for low, high in narrow.intervals:
                for force in np.clip([low, high], -1e4, 1e4).tolist():
                    assert inside(wide.intervals, force, 1e-6 * case.scale)
                    widened += 1
        assert 0.0 <= sure.probability_free <= 1.0
    assert widened > some_of(40)


def test_hardly_any_noise_is_none():
    draw = random.Random(7)
    for _ in range(some_of(30)):
        case = random_pushed(draw, friction=False)
        exact = case.found()
        found = case.found(tension_stddev=1e-9, bend_angle_stddev=1e-9)
        for low, high in exact.intervals:
            assert inside(found.intervals, 0.5 * (max(low, -1e4) + min(high, 1e4)))
        if all(low < high for low, high in exact.intervals):
            assert finite_ends(found.intervals) == pytest.approx(
                finite_ends(exact.intervals), rel=1e-4, abs=1e-5
            )
            assert found.probability_free == pytest.approx(exact.probability_free, abs=1e-3)


def test_with_noise_an_arm_of_one_is_the_single_unit():
    for force in (0.0, 0.05):
        arm = arm_of([ArmUnit(PRELIMINARY, 0.03)])
        known = Load(tip_force=(force, 0.0))
        found = arm_tip_force(
            *(arm, {'l': 1.0, 's': 1.3}),
            bend_angles=[0.2],
            direction=(1.0, 0.0),
            load=known,
            **NOISE,
        )
        expected = tip_force(
            *(PRELIMINARY, 1.0, 1.3),
            bend_angle=0.2,
            direction=(1.0, 0.0),
            distance=0.03,
            load=Load(tip_force=(force, 0.0), tip_distance=0.03),
            **NOISE,
        )
        assert found.intervals == [pytest.approx(one, rel=1e-6) for one in expected.intervals]
        assert found.probability_free == pytest.approx(expected.probability_free, rel=1e-6)
        assert found.bounding_joints == [(1, 1)]


@pytest.mark.parametrize(
    'wrong', [{'tension_stddev': -1.0}, {'level': 1.0}, {'slipping': {1: 'x'}}]
)
def test_deviations_levels_and_sides_that_are_none_are_refused(pushed, wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        pushed[0].found(**wrong)


def shared(design, **stddevs):
    """An uncertainty of parameters that are independent, as shares of each."""
    variances = [(share * getattr(design, name)) ** 2 for name, share in stddevs.items()]
    return DesignUncertainty(tuple(stddevs), tuple(map(tuple, np.diag(variances).tolist())))


def inputs_of(case, names):
    """What an arm's force follows: each with its deviation, a step, and what a step changes."""
    for name, tension in case.tensions.items():
        yield (
            0.01,
            1e-5,
            lambda step, n=name, m=tension: {'tensions': {**case.tensions, n: m + step}},
        )
    for index in range(len(case.angles)):
        yield (
            *(0.005 * (index + 1), 1e-6),
            lambda step, i=index: {
                'bend_angles': [angle + step * (k == i) for k, angle in enumerate(case.angles)]
            },
        )
    for index, unit in enumerate(case.arm.units):
        for name in names:
            value = getattr(unit.design, name)

            def built(step, i=index, unit=unit, name=name, value=value):
                design = dataclasses.replace(unit.design, **{name: value + step})
                units = list(case.arm.units)
                units[i] = dataclasses.replace(unit, design=design)
                return {'arm': dataclasses.replace(case.arm, units=tuple(units))}

            yield 0.02 * abs(value), 1e-5 * abs(value), built


def test_the_deviation_of_a_slipping_joints_force_is_that_of_all_that_is_measured_and_built():
    """Against differences through the exact force: of each tension, angle and parameter."""
    draw = random.Random(1825)
    parameters = ('mass', 'com_distance', 'ball_radius', 'friction_coefficient', 'gravity')
    compared = 0
    while compared < some_of(40):
        case = random_pushed(draw, friction=False)
        joint, side = draw.randint(1, len(case.angles)), draw.choice('sl')
        names = draw.sample(parameters, 2)

        def force(case=case, joint=joint, side=side, **changed):
            found = case.found(slipping={joint: side}, **changed).joint_intervals[joint - 1]
            return found[0][0] if len(found) == 1 else math.nan

        found = case.found(
            slipping={joint: side},
            tension_stddev=0.01,
            bend_angle_stddev=[0.005 * number for number in range(1, len(case.angles) + 1)],
            design_covariance=[
                shared(design, **dict.fromkeys(names, 0.02)) for design in case.arm.designs
            ],
        )
        if found.force is None or abs(found.force) > 0.3 * case.scale:
            continue
        variance = sum(
            (stddev * (force(**change(step)) - force(**change(-step))) / (2.0 * step)) ** 2
            for stddev, step, change in inputs_of(case, names)
        )
        if math.isfinite(variance):
            assert found.at_limit
            assert found.force == force()
            assert found.force_stddev == pytest.approx(math.sqrt(variance), rel=1e-3), case
            compared += 1


class Said(NamedTuple):
    """A joint's doubt, whatever the force is."""

    most: float
    least: float
    slips_to: float = 0.0

    def bounds(self, _force):
        return self.most, self.least


def test_a_force_is_as_doubtful_as_to_the_joint_that_has_the_largest_doubt():
    """Which is not that with the larger score: a narrow set may be left to either side."""
    narrow, wide = Said(1.7, -1.6), Said(1.6, -math.inf)
    level = NormalDist().cdf(1.6)
    for joints in ([narrow, wide], [wide, narrow]):
        doubt = ArmDoubt(joints)
        assert doubt.bounding(0.1) == joints.index(wide) + 1
        assert doubt.beyond(0.1, level**2) == pytest.approx(0.0, abs=1e-9)


def test_while_a_joint_slips_the_probability_of_a_free_tip_is_a_twentieth_at_the_ends():
    asked = {'bend_angles': (0.1, 0.05), 'direction': (1.0, 0.0), 'slipping': {1: 's'}, **NOISE}
    found = arm_tip_force(ARM, EVEN, **asked)
    for end in finite_ends(found.intervals):
        at_end = arm_tip_force(ARM, EVEN, load=Load(tip_force=(end, 0.0)), **asked)
        assert at_end.probability_free == pytest.approx(0.05, abs=1e-3)
    assert found.at_limit
    assert finite_ends(found.intervals)


def test_the_true_force_is_inside_at_the_stated_rate():
    """A rough check; `tools/measure_arm_tip_force.py` has the figures."""
    from measure_arm_tip_force import covered, true_arm, true_force

    draw = random.Random(99)
    results = []
    for _ in range(some_of(40)):
        case, intervals = true_arm(draw)
        for _ in range(3):
            force = true_force(draw, intervals, 'an end')
            if force is not None:
                results.append(covered(draw, case, force))
    known = [one for one in results if one is not None]
    assert np.mean(known) > 0.85
