"""What pushes at the tip of a unit over time: measured angles, motion, and what is no evidence."""

import dataclasses
import math

import pytest
from designs import HANGING, PRELIMINARY

from tendon_statics import (
    BendAngleError,
    Load,
    Regime,
    StickSlipTracker,
    solve,
    tensions_for,
    tip_force,
)
from tendon_statics.estimation.settings import Settings
from tendon_statics.estimation.tip_force_watch import TipForceWatch

SETTINGS = Settings(PRELIMINARY, tip_distance=0.02)
ACROSS = {'direction': (1.0, 0.0), 'distance': 0.02}
NOISE = {
    'tension_stddev': SETTINGS.tension_stddev,
    'bend_angle_stddev': SETTINGS.measured_bend_angle_stddev,
}


def held(angle=0.1):
    return StickSlipTracker(PRELIMINARY, angle).update(1.0, 1.9)


def test_a_measured_angle_at_rest_gives_a_set():
    watch = TipForceWatch()
    for index in range(20):
        watch.note_angle(0.2, 0.01 * index, SETTINGS)
    pushed = watch.ask(held(), SETTINGS, 0.2)
    assert pushed.is_measured
    assert pushed.found == tip_force(PRELIMINARY, 1.0, 1.9, bend_angle=0.2, **ACROSS, **NOISE)


def moved(watch, path, until=1.0):
    """Measure an angle 100 times a second, up to a time in s."""
    for index in range(int(100.0 * until) + 1):
        watch.note_angle(path(0.01 * index), 0.01 * index, SETTINGS)


@pytest.mark.parametrize(('speed', 'side'), [(0.4, 's'), (-0.4, 'l'), (0.05, '')])
def test_while_the_measured_angle_moves_the_force_is_a_number(speed, side):
    watch = TipForceWatch()
    moved(watch, lambda time: speed * time)
    assert watch.motion(1.0, SETTINGS) == side
    pushed = watch.ask(held(), SETTINGS, 1.0)
    assert pushed.found.at_limit == bool(side)
    if side:
        assert pushed.found.force_stddev > 0.0


def test_a_jump_is_no_steady_motion():
    for until in (0.52, 0.6, 0.8, 0.95):
        watch = TipForceWatch()
        moved(watch, lambda time: 0.3 if time > 0.5 else 0.0, until)
        assert watch.motion(until, SETTINGS) == ''


def test_motion_of_long_ago_is_forgotten():
    watch = TipForceWatch()
    moved(watch, lambda time: min(0.4 * time, 0.2))
    assert watch.motion(1.0, SETTINGS) == ''


def test_a_unit_that_does_not_move_is_at_no_limit_though_a_tracker_has_it_slipping():
    """A force unknown to the tracker holds it, within the noise of where that has it slip to."""
    settings = dataclasses.replace(SETTINGS, design=HANGING)
    pair = tensions_for(HANGING, 0.001, total_tension=9.0)
    state = StickSlipTracker(HANGING).update(*pair)
    assert state.regime is Regime.SLIPPING
    assert abs(state.bend_angle) < settings.measured_bend_angle_stddev
    watch = TipForceWatch()
    for index in range(100):
        watch.note_angle(0.0, 0.01 * index, settings)
    found = watch.ask(state, settings, 1.0).found
    assert not found.at_limit
    true = -0.1
    truth = Load(tip_force=(true, 0.0), tip_distance=settings.tip_distance)
    assert StickSlipTracker(HANGING).update(*pair, truth).regime is Regime.HELD
    assert any(low <= true <= high for low, high in found.intervals)


def test_an_old_angle_gives_way_to_the_estimate():
    watch = TipForceWatch()
    watch.note_angle(0.2, 0.0, SETTINGS)
    pushed = watch.ask(held(0.1), SETTINGS, 1.0)
    assert (pushed.is_measured, pushed.bend_angle) == (False, 0.1)
    assert pushed.found.probability_free > 0.5


def test_without_any_angle_nothing_is_said():
    watch = TipForceWatch()
    assert watch.ask(solve(PRELIMINARY, 1.0, 1.5), SETTINGS, 0.0) is None
    tracker = StickSlipTracker(PRELIMINARY)
    tracker.doubt()
    assert watch.ask(tracker.update(1.0, 1.5), SETTINGS, 0.0) is None
    watch.note_angle(0.2, 0.0, SETTINGS)
    assert watch.ask(solve(PRELIMINARY, 1.0, 1.5), SETTINGS, 0.0).is_measured
    assert watch.ask(tracker.update(0.0, 1.5), SETTINGS, 0.0) is None  # a slack cable
    watch.forget()
    assert watch.ask(solve(PRELIMINARY, 1.0, 1.5), SETTINGS, 0.0) is None


def test_an_angle_beyond_the_stop_is_refused_and_the_last_one_stays():
    watch = TipForceWatch()
    watch.note_angle(0.2, 0.0, SETTINGS)
    for bad in (math.nan, 0.6):
        with pytest.raises(BendAngleError):
            watch.note_angle(bad, 0.1, SETTINGS)
    assert watch.ask(held(), SETTINGS, 0.1).bend_angle == 0.2
    narrow = dataclasses.replace(PRELIMINARY, max_bend_angle=0.15)
    narrowed = dataclasses.replace(SETTINGS, design=narrow)
    assert not watch.ask(held(), narrowed, 0.1).is_measured
