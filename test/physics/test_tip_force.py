"""The forces at the tip that friction can hold: against brute force, and what must hold of them."""

import dataclasses
import math
import random
from collections import Counter

import brute
import numpy as np
import pytest
from designs import PRELIMINARY
from thoroughness import some_of

from tendon_statics import (
    BendAngleError,
    Load,
    LoadError,
    TensionError,
    slip_margin,
    tip_force,
    tip_force_intervals,
)

COUNT = 300
GRID = np.linspace(-1.0, 1.0, 4001)[1:-1]
EXACT = 1e-9


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
    assert seen['merged', 0] and seen['friction_circle', 2] and seen['elastic_seat', 'ray'], seen


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
        ({'distance': math.inf}, LoadError, 'distance'),
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
