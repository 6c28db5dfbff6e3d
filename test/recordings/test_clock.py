"""Times of a bag's messages: one clock for each topic, the same for all that belong together."""

import re

import bags
import numpy as np
import pytest
from bags import ORIGIN, write_bag
from programs import assert_refused, run

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.clock import Stamped, common_clock
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.topics import BagTopics

COUNT = 100
RAMP = np.linspace(1.0, 2.0, COUNT)


def states(stamps, topic='/tensions', delay=0.0):
    """A ramp of tensions, recorded every 10 ms, with these stamps in s after the origin."""
    for index, stamp in enumerate(stamps):
        message = bags.joint_state(
            ['cable_l', 'cable_s'], effort=[1.0, RAMP[index]], time=stamp, origin=0
        )
        yield topic, 0.01 * index + delay, message


def angles():
    """An angle with each tension, without a stamp, 1 ms after it."""
    for index in range(COUNT):
        yield '/measured_bend_angle', 0.01 * index + 0.001, bags.number(0.1)


def merged(*streams):
    return sorted((entry for stream in streams for entry in stream), key=lambda entry: entry[1])


SOUND = 1e-9 * ORIGIN + 0.01 * np.arange(COUNT)


def with_some(stamps, where, values):
    changed = np.array(stamps, dtype=float)
    changed[where] = values
    return [None if np.isnan(stamp) else stamp for stamp in changed]


@pytest.mark.parametrize(
    ('stamps', 'said'),
    [
        (with_some(SOUND, slice(0, 70), np.nan), '70 of 100 messages on /tensions have no stamp'),
        (with_some(SOUND, slice(50, 51), -1.0), '1 of 100 stamps on /tensions are before 1970'),
        (
            with_some(SOUND, slice(60, 100), SOUND[60:] - 37.0),
            'the stamps on /tensions go back from .* at message 61 of 100',
        ),
        (
            with_some(SOUND, slice(40, 41), SOUND[40] + 9.0),
            'go back from .* at message 42 of 100',
        ),
        (
            with_some(SOUND, slice(40, 41), SOUND[40] - 9.0),
            'go back from .* at message 41 of 100',
        ),
        (np.full(COUNT, SOUND[0]), '99 of 100 stamps on /tensions are that of the message before'),
        (np.repeat(SOUND[::5], 5), '80 of 100 stamps on /tensions are that of the message before'),
    ],
    ids=[
        *('without', 'negative', 'set back', 'one in the future', 'one in the past'),
        *('always the same', 'seldom new'),
    ],
)
def test_stamps_that_are_no_clock_give_way_to_the_times_of_recording(tmp_path, stamps, said):
    """Nothing is sorted, so that a ramp stays a ramp, and none of it is left out."""
    file = write_bag(tmp_path / 'bag', merged(states(stamps), angles()))
    recording = load_recording(file)
    assert recording.tension_s.tolist() == RAMP.tolist()
    assert recording.time == pytest.approx(0.01 * np.arange(COUNT))
    assert recording.disorder == ''
    assert (recording.bend_angle == 0.1).all()
    (note,) = recording.notes
    assert 'its times are those of recording (--clock stamp|log)' in note
    assert re.search(said, note)


def test_messages_that_come_late_one_by_one_are_put_in_order_by_their_stamps(tmp_path):
    order = [*range(10), 11, 10, *range(12, COUNT)]
    messages = list(states(SOUND))
    late = [('/tensions', 0.01 * place, messages[index][2]) for place, index in enumerate(order)]
    recording = load_recording(write_bag(tmp_path / 'bag', late))
    assert recording.tension_s.tolist() == RAMP.tolist()
    assert recording.time == pytest.approx(0.01 * np.arange(COUNT), abs=1e-6)
    (note,) = recording.notes
    assert 'came late: they are put in order' in note


