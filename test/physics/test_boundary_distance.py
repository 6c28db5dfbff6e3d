"""`boundary_distance` against the scalar physics, and its noise against finite differences."""

import math

import brute
import numpy as np
import pytest
from designs import PRELIMINARY, cases
from hypothesis import assume, given
from hypothesis import strategies as st
from law_sessions import SessionPlan, pressure, slips_of, unit_of
from slips import TRUTH, slipping_samples

from tendon_statics import Load
from tendon_statics.physics import slip_margin
from tendon_statics.physics.calibration.boundary_distance import Noise, boundary_distance
from tendon_statics.physics.calibration.load_cells import LoadCells
from tendon_statics.physics.sample_loads import SampleLoads

NOISE = Noise(0.01, math.radians(0.5), 8.0)


def distance(design, tension_l, tension_s, bend_angle, pressure=math.nan, noise=NOISE):
    arrays = (
        np.atleast_1d(np.asarray(value, dtype=float))
        for value in (tension_l, tension_s, bend_angle, pressure)
    )
    return boundary_distance(design, *arrays, noise)


@given(cases(), st.floats(-1.0, 1.0))
def test_the_excess_is_what_the_slip_margin_lacks(case, share):
    """|M| / (μ r) = |margin| N_f, so the excess is (|margin| − 1) N_f."""
    design, tension_l, tension_s = case
    angle = share * design.max_bend_angle
    margin = slip_margin(design, tension_l, tension_s, angle)
    assume(margin != 0.0)
    got = distance(design, tension_l, tension_s, angle)
    moment = (tension_s - tension_l) * (design.ball_radius + design.cable_offset)
    moment += design.weight * design.com_distance * math.sin(angle)
    asked = abs(moment) / (design.friction_coefficient * design.ball_radius)
    total = tension_l + tension_s
    assert got.excess[0] == pytest.approx(asked - asked / abs(margin), abs=1e-7 * total)
    assert got.side[0] == math.copysign(1.0, margin)


def test_on_the_boundary_both_distances_are_zero():
    tension_l, tension_s, angle, pressure = slipping_samples(50, np.random.default_rng(1)).T
    got = distance(TRUTH, tension_l, tension_s, angle, pressure)
    assert got.excess == pytest.approx(np.zeros(50), abs=1e-10)
    assert got.pressure_standardised == pytest.approx(np.zeros(50), abs=1e-8)


def test_the_noise_is_that_of_tensions_angle_and_pressure_to_first_order():
    """Against the covariance of e and q from finite differences."""
    samples = slipping_samples(20, np.random.default_rng(2))
    samples[:, 3] += 20.0  # off the boundary, so that q is not zero
    samples[:, 1] *= 1.02
    tiny = Noise(1e9, 0.0, 0.0)  # only the excess is looked at in the differences

    def equations(row):
        got = distance(TRUTH, *row, noise=tiny)
        moment_force = (row[1] - row[0]) * (TRUTH.ball_radius + TRUTH.cable_offset)
        moment_force += TRUTH.weight * TRUTH.com_distance * math.sin(row[2])
        moment_force /= TRUTH.friction_coefficient * TRUTH.ball_radius
        limit = abs(moment_force) - got.excess[0]
        return np.array([got.excess[0], row[3] * TRUTH.contact_area - limit])

    variances = np.array([NOISE.tension, NOISE.tension, NOISE.bend_angle, NOISE.pressure]) ** 2
    for row in samples:
        columns = []
        for index, step in enumerate((1e-6, 1e-6, 1e-6, 1e-3)):
            change = np.zeros(4)
            change[index] = step
            columns.append((equations(row + change) - equations(row - change)) / (2.0 * step))
        gradients = np.array(columns).T
        covariance = gradients * variances @ gradients.T
        whitened = np.linalg.solve(np.linalg.cholesky(covariance), equations(row))
        got = distance(TRUTH, *row)
        assert got.standardised[0] == pytest.approx(whitened[0], rel=1e-5)
        assert got.pressure_standardised[0] == pytest.approx(whitened[1], rel=1e-5)


