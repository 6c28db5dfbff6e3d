"""`solve_batch` against a loop of `solve`, and what it makes of shapes and of invalid pairs."""

import math
import pickle
import random
import subprocess
import sys
from dataclasses import replace

import brute
import numpy as np
import pytest
from designs import PRELIMINARY, random_cases, random_design, random_tensions, tensions_at_slip
from hypothesis import given
from hypothesis import strategies as st
from programs import TIME_LIMIT
from thoroughness import examples

from tendon_statics import JointDesign, Load, Regime, TensionError, solve, solve_batch
from tendon_statics.physics.batch import INVALID, REGIME_CODES, pairs
from tendon_statics.physics.slip import Slip
from tendon_statics.physics.tensions import MAX_TENSION

NUMBERS = ('bend_angle', 'pressure', 'normal_force', 'residual')
FLAGS = ('stable', 'branch_consistent')
GROUPS = ('forces', 'force_remainder', 'bend_angle_gradient', 'pressure_gradient')
TOLERANCE = 1e-9

EDGES = [
    (0.0, 1.0),
    (1.0, 0.0),
    (-0.0, 0.0),
    (-1.0, 5.0),
    (5.0, -1.0),
    (math.nan, 1.0),
    (1.0, math.nan),
    (math.inf, 1.0),
    (1.0, -math.inf),
    (2.0 * MAX_TENSION, 1.0),
    (MAX_TENSION, MAX_TENSION),
    (5e-324, 5e-324),
]


def assert_is_a_loop_of_solve(design: JointDesign, tension_l, tension_s) -> None:
    """Every field of every pair is what `solve` says, or is marked where it raises."""
    answers = solve_batch(design, tension_l, tension_s)
    left, right = np.broadcast_arrays(np.asarray(tension_l, float), np.asarray(tension_s, float))
    names = (*NUMBERS, *FLAGS, *GROUPS, 'regime', 'root_count', 'iterations')
    fields = {name: getattr(answers, name) for name in names}
    for index in np.ndindex(left.shape):
        case = (design, float(left[index]), float(right[index]))
        try:
            alone = solve(*case)
        except TensionError:
            assert fields['regime'][index] == INVALID, case
            assert fields['root_count'][index] == fields['iterations'][index] == 0, case
            assert not any(fields[name][index] for name in FLAGS), case
            for name in NUMBERS:
                assert np.isnan(fields[name][index]), (name, case)
            for name in GROUPS:
                assert all(np.isnan(part[index]) for part in fields[name]), (name, case)
            continue
        assert fields['regime'][index] == REGIME_CODES[alone.regime], case
        assert fields['root_count'][index] == alone.root_count, case
        assert (fields['iterations'][index] > 0) == (alone.iterations > 0), case
        for name in FLAGS:
            assert fields[name][index] == bool(getattr(alone, name)), (name, case)
        scale = sum(case[1:]) * design.relative_lever / design.friction_coefficient
        assert_agree(
            fields['bend_angle'][index],
            alone.bend_angle,
            angle_tolerance(alone),
            ('bend_angle', case),
            relative=0.0,
        )
        for name in NUMBERS[1:]:
            tolerance = 1e-12 * scale if name == 'residual' else 0.0
            assert_agree(fields[name][index], getattr(alone, name), tolerance, (name, case))
        # Where roots are about to merge, forces and gradients change with the angle's last digits.
        if alone.bend_angle is not None:
            alone = alone._replace(bend_angle=float(fields['bend_angle'][index]))
        for name in GROUPS:
            expected = getattr(alone, name)
            # Parts next to nothing are held against the largest.
            largest = 0.0 if expected is None else max(map(abs, expected))
            for position, part in enumerate(fields[name]):
                value = None if expected is None else expected[position]
                assert_agree(part[index], value, TOLERANCE * largest, (name, case))


def angle_tolerance(equilibrium) -> float:
    """1e-12 rad, and as much as the rounding of the tensions moves a root that hardly is one."""
    gradient = equilibrium.bend_angle_gradient
    if gradient is None:
        return TOLERANCE
    rounding = 1e-15 * (equilibrium.tension_l + equilibrium.tension_s)
    return min(TOLERANCE, 1e-12 + rounding * max(map(abs, gradient)))


def assert_agree(value, expected, tolerance, of, relative=TOLERANCE) -> None:
    if expected is None:
        assert np.isnan(value), of
    else:
        # As `pytest.approx`, which takes most of the time for so many numbers.
        allowed = max(relative * abs(expected), tolerance)
        assert value == expected or abs(value - expected) <= allowed, of


