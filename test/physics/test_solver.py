"""`solve` against published, recorded and independent results, and by its properties."""

import csv
import json
import math
import pickle
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from designs import PRELIMINARY, cases, random_cases
from hypothesis import assume, given
from hypothesis import strategies as st
from quartic import solve_quartic
from thoroughness import examples

from tendon_statics import Equilibrium, JointDesign, Regime, TensionError, solve
from tendon_statics.physics import UPRIGHT, design_parameters, residual

ANGLE_TOLERANCE = 1e-9
PRESSURE_TOLERANCE = 1e-9
REFERENCE = Path(__file__).parents[1] / 'data' / 'reference_cases.csv'


def reference_cases():
    """Rows of an independent solver's results, with their designs."""
    with REFERENCE.open(newline='') as file:
        for row in csv.DictReader(file):
            design = JointDesign(
                **{p.name: float(row[p.name]) for p in design_parameters() if p.name in row}
            )
            yield design, row


def assert_agrees(equilibrium: Equilibrium, regime: str, roots: int, angle, pressure) -> None:
    assert equilibrium.regime == regime
    assert equilibrium.root_count == roots
    if angle is None:
        assert equilibrium.bend_angle is None
        assert equilibrium.pressure is None
    else:
        assert equilibrium.bend_angle == pytest.approx(angle, abs=ANGLE_TOLERANCE, rel=0.0)
        assert equilibrium.pressure == pytest.approx(pressure, rel=PRESSURE_TOLERANCE)


def test_a_regime_is_the_same_key_as_its_value():
    """As what is equal has to be."""
    assert {Regime.HELD: 1.0}['held'] == 1.0
    assert len({*Regime, *map(str, Regime)}) == len(Regime)


def test_the_published_case():
    equilibrium = solve(PRELIMINARY, 1.0, 2.0)
    assert math.degrees(equilibrium.bend_angle) == pytest.approx(17.14, abs=5e-6)
    assert equilibrium.pressure == pytest.approx(405.6, abs=5e-6)
    assert equilibrium.stable is False
    assert equilibrium.branch_consistent is True
    assert 1 <= equilibrium.iterations <= 12
    assert abs(equilibrium.residual) < 1e-12


@pytest.mark.parametrize(
    ('design', 'row'),
    [
        pytest.param(*case, id=f'{i}-{case[1]["design"]}')
        for i, case in enumerate(reference_cases())
    ],
)
def test_recorded_results_of_an_independent_solver(design, row):
    equilibrium = solve(design, float(row['tension_l']), float(row['tension_s']))
    angle = float(row['bend_angle']) if row['bend_angle'] else None
    pressure = float(row['pressure']) if row['pressure'] else None
    assert_agrees(equilibrium, row['regime'], int(row['root_count']), angle, pressure)


def test_400_random_designs_agree_with_the_quartic():
    seen = Counter()
    for design, tension_l, tension_s in random_cases(400, seed=1):
        expected = solve_quartic(design, tension_l, tension_s)
        assert not expected.doubtful, (design, tension_l, tension_s)
        side = -1.0 if tension_l > tension_s else 1.0
        angle = None
        if expected.regime == 'equilibrium':
            angle = side * expected.roots[0]
        elif expected.regime == 'driven_to_stop':
            angle = side * design.max_bend_angle
        assert_agrees(
            solve(design, tension_l, tension_s),
            expected.regime,
            len(expected.roots),
            angle,
            expected.pressure,
        )
        seen[expected.regime] += 1
        seen['several'] += len(expected.roots) > 1
    # The sample is worth its name only if it holds every kind of case.
    assert min(seen[regime] for regime in ('equilibrium', 'held', 'driven_to_stop')) >= 40
    assert seen['several'] >= 3


@given(cases())
@examples(200)
def test_drawn_designs_agree_with_the_quartic(case):
    design, tension_l, tension_s = case
    expected = solve_quartic(design, tension_l, tension_s)
    assume(not expected.doubtful)
    equilibrium = solve(design, tension_l, tension_s)
    assert equilibrium.regime == expected.regime
    assert equilibrium.root_count == len(expected.roots)
    if expected.roots:
        assert abs(equilibrium.bend_angle) == pytest.approx(
            expected.roots[0], abs=ANGLE_TOLERANCE, rel=0.0
        )
    if expected.pressure is not None:
        assert equilibrium.pressure == pytest.approx(expected.pressure, rel=PRESSURE_TOLERANCE)


