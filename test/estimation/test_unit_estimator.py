"""One unit from its readings, without ROS: where it is, what casts doubt, what is counted."""

import dataclasses
import math

import pytest
from designs import PRELIMINARY

from tendon_statics import BendAngleError, Load, Regime, admissible_angles, solve
from tendon_statics.estimation.settings import Settings
from tendon_statics.estimation.unit_estimator import KnownLoad, UnitEstimator
from tendon_statics.physics import UPRIGHT
from tendon_statics.tensions.cable_scale import CableScale
from tendon_statics.tensions.reason import ReadingError, Reason
from tendon_statics.tensions.watch import Plausibility

HELD, SLIPPING, STOP = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0)
KNOWN = KnownLoad(UPRIGHT)
SETTINGS = Settings(PRELIMINARY)


def tracking(**changes) -> UnitEstimator:
    return UnitEstimator(dataclasses.replace(SETTINGS, **changes), 'tracking')


def test_readings_become_tensions_and_are_solved():
    cable = CableScale(gain=0.001, bias=-1.0)
    unit = UnitEstimator(dataclasses.replace(SETTINGS, cable_l=cable))
    result = unit.take(2000.0, 2.0, KNOWN, 0.0)
    assert result.exact == solve(PRELIMINARY, 1.0, 2.0)
    assert unit.newest.tensions == (1.0, 2.0)
    assert unit.health.solved == 1


@pytest.mark.parametrize(
    ('row', 'reason'),
    [
        ((math.nan, 1.0), Reason.NOT_FINITE),
        ((-1.0, 1.0), Reason.NEGATIVE),
        ((1.0, 2000.0), Reason.IMPLAUSIBLE),
        ((0.05, 0.1), Reason.BELOW_WEIGHT),
    ],
)
def test_what_is_no_pair_is_refused_counted_and_casts_doubt(row, reason):
    unit = tracking()
    assert unit.take(*HELD, KNOWN, 0.0).angle_assured
    with pytest.raises(ReadingError) as raised:
        unit.take(*row, KNOWN, 0.1)
    assert raised.value.reason is reason
    assert unit.health.dropped == {reason: 1}
    assert unit.invalid_since_newest == 1
    assert not unit.take(*HELD, KNOWN, 0.2).angle_assured
    assert unit.invalid_since_newest == 0
    # A stop tells where it is.
    assert unit.take(*STOP, KNOWN, 0.3).angle_assured


@pytest.mark.parametrize('reading', [0.0, 0.01, 0.03, -0.01, -0.04])
def test_a_cable_that_is_slack_but_for_noise_casts_doubt(reading):
    unit = tracking()
    unit.take(*HELD, KNOWN, 0.0)
    result = unit.take(reading, 1.5, KNOWN, 0.1)
    assert (result.regime, result.tension_l, result.bend_angle) == (Regime.SLACK, 0.0, None)
    assert not unit.take(*HELD, KNOWN, 0.2).angle_assured


def test_what_only_comes_at_a_wrong_time_casts_none():
    unit = tracking()
    unit.take(*HELD, KNOWN, 0.0)
    for reason in (Reason.OUT_OF_ORDER, Reason.REPEATED_STAMP, Reason.UNPAIRED):
        unit.drop(reason, 'late')
    assert unit.invalid_since_newest == 0
    assert unit.take(*HELD, KNOWN, 0.1).angle_assured


def test_a_gap_casts_doubt_unless_somebody_says_where_the_unit_is():
    unit = tracking()
    for now, told_at, assured in ((0.0, None, True), (0.5, None, True), (1.1, None, False)):
        assert told_at is None
        assert unit.take(*HELD, KNOWN, now).angle_assured is assured
    unit.put(0.1, 5.0)
    assert unit.take(*HELD, KNOWN, 5.4).angle_assured
    unit.put(0.1, 9.0)  # and left alone again
    assert not unit.take(*HELD, KNOWN, 9.6).angle_assured
    with pytest.raises(BendAngleError):
        unit.put(1.0, 9.6)


def test_before_the_first_tensions_it_is_where_it_began():
    unit = tracking(initial_bend_angle=0.1)
    unit.drop(Reason.NOT_FINITE, 'nothing yet')
    unit.lose_sight()
    result = unit.take(*HELD, KNOWN, 1000.0)
    assert (result.bend_angle, result.angle_assured) == (0.1, True)


def test_a_load_that_was_never_known_moves_no_unit_and_one_that_is_lost_casts_doubt():
    unit = tracking()
    tilted = Load.tilted(0.3)
    never = KnownLoad(tilted, is_assured=False, is_measured=False)
    # Not even a stop is one for sure.
    slipped = unit.take(*STOP, never, 0.0)
    assert (slipped.regime, slipped.angle_assured) == (Regime.DRIVEN_TO_STOP, False)
    held = unit.take(*HELD, KNOWN, 0.1)
    assert (held.bend_angle, held.angle_assured) == (0.0, True)
    lost = KnownLoad(UPRIGHT, is_assured=False)
    assert not unit.take(*HELD, lost, 0.2).angle_assured
    assert not unit.take(*STOP, lost, 0.3).angle_assured
    assert not unit.take(*HELD, KNOWN, 0.4).angle_assured
    assert unit.take(*STOP, KNOWN, 0.5).angle_assured
    assert 'the load is not assured' in '; '.join(unit.health.findings())


