"""The forces at the tip that friction can hold: against brute force, and their properties."""

import dataclasses
import math
import random
from collections import Counter

import brute
import measure_tip_force
import numpy as np
import pytest
from designs import PRELIMINARY
from thoroughness import some_of

from tendon_statics import (
    BendAngleError,
    Load,
    LoadError,
    Regime,
    StickSlipFilter,
    StickSlipTracker,
    TensionError,
    slip_margin,
    solve,
    tip_force,
    tip_force_intervals,
    tip_force_of_state,
)

COUNT = 300
GRID = np.linspace(-1.0, 1.0, 4001)[1:-1]
EXACT = 1e-9
HANGING = dataclasses.replace(
    PRELIMINARY,
    com_distance=-0.02,
    mass=0.08,
    friction_coefficient=0.4,
    contact_start_angle=math.radians(20.0),
    contact_end_angle=math.radians(50.0),
    cable_offset=0.0025,
    contact_law='friction_circle',
)


@pytest.fixture(scope='module')
def pushed():
    """Random units at random angles, and lines along which they are pushed."""
    draw = random.Random(18)
    found = []
    for _ in range(some_of(COUNT)):
        case = brute.random_case(draw)
        angle = draw.uniform(-1.0, 1.0) * case.design.max_bend_angle
        of = draw.choice((draw.uniform(-math.pi, math.pi), 0.5 * math.pi))
        distance = draw.choice((0.0, draw.uniform(0.0, 0.06), draw.uniform(-0.02, 0.06)))
        found.append((case, angle, np.array([math.sin(of), math.cos(of)]), distance))
    return found


def intervals(case, angle, direction, distance, **more):
    return tip_force_intervals(
        *(case.design, case.tension_l, case.tension_s),
        bend_angle=angle,
        direction=tuple(direction),
        distance=distance,
        load=case.load,
        **more,
    )


def is_held(case, angle, direction, distance, force):
    towards_s, towards_l, seated = brute.excesses_under_push(
        case, angle, direction, distance, force
    )
    return seated & (towards_s <= 0.0) & (towards_l <= 0.0)


def inside(found, force, slack=0.0):
    return any(low - slack <= force <= high + slack for low, high in found)


def test_the_sample_holds_none_one_and_two_intervals_and_rays(pushed):
    seen = Counter()
    for one in pushed:
        found = intervals(*one)
        law = one[0].design.contact_law
        seen[law, len(found)] += 1
        seen[law, 'ray'] += any(math.isinf(end) for interval in found for end in interval)
    assert all(seen[law, 1] for law in brute.LAWS)
    kinds = ('merged', 0), ('friction_circle', 2), ('elastic_seat', 'ray')
    assert all(seen[kind] for kind in kinds), seen


def test_every_end_is_where_brute_force_finds_one(pushed):
    for one in pushed:
        found = intervals(*one)
        scale = sum(one[0][2:4])
        grid = scale * GRID / (1.0 - GRID**2)
        held = is_held(*one, grid)
        ends = [end for interval in found for end in interval if math.isfinite(end)]
        for index in np.flatnonzero(held[:-1] != held[1:]):
            low, high = float(grid[index]), float(grid[index + 1])
            while high - low > 1e-13 * max(1.0, abs(high)):
                middle = 0.5 * (low + high)
                if not low < middle < high:
                    break
                same = bool(is_held(*one, middle)) == held[index]
                low, high = (middle, high) if same else (low, middle)
            off = min(abs(end - low) for end in ends)
            assert off < EXACT * max(1.0, abs(low)), (one, low, found)
        # None is missing between the points of the grid, and none too many.
        for force, is_inside in zip(grid.tolist(), held.tolist(), strict=True):
            near = any(abs(force - end) < 1e-6 * scale for end in ends)
            assert near or inside(found, force) == is_inside, (one, force, found)