def test_stamps_that_jump_ahead_are_named(tmp_path):
    stamps = with_some(SOUND, slice(50, 100), SOUND[50:] + 37.0)
    recording = load_recording(write_bag(tmp_path / 'bag', states(stamps)))
    assert recording.time[-1] == pytest.approx(37.99)
    note = recording.notes[0]
    assert note.startswith('the stamps on /tensions jump ahead by 3')
    assert 'at message 51 of 100, and the times of recording do not' in note


def test_stamps_since_boot_and_topics_without_stamps_are_put_together_by_recording(tmp_path):
    file = write_bag(tmp_path / 'bag', merged(states(12.3 + 0.01 * np.arange(COUNT)), angles()))
    recording = load_recording(file)
    assert (recording.bend_angle == 0.1).all()
    assert recording.time_origin == ORIGIN
    assert 'the stamps on /tensions are 1699999987.7 s behind' in recording.notes[0]
    by_stamp = load_recording(file, BagTopics(clock='stamp'))
    assert np.isnan(by_stamp.bend_angle).all()
    assert by_stamp.time_origin == 12_300_000_000
    assert 'behind the times of recording' in by_stamp.notes[0]


def test_two_stamped_topics_whose_clocks_are_apart_are_named_and_joined(tmp_path):
    """The camera's computer is 30 s ahead."""
    camera = (
        (topic, time + 0.001, bags.joint_state(['tip'], position=[0.2], time=stamp, origin=0))
        for stamp, (topic, time, _) in zip(
            SOUND + 30.0, states(SOUND, '/measured_bend_angle'), strict=True
        )
    )
    recording = load_recording(write_bag(tmp_path / 'bag', merged(states(SOUND), camera)))
    assert (recording.bend_angle == 0.2).all()
    assert any('/measured_bend_angle are 29.99' in note for note in recording.notes)


def test_a_delay_to_the_recorder_is_no_other_clock(tmp_path):
    file = write_bag(tmp_path / 'bag', merged(states(SOUND, delay=0.015), angles()))
    recording = load_recording(file)
    assert recording.notes == ()
    assert recording.time_origin == ORIGIN


def test_stamps_that_are_all_zero_mean_the_time_of_arrival(tmp_path):
    for clock in ('auto', 'stamp', 'log'):
        file = write_bag(tmp_path / clock, states([None] * COUNT))
        recording = load_recording(file, BagTopics(clock=clock))
        assert recording.time == pytest.approx(0.01 * np.arange(COUNT))
        assert recording.notes == ()


def test_the_clock_can_be_chosen(tmp_path):
    file = write_bag(tmp_path / 'bag', states(SOUND - 5.0))
    recording = load_recording(file)
    assert recording.time_origin == ORIGIN - 5_000_000_000
    assert recording.notes == (
        'the stamps on /tensions are 5 s behind the times of recording (--clock stamp|log)',
    )
    assert load_recording(file, BagTopics(clock='log')).time_origin == ORIGIN
    with pytest.raises(RecordingError, match=r'the clock is .sun.; there are auto, stamp, log'):
        BagTopics(clock='sun')


def test_stamps_that_are_asked_for_stay_in_the_order_of_recording_and_are_named(tmp_path):
    set_back = with_some(SOUND, slice(60, 100), SOUND[60:] - 37.0)
    file = write_bag(tmp_path / 'bag', states(set_back))
    recording = load_recording(file, BagTopics(clock='stamp'))
    assert recording.tension_s.tolist() == RAMP.tolist()
    assert 'time goes back' in recording.disorder
    done = run('replay', file, '--clock', 'stamp', '--estimation', 'tracking')
    assert_refused(done, '(--clock log)')
    without = write_bag(tmp_path / 'other', states(with_some(SOUND, slice(0, 2), np.nan)))
    with pytest.raises(RecordingError, match=r'2 of 100 messages .*; --clock log takes'):
        load_recording(without, BagTopics(clock='stamp'))


def test_topics_of_which_none_has_a_message_have_no_clock():
    empty = Stamped.of([])
    clocked = common_clock({'/a': empty}, 'auto', 0)
    assert clocked.times['/a'].shape == (0,)
    assert not clocked.late
    assert clocked.notes == []
