"""`slip_angle_distribution` against draws, and what it says at its ends."""

import itertools
import math
import random
from dataclasses import replace

import numpy as np
import pytest
from brute import Case, excess, random_case
from designs import PRELIMINARY

from tendon_statics import (
    DesignUncertainty,
    Load,
    Regime,
    TensionError,
    slip_angle_distribution,
    solve,
    solve_batch,
)
from tendon_statics.physics.batch import REGIME_CODES
from tendon_statics.physics.uncertainty import distribution_about

REGIMES = (Regime.EQUILIBRIUM, Regime.HELD, Regime.DRIVEN_TO_STOP, Regime.SLACK)
DRAWS = 20_000


def noisy_cases(count, seed):
    draw = random.Random(seed)
    for case in itertools.islice(iter(lambda: random_case(draw), None), count):
        share = draw.choice((0.002, 0.005, 0.01, 0.02))
        yield case, share * (case.tension_l + case.tension_s)


def drawn(case, stddev, seed):
    noise = np.random.default_rng(seed).normal(0.0, stddev, (2, DRAWS))
    tensions = np.maximum(np.array([[case.tension_l], [case.tension_s]]) + noise, 0.0)
    return solve_batch(case.design, tensions[0], tensions[1], case.load)


def assert_probabilities(found, answers, case):
    """Assert those of all regimes; return the angles of the draws that are in equilibrium."""
    for regime in REGIMES:
        share = np.mean(answers.regime == REGIME_CODES[regime])
        assert found.probability(regime) == pytest.approx(share, abs=0.02), (case, regime)
    return answers.bend_angle[answers.regime == REGIME_CODES[Regime.EQUILIBRIUM]]


def assert_interval(found, rooted, case):
    low, high = found.interval(0.9)
    covered = np.mean((rooted >= low) & (rooted <= high))
    assert covered == pytest.approx(0.9, abs=0.03), case


def test_probabilities_and_intervals_are_those_of_draws():
    """Of random units of every law, tilt, tip force and stiffness."""
    closed = intervals = 0
    for seed, (case, stddev) in enumerate(noisy_cases(60, seed=5)):
        found = slip_angle_distribution(
            case.design, case.tension_l, case.tension_s, tension_stddev=stddev, load=case.load
        )
        answers = drawn(case, stddev, seed)
        rooted = assert_probabilities(found, answers, case)
        if len(rooted) > 0.05 * DRAWS:
            assert_interval(found, rooted, case)
            intervals += 1
        closed += found.is_closed_form
    assert closed == 60
    assert intervals > 15


def with_weaker(case, weaker):
    """Return a case with the same sum of tensions and side, and another weaker cable."""
    total = case.tension_l + case.tension_s
    if case.tension_l < case.tension_s:
        return case._replace(tension_l=weaker, tension_s=total - weaker)
    return case._replace(tension_l=total - weaker, tension_s=weaker)


@pytest.mark.parametrize('kind', ['equal', 'slack'])
def test_next_to_equal_tensions_and_to_a_slack_cable_it_is_in_closed_form_too(kind):
    draw = random.Random(kind)
    intervals = doubtful = 0
    for seed, (case, stddev) in enumerate(noisy_cases(120, seed=31)):
        far = draw.uniform(0.0, 5.0) * stddev
        total = case.tension_l + case.tension_s
        case = with_weaker(case, far if kind == 'slack' else 0.5 * (total - far))
        found = slip_angle_distribution(
            case.design, case.tension_l, case.tension_s, tension_stddev=stddev, load=case.load
        )
        if not found.is_closed_form:
            continue
        assert sum(found.probabilities.values()) == pytest.approx(1.0, abs=1e-9)
        answers = drawn(case, stddev, seed)
        rooted = assert_probabilities(found, answers, case)
        doubtful += max(found.probabilities.values()) < 0.98
        if len(rooted) > 0.1 * DRAWS:
            assert_interval(found, rooted, case)
            intervals += 1
    assert doubtful > 10
    assert intervals > 10