def test_a_force_inside_is_held_and_one_outside_is_not(pushed):
    draw = random.Random(19)
    for case, angle, direction, distance in pushed:
        bare = dataclasses.replace(case.load, tip_force=(0.0, 0.0), tip_distance=distance)
        case = case._replace(load=bare)
        found = intervals(case, angle, direction, distance)
        scale = sum(case[2:4])
        for _ in range(20):
            force = draw.gauss(0.0, scale)
            load = dataclasses.replace(bare, tip_force=tuple(force * direction))
            try:
                margin = slip_margin(case.design, *case[2:4], angle, load)
            except TensionError:
                assert not inside(found, force, -1e-9 * scale)
                continue
            if abs(abs(margin) - 1.0) > 1e-7:
                assert inside(found, force) == (abs(margin) <= 1.0), (case, angle, force)


def test_at_an_end_friction_is_at_its_limit_or_the_seat_is_lost(pushed):
    for one in pushed:
        case = one[0]
        scale = case.design.ball_radius * sum(case[2:4])
        for end in (e for interval in intervals(*one) for e in interval if math.isfinite(e)):
            step = 1e-8 * max(1.0, abs(end))
            changes = [is_held(*one, end - step), is_held(*one, end + step)]
            towards_s, towards_l, _ = brute.excesses_under_push(*one, end)
            at_limit = min(abs(towards_s), abs(towards_l)) < 1e-9 * scale * max(1.0, abs(end))
            seats = [brute.excesses_under_push(*one, end + s)[2] for s in (-step, step)]
            assert changes[0] != changes[1]
            assert at_limit or seats[0] != seats[1], (one, end)


def test_the_reverse_direction_has_the_mirrored_set(pushed):
    for case, angle, direction, distance in pushed:
        found = intervals(case, angle, direction, distance)
        other = intervals(case, angle, -direction, distance)
        mirrored = [(-high, -low) for low, high in reversed(other)]
        assert np.allclose(found, mirrored, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize('law', ['friction_circle', 'elastic_seat'])
def test_the_rays_of_a_line_across_the_units_axis_are_not_ended_by_rounding(law):
    # Along it a force neither presses the unit on its ball nor lifts it off, but for a last digit.
    design = dataclasses.replace(HANGING, contact_law=law)
    for degrees in range(-29, 30):
        angle = math.radians(degrees)
        found = tip_force_intervals(
            *(design, 1.0, 1.2),
            bend_angle=angle,
            direction=(math.sin(angle + 0.5 * math.pi), math.cos(angle + 0.5 * math.pi)),
            distance=0.0,
        )
        assert (found[0][0], found[-1][1]) == (-math.inf, math.inf), (degrees, found)


def test_the_force_asked_for_adds_to_a_known_one_at_a_place_of_its_own():
    known = Load(tip_force=(0.05, 0.0), tip_distance=0.02)
    pair = {'bend_angle': 0.1, 'direction': (1.0, 0.0), 'distance': 0.02}
    ((low, high),) = tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair)
    ((with_low, with_high),) = tip_force_intervals(PRELIMINARY, 1.0, 1.9, load=known, **pair)
    assert (with_low + 0.05, with_high + 0.05) == pytest.approx((low, high), abs=1e-12)


@pytest.mark.parametrize(
    ('changed', 'error', 'reason'),
    [
        ({'direction': (0.0, 0.0)}, LoadError, 'length zero'),
        ({'direction': (0.0, 1.0, 0.0)}, LoadError, 'out of the plane'),
        ({'direction': (0.0, 0.0, 0.0)}, LoadError, 'length zero'),
        ({'direction': (1.0, 1.0)}, LoadError, r'such as \(0.707107, 0.707107\)'),
        ({'direction': (1.0,)}, LoadError, r'\(x, z\)'),
        ({'direction': 1.0}, LoadError, r'\(x, z\)'),
        ({'direction': (math.nan, 1.0)}, LoadError, 'allowed'),
        ({'distance': math.inf}, LoadError, 'distance is inf, allowed'),
        ({'distance': 11.0}, LoadError, '10 m'),
        ({'bend_angle': 0.6}, BendAngleError, 'allowed is'),
        ({'bend_angle': math.nan}, BendAngleError, 'allowed is'),
        ({'tension_l': 0.0}, TensionError, 'slack'),
        ({'tension_s': -1.0}, TensionError, 'allowed is'),
        ({'tension_stddev': -0.1}, ValueError, '0 or more'),
        ({'bend_angle_stddev': math.nan}, ValueError, '0 or more'),
        ({'level': 1.0}, ValueError, 'below 1'),
    ],
)
def test_bad_input_is_refused_with_the_reason_in_one_line(changed, error, reason):
    good = {'tension_l': 1.0, 'tension_s': 1.9, 'bend_angle': 0.1, 'direction': (1.0, 0.0)}
    with pytest.raises(error, match=reason) as raised:
        tip_force_intervals(PRELIMINARY, **{**good, 'distance': 0.02, **changed})
    assert '\n' not in str(raised.value)


