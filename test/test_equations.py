"""The equations against numeric integration and against themselves in other forms."""

import math

import mpmath as mp
import pytest
from designs import PRELIMINARY, cases
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from tendon_statics.physics import contact_coefficients
from tendon_statics.physics.equations import NormalForces, normal_force_ratios


@pytest.mark.parametrize('bend_angle', [-0.5, 0.0, 0.3])
def test_contact_coefficients_are_integrals_over_the_arc(bend_angle):
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
        _, force, _ = normal_force_ratios(design, tension_l, tension_s)(bend_angle)
        assert force > 0.0
        # The sum of the tensions and T − W are rounded before; the rest adds a few units.
        lost = float(total / (total - weight))
        assert force * float(total) == pytest.approx(float(exact), rel=1e-14 * (10.0 + lost))


@given(cases(), st.floats(-1.5, 1.5))
def test_the_quartic_is_the_quadratic_of_the_force_balance_with_the_moments_force(
    case, bend_angle
):
    """(1 − μ²) N² − 2 B N + T² − W² at N = N_m in units of T, times (1 + t²)², t = tan(θ/2)."""
    design, tension_l, tension_s = case
    forces = NormalForces(design, tension_l, tension_s)
    t = math.tan(0.5 * bend_angle)
    value = sum(c * t**power for power, c in enumerate(forces.quartic()))
    with mp.workdps(50):
        mu, total = mp.mpf(design.friction_coefficient), mp.mpf(tension_l + tension_s)
        weight = mp.mpf(design.weight) / total
        phi = mp.mpf(design.contact_centre_angle) + mp.mpf(bend_angle)
        lever = (design.ball_radius + mp.mpf(design.cable_offset)) / (mu * design.ball_radius)
        gain = weight * design.com_distance / (mu * design.ball_radius)
        n = (mp.mpf(tension_s) - mp.mpf(tension_l)) / total * lever + gain * mp.sin(bend_angle)
        quadratic = (1 - mu**2) * n**2 - 2 * (1 - mu * weight * mp.sin(phi)) * n + 1 - weight**2
        exact = quadratic * (1 + mp.mpf(t) ** 2) ** 2
        size = (1 + lever + abs(gain)) ** 2 * (1 + mu) ** 2 * (1 + mp.mpf(t) ** 2) ** 2
        assert value == pytest.approx(float(exact), rel=0.0, abs=1e-14 * float(size))
