"""`StickSlipFilter`: where a unit is under noise, how sure that is, and what it never does."""

import dataclasses
import math
import warnings

import numpy as np
import pytest
from designs import PRELIMINARY
from measure_filter.sessions import UNITS, session, slip_tension
from thoroughness import few_of, some_of

from tendon_statics import (
    BendAngleError,
    DesignUncertainty,
    Load,
    Regime,
    StickSlipFilter,
    StickSlipTracker,
    TensionError,
    design_parameters,
)

HANGING, _ = UNITS['hanging']
NOISE = 0.02


def fed(found, tensions, *, rate=500.0, noise=NOISE, seed=1, start=0.0, load=None):
    """Feed a filter with noise on tensions; return its states."""
    random = np.random.default_rng(seed)
    states = []
    for index, pair in enumerate(tensions):
        noisy = np.array(pair) + random.normal(0.0, noise, 2)
        more = () if load is None else (load,)
        states.append(found.update(*noisy, start + index / rate, *more))
    return states


RAMP = [(3.0, 3.0 + 0.004 * index) for index in range(800)]
"""Tensions in N of the hanging unit, which slips along with them in the end"""


@pytest.fixture(scope='module')
def ramped():
    """States of a filter that knows bias and design, one for each pair of `RAMP`."""
    return fed(StickSlipFilter(HANGING, tension_stddev=NOISE), RAMP)


def test_a_unit_held_3_percent_below_slip_stays_where_it_is():
    """The tracker is driven to the stop within seconds by the same samples."""
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    tracker = StickSlipTracker(PRELIMINARY)
    random = np.random.default_rng(4)
    for index in range(5000):
        pair = np.array([1.0, 1.98]) + random.normal(0.0, NOISE, 2)
        state = found.update(*pair, index / 500.0)
        tracker.update(*pair)
    assert tracker.bend_angle == PRELIMINARY.max_bend_angle
    assert state.interval(0.95) == (0.0, 0.0)
    assert state.regime_probabilities[Regime.HELD] == 1.0
    assert state.bend_angle_stddev == 0.0


def test_without_noise_to_speak_of_it_is_the_tracker():
    steps = np.linspace(3.0, 6.4, 400)
    found = StickSlipFilter(HANGING, tension_stddev=1e-7)
    tracker = StickSlipTracker(HANGING)
    for index, tension_s in enumerate(steps):
        state = found.update(3.0, tension_s, index / 500.0)
        tracker.update(3.0, tension_s)
    assert state.bend_angle == pytest.approx(tracker.bend_angle, abs=1e-3)
    assert tracker.bend_angle > math.radians(10.0)


@pytest.mark.parametrize('unit', list(UNITS))
def test_a_unit_that_is_driven_to_both_sides_within_a_lag_is_followed_to_both(unit):
    """At 5 Hz, from stop to stop, without noise to speak of."""
    design, weak = UNITS[unit]
    found = StickSlipFilter(design, tension_stddev=1e-7)
    tracker = StickSlipTracker(design)
    truth = {}
    for index in range(200):
        drive = 1.15 * weak * math.sin(2.0 * math.pi * 5.0 * index / 500.0)
        pair = weak + max(-drive, 0.0), weak + max(drive, 0.0)
        truth[index / 500.0] = tracker.update(*pair).bend_angle
        found.update(*pair, index / 500.0)
        if committed := found.committed:
            assert committed.bend_angle == pytest.approx(truth[committed.time], abs=1e-6)
    for side in (min, max):
        assert abs(side(truth.values())) == design.max_bend_angle


def test_the_same_seed_gives_the_same_and_mirrored_tensions_the_mirror_image():
    runs = [StickSlipFilter(HANGING, tension_stddev=NOISE, seed=3) for _ in range(2)]
    one, other = (fed(run, RAMP)[-1] for run in runs)
    np.testing.assert_array_equal(one.members, other.members)
    random = np.random.default_rng(1)
    mirrored = StickSlipFilter(HANGING, tension_stddev=NOISE)
    for index, (tension_l, tension_s) in enumerate(RAMP):
        noise = random.normal(0.0, NOISE, 2)
        state = mirrored.update(tension_s + noise[1], tension_l + noise[0], index / 500.0)
    np.testing.assert_allclose(state.members, -one.members[::-1], atol=1e-7)


def test_where_it_cannot_know_whether_the_unit_has_slipped_it_says_both():
    """The unstable unit rests within the noise of slipping, where it would slide to the stop."""
    limit = 2.0505867
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    ramp = [(1.0, 1.0 + (limit - 1.0) * min(index / 400, 1.0)) for index in range(800)]
    state = fed(found, ramp)[-1]
    probabilities = state.regime_probabilities
    assert sum(probabilities.values()) == pytest.approx(1.0)
    low, high = state.interval(0.95)
    assert (low, high) == (0.0, PRELIMINARY.max_bend_angle)


