"""All that the core says of random units of every law, load and stiffness, by brute force."""

import itertools
import math
import random
from collections import Counter

import brute
import pytest

from tendon_statics import Regime, solve
from tendon_statics.physics import (
    StickSlipTracker,
    UnreachableError,
    admissible_angles,
    slip_margin,
    tensions_for,
)

COUNT = 400


@pytest.fixture(scope='module')
def cases():
    draw = random.Random(20)
    drawn = (brute.random_case(draw) for _ in itertools.count())
    return list(itertools.islice((c for c in drawn if not brute.is_doubtful(c)), COUNT))


def arguments(case):
    return case.design, case.tension_l, case.tension_s


def test_the_sample_holds_every_kind_of_case(cases):
    seen = Counter((c.design.contact_law, str(solve(*arguments(c), c.load).regime)) for c in cases)
    regimes = ('equilibrium', 'held', 'driven_to_stop')
    assert all(seen[law, regime] >= 10 for law in brute.LAWS for regime in regimes), seen


def test_the_first_root_and_their_number(cases):
    for case in cases:
        answer = solve(*arguments(case), case.load)
        side = -1.0 if case.tension_l > case.tension_s else 1.0
        stop = case.design.max_bend_angle
        low, high = sorted((0.0, side * stop))
        found = sorted(brute.roots(case, side, low, high), key=abs)
        assert answer.root_count == len(found), case
        if found:
            assert answer.regime is Regime.EQUILIBRIUM
            assert answer.bend_angle == pytest.approx(found[0], abs=1e-8, rel=0.0), case
        elif brute.excess(case, 0.0, side) > 0.0:
            assert (answer.regime, answer.bend_angle) == (Regime.DRIVEN_TO_STOP, side * stop)
        else:
            assert (answer.regime, answer.bend_angle) == (Regime.HELD, None)


def test_admissible_angles(cases):
    for case in cases:
        found = admissible_angles(*arguments(case), case.load)
        expected = brute.admissible(case)
        assert len(found) == len(expected), case
        for interval, other in zip(found, expected, strict=True):
            assert interval == pytest.approx(other, abs=1e-8, rel=0.0), case


def test_margins(cases):
    draw = random.Random(21)
    for case in cases:
        for _ in range(5):
            angle = draw.uniform(-1.0, 1.0) * case.design.max_bend_angle
            margin = slip_margin(*arguments(case), angle, case.load)
            assert margin == pytest.approx(brute.margin(case, angle), rel=1e-7, abs=1e-7), case


def test_where_the_tracker_ends(cases):
    draw = random.Random(22)
    for case in cases:
        for _ in range(5):
            start = draw.uniform(-1.0, 1.0) * case.design.max_bend_angle
            tracker = StickSlipTracker(case.design, start)
            state = tracker.update(case.tension_l, case.tension_s, case.load)
            expected = brute.landing(case, start)
            assert state.bend_angle == pytest.approx(expected, abs=1e-8, rel=0.0), (case, start)


def test_round_trips_of_the_inverse(cases):
    reached = Counter()
    draw = random.Random(23)
    for case in cases:
        angle = draw.uniform(-0.95, 0.95) * case.design.max_bend_angle
        total = case.tension_l + case.tension_s
        try:
            tensions = tensions_for(case.design, angle, total_tension=total, load=case.load)
        except UnreachableError:
            continue
        answer = solve(case.design, *tensions, case.load)
        assert sum(tensions) == pytest.approx(total, rel=1e-12)
        assert answer.bend_angle == pytest.approx(angle, abs=1e-9, rel=0.0)
        slipping = case._replace(tension_l=tensions.tension_l, tension_s=tensions.tension_s)
        side = math.copysign(1.0, angle)
        scale = case.design.ball_radius * total
        assert abs(brute.excess(slipping, angle, side)) < 1e-9 * scale
        again = tensions_for(case.design, angle, pressure=answer.pressure, load=case.load)
        assert tuple(again) == pytest.approx(tuple(tensions), rel=1e-7)
        reached[case.design.contact_law] += 1
    assert all(reached[law] >= 30 for law in brute.LAWS), reached