@st.composite
def designs_with_pairs(draw: st.DrawFn):
    """Draw a design with many pairs of tensions, whole or with a property at its limit."""
    source = draw(st.randoms(use_true_random=False))
    design = random_design(source)
    change = draw(
        st.sampled_from(
            [
                {},
                {'friction_coefficient': 1.0},
                {'friction_coefficient': 0.3},
                {'com_distance': -0.03},
                {'com_distance': 0.0},
                {'contact_start_angle': 0.0, 'contact_end_angle': 1e-3},
                {'contact_start_angle': math.pi - 1e-3, 'contact_end_angle': math.pi},
                {'max_bend_angle': math.pi / 2},
                {'cable_offset': 0.0},
            ]
        )
    )
    design = replace(design, **change)
    pairs = [random_tensions(design, source) for _ in range(draw(st.integers(1, 25)))]
    if draw(st.booleans()):
        design = replace(design, mass=0.0)
    near = design.weight * (1.0 + 10.0 ** draw(st.floats(-6.0, -1.0)))
    pairs += [(0.3 * near, 0.7 * near), (0.5 * design.weight, 0.5 * design.weight)]
    return design, np.array(pairs + EDGES)


@given(designs_with_pairs())
@examples(150)
def test_a_batch_is_a_loop_of_solve(case):
    design, pairs = case
    assert_is_a_loop_of_solve(design, *pairs.T)


@given(designs_with_pairs())
@examples(30)
def test_mirrored_pairs_give_the_mirror_image(case):
    design, pairs = case
    tension_l, tension_s = pairs[pairs[:, 0] != pairs[:, 1]].T
    one, other = (
        solve_batch(design, tension_l, tension_s),
        solve_batch(design, tension_s, tension_l),
    )
    np.testing.assert_array_equal(one.regime, other.regime)
    np.testing.assert_array_equal(one.bend_angle, -other.bend_angle)
    np.testing.assert_array_equal(one.pressure, other.pressure)
    np.testing.assert_array_equal(one.forces.pressure_x, -other.forces.pressure_x)
    np.testing.assert_array_equal(
        one.bend_angle_gradient.tension_l, -other.bend_angle_gradient.tension_s
    )


@given(designs_with_pairs(), st.floats(-15.0, -6.0), st.floats(0.05, 0.95))
@examples(100)
def test_pairs_that_hardly_exceed_the_weight_keep_their_digits(case, exponent, share):
    design, _ = case
    total = design.weight * (1.0 + 10.0**exponent)
    pair = share * total, (1.0 - share) * total
    answers = solve_batch(design, *([tension] for tension in pair))
    try:
        alone = solve(design, *pair)
    except TensionError:
        assert answers.regime == [INVALID]
    else:
        assert answers.regime == [REGIME_CODES[alone.regime]]
        assert_agree(answers.pressure[0], alone.pressure, 0.0, (design, pair))


@given(designs_with_pairs(), st.floats(0.01, 30.0))
@examples(100)
def test_a_root_at_an_end_of_the_range_is_judged_as_by_solve(case, spare):
    """There the last bit decides the regime, so it has to be the same."""
    design, _ = case
    total = 1.05 * design.weight + spare
    pairs = [tensions_at_slip(design, angle, total) for angle in (0.0, design.max_bend_angle)]
    pairs = [pair for pair in pairs if min(pair) > 0.0]
    near = [(one * (1.0 + bits * 2.0**-52), two) for one, two in pairs for bits in range(-4, 5)]
    answers = solve_batch(design, *np.reshape(near, (-1, 2)).T)
    for index, pair in enumerate(near):
        alone = solve(design, *pair)
        assert answers.regime[index] == REGIME_CODES[alone.regime], (design, pair)
        assert answers.root_count[index] == alone.root_count, (design, pair)


@pytest.mark.parametrize('spared', ['mass', 'com_distance'])
def test_where_nothing_determines_an_angle_none_is_searched(spared, monkeypatch):
    """A flat function is never shown to have no root, so that the search ran to its limit."""
    probes = []
    probe = Slip.probe
    monkeypatch.setattr(Slip, 'probe', lambda *given: probes.append(given) or probe(*given))
    flat = replace(PRELIMINARY, **{spared: 0.0})
    pairs = [(1.0, tension_s) for tension_s in (1.0, 1.5, 2.0, 3.0)]
    alone = [solve(flat, *pair) for pair in pairs]
    batch = solve_batch(flat, *np.transpose(pairs))
    assert len(probes) < 10 * len(pairs)
    assert {one.regime for one in alone} == {Regime.HELD, Regime.DRIVEN_TO_STOP}
    assert batch.regime.tolist() == [REGIME_CODES[one.regime] for one in alone]


