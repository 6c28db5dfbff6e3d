"""`mark_motion`: states from the measured angle."""

import math

import numpy as np
import pytest

from tendon_statics import Recording, RecordingError
from tendon_statics.recordings.motion import mark_motion


def states(*angles):
    ones = [1.0] * len(angles)
    return mark_motion(Recording(ones, ones, list(angles)), 0.1).state


def test_the_sample_before_a_motion_is_slipping_and_rest_is_held():
    found = states(0.0, 0.01, 0.0, 0.3, 0.5, 0.5, 0.49)
    assert found == ['held', 'held', 'slipping', 'moving', 'moving', 'held', 'held']


def test_each_motion_has_a_beginning_of_its_own():
    found = states(0.0, -0.5, -0.5, 0.2, 0.2)
    assert found == ['slipping', 'moving', 'slipping', 'moving', 'held']


def test_a_missing_angle_is_no_motion():
    assert states(0.0, math.nan, 0.5, 0.5) == ['held'] * 4
    assert states(0.0) == ['held']


def test_motion_is_not_looked_for_where_time_goes_back():
    ones = [1.0] * 3
    recording = Recording(ones, ones, [0.0, 0.0, 0.3], time=[0.0, 2.0, 1.0])
    with pytest.raises(RecordingError, match=r'goes back from 2 s to 1 s at sample 3 of 3: sort'):
        mark_motion(recording, 0.1)


def test_angles_that_come_less_often_than_tensions_are_compared_with_each_other():
    """A camera of 20 Hz beside load cells of 100 Hz; then it loses the unit for a while."""
    lost = [math.nan] * 4
    angles = [0.0, *lost, 0.5, *lost, 0.5, *lost, 0.0]
    times = [0.01 * index for index in range(15)] + [1.0]
    ones = [1.0] * 16
    found = mark_motion(Recording(ones, ones, angles, time=times), 0.1).state
    assert found[::5] == ['slipping', 'moving', 'held', 'held']


def test_what_happened_in_a_gap_is_no_motion_of_which_the_beginning_was_seen():
    """Neighbouring samples, an hour apart: tensions before it say nothing of the slip."""
    ones = [1.0] * 6
    times = [0.0, 0.1, 3600.0, 3600.2, 3600.3, np.nan]
    angles = [0.0, 0.0, 0.4, 0.0, 0.0, 0.4]
    found = mark_motion(Recording(ones, ones, angles, time=times), 0.1).state
    assert found == ['held', 'held', 'slipping', 'moving', 'held', 'held']


def test_angles_that_are_never_near_each_other_are_refused():
    ones = [1.0] * 3
    recording = Recording(ones, ones, [0.0, 0.0, 0.4], time=[0.0, 1.0, 2.0])
    with pytest.raises(RecordingError, match=r'angles are 1 s apart, or more; .* within 0.2 s'):
        mark_motion(recording, 0.1)


def test_without_an_angle_or_a_step_there_is_nothing_to_mark():
    with pytest.raises(RecordingError, match='no measured bend angle'):
        mark_motion(Recording([1.0], [1.0]), 0.1)
    with pytest.raises(RecordingError, match='step of a motion is nan'):
        mark_motion(Recording([1.0], [1.0], [0.0]), math.nan)