@given(cases())
def test_mirrored_tensions_give_the_mirror_image(case):
    design, tension_l, tension_s = case
    assume(tension_l != tension_s)
    one, other = solve(design, tension_l, tension_s), solve(design, tension_s, tension_l)
    assert one.regime == other.regime
    assert one.pressure == other.pressure
    assert one.stable == other.stable
    assert one.residual == other.residual
    if one.bend_angle is not None:
        assert one.bend_angle == -other.bend_angle
        assert one.forces.pressure_x == -other.forces.pressure_x
        assert one.forces.friction_z == other.forces.friction_z
        assert one.force_remainder.x == -other.force_remainder.x
        assert one.force_remainder.z == other.force_remainder.z
    if one.bend_angle_gradient is not None:
        assert one.bend_angle_gradient.tension_l == -other.bend_angle_gradient.tension_s
        assert one.pressure_gradient.tension_l == other.pressure_gradient.tension_s


@given(cases())
def test_a_result_proves_itself(case):
    """The angle is a root, and the forces are those of the three equations."""
    design, tension_l, tension_s = case
    equilibrium = solve(design, tension_l, tension_s)
    assume(equilibrium.bend_angle is not None)
    total, normal = tension_l + tension_s, equilibrium.normal_force
    assert equilibrium.residual == residual(
        design, *sorted((tension_l, tension_s)), abs(equilibrium.bend_angle)
    )
    if equilibrium.regime is Regime.EQUILIBRIUM:
        scale = total * (1.0 + design.cable_offset / design.ball_radius)
        assert abs(equilibrium.residual) <= 1e-12 * scale / design.friction_coefficient
        assert 0.0 <= abs(equilibrium.bend_angle) <= design.max_bend_angle
    else:
        assert equilibrium.residual > 0.0
        assert abs(equilibrium.bend_angle) == design.max_bend_angle
    forces = equilibrium.forces
    assert math.hypot(forces.pressure_x, forces.pressure_z) == pytest.approx(normal)
    assert math.hypot(forces.friction_x, forces.friction_z) == pytest.approx(
        design.friction_coefficient * normal
    )
    # Eqs. (1) and (2), squared and added: what the merge does ask for.
    along, across = forces.friction_x, design.weight - forces.friction_z
    assert (total - normal) ** 2 == pytest.approx(along**2 + across**2, abs=1e-9 * total**2)


@given(cases())
@examples(200)
def test_derivatives_are_those_of_finite_differences(case):
    design, tension_l, tension_s = case
    here = solve(design, tension_l, tension_s)
    assume(here.bend_angle_gradient is not None and tension_l != tension_s)
    steepness = max(map(abs, here.bend_angle_gradient))
    step = min(1e-5 / max(steepness, 1e-3), 1e-5 * (tension_l + tension_s))
    for index, name in enumerate(('tension_l', 'tension_s')):
        near = []
        for sign in (-1.0, 1.0):
            tensions = [tension_l, tension_s]
            tensions[index] += sign * step
            assume(min(tensions) > 0.0 and sum(tensions) > design.weight)
            near.append(solve(design, *tensions))
        assume(all(e.regime == here.regime and e.root_count == here.root_count for e in near))
        before, after = near
        # Where the curve bends within a step, differences of it say nothing.
        forward, backward = after.bend_angle_gradient, before.bend_angle_gradient
        assume(forward is not None and backward is not None)
        angle_slope = getattr(here.bend_angle_gradient, name)
        assume(
            abs(getattr(forward, name) - getattr(backward, name)) < 1e-2 * abs(angle_slope) + 1e-9
        )
        assert (after.bend_angle - before.bend_angle) / (2 * step) == pytest.approx(
            angle_slope, rel=1e-3, abs=1e-6
        )
        assert (after.pressure - before.pressure) / (2 * step) == pytest.approx(
            getattr(here.pressure_gradient, name), rel=1e-3, abs=1e-3
        )


def test_sensitivity_of_the_published_case():
    gradient = solve(PRELIMINARY, 1.0, 2.0).bend_angle_gradient
    assert math.degrees(gradient.tension_l) == pytest.approx(627.6, abs=0.05)
    assert math.degrees(gradient.tension_s) == pytest.approx(-319.8, abs=0.05)
    assert math.degrees(solve(PRELIMINARY, 1.0, 2.0).bend_angle_stddev(0.01)) == pytest.approx(
        math.hypot(6.276, 3.198), abs=1e-3
    )