def test_what_is_new_is_provisional_and_what_is_a_lag_old_is_not():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE, lag=0.1)
    states = fed(found, RAMP)
    assert all(state.provisional for state in states)
    committed = found.committed
    assert not committed.provisional
    assert states[-1].time - committed.time == pytest.approx(0.1, abs=0.003)
    assert found.history(committed.time) is committed
    earlier = found.history(1.0001)
    assert earlier.time == pytest.approx(1.0)
    assert not earlier.provisional
    assert found.history(-1.0) is None


def test_without_a_lag_every_sample_is_committed_at_once():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE, lag=0.0)
    for number in range(3):  # each with no sample before it that counts
        state = found.update(3.0, 3.5, float(number))
        assert found.committed.time == state.time
        assert found.committed.bend_angle == state.bend_angle


def test_without_a_lag_a_unit_is_said_to_slip_at_once_too():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE, lag=0.0)
    said = [
        (fed(found, [pair], start=0.002 * number, seed=number)[-1], found.committed)
        for number, pair in enumerate(RAMP)
    ]
    slipping = [state.regime_probabilities[Regime.SLIPPING] for state, _ in said]
    assert max(slipping) > 0.9
    assert slipping == [committed.regime_probabilities[Regime.SLIPPING] for _, committed in said]


def test_friction_of_one_is_followed_without_a_word_of_numpys():
    design = dataclasses.replace(PRELIMINARY, friction_coefficient=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        fed(
            StickSlipFilter(design, tension_stddev=NOISE),
            [(1.0, 1.0 + 0.03 * n) for n in range(60)],
        )


def test_an_hour_below_slip_leaves_median_and_interval_where_they_were():
    """At 10 Hz, 5 % below slip; at the desk a part of the hour."""
    design, weak = UNITS['hanging']
    found = StickSlipFilter(design, tension_stddev=0.01)
    fed(found, [(weak, weak + 0.01 * index) for index in range(300)], rate=100.0, noise=0.01)
    before = fed(found, [(weak, 5.7)] * 100, rate=100.0, noise=0.01, start=10.0)[-1]
    random = np.random.default_rng(6)
    noises = random.normal(0.0, 0.01, (few_of(36_000), 2))
    for index, (noise_l, noise_s) in enumerate(noises):
        after = found.update(weak + noise_l, 5.7 + noise_s, 20.0 + index / 10.0)
    assert after.bend_angle == pytest.approx(before.bend_angle, abs=math.radians(0.1))
    for end, was in zip(after.interval(0.95), before.interval(0.95), strict=True):
        assert end == pytest.approx(was, abs=math.radians(0.1))


@pytest.mark.parametrize('seed', [1, 5])
def test_no_noise_of_a_rest_5_percent_below_slip_moves_a_unit(seed):
    """At 100 Hz, where few samples lie within the lag; the unit would jump to its stop."""
    design, weak = UNITS['preliminary']
    rest = (weak, 0.95 * slip_tension(design, weak, 0.0))
    found = StickSlipFilter(design, tension_stddev=NOISE)
    states = fed(found, [rest] * 2000, rate=100.0, seed=seed)
    for state in states[100:]:  # of the first few samples nothing is sure
        assert state.interval(0.95) == (0.0, 0.0), state.time


def test_a_measured_angle_puts_the_unit_there():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE, bend_angle_stddev=0.2)
    assert fed(found, [(3.0, 3.5)] * 50)[-1].bend_angle_stddev > 0.1
    found.measure(0.15, 0.002)
    state = fed(found, [(3.0, 3.5)] * 50, start=1.0)[-1]
    assert state.bend_angle == pytest.approx(0.15, abs=0.002)
    assert state.bend_angle_stddev == pytest.approx(0.002, rel=0.3)
    found.measure(0.15, 1.0)
    again = fed(found, [(3.0, 3.5)] * 5, start=2.0)[-1]
    assert again.bend_angle_stddev == pytest.approx(0.002, rel=0.3)


def test_doubt_lasts_until_a_stop_or_a_measurement():
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    assert fed(found, [(1.0, 1.5)] * 10)[-1].assured
    slack = found.update(0.0, 1.5, 1.0)
    assert slack.regime is Regime.SLACK
    assert slack.bend_angle is slack.pressure is slack.interval() is None
    doubted = fed(found, [(1.0, 1.5)] * 10, start=2.0)[-1]
    assert not doubted.assured
    assert doubted.bend_angle_stddev is None
    found.measure(0.1, 0.01)
    assert fed(found, [(1.0, 1.5)] * 10, start=3.0)[-1].assured
    found.doubt()
    assert not fed(found, [(1.0, 1.5)] * 10, start=4.0)[-1].assured
    assert fed(found, [(1.0, 3.0)] * 200, start=5.0)[-1].assured