def general_slips(law):
    """Slips of a unit of any law, on a tilted base, with a force at the tip and a backbone."""
    plan = SessionPlan(
        slips=20,
        tilts=(0.0, 0.9, -1.7),
        tip_forces=((0.05, -0.1), (-0.08, 0.02)),
        tip_distance=0.02,
        pressure_stddev=0.0,
    )
    unit = unit_of(law, stiffness=0.004)
    rows, loads = slips_of(unit, plan, np.random.default_rng(3))
    arrays = SampleLoads.of(
        Load(tip_distance=0.02),
        len(loads),
        base_tilt=[load.base_tilt for load in loads],
        tip_force_x=[load.tip_force[0] for load in loads],
        tip_force_z=[load.tip_force[1] for load in loads],
    )
    return unit, rows, loads, arrays


@pytest.mark.parametrize('law', brute.LAWS)
def test_the_excess_is_that_of_every_law_and_load_by_brute_force(law):
    unit, rows, loads, arrays = general_slips(law)
    rows[:, 0] *= 1.03
    got = boundary_distance(unit, *rows.T, NOISE, arrays)
    for index, (tension_l, tension_s, angle, _) in enumerate(rows.tolist()):
        case = brute.Case(unit, loads[index], tension_l, tension_s)
        moment = float(brute.forces(case, angle)[0])
        side = math.copysign(1.0, moment)
        excess = float(brute.excess(case, angle, side))
        scale = unit.friction_coefficient * unit.ball_radius
        assert got.side[index] == side
        assert got.excess[index] == pytest.approx(excess / scale, abs=1e-8)
        alone = boundary_distance(unit, *rows[index : index + 1].T, NOISE, loads[index])
        for part, one in zip(got, alone, strict=True):
            assert part[index] == pytest.approx(one[0], rel=1e-9)


@pytest.mark.parametrize('law', brute.LAWS)
def test_the_noise_is_that_of_every_law_load_and_load_cell(law):
    """Against the covariance of e and q from finite differences of the brute force."""
    unit, rows, loads, arrays = general_slips(law)
    cells = LoadCells(1.2, 0.9, 0.02, -0.03)
    measured = rows.copy()
    measured[:, 0] = (rows[:, 0] - cells.bias_l) / cells.gain_l
    measured[:, 1] = (rows[:, 1] - cells.bias_s) / cells.gain_s
    measured[:, 1] *= 1.01  # off the boundary
    got = boundary_distance(unit, *measured.T, NOISE, arrays, cells)
    scale = unit.friction_coefficient * unit.ball_radius

    def equations(row, load, side):
        tension_l, tension_s = cells.tensions(row[0], row[1])
        case = brute.Case(unit, load, tension_l, tension_s)
        normal = pressure(case, row[2], side) * unit.contact_area
        excess = float(brute.excess(case, row[2], side)) / scale
        return np.array([excess, row[3] * unit.contact_area - normal])

    variances = np.array([NOISE.tension, NOISE.tension, NOISE.bend_angle, NOISE.pressure]) ** 2
    for index, row in enumerate(measured):
        load, side = loads[index], got.side[index]
        columns = []
        for place, step in enumerate((1e-6, 1e-6, 1e-6, 1e-3)):
            change = np.zeros(4)
            change[place] = step
            ends = [equations(row + sign * change, load, side) for sign in (1.0, -1.0)]
            columns.append((ends[0] - ends[1]) / (2.0 * step))
        gradients = np.array(columns).T
        covariance = gradients * variances @ gradients.T
        whitened = np.linalg.solve(np.linalg.cholesky(covariance), equations(row, load, side))
        assert got.standardised[index] == pytest.approx(whitened[0], rel=1e-4)
        # The constants of the seat are summed up by two methods.
        assert got.pressure_standardised[index] == pytest.approx(whitened[1], rel=1e-3, abs=2e-3)


def test_where_there_is_no_friction_force_there_is_no_distance():
    got = distance(PRELIMINARY, [0.05, 1.0], [0.05, 2.0], [0.0, 0.1])
    assert np.isnan(got.standardised).tolist() == [True, False]
    assert np.isnan(got.pressure_standardised).all()
