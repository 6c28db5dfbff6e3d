"""The three methods behind `UnitEstimator`: what each knows, and what they have in common."""

import dataclasses
import math

import numpy as np
import pytest
from designs import PRELIMINARY

from tendon_statics import DesignUncertainty, Load, Regime, slip_angle_distribution, tensions_for
from tendon_statics.estimation.estimate import KnownLoad, Remark
from tendon_statics.estimation.filtered_estimate import UNEXPLAINED
from tendon_statics.estimation.health import Level
from tendon_statics.estimation.methods import METHODS
from tendon_statics.estimation.settings import Settings
from tendon_statics.estimation.unit_estimator import UnitEstimator
from tendon_statics.physics import UPRIGHT
from tendon_statics.tensions.reason import ReadingError, Reason

HELD, SLIPPING, STOP = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0)
KNOWN = KnownLoad(UPRIGHT)
SETTINGS = Settings(PRELIMINARY, tension_stddev=0.02)
REMEMBERING = [name for name, method in METHODS.items() if method.remembers]
UNSURE = DesignUncertainty(('friction_coefficient',), ((1e-4,),))
VERY_UNSURE = DesignUncertainty(('friction_coefficient',), ((1e-2,),))


def unit_of(estimation, **changes) -> UnitEstimator:
    return UnitEstimator(dataclasses.replace(SETTINGS, **changes), estimation)


def near_slip(share, noise, count, seed=1):
    """Noisy tensions at rest, `share` of the way from even ones to those that slip at 0."""
    random = np.random.default_rng(seed)
    behind, ahead = tensions_for(PRELIMINARY, 1e-6, total_tension=3.0)
    pull = share * (ahead - behind)
    pair = np.array([[1.5 - 0.5 * pull], [1.5 + 0.5 * pull]])
    return (pair + random.normal(0.0, noise, (2, count))).T.tolist()


def follow(unit, pairs, step=0.002):
    return [
        unit.take(*pair, KNOWN, step * place, step * place) for place, pair in enumerate(pairs)
    ]


def test_a_unit_held_near_slip_does_not_jump_under_noise_while_tracking_does():
    pairs = near_slip(0.97, 0.02, 1000)
    filtered, tracked = follow(unit_of('filtering'), pairs), follow(unit_of('tracking'), pairs)
    assert max(abs(estimate.bend_angle) for estimate in filtered) < math.radians(0.5)
    assert tracked[-1].bend_angle == PRELIMINARY.max_bend_angle
    low, high = filtered[-1].interval
    assert low <= 0.0 <= high
    assert high - low < math.radians(1.0)
    assert tracked[-1].interval is None


def test_what_is_filtered_is_provisional_and_committed_a_lag_behind_with_its_own_time():
    unit, committed = unit_of('filtering', filter_lag=0.1), []
    for place, pair in enumerate(near_slip(0.5, 0.02, 200)):
        estimate = unit.take(*pair, KNOWN, 7.0 + 0.002 * place, 100.0 + 0.002 * place)
        assert estimate.is_provisional
        committed += [(place, estimate) for estimate in unit.take_committed()]
        assert unit.take_committed() == []
    assert len(committed) > 70
    for place, estimate in committed:
        assert not estimate.is_provisional
        assert 100.0 + 0.002 * place - estimate.measured == pytest.approx(0.1, abs=0.005)
    assert unit_of('tracking').take_committed() == []


def test_the_interval_is_that_of_the_confidence_asked_for():
    wide, narrow = (unit_of('filtering', confidence=level) for level in (0.9, 0.3))
    pairs = near_slip(0.5, 0.02, 10)
    for unit in (wide, narrow):
        unit.doubt()
        unit.measure(0.1, 0.0)
    for one, other in zip(follow(wide, pairs), follow(narrow, pairs), strict=True):
        assert one.interval[0] <= other.interval[0] <= other.interval[1] <= one.interval[1]
    assert one.interval != other.interval


