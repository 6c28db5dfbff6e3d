"""The equations against numeric integration and against themselves in other forms."""

import math

import mpmath as mp
import pytest
from designs import PRELIMINARY, cases
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics.physics import contact_coefficients
from tendon_statics.physics.load import UPRIGHT
from tendon_statics.physics.tensions import Tensions, taut_slip


@pytest.mark.parametrize('bend_angle', [-0.5, 0.0, 0.3])
def test_contact_coefficients_are_integrals_over_the_arc(bend_angle):
    from scipy.integrate import quad  # Here, as each worker loads this file.

    start = PRELIMINARY.contact_start_angle + bend_angle
    end = PRELIMINARY.contact_end_angle + bend_angle
    r = PRELIMINARY.ball_radius
    sine, _ = quad(lambda angle: r * math.sin(angle), start, end)
    cosine, _ = quad(lambda angle: r * math.cos(angle), start, end)
    assert tuple(contact_coefficients(PRELIMINARY, bend_angle)) == pytest.approx(
        (sine, cosine, cosine, sine), rel=1e-12, abs=1e-15
    )


@given(cases(), st.floats(-1.5, 1.5))
def test_the_force_balance_keeps_its_digits(case, bend_angle):
    """N_f against the quadratic's textbook root in 50 digits; also at μ = 1 and near it."""
    design, tension_l, tension_s = case
    with mp.workdps(50):
        mu, total = mp.mpf(design.friction_coefficient), mp.mpf(tension_l + tension_s)
        weight = mp.mpf(design.weight)
        phi = mp.mpf(design.contact_centre_angle) + mp.mpf(bend_angle)
        b = total - mu * weight * mp.sin(phi)
        root = mp.sqrt(b**2 - (1 - mu**2) * (total**2 - weight**2))
        if mu == 1:
            exact = (total**2 - weight**2) / (2 * b)
        else:
            exact = (b - root) / (1 - mu**2)
        slip = taut_slip(design, Tensions(tension_l, tension_s), UPRIGHT)
        force = slip.at(bend_angle).capacity / design.friction_coefficient
        assert force > 0.0
        # The sum of the tensions and T − W are rounded before; the rest adds a few units.
        lost = float(total / (total - weight))
        assert force * float(total) == pytest.approx(float(exact), rel=1e-14 * (10.0 + lost))
