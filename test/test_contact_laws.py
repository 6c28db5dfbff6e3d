"""What every contact law has to keep; one that is added needs its rows in `CAPACITIES`."""

import math
import random

import numpy as np
import pytest
from thoroughness import some_of

from tendon_statics.physics.contact import CONTACT_LAWS
from tendon_statics.physics.contact.law import LoadShare, Turn

CAPACITIES = [
    # law, μ, θ1 and θ2 in deg, |P| / T, tilt ψ in deg, and K / (r T) worked from the definition of
    # the law with mpmath: roots of the quadratic, lengths of vectors, integrals over the seat.
    ('merged', 1.05, 60, 88.49, 0.064, 17.14, 0.544964758896),
    ('merged', 0.3, 20, 50, 0.5, -120, 0.11546701329),
    ('merged', 0.1, 20, 50, 0.0, 0, 0.0909090909091),
    ('merged', 1.0, 0, 45, 0.25, 60, 0.623222747666),
    ('friction_circle', 1.05, 60, 88.49, 0.064, 17.14, 0.768545841385),
    ('friction_circle', 0.3, 20, 50, 0.5, -120, 0.248850568624),
    ('friction_circle', 0.1, 20, 50, 0.0, 0, 0.099503719021),
    ('friction_circle', 1.0, 0, 45, 0.25, 60, 0.810092587301),
    ('elastic_seat', 1.05, 60, 88.49, 0.064, 17.14, 0.783354561238),
    ('elastic_seat', 0.3, 20, 50, 0.5, -120, 0.248850568624),
    ('elastic_seat', 0.1, 20, 50, 0.0, 0, 0.11156327658),
    ('elastic_seat', 1.0, 0, 45, 0.25, 60, 0.810092587301),
]

STEP = 1e-6


def load_of(share):
    return LoadShare(share, 1.0 - share, (1.0 - share) * (1.0 + share))


def drawn(name, count, seed=5):
    """Draw laws with a load share and a tilt."""
    draw = random.Random(seed)
    for _ in range(some_of(count)):
        start = draw.uniform(0.0, math.radians(70.0))
        law = CONTACT_LAWS[name](
            draw.uniform(0.05, 1.5), start, draw.uniform(start + 0.1, 0.5 * math.pi)
        )
        yield law, draw.uniform(0.0, 0.9), draw.uniform(-math.pi, math.pi)


def capacity(law, share, tilt):
    return law.capacity(load_of(share), math.cos(tilt), math.sin(tilt))


def normal(law, share, tilt, moment):
    return law.normal_slopes(load_of(share), math.cos(tilt), math.sin(tilt), moment).normal


def slope(of, *at, by):
    ends = []
    for sign in (-1.0, 1.0):
        moved = list(at)
        moved[by] += sign * STEP
        ends.append(of(*moved))
    return (ends[1] - ends[0]) / (2.0 * STEP)


@pytest.mark.parametrize(
    ('name', 'friction', 'start', 'end', 'share', 'tilt', 'expected'), CAPACITIES
)
def test_the_capacity_is_that_of_the_definition(name, friction, start, end, share, tilt, expected):
    law = CONTACT_LAWS[name](friction, math.radians(start), math.radians(end))
    assert capacity(law, share, math.radians(tilt)) == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize('name', CONTACT_LAWS)
def test_every_law_has_rows_in_the_table_and_says_what_it_fits(name):
    assert sum(row[0] == name for row in CAPACITIES) >= 4
    assert CONTACT_LAWS[name].fits


@pytest.mark.parametrize('name', CONTACT_LAWS)
def test_slopes_are_those_of_the_capacity(name):
    for law, share, tilt in drawn(name, 200):
        slopes = law.slopes(load_of(share), math.cos(tilt), math.sin(tilt))
        assert slopes.capacity == capacity(law, share, tilt)
        if share > 2.0 * STEP:
            by_share = slope(lambda s, t, law=law: capacity(law, s, t), share, tilt, by=0)
            assert slopes.by_share == pytest.approx(by_share, rel=1e-5, abs=1e-7)
        by_tilt = slope(lambda s, t, law=law: capacity(law, s, t), share, tilt, by=1)
        assert slopes.by_tilt == pytest.approx(by_tilt, rel=1e-5, abs=1e-7)


@pytest.mark.parametrize('name', CONTACT_LAWS)
def test_slopes_lie_within_their_bounds(name):
    draw = random.Random(6)
    for law, share, tilt in drawn(name, 200):
        half_width = draw.uniform(0.0, 0.5 * math.pi)
        load = load_of(share)
        bounds = law.slope_bounds(load, math.cos(tilt), math.sin(tilt), Turn.by(half_width))
        for angle in np.linspace(tilt - half_width, tilt + half_width, 41).tolist():
            by_tilt = law.slopes(load, math.cos(angle), math.sin(angle)).by_tilt
            assert abs(by_tilt - bounds.centre) <= bounds.radius * (1.0 + 1e-12) + 1e-14


@pytest.mark.parametrize('name', CONTACT_LAWS)
def test_the_contact_force_and_its_slopes(name):
    draw = random.Random(7)
    for law, share, tilt in drawn(name, 200):
        turn = math.cos(tilt), math.sin(tilt)
        moment = draw.uniform(0.1, 0.95) * capacity(law, share, tilt)
        slopes = law.normal_slopes(load_of(share), *turn, moment)
        assert law.contact(load_of(share), *turn, moment).normal == pytest.approx(slopes.normal)
        for by, name_of in enumerate(('by_share', 'by_tilt', 'by_moment')):
            if by or share > 2.0 * STEP:
                of_normal = slope(
                    lambda *at, law=law: normal(law, *at), share, tilt, moment, by=by
                )
                # Where N turns about a point, rounding has the better of a difference.
                assert getattr(slopes, name_of) == pytest.approx(of_normal, rel=1e-3, abs=1e-4)


@pytest.mark.parametrize('name', CONTACT_LAWS)
def test_the_total_tension_gives_the_contact_force_back(name):
    for law, share, tilt in drawn(name, 200):
        turn = math.cos(tilt), math.sin(tilt)
        force = normal(law, share, tilt, capacity(law, share, tilt))
        total = law.total_tension(share * turn[0], share * turn[1], force)
        # Two totals may have one contact force; the first is the one that was asked for.
        if law.contact(load_of(share), *turn, capacity(law, share, tilt)).consistent:
            assert total == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize('name', CONTACT_LAWS)
def test_arrays_go_through_the_same_formula_as_floats(name):
    for law, share, _ in drawn(name, 20):
        tilts = np.linspace(-3.0, 3.0, 25)
        turns = np.array([math.cos(t) for t in tilts]), np.array([math.sin(t) for t in tilts])
        load = load_of(np.full(25, share))
        of_arrays = law.slopes(load, *turns)
        for index in range(25):
            turn = float(turns[0][index]), float(turns[1][index])
            alone = law.slopes(load_of(share), *turn)
            assert tuple(float(part[index]) for part in of_arrays) == tuple(map(float, alone))