def test_designs_made_up_to_be_flat_are_left_to_solve():
    """No interval can be shown to hold one root; found when `solve` took a minute for one."""
    flat = JointDesign(
        *(0.01, 0.0, -0.0002779227153540849, 0.04868190611967352, 0.07164579484089229),
        *(2.118356171316682, 3.0877381018912082, 1.5, 9.81),
    )
    pair = (1.4073725036922449, 1.5926274963077551)
    answers = solve_batch(flat, [pair[0], 1.0], [pair[1], 4.0])
    assert answers.root_count[0] == solve(flat, *pair).root_count
    assert answers.bend_angle[0] == solve(flat, *pair).bend_angle


def test_several_roots_of_one_pair_are_counted_and_the_nearest_is_given():
    several = [case for case in random_cases(400, seed=1) if solve(*case).root_count > 1]
    assert len(several) >= 3
    for design, tension_l, tension_s in several:
        tensions = tension_l * np.linspace(0.98, 1.02, 41), np.full(41, tension_s)
        assert (solve_batch(design, *tensions).root_count > 1).any()
        assert_is_a_loop_of_solve(design, *tensions)


def test_every_angle_is_a_root_within_the_bracket():
    draw = np.random.default_rng(2)
    answers = solve_batch(PRELIMINARY, *draw.uniform(0.9, 2.1, (2, 20_000)))
    rooted = answers.regime == REGIME_CODES[Regime.EQUILIBRIUM]
    assert rooted.sum() > 300
    assert (np.abs(answers.residual[rooted]) < 1e-13).all()
    assert (answers.iterations[rooted] > 0).all()
    assert (answers.iterations[~rooted] == 0).all()


@pytest.mark.parametrize('size', [1, 6, 7, 8, 13, 14, 15])
def test_the_size_of_a_chunk_does_not_matter(size, monkeypatch):
    draw = np.random.default_rng(size)
    tensions = draw.uniform(0.0, 3.0, (2, size))
    whole = solve_batch(PRELIMINARY, *tensions)
    monkeypatch.setattr(pairs, 'CHUNK', 7)
    cut = solve_batch(PRELIMINARY, *tensions)
    for name in ('regime', 'root_count', 'iterations', *NUMBERS, *FLAGS):
        np.testing.assert_array_equal(getattr(cut, name), getattr(whole, name))
    for name in GROUPS:
        np.testing.assert_array_equal(getattr(cut, name), getattr(whole, name))


def test_shapes_broadcast_and_broadcast_tensions_are_no_copies():
    tension_l, tension_s = np.linspace(0.5, 2.0, 4), np.linspace(0.0, 3.0, 6)[:, None]
    answers = solve_batch(PRELIMINARY, tension_l, tension_s)
    assert answers.bend_angle.shape == answers.regime.shape == answers.tension_l.shape == (6, 4)
    assert answers.forces.pressure_x.shape == answers.branch_consistent.shape == (6, 4)
    assert np.shares_memory(answers.tension_l, tension_l)
    assert_is_a_loop_of_solve(PRELIMINARY, tension_l, tension_s)


@pytest.mark.parametrize(
    ('tension_l', 'tension_s', 'shape'),
    [
        (1.0, 2, ()),
        ([], [], (0,)),
        (np.empty((3, 0)), 1.0, (3, 0)),
        ([1, 1], [2, 3], (2,)),
        (np.ones((2, 3), np.float32), 2.0, (2, 3)),
        (np.linspace(0.3, 2.6, 24).reshape(4, 6)[::-2, ::-3], [[2.0, 1.0]], (2, 2)),
        (np.ones((2, 3), order='F'), np.arange(6.0).reshape(2, 3), (2, 3)),
    ],
)
def test_any_array_like_will_do(tension_l, tension_s, shape):
    answers = solve_batch(PRELIMINARY, tension_l, tension_s)
    assert answers.regime.shape == answers.pressure.shape == shape
    assert answers.pressure_gradient.tension_s.shape == shape
    assert_is_a_loop_of_solve(PRELIMINARY, tension_l, tension_s)