def test_a_stop_tells_where_a_doubted_unit_is_only_if_nothing_else_can_hold_it():
    """Under 0.2 N and 0.5 N friction holds a unit that is bent towards cable l."""
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    fed(found, [(1.0, 1.5)] * 10)
    found.doubt()
    state = fed(found, [(0.2, 0.5)] * 200, start=1.0)[-1]
    assert state.regime is Regime.DRIVEN_TO_STOP
    assert not state.assured
    assert fed(found, [(1.0, 3.0)] * 200, start=2.0)[-1].assured


def test_a_bias_that_is_stated_widens_what_is_known(ramped):
    biased = StickSlipFilter(HANGING, tension_stddev=NOISE, tension_bias_stddev=0.05)
    assert fed(biased, RAMP[:700])[-1].bend_angle_stddev > 2.0 * ramped[699].bend_angle_stddev


def test_the_load_counts():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE)
    tracker = StickSlipTracker(HANGING)
    load = Load.tilted(0.3)
    ramp = RAMP[:700]
    state = fed(found, ramp, load=load)[-1]
    for pair in ramp:
        tracker.update(*pair, load)
    assert state.bend_angle == pytest.approx(tracker.bend_angle, abs=math.radians(1.0))


def test_pressure_comes_with_its_deviation(ramped):
    state = ramped[699]
    tracker = StickSlipTracker(HANGING, state.bend_angle)
    expected = tracker.update(*RAMP[699])
    assert state.pressure == pytest.approx(expected.pressure, rel=0.05)
    assert state.pressure_stddev > 0.0


def test_there_is_no_pressure_where_the_model_stands_behind_none():
    """One that is hardly driven: so little friction asks for the other root of `merged`."""
    pair = (10.0, 10.1)
    truth = StickSlipTracker(PRELIMINARY).update(*pair)
    assert truth.pressure is None
    assert truth.branch_consistent is False
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    for state in (fed(found, [pair] * 150)[-1], found.committed):
        assert state.regime is Regime.HELD
        assert state.pressure is state.pressure_stddev is None


@pytest.mark.parametrize(('design', 'pair'), [(PRELIMINARY, (1.0, 3.0)), (HANGING, (3.0, 5.3))])
def test_the_deviation_of_the_pressure_is_that_of_its_errors(design, pair):
    """At a stop and at rest, where the sum of the tensions tells it."""
    scores = []
    for seed in range(some_of(40)):
        found = StickSlipFilter(design, tension_stddev=NOISE)
        for state in (fed(found, [pair] * 150, seed=seed)[-1], found.committed):
            truth = StickSlipTracker(design, state.bend_angle).update(*pair).pressure
            scores.append((state.pressure - truth) / state.pressure_stddev)
    assert np.mean(np.abs(scores) < 2.0) >= 0.9
    assert np.std(scores) > 0.3


def test_bad_input_changes_nothing():
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    fed(found, [(1.0, 1.5)] * 10)
    for pair in ((math.nan, 1.0), (-1.0, 1.0), (0.05, 0.1)):
        with pytest.raises(TensionError):
            found.update(*pair, 1.0)
    with pytest.raises(ValueError, match='is not after'):
        found.update(1.0, 1.5, 0.0)
    with pytest.raises(BendAngleError):
        found.measure(2.0, 0.01)
    with pytest.raises(ValueError, match='must be above 0'):
        found.measure(0.1, 0.0)
    for stddev in (-1.0, math.nan):
        with pytest.raises(ValueError, match='stddev'):
            found.reset(0.0, stddev)
    assert fed(found, [(1.0, 1.5)], start=2.0)[-1].interval() == (0.0, 0.0)


@pytest.mark.parametrize('time', [math.nan, math.inf])
def test_a_time_that_is_none_is_refused_even_as_the_first(time):
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE)
    with pytest.raises(ValueError, match='finite'):
        found.update(1.0, 1.5, time)
    assert found.update(1.0, 1.5, 0.0).time == 0.0


def test_times_go_on_without_a_lag_too():
    found = StickSlipFilter(PRELIMINARY, tension_stddev=NOISE, lag=0.0)
    found.update(1.0, 1.5, 1.0)
    with pytest.raises(ValueError, match='is not after'):
        found.update(1.0, 1.5, 0.5)


@pytest.mark.parametrize(
    'wrong',
    [
        {'tension_stddev': 0.0},
        {'tension_stddev': math.nan},
        {'bend_angle_stddev': -1.0},
        {'tension_bias_stddev': math.inf},
        {'lag': -0.1},
    ],
)
def test_deviations_that_are_none_are_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        StickSlipFilter(PRELIMINARY, **{'tension_stddev': 0.01, **wrong})


