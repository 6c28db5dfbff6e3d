"""The computations that the contact laws are held against, as far as they need no simulator."""

import math

import pytest
from validate import bristles, foundation, results
from validate.constructions import BALL_RADIUS, BOWL, CASES, EQUATOR_SEAT, HANGING, LOW_SEAT
from validate.rest import by_foundation

SEATS = (LOW_SEAT, EQUATOR_SEAT)


@pytest.mark.parametrize('seat', SEATS)
def test_pads_stand_for_the_whole_seat(seat):
    directions, shares = seat.pads(4, 24)
    start, end = (math.cos(math.radians(angle)) for angle in (seat.start_deg, seat.end_deg))
    assert shares.sum() == pytest.approx(1.0)
    assert shares @ directions[:, 2] ** 2 == pytest.approx((start**3 - end**3) / (start - end) / 3)
    assert shares @ directions[:, 0] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize('seat', SEATS)
@pytest.mark.parametrize('friction', [0.1, 0.5])
def test_bristles_and_integration_agree(seat, friction):
    integrated = foundation.capacity(seat.pads(*foundation.FINE), friction, 1.0) / BALL_RADIUS
    assert bristles.held_moment(seat, friction) == pytest.approx(integrated, rel=2e-3)


def test_how_stiff_bristles_are_does_not_matter():
    soft, stiff = (bristles.held_moment(LOW_SEAT, 0.3, stiffness) for stiffness in (0.2, 5.0))
    assert soft == pytest.approx(stiff, rel=1e-3)


def test_a_loose_bowl_slips_where_one_contact_slides_down_its_friction_cone():
    friction = 0.3
    one_contact = (1.0 + BOWL.clearance) * math.sin(math.atan(friction))
    assert bristles.held_moment(BOWL, friction) == pytest.approx(one_contact, rel=3e-3)


def test_what_is_kept_is_of_the_cases_that_are_simulated():
    kept = results.read()
    assert [(onset.construction, onset.friction) for onset in kept.onsets] == [
        (construction.name, friction) for construction, friction in CASES
    ]
    assert len(kept.rest_angles_deg) == len(HANGING.tensions_s)


def test_the_kept_simulation_agrees_with_bristles_and_integration():
    kept = results.read()
    for onset in kept.onsets:
        assert onset.bristles == pytest.approx(onset.rigid_body, rel=3e-3)
        if onset.foundation is not None:
            assert onset.foundation == pytest.approx(onset.rigid_body, rel=3e-3)
    for tension_s, angle in zip(HANGING.tensions_s, kept.rest_angles_deg, strict=True):
        assert math.degrees(by_foundation(HANGING, tension_s)) == pytest.approx(angle, abs=0.05)