def test_next_to_equal_tensions_each_side_has_its_own_angles():
    """Against draws, on both sides of 0."""
    slippery = replace(PRELIMINARY, friction_coefficient=0.02)
    case = Case(slippery, Load(), 1.0, 1.01)
    found = slip_angle_distribution(slippery, 1.0, 1.01, tension_stddev=0.015)
    assert found.is_closed_form
    angles = drawn(case, 0.015, seed=2)
    at_root = angles.regime == REGIME_CODES[Regime.EQUILIBRIUM]
    driven = angles.regime == REGIME_CODES[Regime.DRIVEN_TO_STOP]
    for side in (1.0, -1.0):
        of_side = side * (angles.tension_s - angles.tension_l) > 0.0
        for angle in (0.05, 0.15, 0.4):
            before = driven | (at_root & (np.abs(angles.bend_angle) <= angle))
            share = np.mean(before[of_side])
            assert found.cdf(side * angle) == pytest.approx(share, abs=0.02)
    assert found.cdf(0.0) == pytest.approx(
        np.mean(driven[angles.tension_s > angles.tension_l]), abs=0.02
    )
    assert found.cdf(found.quantile(0.7)) == pytest.approx(0.7, abs=1e-4)
    low, high = found.interval(0.9)
    assert low < 0.0 < high


def test_quantiles_next_to_a_slack_cable_leave_out_what_is_slack():
    found = slip_angle_distribution(PRELIMINARY, 0.02, 1.0, tension_stddev=0.01)
    assert found.is_closed_form
    assert found.probability('slack') == pytest.approx(0.0228, abs=1e-4)
    whole = found.cdf(PRELIMINARY.max_bend_angle) + found.probability('held')
    assert whole + found.probability('slack') == pytest.approx(1.0)


def test_where_noise_both_turns_and_slackens_the_cables_it_is_drawn():
    case = replace(PRELIMINARY, friction_coefficient=0.02)
    found = slip_angle_distribution(case, 1.0, 1.001, tension_stddev=0.3)
    assert not found.is_closed_form
    answers = drawn(Case(case, Load(), 1.0, 1.001), 0.3, seed=4)
    assert_probabilities(found, answers, case)
    for share in (0.97, 0.99):
        assert found.cdf(found.quantile(share)) == pytest.approx(share, abs=1e-3)


def side_is_sure(case, stddev):
    """Whether noise changes neither which cable is the stronger nor that both are taut."""
    weak, strong = sorted((case.tension_l, case.tension_s))
    return min(weak, (strong - weak) / math.sqrt(2.0)) > 5.0 * stddev


def turns(case):
    """Whether the slip function both rises and falls within the range."""
    side = -1.0 if case.tension_l > case.tension_s else 1.0
    angles = np.linspace(0.0, side * case.design.max_bend_angle, 100)
    slopes = np.diff(excess(case, angles, side))
    return slopes.max() > 0.0 > slopes.min()


def test_where_the_slip_function_turns_the_root_nearest_to_0_counts():
    """In closed form too, of units that turn within the noise of slipping somewhere."""
    intervals = tried = 0
    for seed, (case, stddev) in enumerate(noisy_cases(300, seed=9)):
        if not turns(case) or not side_is_sure(case, stddev):
            continue
        found = slip_angle_distribution(
            case.design, case.tension_l, case.tension_s, tension_stddev=stddev, load=case.load
        )
        if max(found.probabilities.values()) > 0.99:
            continue
        tried += 1
        answers = drawn(case, stddev, seed)
        rooted = assert_probabilities(found, answers, case)
        if len(rooted) > 0.1 * DRAWS:
            assert_interval(found, rooted, case)
            intervals += 1
            for share in (0.2, 0.7):
                angle = found.quantile(found.cdf(0.0) + share * found.probability('equilibrium'))
                before = np.mean(np.abs(rooted) <= abs(angle))
                assert before == pytest.approx(share, abs=0.03), case
    assert tried >= 5
    assert intervals >= 2


def test_a_slip_function_that_turns_next_to_0_is_followed_there():
    """Between looks far apart its turn was taken for part of a rise, 0.023 in probability."""
    design = replace(
        PRELIMINARY,
        ball_radius=0.014544,
        cable_offset=0.0054077,
        com_distance=-0.03547,
        mass=0.050891,
        friction_coefficient=0.17746,
        contact_start_angle=0.92541,
        contact_end_angle=1.34986,
        max_bend_angle=1.0407,
    )
    load = Load((0.99135, 0.0, -0.13127), (-0.91168, -0.11574), 0.0095745)
    case, stddev = Case(design, load, 2.74313, 4.85459), 0.037989
    assert turns(case)
    found = slip_angle_distribution(design, *case[2:], tension_stddev=stddev, load=load)
    answers = drawn(case, stddev, seed=3)
    share = np.mean(answers.regime == REGIME_CODES[Regime.EQUILIBRIUM])
    assert found.probability('equilibrium') == pytest.approx(share, abs=0.01)