def test_what_is_not_determined_is_none():
    for tensions, regime in (((1.0, 1.5), Regime.HELD), ((0.0, 2.0), Regime.SLACK)):
        equilibrium = solve(PRELIMINARY, *tensions)
        assert equilibrium == Equilibrium(
            PRELIMINARY, UPRIGHT, regime, *tensions, root_count=0, iterations=0
        )
        assert equilibrium.bend_angle_stddev(0.01) is None
        assert equilibrium.pressure_stddev(0.01) is None


@pytest.mark.parametrize('tensions', [(1.0, 2.0), (3.0, 1.0), (1.0, 1.5), (0.0, 2.0)])
def test_a_result_is_a_value(tensions):
    """It can be pickled, compared and hashed, and not changed."""
    equilibrium = solve(PRELIMINARY, *tensions)
    again = pickle.loads(pickle.dumps(equilibrium))
    assert again == equilibrium == solve(PRELIMINARY, *tensions)
    assert hash(again) == hash(equilibrium)
    assert again.as_dict() == equilibrium.as_dict()
    for name in ('bend_angle', 'forces', 'something_else'):
        with pytest.raises(AttributeError):
            setattr(equilibrium, name, None)


def test_the_dict_has_all_that_the_result_has():
    equilibrium = solve(PRELIMINARY, 1.0, 2.0)
    fields = equilibrium.as_dict()
    assert set(Equilibrium._fields) - set(fields) == {'design', 'load', 'slip_gradient'}
    for name, value in fields.items():
        attribute = getattr(equilibrium, name)
        assert value == (attribute._asdict() if isinstance(value, dict) else attribute), name
    assert all(value is not None for value in fields.values())
    assert set(solve(PRELIMINARY, 1.0, 1.5).as_dict()) == set(fields)


def test_at_the_stop_the_angle_does_not_follow_the_tensions():
    equilibrium = solve(PRELIMINARY, 1.0, 3.0)
    assert equilibrium.regime is Regime.DRIVEN_TO_STOP
    assert equilibrium.stable is True
    assert tuple(equilibrium.bend_angle_gradient) == (0.0, 0.0)
    assert all(slope > 0.0 for slope in equilibrium.pressure_gradient)


def test_two_roots_between_ends_of_one_sign():
    """The recorded design with two roots: the nearest to zero is given, both are counted."""
    design, row = next(
        (design, row) for design, row in reference_cases() if row['root_count'] == '2'
    )
    tensions = float(row['tension_l']), float(row['tension_s'])
    ends = [residual(design, *sorted(tensions), angle) for angle in (0.0, design.max_bend_angle)]
    assert ends[0] * ends[1] > 0.0
    assert solve(design, *tensions).root_count == 2


def test_a_weightless_unit_has_no_angle_of_its_own():
    weightless = replace(PRELIMINARY, mass=0.0)
    assert solve(weightless, 1.0, 1.5).regime is Regime.HELD
    assert solve(weightless, 1.0, 3.0).regime is Regime.DRIVEN_TO_STOP


def test_friction_above_one_and_a_heavy_unit_keep_their_digits():
    """B < 0, where the usual rationalised root cancels: μ W sin φ above T, T just above W."""
    design = replace(PRELIMINARY, friction_coefficient=1.5, mass=0.2, com_distance=0.0)
    total = design.weight * (1.0 + 1e-9)
    expected = solve_quartic(design, total * 0.01, total * 0.99)
    assert expected.regime == 'driven_to_stop'
    pressure = solve(design, total * 0.01, total * 0.99).pressure
    assert pressure == pytest.approx(expected.pressure, rel=PRESSURE_TOLERANCE)


@given(cases(), st.floats(-12.0, -1.0), st.floats(0.1, 0.9))
@examples(150)
def test_tensions_that_hardly_exceed_the_weight_keep_their_digits(case, exponent, share):
    design, _, _ = case
    total = design.weight * (1.0 + 10.0**exponent)
    tensions = total * share, total * (1.0 - share)
    assume(sum(tensions) > design.weight)
    expected, equilibrium = solve_quartic(design, *tensions), solve(design, *tensions)
    assume(not expected.doubtful and expected.regime == equilibrium.regime)
    if expected.pressure is not None:
        assert equilibrium.pressure == pytest.approx(expected.pressure, rel=PRESSURE_TOLERANCE)


