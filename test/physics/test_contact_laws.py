"""What every contact law has to keep; one that is added needs its rows in `CAPACITIES`."""

import math
import random

import brute
import pytest

from tendon_statics import JointDesign, Load, slip_margin, solve, solve_batch
from tendon_statics.physics import CONTACT_LAWS
from tendon_statics.physics.contact.numbers import FLOATS
from tendon_statics.physics.tensions import Tensions, taut_slip

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

WEIGHT = 0.4
"""N"""


def case_of(law, friction, start, end, share, tilt, slope=0.05):
    """A unit under a weight of the direction and the share of T that are asked for.

    At zero bend it has M / (r T) = `slope`, since the weight acts in the centre of the ball.
    """
    design = JointDesign(
        ball_radius=0.01,
        cable_offset=0.0,
        com_distance=0.0,
        mass=WEIGHT / 10.0 if share else 0.0,
        gravity=10.0,
        friction_coefficient=friction,
        contact_start_angle=math.radians(start),
        contact_end_angle=math.radians(end),
        max_bend_angle=0.5,
        contact_law=law,
    )
    total = WEIGHT / share if share else 3.0
    tensions = (0.5 * total * (1.0 - slope), 0.5 * total * (1.0 + slope))
    return brute.Case(design, Load.tilted(math.radians(tilt)), *tensions)


@pytest.mark.parametrize(
    ('law', 'friction', 'start', 'end', 'share', 'tilt', 'expected'), CAPACITIES
)
def test_the_capacity_is_that_of_the_definition(law, friction, start, end, share, tilt, expected):
    case = case_of(law, friction, start, end, share, tilt)
    margin = slip_margin(case.design, case.tension_l, case.tension_s, 0.0, case.load)
    assert 0.05 / margin == pytest.approx(expected, rel=1e-11)
    # The brute force that random units of every law are held against has the same law.
    scale = case.design.ball_radius * (case.tension_l + case.tension_s)
    assert brute.capacity(case, 0.0, 1.0) / scale == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize('row', CAPACITIES)
def test_slipping_to_the_other_side_is_the_mirror_image(row):
    case = case_of(*row[:-1])
    there = slip_margin(case.design, case.tension_l, case.tension_s, 0.0, case.load)
    back = slip_margin(case.design, case.tension_s, case.tension_l, 0.0, case.load.mirrored())
    assert back == pytest.approx(-there, rel=1e-14)


@pytest.mark.parametrize('law', CONTACT_LAWS)
def test_every_law_has_rows_in_the_table_and_a_brute_force_and_says_what_it_fits(law):
    assert sum(row[0] == law for row in CAPACITIES) >= 4
    assert law in brute.LAWS
    assert CONTACT_LAWS[law].fits


@pytest.mark.parametrize('law', CONTACT_LAWS)
def test_the_contact_force_and_pressure_of_one_pair_are_those_of_many(law):
    rows = [row for row in CAPACITIES if row[0] == law]
    for row in rows:
        case = case_of(*row[:-1], slope=1.5 * row[-1] if row[-1] < 0.6 else 0.98)
        pair = (case.tension_l, case.tension_s)
        alone = solve(case.design, *pair, case.load)
        among = solve_batch(case.design, [pair[0]] * 3, [pair[1]] * 3, case.load)
        assert among.regime_names.tolist() == [str(alone.regime)] * 3
        if alone.pressure is not None:
            assert among.pressure == pytest.approx([alone.pressure] * 3, rel=1e-10)


@pytest.mark.parametrize('law', CONTACT_LAWS)
def test_the_slope_of_the_capacity_keeps_within_its_bounds_wherever_it_turns(law):
    draw, turned = random.Random(3), 0
    for _ in range(300):
        # Also where the contact force of the paper's law changes its form, and where μ is 1.
        friction = draw.choice((1.0, draw.uniform(0.05, 1.6)))
        start = draw.uniform(0.0, 1.4)
        share = draw.choice((draw.uniform(0.0, 0.99), min(friction, 0.9)))
        tilt = draw.uniform(-math.pi, math.pi)
        loaded = CONTACT_LAWS[law](friction, start, draw.uniform(start + 0.05, 1.55)).under(
            (share, 1.0 - share, (1.0 - share) * (1.0 + share)),
            (math.cos(tilt), math.sin(tilt)),
            FLOATS,
        )
        low = draw.uniform(-0.5 * math.pi, 1.4)
        width = draw.uniform(0.0, 0.5 * math.pi - low)
        states = [
            loaded.at(math.cos(angle), math.sin(angle))
            for angle in (low + width * part / 40.0 for part in range(41))
        ]
        slopes = [state[1] for state in states]
        least, greatest = loaded.slope_bounds(states[0], states[-1], width)
        assert least - 1e-12 <= min(slopes), (friction, share, tilt)
        assert max(slopes) <= greatest + 1e-12, (friction, share, tilt)
        turned += max(slopes) > max(slopes[0], slopes[-1]) + 1e-3
    assert turned > 30


@pytest.mark.parametrize('law', list(CONTACT_LAWS))
def test_the_capacity_never_falls_as_a_cable_pulls_more(law):
    draw = random.Random(law)
    for _ in range(300):
        friction, share = draw.choice((draw.uniform(0.01, 2.0), 1.0)), draw.uniform(0.0, 0.99)
        case = case_of(law, friction, 20, 60, share, draw.uniform(-180, 180))
        angle, more = draw.uniform(-0.5, 0.5), draw.uniform(0.0, 3.0)
        tension_l, tension_s = case.tension_l, case.tension_s
        before, after = (
            taut_slip(case.design, Tensions(tension_l + pulled, tension_s), case.load)
            for pulled in (0.0, more)
        )
        least = before.at(angle).capacity * before.total
        assert after.at(angle).capacity * after.total >= least * (1.0 - 1e-12)