def test_the_published_pair():
    """What the gradient calls ±7 degrees in a range of 30."""
    found = slip_angle_distribution(PRELIMINARY, 1.0, 2.0, tension_stddev=0.01)
    assert found.is_closed_form
    assert sum(found.probability(regime) for regime in REGIMES) == pytest.approx(1.0)
    assert found.cdf(math.radians(17.14)) == pytest.approx(0.5, abs=1e-6)
    assert found.quantile(0.5) == pytest.approx(math.radians(17.14), abs=1e-6)
    assert found.cdf(0.0) == found.probability('driven_to_stop')
    assert 1.0 - found.cdf(PRELIMINARY.max_bend_angle) == pytest.approx(found.probability('held'))
    mirrored = slip_angle_distribution(PRELIMINARY, 2.0, 1.0, tension_stddev=0.01)
    assert mirrored.quantile(0.4) == pytest.approx(-found.quantile(0.4))
    assert mirrored.interval(0.8) == pytest.approx([-end for end in found.interval(0.8)[::-1]])


def test_a_quantile_within_another_regime_is_none():
    held = slip_angle_distribution(PRELIMINARY, 1.0, 1.5, tension_stddev=0.01)
    assert held.probability('held') == pytest.approx(1.0)
    assert held.quantile(0.5) is None
    assert held.interval() is None


@pytest.mark.parametrize('law', ['merged', 'friction_circle', 'elastic_seat'])
def test_the_designs_own_uncertainty_counts(law):
    """Against draws of designs, solved one by one."""
    design = replace(PRELIMINARY, contact_law=law, friction_coefficient=0.3)
    assert_as_of_drawn_designs(design, 1.01 * _slip_tension(design), 0.01)


def test_the_designs_own_uncertainty_counts_next_to_equal_tensions_too():
    design = replace(PRELIMINARY, friction_coefficient=0.02)
    assert_as_of_drawn_designs(design, 1.003, 0.005)


def assert_as_of_drawn_designs(design, tension_s, friction_stddev):
    names = ('friction_coefficient', 'cable_offset')
    deviations = np.array([friction_stddev, 1e-4])
    uncertainty = DesignUncertainty(names, tuple(map(tuple, np.diag(deviations**2).tolist())))
    found = slip_angle_distribution(
        design, 1.0, tension_s, tension_stddev=0.005, design_covariance=uncertainty
    )
    assert found.is_closed_form
    noise = np.random.default_rng(8)
    regimes = []
    for _ in range(4000):
        values = dict(zip(names, noise.normal(0.0, deviations).tolist(), strict=True))
        other = replace(
            design, **{name: getattr(design, name) + change for name, change in values.items()}
        )
        pair = np.array([1.0, tension_s]) + noise.normal(0.0, 0.005, 2)
        regimes.append(solve(other, *pair).regime)
    for regime in REGIMES:
        share = sum(one is regime for one in regimes) / len(regimes)
        assert found.probability(regime) == pytest.approx(share, abs=0.035), regime


def _slip_tension(design):
    low, high = 1.0, 20.0
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        low, high = (
            (middle, high) if solve(design, 1.0, middle).regime == 'held' else (low, middle)
        )
    return high


@pytest.mark.parametrize('stddev', [0.0, -1.0, math.nan, math.inf])
def test_a_deviation_that_is_none_is_refused(stddev):
    with pytest.raises(ValueError, match='must be above 0'):
        slip_angle_distribution(PRELIMINARY, 1.0, 2.0, tension_stddev=stddev)


def test_a_slack_cable_is_refused():
    with pytest.raises(TensionError, match='slack'):
        slip_angle_distribution(PRELIMINARY, 0.0, 2.0, tension_stddev=0.01)


@pytest.mark.parametrize('level', [0.0, 1.0, math.nan])
def test_levels_are_between_0_and_1(level):
    found = slip_angle_distribution(PRELIMINARY, 1.0, 2.0, tension_stddev=0.01)
    with pytest.raises(ValueError, match='between 0 and 1'):
        found.interval(level)
    with pytest.raises(ValueError, match='between 0 and 1'):
        found.quantile(level)


def test_an_interval_ends_where_its_probability_does():
    """Also where σ_g changes so much with the angle that steps by the slope of g fall short."""
    intervals = 0
    for case, stddev in noisy_cases(1000, seed=11):
        if abs(case.tension_l - case.tension_s) < 8.0 * stddev:
            continue  # `cdf` is that of one side.
        found = slip_angle_distribution(
            case.design, case.tension_l, case.tension_s, tension_stddev=stddev, load=case.load
        )
        if not found.is_closed_form or (interval := found.interval(0.9)) is None:
            continue
        one, other = (found.cdf(angle) for angle in interval)
        whole = found.probability('equilibrium')
        assert abs(other - one) == pytest.approx(0.9 * whole, abs=5e-4), case
        intervals += 1
    assert intervals > 100