@pytest.mark.parametrize('estimation', REMEMBERING)
def test_all_that_remember_doubt_alike(estimation):
    unit = unit_of(estimation)
    assert unit.take(*HELD, KNOWN, 0.0).angle_assured
    with pytest.raises(ReadingError):
        unit.take(math.nan, 1.0, KNOWN, 0.01)
    assert not unit.take(*HELD, KNOWN, 0.02).angle_assured
    unit.put(0.1, 0.02)
    assert unit.take(*HELD, KNOWN, 0.03).angle_assured
    assert not unit.take(*HELD, KNOWN, 1.0).angle_assured  # a gap
    unit.measure(0.1, 1.0)
    found = unit.take(*HELD, KNOWN, 1.01)
    assert found.angle_assured
    assert found.bend_angle == pytest.approx(0.1, abs=0.005)
    slack = unit.take(0.0, 1.5, KNOWN, 1.02)
    assert (slack.regime, slack.bend_angle, slack.angle_assured) == (Regime.SLACK, None, False)
    assert not unit.take(*HELD, KNOWN, 1.03).angle_assured
    for place in range(30):  # A stop tells where it is.
        found = unit.take(*STOP, KNOWN, 1.04 + 0.01 * place)
    assert found.angle_assured
    assert found.bend_angle == PRELIMINARY.max_bend_angle
    unit.drop(Reason.NOT_FINITE, 'nothing')
    found = unit.take(*HELD, KNOWN, 1.4)
    assert (found.bend_angle_stddev, found.interval) == (None, None)
    assert found.remarks == [Remark.UNASSURED]


@pytest.mark.parametrize('estimation', REMEMBERING)
def test_a_load_that_was_never_known_moves_no_unit_that_is_remembered(estimation):
    unit = unit_of(estimation)
    never = KnownLoad(Load.tilted(0.3), is_assured=False, is_measured=False)
    for place in range(5):
        assert not unit.take(*STOP, never, 0.01 * place).angle_assured
    found = unit.take(*HELD, KNOWN, 0.05)
    assert (found.bend_angle, found.angle_assured) == (0.0, True)
    lost = KnownLoad(UPRIGHT, is_assured=False)
    assert not unit.take(*HELD, lost, 0.06).angle_assured
    assert not unit.take(*HELD, KNOWN, 0.07).angle_assured


def test_stamps_that_go_back_or_are_missing_end_no_filter():
    unit = unit_of('filtering')
    stamps = [5.0, 5.01, 1.0, 1.01, math.nan, math.nan, 1e9, 3.0, 3.0]
    for place, stamp in enumerate(stamps):
        assert unit.take(*HELD, KNOWN, 0.01 * place, stamp).bend_angle == 0.0
    assert unit.take(*HELD, KNOWN, 0.01 * (len(stamps) - 1), math.nan).bend_angle == 0.0


def test_probabilities_of_one_pair_are_those_of_the_closed_form_and_add_up_to_1():
    unit = unit_of('equilibrium', tension_stddev=0.01)
    for pair in (HELD, SLIPPING, (1.0, 1.97), STOP, STOP[::-1]):
        found = unit.take(*pair, KNOWN, 0.0)
        expected = slip_angle_distribution(PRELIMINARY, *pair, tension_stddev=0.01)
        assert sum(found.regime_probabilities.values()) == pytest.approx(1.0)
        assert found.regime_probabilities[Regime.HELD] == expected.probability('held')
        is_sure = max(found.regime_probabilities.values()) > 0.99
        assert not is_sure or found.regime_probabilities[found.regime] > 0.99
        of_root = found.regime is Regime.EQUILIBRIUM
        assert found.interval == (expected.interval(0.95) if of_root else None)
    assert unit.take(1.5, 1.5, KNOWN, 0.0).regime_probabilities[Regime.HELD] > 0.999
    # Where noise turns and slackens the cables only draws would tell, for which there is no time.
    noisy = unit_of('equilibrium', tension_stddev=0.5)
    assert noisy.take(1.5, 1.5, KNOWN, 0.0).regime_probabilities is None
    assert unit.take(0.0, 1.5, KNOWN, 0.0).regime_probabilities is None
    exact = unit_of('equilibrium', tension_stddev=0.0).take(*SLIPPING, KNOWN, 0.0)
    assert (exact.regime_probabilities, exact.interval) == (None, None)


@pytest.mark.parametrize('estimation', ['equilibrium', 'tracking'])
def test_deviations_cover_the_design_where_it_is_not_exact(estimation):
    stiff = dataclasses.replace(
        PRELIMINARY, contact_law='friction_circle', stiffness=0.02, max_bend_angle=1.0
    )
    pair = tensions_for(stiff, 0.2, total_tension=3.0)
    sure, unsure = (
        unit_of(estimation, design=stiff, tension_stddev=0.001, design_uncertainty=uncertainty)
        for uncertainty in (None, UNSURE)
    )
    one, other = sure.take(*pair, KNOWN, 0.0), unsure.take(*pair, KNOWN, 0.0)
    assert one.bend_angle == pytest.approx(0.2)
    # By another friction coefficient the root moves.
    rougher = dataclasses.replace(stiff, friction_coefficient=stiff.friction_coefficient + 1e-4)
    moved = unit_of(estimation, design=rougher).take(*pair, KNOWN, 0.0).bend_angle
    of_design = 0.01 * abs(moved - one.bend_angle) / 1e-4
    expected = math.hypot(one.bend_angle_stddev, of_design)
    assert other.bend_angle_stddev == pytest.approx(expected, rel=1e-3)
    assert of_design > one.bend_angle_stddev