@pytest.mark.parametrize(
    ('values', 'tensions'),
    [
        (
            (
                *(0.01, 0.0, -0.0002779227153540849, 0.04868190611967352, 0.07164579484089229),
                *(2.118356171316682, 3.0877381018912082, 1.5, 9.81),
            ),
            (1.4073725036922449, 1.5926274963077551),
        ),
        (
            (
                *(0.01, 0.0, -0.001169859696948364, 0.22740897014644076, 0.6358340818281637),
                *(2.1225203802187065, 3.0879572707807887, 1.5, 9.81),
            ),
            (1.2054060440733825, 1.7945939559266175),
        ),
        ((0.01, 0.0, 0.01, 5e-324, 1.05, 1.0, 1.5, 0.5, 9.81), (1.0, 2.05)),
        ((0.01, 0.0, 0.01, 1e-310, 1.0, 1.0, 1.5, 0.5, 9.81), (1.0, 3.0)),
    ],
)
def test_a_design_made_up_to_be_flat_is_solved_without_end_or_invention(values, tensions):
    """G is zero to rounding over a wide range: once a minute's work and 97578 roots."""
    equilibrium = solve(JointDesign(*values), *tensions)
    assert equilibrium.root_count <= 4
    json.dumps(equilibrium.as_dict(), allow_nan=False)


def test_where_two_roots_merge_no_more_than_two_are_seen():
    design = next(design for design, row in reference_cases() if row['root_count'] == '2')
    counts = set()
    for index in range(100):
        tension_s = 1.212456747700884 + 2e-14 * index / 100
        counts.add(solve(design, 0.6492, tension_s).root_count)
    assert counts <= {0, 1, 2}


@pytest.mark.parametrize('scale', [1e-6, 1.0, 1e8])
def test_scaling_all_forces_scales_the_pressure_alone(scale):
    heavy = replace(PRELIMINARY, gravity=1e-6)
    design = replace(heavy, mass=min(heavy.mass * scale, 100.0))
    factor = design.mass / heavy.mass
    one, scaled = solve(heavy, 1e-6, 2e-6), solve(design, 1e-6 * factor, 2e-6 * factor)
    assert scaled.regime == one.regime
    assert scaled.pressure == pytest.approx(factor * one.pressure, rel=1e-12)


@pytest.mark.parametrize(
    ('tensions', 'named'),
    [
        ((math.nan, 2.0), 'tension_l is nan'),
        ((1.0, math.inf), 'tension_s is inf'),
        ((-math.inf, 1.0), 'tension_l is -inf'),
        ((1.0, -0.5), 'tension_s is -0.5'),
        ((0.0, -0.5), 'tension_s is -0.5'),
        ((1.0, 2e9), 'tension_s is 2000000000.0'),
        ((0.05, 0.1), '0.05 + 0.1'),
        (('1', 2.0), "tension_l is '1'"),
        ((True, 2.0), 'tension_l is True'),
        ((None, 2.0), 'tension_l is None'),
        ((10**400, 2.0), 'tension_l is inf'),
    ],
)
def test_bad_tensions_are_named(tensions, named):
    with pytest.raises(TensionError, match=named.replace('+', r'\+')):
        solve(PRELIMINARY, *tensions)


@pytest.mark.parametrize('tensions', [(0.0, 2.0), (2.0, 0.0), (0.0, 0.0), (-0.0, 0.01), (0, 1)])
def test_no_tension_is_slack(tensions):
    assert solve(PRELIMINARY, *tensions).regime is Regime.SLACK


@given(
    st.floats(allow_nan=True, allow_infinity=True), st.floats(allow_nan=True, allow_infinity=True)
)
@examples(500)
def test_any_two_floats_give_a_finite_answer_or_a_tension_error(tension_l, tension_s):
    try:
        equilibrium = solve(PRELIMINARY, tension_l, tension_s)
    except TensionError:
        return
    numbers = [equilibrium.bend_angle, equilibrium.pressure, equilibrium.residual]
    numbers += [*(equilibrium.bend_angle_gradient or ()), *(equilibrium.pressure_gradient or ())]
    assert all(math.isfinite(number) for number in numbers if number is not None)


@given(st.integers(0, 2**32))
@examples(100)
def test_numpy_scalars_are_numbers(seed):
    import numpy as np

    tensions = np.random.default_rng(seed).uniform(0.5, 3.0, 2)
    assert solve(PRELIMINARY, *tensions) == solve(PRELIMINARY, *tensions.tolist())