@pytest.mark.parametrize('kind', ['any', 'equal', 'slack'])
def test_cdf_of_a_quantile_is_its_probability(kind):
    """But across a kink of K, which that of the elastic seat may have: there σ_g jumps."""
    draw = random.Random(kind)
    quantiles = 0
    for case, stddev in noisy_cases(600, seed=41):
        if kind != 'any':
            total = case.tension_l + case.tension_s
            far = draw.uniform(0.0, 6.0) * stddev
            case = with_weaker(case, far if kind == 'slack' else 0.5 * (total - far))
        found = slip_angle_distribution(
            case.design, case.tension_l, case.tension_s, tension_stddev=stddev, load=case.load
        )
        if not found.is_closed_form:
            continue
        stop = case.design.max_bend_angle
        side = 1.0 if case.tension_s >= case.tension_l else -1.0
        ends = found.cdf(side * 1e-9), found.cdf(side * stop)
        for share in (0.01, 0.3, 0.8, 0.99):
            q = min(ends) + share * abs(ends[1] - ends[0])
            if 0.0 < q < 1.0 and (angle := found.quantile(q)) is not None:
                has_kink = case.design.contact_law == 'elastic_seat'
                assert found.cdf(angle) == pytest.approx(q, abs=0.02 if has_kink else 1e-3), case
                quantiles += 1
    assert quantiles > 300


def test_the_unlikelier_side_has_its_own_angles_too():
    """Against draws of what would make it the stronger, once in 300 times."""
    slippery = replace(PRELIMINARY, friction_coefficient=0.01)
    left, right, stddev = 1.0, 1.05, 0.013
    found = slip_angle_distribution(slippery, left, right, tension_stddev=stddev)
    noise = np.random.default_rng(6).normal(0.0, stddev, (2, 3_000_000))
    pairs = np.array([[left], [right]]) + noise
    pairs = pairs[:, pairs[0] > pairs[1]]
    answers = solve_batch(slippery, *pairs)
    driven = answers.regime == REGIME_CODES[Regime.DRIVEN_TO_STOP]
    at_root = answers.regime == REGIME_CODES[Regime.EQUILIBRIUM]
    assert pairs.shape[1] > 8000
    for angle in (-0.01, -0.05):
        share = np.mean(driven | (at_root & (answers.bend_angle >= angle)))
        assert 0.02 < share < 0.98
        assert found.cdf(angle) == pytest.approx(share, abs=0.015)


def test_what_is_known_about_an_equilibrium_is_what_is_known_of_its_tensions():
    for case, stddev in noisy_cases(200, seed=12):
        given = case.design, case.tension_l, case.tension_s
        of_tensions = slip_angle_distribution(*given, tension_stddev=stddev, load=case.load)
        if not of_tensions.is_closed_form:
            continue
        found = distribution_about(solve(*given, case.load), stddev)
        assert found.interval(0.9) == of_tensions.interval(0.9)
        assert found.probabilities == of_tensions.probabilities


def test_a_covariance_without_an_inverse_is_one():
    """Of mass and gravity, whose product is known but for rounding: g hardly varies with them."""
    design = replace(PRELIMINARY, mass=0.01)
    slope = design.gravity / design.mass
    exact = slip_angle_distribution(design, 1.0, 2.0, tension_stddev=0.01)
    for correlation in (-1.0, -1.0 - 1e-10, -1.0 - 1e-9):
        both = correlation * 1e-8 * slope
        known = DesignUncertainty(('mass', 'gravity'), ((1e-8, both), (both, 1e-8 * slope**2)))
        found = slip_angle_distribution(
            design, 1.0, 2.0, tension_stddev=0.01, design_covariance=known
        )
        assert found.probabilities == pytest.approx(exact.probabilities, abs=1e-6)


def test_an_equilibrium_that_is_all_but_impossible_has_no_interval():
    for case, stddev in noisy_cases(300, seed=21):
        found = slip_angle_distribution(
            case.design, case.tension_l, case.tension_s, tension_stddev=stddev, load=case.load
        )
        if found.is_closed_form:
            is_rare = found.probability('equilibrium') < 1e-3
            assert (found.interval(0.999) is None) is is_rare