def test_loads_in_an_array_are_those_of_a_loop_of_solve():
    draw = random.Random(31)
    design = replace(PRELIMINARY, contact_law='elastic_seat')
    loads = [
        Load.tilted(draw.uniform(-3.0, 3.0), (draw.gauss(0.0, 0.1), draw.gauss(0.0, 0.1)), 0.03)
        for _ in range(60)
    ]
    pairs = np.array([(draw.uniform(0.3, 3.0), draw.uniform(0.3, 3.0)) for _ in loads])
    answers = solve_batch(design, *pairs.T, loads)
    for index, load in enumerate(loads):
        alone = solve(design, *pairs[index].tolist(), load)
        assert answers.regime_names[index] == alone.regime.value
        if alone.bend_angle is not None:
            assert answers.bend_angle[index] == pytest.approx(alone.bend_angle, abs=1e-9)


def test_the_inputs_are_left_alone():
    tension_l, tension_s = np.array([2.0, -1.0, 1.0]), np.array([1.0, 1.0, math.nan])
    tension_l.flags.writeable = tension_s.flags.writeable = False
    solve_batch(PRELIMINARY, tension_l, tension_s)
    assert tension_l.tolist() == [2.0, -1.0, 1.0]


@pytest.mark.parametrize(
    ('tension_l', 'tension_s', 'named'),
    [
        ([1.0, 2.0], [1.0, 2.0, 3.0], r'tension_l has shape \(2,\) and tension_s \(3,\)'),
        ([True, False], [1.0, 2.0], 'tension_l has values of type bool'),
        ([1.0], ['2'], 'tension_s has values of type'),
        ([1.0], [None], 'tension_s has values of type object'),
        ([1.0], [1j], 'tension_s has values of type complex'),
        ([[1.0], [1.0, 2.0]], [1.0], 'rows differ in length'),
    ],
)
def test_what_is_no_array_of_tensions_is_named(tension_l, tension_s, named):
    with pytest.raises(TensionError, match=named):
        solve_batch(PRELIMINARY, tension_l, tension_s)


def test_regimes_have_numbers_and_names():
    answers = solve_batch(PRELIMINARY, [1.0, 1.0, 1.0, 0.0, math.nan], [2.0, 1.5, 3.0, 2.0, 1.0])
    assert answers.regime_names.tolist() == [
        *('equilibrium', 'held', 'driven_to_stop', 'slack', 'invalid'),
    ]
    assert set(REGIME_CODES) == set(Regime)
    assert answers.regime.dtype == np.int8


def test_deviations_are_those_of_solve():
    answers = solve_batch(PRELIMINARY, [1.0, 1.0], [2.0, 1.5])
    alone = solve(PRELIMINARY, 1.0, 2.0)
    assert answers.bend_angle_stddev(0.01)[0] == pytest.approx(alone.bend_angle_stddev(0.01))
    assert answers.pressure_stddev(0.01)[0] == pytest.approx(alone.pressure_stddev(0.01))
    assert np.isnan(answers.bend_angle_stddev(0.01)[1])


def test_a_batch_can_be_pickled_and_not_changed():
    answers = solve_batch(PRELIMINARY, [1.0, 0.0], [2.0, 1.0])
    again = pickle.loads(pickle.dumps(answers))
    np.testing.assert_array_equal(again.bend_angle, answers.bend_angle)
    np.testing.assert_array_equal(again.forces, answers.forces)
    with pytest.raises(AttributeError):
        answers.bend_angle = None


def test_numpy_is_loaded_only_for_a_batch():
    code = (
        'import sys, tendon_statics, tendon_statics.physics as physics\n'
        'design = tendon_statics.load_design(tendon_statics.default_design_path())\n'
        'physics.solve(design, 1.0, 2.0)\n'
        'assert "numpy" not in sys.modules\n'
        'assert tendon_statics.solve_batch is physics.solve_batch\n'
        'assert "numpy" in sys.modules\n'
    )
    subprocess.run([sys.executable, '-c', code], check=True, timeout=TIME_LIMIT)


def test_margins_are_those_of_solve_under_every_law():
    draw = random.Random(9)
    for case in [brute.random_case(draw) for _ in range(60)]:
        answers = solve_batch(case.design, [case.tension_l], [case.tension_s], case.load)
        expected = solve(case.design, case.tension_l, case.tension_s, case.load).slip_margin
        if expected is None:
            assert math.isnan(answers.slip_margin[0])
        else:
            assert answers.slip_margin[0] == pytest.approx(expected, rel=1e-9)