@pytest.mark.parametrize('unit', list(UNITS))
def test_the_truth_of_a_random_session_is_within_the_interval(unit):
    """A rough check; `make measure-filter` has the figures."""
    drawn = session(unit, 'ramps', 0.01, 200.0, 8.0, np.random.default_rng(12))
    found = StickSlipFilter(drawn.design, tension_stddev=drawn.noise)
    covered = []
    for time, truth, _, *pair in drawn.samples:
        low, high = found.update(*pair, time).interval(0.95)
        covered.append(low - 1e-9 <= truth <= high + 1e-9)
    assert np.mean(covered) > 0.7


def test_a_gap_in_time_is_not_bridged():
    """After it windows begin anew: what was before does not tell what the tensions are now."""
    found = StickSlipFilter(HANGING, tension_stddev=NOISE)
    fed(found, [(3.0, 4.0)] * 200)
    state = fed(found, [(3.0, 6.0)] * 3, start=10.0)[-1]
    expected = StickSlipTracker(HANGING).update(3.0, 6.0).bend_angle
    assert state.bend_angle == pytest.approx(expected, abs=math.radians(2.0))


FRICTION = DesignUncertainty(('friction_coefficient',), ((0.01**2,),))


def test_a_design_that_is_not_quite_known_widens_what_is_known(ramped):
    ramp = RAMP[:640]
    unsure = StickSlipFilter(HANGING, tension_stddev=NOISE, design_covariance=FRICTION)
    one, other = ramped[639], fed(unsure, ramp)[-1]
    assert other.bend_angle_stddev > 2.0 * one.bend_angle_stddev
    assert other.pressure_stddev > one.pressure_stddev
    for friction in (0.385, 0.415):
        true = dataclasses.replace(HANGING, friction_coefficient=friction)
        low, high = other.interval(0.95)
        assert low <= follow_exactly(true, ramp) <= high


def follow_exactly(design, tensions, load=None):
    tracker = StickSlipTracker(design)
    for pair in tensions:
        tracker.update(*pair, *([] if load is None else [load]))
    return tracker.bend_angle


@pytest.mark.parametrize('unit', list(UNITS))
def test_a_stack_of_the_design_itself_is_the_design(unit):
    """One formula serves both; every parameter is uncertain, by nothing."""
    design, weak = UNITS[unit]
    names = [parameter.name for parameter in design_parameters()]
    nothing = DesignUncertainty(tuple(names), tuple((0.0,) * len(names) for _ in names))
    little = DesignUncertainty(
        tuple(names),
        tuple(tuple(1e-30 if one == other else 0.0 for other in names) for one in names),
    )
    ramp = [(weak, weak * (1.0 + 0.02 * index)) for index in range(80)]
    back = [tensions[::-1] for tensions in ramp]
    runs = [
        fed(StickSlipFilter(design, tension_stddev=NOISE, **more), ramp + back)[-1]
        for more in ({}, {'design_covariance': nothing}, {'design_covariance': little})
    ]
    for other in runs[1:]:
        np.testing.assert_allclose(other.members, runs[0].members, atol=1e-7)
        assert other.regime_probabilities == runs[0].regime_probabilities
        assert other.pressure == pytest.approx(runs[0].pressure, rel=1e-6)


@pytest.mark.parametrize('unsure', [None, FRICTION])
def test_a_load_that_turns_is_followed_with_each_of_its_values(unsure):
    """Also by an unstable unit, whose members are followed pair by pair."""
    found = StickSlipFilter(PRELIMINARY, tension_stddev=1e-3, design_covariance=unsure)
    tracker = StickSlipTracker(PRELIMINARY)
    random = np.random.default_rng(2)
    for index in range(300):
        load = Load.tilted(0.001 * index)
        pair = np.array([1.0, 1.0 + 0.004 * index])
        tracker.update(*pair, load)
        state = found.update(*(pair + random.normal(0.0, 1e-3, 2)), index / 200.0, load)
    assert tracker.bend_angle == PRELIMINARY.max_bend_angle
    assert state.bend_angle == PRELIMINARY.max_bend_angle


def test_a_measured_angle_far_from_all_members_is_believed():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE)
    fed(found, [(3.0, 3.5)] * 50)
    found.measure(0.15, 0.002)
    assert fed(found, [(3.0, 3.5)] * 5, start=1.0)[-1].bend_angle == pytest.approx(0.15, abs=0.005)


def test_what_was_measured_is_committed():
    found = StickSlipFilter(HANGING, tension_stddev=NOISE)
    for index in range(100):
        found.update(3.0, 3.5, index / 500.0)
        found.measure(0.0, 0.002)
    assert found.committed.time == 99 / 500.0
    assert not found.committed.provisional
    assert found.history(0.1).time == pytest.approx(0.1)