def test_another_bias_is_no_step_of_the_tension():
    """As ``~/tare`` sets one."""
    believed = Plausibility(max_rate=1.0)
    unit = UnitEstimator(dataclasses.replace(SETTINGS, plausibility=believed))
    unit.take(*HELD, KNOWN, 0.0, measured=0.0)
    with pytest.raises(ReadingError, match='tension_l went from 1 N to 3 N'):
        unit.take(3.0, 1.5, KNOWN, 0.1, measured=0.1)
    unit.change_settings(dataclasses.replace(unit.settings, cable_l=CableScale(bias=2.0)))
    assert unit.take(*HELD, KNOWN, 0.2, measured=0.2).tension_l == 3.0


def test_asking_again_does_not_move_the_unit():
    unit = tracking()
    unit.take(*HELD, KNOWN, 0.0)
    unit.change_settings(dataclasses.replace(SETTINGS, design=PRELIMINARY))
    first = unit.again(unit.newest).as_dict()
    assert unit.again(unit.newest).as_dict() == first
    tilted = dataclasses.replace(PRELIMINARY, max_bend_angle=0.2)
    unit.put(0.4, 0.1)
    said = unit.change_settings(dataclasses.replace(SETTINGS, design=tilted))
    assert 'beyond the new stop; it is now taken to be at 0.2 rad' in said


def test_it_is_stale_after_the_timeout_once():
    unit = tracking(input_timeout=0.5)
    assert unit.stale_from(7.0) == 7.5
    unit.take(*HELD, KNOWN, 8.0)
    assert unit.stale_from(7.0) == 8.5
    unit.health.stale = True
    assert unit.stale_from(7.0) == math.inf


def test_a_largest_tension_that_fits_no_such_unit_is_said():
    weight = PRELIMINARY.weight
    large, fitting = CableScale(max_tension=500.0), CableScale(max_tension=20.0)
    (of_both,) = dataclasses.replace(SETTINGS, cable_l=large, cable_s=large).doubts
    named = 'cable_l.max_tension and cable_s.max_tension are 500 N, up to'
    assert of_both.startswith(f'{named} {500 / weight:.3g} times the weight')
    (of_s,) = dataclasses.replace(SETTINGS, cable_l=fitting, cable_s=large).doubts
    assert of_s.startswith('cable_s.max_tension is 500 N')
    assert dataclasses.replace(SETTINGS, cable_l=fitting, cable_s=fitting).doubts == []


def test_a_largest_tension_that_nobody_has_set_is_no_doubt_and_is_told():
    fitting = CableScale(max_tension=20.0)
    assert SETTINGS.doubts == []
    (of_default,) = SETTINGS.defaults
    assert of_default.startswith('Tensions up to 1000 N are believed')
    assert dataclasses.replace(SETTINGS, cable_l=fitting).defaults == [of_default]
    assert dataclasses.replace(SETTINGS, cable_l=fitting, cable_s=fitting).defaults == []


@pytest.mark.parametrize('estimation', ['tracking', 'filtering'])
def test_a_first_reading_that_may_be_a_spike_moves_no_unit_and_is_not_assured(estimation):
    believed = Plausibility(max_rate=10.0)
    settings = dataclasses.replace(SETTINGS, plausibility=believed)
    unit = UnitEstimator(settings, estimation)
    assert not unit.take(*STOP, KNOWN, 0.0, 0.0).angle_assured
    with pytest.raises(ReadingError):
        unit.take(*HELD, KNOWN, 0.1, 0.1)
    found = unit.take(*HELD, KNOWN, 0.2, 0.2)
    assert found.bend_angle == pytest.approx(0.0, abs=1e-3)
    assert found.regime is Regime.HELD
    sound = UnitEstimator(settings, estimation)
    pairs = enumerate((HELD, HELD))
    assured = [sound.take(*pair, KNOWN, 0.1, 0.1 * at).angle_assured for at, pair in pairs]
    assert assured == [False, True]


def test_a_stop_tells_where_a_doubted_unit_is_only_if_nothing_else_can_hold_it():
    """Under 0.2 N and 0.5 N friction holds a unit that is bent towards cable l."""
    unit = tracking()
    unit.take(*HELD, KNOWN, 0.0)
    unit.doubt()
    found = unit.take(0.2, 0.5, KNOWN, 0.1)
    assert found.regime is Regime.DRIVEN_TO_STOP
    assert admissible_angles(PRELIMINARY, 0.2, 0.5)
    assert not found.angle_assured
    assert unit.take(*STOP, KNOWN, 0.2).angle_assured