def test_a_direction_may_be_given_in_space():
    pair = {'bend_angle': 0.1, 'distance': 0.02}
    flat = tip_force_intervals(PRELIMINARY, 1.0, 1.9, direction=(0.6, 0.8), **pair)
    assert tip_force_intervals(PRELIMINARY, 1.0, 1.9, direction=(0.6, 0.0, 0.8), **pair) == flat


def test_a_slipping_unit_tells_one_force_which_is_an_end_of_its_set():
    pair = {'bend_angle': 0.1, 'direction': (1.0, 0.0), 'distance': 0.02}
    ((low, high),) = tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair)
    for slipping, end in (('s', high), ('l', low)):
        found = tip_force(PRELIMINARY, 1.0, 1.9, slipping=slipping, **pair)
        assert found.at_limit
        assert found.force == pytest.approx(end, abs=1e-12)
        assert found.intervals == [(found.force, found.force)]


def test_a_stop_carries_what_friction_does_not():
    stop = PRELIMINARY.max_bend_angle
    pair = {'bend_angle': stop, 'direction': (1.0, 0.0), 'distance': 0.02}
    ((low, high),) = tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair)
    ((stop_low, stop_high),) = tip_force(PRELIMINARY, 1.0, 1.9, at_stop=True, **pair).intervals
    assert stop_low == low
    assert stop_high > high


# Under noise

ACROSS = {'direction': (1.0, 0.0), 'distance': 0.02}


def test_noise_widens_the_set_more_at_a_higher_level_and_not_at_all_where_there_is_none():
    pair = {'bend_angle': 0.1, **ACROSS}
    ((low, high),) = tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair)
    ends = [(low, high)]
    for level in (0.5, 0.9, 0.99):
        noisy = {'tension_stddev': 0.01, 'bend_angle_stddev': 0.01, 'level': level}
        ends += tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair, **noisy)
    assert ends[1] == pytest.approx(ends[0], abs=1e-6)  # each end by itself, at one half
    assert ends[0][0] > ends[2][0] > ends[3][0]
    assert ends[0][1] < ends[2][1] < ends[3][1]
    nearly = tip_force_intervals(PRELIMINARY, 1.0, 1.9, **pair, tension_stddev=1e-9)
    assert nearly[0] == pytest.approx((low, high), abs=1e-6)


def test_without_friction_the_set_is_an_ordinary_interval_of_its_level():
    smooth = dataclasses.replace(PRELIMINARY, friction_coefficient=1e-3)
    pair = {'bend_angle': 0.1, **ACROSS}
    slips = tip_force(smooth, 1.0, 1.0, tension_stddev=0.01, slipping='s', **pair)
    found = tip_force(smooth, 1.0, 1.0, tension_stddev=0.01, **pair)
    assert found.intervals[0] == pytest.approx(slips.intervals[0], abs=2e-3)
    half = 1.959964 * slips.force_stddev
    assert slips.intervals[0] == pytest.approx((slips.force - half, slips.force + half), rel=1e-3)