def test_tracking_says_once_that_believing_each_sample_is_unsafe():
    unit = unit_of('tracking')
    for pair in near_slip(0.99, 0.0, 3):
        assert Remark.NOISE in unit.take(*pair, KNOWN, 0.0).remarks
    assert unit.health.level is Level.WARN
    said = '; '.join(unit.health.findings())
    assert 'estimation: filtering is for such load cells (3 of 3)' in said
    assert unit.health.take_what_is_to_log() == [Remark.NOISE]
    unit.health.begin_period()
    unit.take(*near_slip(0.99, 0.0, 1)[0], KNOWN, 0.1)
    assert unit.health.take_what_is_to_log() == []
    safe = unit_of('tracking', tension_stddev=1e-4)
    assert safe.take(*near_slip(0.99, 0.0, 1)[0], KNOWN, 0.0).remarks == []
    assert safe.take(*HELD, KNOWN, 0.0).remarks == []


@pytest.mark.parametrize(('pair', 'explained'), [(HELD, True), (STOP, False)])
def test_a_model_that_does_not_explain_the_measured_angle_is_a_warning(pair, explained):
    """A sensor says all the time that the unit stays at 0.1 rad, also where it has to slip."""
    unit, random = unit_of('filtering'), np.random.default_rng(3)
    assert math.isnan(unit.take(*pair, KNOWN, 0.0).consistency)
    for place in range(1, 200):
        unit.measure(0.1 + random.normal(0.0, 0.01), 0.01 * place)
        found = unit.take(*pair, KNOWN, 0.01 * place)
    remarks = [] if explained else [Remark.UNEXPLAINED]
    assert found.remarks == remarks
    assert (found.consistency < UNEXPLAINED) is not explained
    assert unit.health.level is (Level.OK if explained else Level.WARN)
    assert unit.health.take_what_is_to_log() == remarks
    said = ' '.join(unit.health.findings())
    assert ('does not explain the measured angle' in said) is not explained


def test_the_interval_of_a_filter_covers_a_design_that_is_not_exact():
    pairs = near_slip(0.9, 0.02, 100)
    units = (unit_of('filtering', design_uncertainty=of) for of in (None, UNSURE))
    sure, unsure = (follow(unit, [*pairs, *[STOP] * 40, *pairs])[-1] for unit in units)
    assert sure.interval == unsure.interval  # The stop is certain.
    units = (unit_of('filtering', design_uncertainty=of) for of in (None, VERY_UNSURE))
    sure, unsure = (follow(unit, near_slip(0.97, 0.02, 300))[-1] for unit in units)
    assert sure.interval[1] < math.radians(1.0)
    assert unsure.interval[1] > math.radians(10.0)
    assert 0.05 < 1.0 - unsure.regime_probabilities[Regime.HELD] < 0.95


def test_a_sensor_that_reads_a_little_beyond_the_stop_is_at_the_stop():
    unit, stop = unit_of('filtering'), PRELIMINARY.max_bend_angle
    unit.take(*HELD, KNOWN, 0.0)
    unit.doubt()
    unit.measure(stop + 0.01, 0.0)
    assert unit.take(*HELD, KNOWN, 0.01).bend_angle == pytest.approx(stop, abs=0.02)
    with pytest.raises(ValueError, match='bend_angle'):
        unit.measure(stop + 0.1, 0.01)


def test_settings_of_a_filter_change_while_it_runs_and_the_unit_stays():
    unit = unit_of('filtering')
    unit.put(0.4, 0.0)
    unit.take(*HELD, KNOWN, 0.0)
    before = unit.again(unit.newest).as_dict()
    assert unit.change_settings(dataclasses.replace(unit.settings, confidence=0.5)) == ''
    assert unit.again(unit.newest).as_dict() == before
    louder = dataclasses.replace(unit.settings, tension_stddev=0.03, filter_lag=0.3)
    assert unit.change_settings(louder) == ''
    assert unit.take(*HELD, KNOWN, 0.01).bend_angle == pytest.approx(0.4)
    narrow = dataclasses.replace(PRELIMINARY, max_bend_angle=0.2)
    said = unit.change_settings(dataclasses.replace(louder, design=narrow))
    assert 'beyond the new stop; it is now taken to be at 0.2 rad' in said
    found = unit.take(*HELD, KNOWN, 0.02)
    assert (found.bend_angle, found.angle_assured) == (0.2, False)