@pytest.mark.parametrize('law', brute.LAWS)
def test_the_true_force_is_inside_at_the_stated_rate(law):
    held, drawn = Counter(), Counter()
    for seed in range(some_of(80)):
        truth_draw = random.Random(f'{seed} {law} coverage')
        truth = measure_tip_force.true_unit(truth_draw, law)
        for kind in ('end', 'slipping', 'inside'):
            for _ in range(2):
                result = measure_tip_force.covered(truth, kind, truth_draw, is_exact=True)
                drawn[kind] += result is not None
                held[kind] += bool(result)
    for kind in ('end', 'slipping'):
        chance = 4.0 * math.sqrt(0.95 * 0.05 / drawn[kind])
        assert abs(held[kind] / drawn[kind] - 0.95) < 0.02 + chance, (kind, held, drawn)
    assert held['inside'] / drawn['inside'] > 0.95 - 4.0 * math.sqrt(0.95 * 0.05 / drawn['inside'])


def test_the_probability_of_a_free_tip_is_how_often_zero_is_in_the_set():
    draw = random.Random(7)
    # Next to the end of what friction holds at 0.1 rad with a free tip.
    for tension_s in (1.97, 2.0, 2.02):
        pair = {'bend_angle': 0.1, **ACROSS}
        noisy = {'tension_stddev': 0.02, 'bend_angle_stddev': 0.02}
        found = tip_force(PRELIMINARY, 1.0, tension_s, **pair, **noisy)
        count = 2000
        free = 0
        for _ in range(count):
            drawn = {**pair, 'bend_angle': draw.gauss(0.1, 0.02)}
            tensions = draw.gauss(1.0, 0.02), draw.gauss(tension_s, 0.02)
            free += tip_force(PRELIMINARY, *tensions, **drawn).probability_free
        assert found.probability_free == pytest.approx(free / count, abs=0.05)


def test_the_deviation_at_the_limit_is_the_scatter_of_the_number():
    draw = random.Random(8)
    pair = {'bend_angle': 0.1, 'slipping': 's', **ACROSS}
    found = tip_force(PRELIMINARY, 1.0, 1.9, tension_stddev=0.01, bend_angle_stddev=0.01, **pair)
    forces = [
        tip_force(
            PRELIMINARY,
            *(draw.gauss(1.0, 0.01), draw.gauss(1.9, 0.01)),
            **{**pair, 'bend_angle': draw.gauss(0.1, 0.01)},
        ).force
        for _ in range(1000)
    ]
    assert found.force_stddev == pytest.approx(np.std(forces), rel=0.15)


# Of a unit that is followed


def slipped():
    """A tracker's unit that has just slipped towards s, and its state."""
    tracker = StickSlipTracker(HANGING, 0.0)
    state = tracker.update(3.0, 6.25)
    assert state.regime is Regime.SLIPPING
    return state


def test_a_slipping_unit_whose_angle_agrees_tells_a_number():
    state = slipped()
    own = tip_force_of_state(state, **ACROSS)
    assert own.at_limit
    assert own.force == pytest.approx(0.0, abs=1e-9)  # its angle took the tip for free
    near = state.bend_angle + 0.01
    found = tip_force_of_state(state, bend_angle=near, bend_angle_stddev=0.02, **ACROSS)
    assert found.at_limit
    assert abs(found.force) > 1e-3


@pytest.mark.parametrize('law', brute.LAWS)
def test_a_pushed_unit_that_is_followed_gives_its_force_away_when_it_slips(law):
    """The truth is a tracker that knows of a force; who is asked knows tensions and angle."""
    draw = random.Random(5)
    design = dataclasses.replace(HANGING, contact_law=law)
    tracker, numbers = StickSlipTracker(design), 0
    pair, force = [3.0, 3.0], 0.0
    for _ in range(400):
        pair = [min(max(tension + draw.gauss(0.0, 0.5), 2.0), 6.0) for tension in pair]
        force = min(max(force + draw.gauss(0.0, 0.05), -0.3), 0.3)
        state = tracker.update(*pair, Load(tip_force=(force, 0.0), tip_distance=0.02))
        angle, at_stop = state.bend_angle, state.regime is Regime.DRIVEN_TO_STOP
        at_stop |= abs(angle) == design.max_bend_angle
        slipping = ''
        if state.regime is Regime.SLIPPING and not at_stop and abs(state.slip_margin) > 1 - 1e-9:
            slipping = 's' if state.slip_margin > 0.0 else 'l'
        asked = {'bend_angle': angle, 'at_stop': at_stop, **ACROSS}
        found = tip_force(design, *pair, slipping=slipping, **asked)
        if slipping:
            numbers += 1
            assert found.force == pytest.approx(force, abs=1e-6)
        else:
            assert inside(found.intervals, force, 1e-9)
    assert numbers > 5


def test_an_angle_that_does_not_agree_leaves_the_whole_set():
    state = slipped()
    far = state.bend_angle - 0.2
    found = tip_force_of_state(state, bend_angle=far, bend_angle_stddev=0.01, **ACROSS)
    assert not found.at_limit
    assert found.force is None
    assert found.probability_free < 0.01  # it is held there by something


def test_a_held_unit_has_a_set_with_nothing_in_it():
    state = StickSlipTracker(PRELIMINARY, 0.1).update(1.0, 1.9)
    found = tip_force_of_state(state, **ACROSS)
    assert (found.at_limit, found.probability_free) == (False, 1.0)
    assert found.intervals == tip_force_intervals(PRELIMINARY, 1.0, 1.9, bend_angle=0.1, **ACROSS)


@pytest.mark.parametrize('short', [0.0, 2.5, 3.9])
def test_a_free_tip_at_a_stop_stays_possible_when_the_angle_reads_short_of_it(short):
    stddev = 0.005
    state = StickSlipTracker(PRELIMINARY).update(1.0, 3.0)
    assert state.regime is Regime.DRIVEN_TO_STOP
    measured = state.bend_angle - short * stddev
    known = {'bend_angle': measured, 'bend_angle_stddev': stddev, 'tension_stddev': 0.01}
    assert tip_force_of_state(state, **known, **ACROSS).probability_free > 0.05


def test_at_a_stop_the_force_is_known_to_one_side_only():
    state = StickSlipTracker(PRELIMINARY).update(1.0, 3.0)
    assert state.regime is Regime.DRIVEN_TO_STOP
    found = tip_force_of_state(state, **ACROSS)
    free = tip_force(PRELIMINARY, 1.0, 3.0, bend_angle=state.bend_angle, at_stop=True, **ACROSS)
    assert (found.at_limit, found.intervals) == (False, free.intervals)
    assert found.probability_free == 1.0


def test_a_filters_state_brings_its_own_deviation():
    followed = StickSlipFilter(
        PRELIMINARY, bend_angle=0.1, bend_angle_stddev=0.02, tension_stddev=0.01
    )
    state = followed.update(1.0, 1.9, 0.0)
    found = tip_force_of_state(state, tension_stddev=0.01, **ACROSS)
    same = tip_force(
        *(PRELIMINARY, 1.0, 1.9),
        bend_angle=state.bend_angle,
        bend_angle_stddev=state.bend_angle_stddev,
        tension_stddev=0.01,
        **ACROSS,
    )
    assert found == same


def test_a_state_without_an_angle_needs_one_that_was_measured():
    held = solve(PRELIMINARY, 1.0, 1.5)
    with pytest.raises(BendAngleError, match='no bend angle'):
        tip_force_of_state(held, **ACROSS)
    assert tip_force_of_state(held, bend_angle=0.1, **ACROSS).intervals
    slack = StickSlipTracker(PRELIMINARY).update(1.0, 0.0)
    with pytest.raises(TensionError, match='slack'):
        tip_force_of_state(slack, **ACROSS)


def test_a_filter_that_has_its_unit_slipping_tells_a_number():
    followed = StickSlipFilter(HANGING, tension_stddev=0.002, lag=0.05)
    for index in range(150):
        state = followed.update(3.0, 5.8 + 0.003 * index, 0.01 * index)
    assert state.regime is Regime.SLIPPING
    found = tip_force_of_state(state, tension_stddev=0.002, **ACROSS)
    assert found.at_limit
    assert abs(found.force) < 4.0 * found.force_stddev
