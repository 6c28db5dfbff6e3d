"""Messages of drivers as pairs of values: what is delivered, what is dropped, and why."""

import math
import random

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3, Wrench, WrenchStamped
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, Header

from tendon_statics.node.inputs.sources import (
    ArraySource,
    JointStateSource,
    WrenchPairSource,
)
from tendon_statics.node.inputs.tension_source import Reading, nanoseconds
from tendon_statics.tensions.cable_scale import CableScale, scaled
from tendon_statics.tensions.pairing import MOST_WAITING
from tendon_statics.tensions.reason import Reason
from tendon_statics.tensions.stamp_order import StampOrder

ARRIVAL = 10**18
"""ns"""

MILLISECOND = 10**6
"""ns"""


class Taken:
    """Keeps what a source delivers and drops."""

    def __init__(self):
        self.readings: list[Reading] = []
        self.drops: list[tuple[Reason, str]] = []

    def deliver(self, reading):
        self.readings.append(reading)

    def drop(self, reason, text):
        self.drops.append((reason, text))

    @property
    def values(self):
        return [reading.values for reading in self.readings]

    @property
    def reasons(self):
        return [reason for reason, _ in self.drops]


@pytest.fixture
def taken():
    return Taken()


def at(milliseconds: int) -> Time:
    return Time(sec=milliseconds // 1000, nanosec=milliseconds % 1000 * 1_000_000)


def joint_state(milliseconds, **efforts) -> JointState:
    return JointState(
        header=Header(stamp=at(milliseconds)),
        name=list(efforts),
        effort=[float(value) for value in efforts.values()],
    )


def wrench(milliseconds, x=0.0, y=0.0, z=0.0) -> WrenchStamped:
    force = Vector3(x=float(x), y=float(y), z=float(z))
    return WrenchStamped(header=Header(stamp=at(milliseconds)), wrench=Wrench(force=force))


def send(source, topic, *sent):
    for message in sent:
        source.inputs[topic][1](message, ARRIVAL)


def test_an_array_is_taken_as_it_is_and_has_no_stamp(taken):
    source = ArraySource(taken.deliver, taken.drop)
    for data in ([1.0, 2.0], [1.0], [], [1.0, 2.0, 3.0]):
        send(source, 'tensions', Float64MultiArray(data=data))
    assert taken.readings == [Reading((1.0, 2.0), None)]
    assert taken.reasons == [Reason.WRONG_LENGTH] * 3
    assert '1 values came' in taken.drops[0][1]


def test_cables_are_found_by_name_in_any_order(taken):
    source = JointStateSource(taken.deliver, taken.drop, ('left', 'right'), lambda: 0.0005)
    send(
        source,
        'tensions',
        joint_state(1, left=1, right=2),
        joint_state(2, other=7, right=4, left=3),
        JointState(header=Header(stamp=at(4)), name=['left', 'right'], effort=[1.0]),
        JointState(header=Header(stamp=at(5)), name=['left', 'right']),
    )
    assert taken.values == [(1.0, 2.0), (3.0, 4.0)]
    assert [reading.stamp for reading in taken.readings] == [at(1), at(2)]
    assert taken.reasons == [Reason.WRONG_LENGTH, Reason.WRONG_LENGTH]
    assert '2 names came with 1 efforts, so it is not known whose' in taken.drops[0][1]


def test_what_is_about_neither_cable_is_passed_over_whatever_else_is_wrong_with_it(taken):
    """Stamps equal to ours, interleaved, or going back, and wrong lengths."""
    source = JointStateSource(taken.deliver, taken.drop, ('left', 'right'), lambda: 0.0005)
    for stamp in range(1, 6):
        foreign = (
            joint_state(stamp, wheel=1),
            joint_state(0, wheel=1, arm=2),
            JointState(header=Header(stamp=at(99)), name=['wheel'], effort=[1.0, 2.0]),
            JointState(header=Header(stamp=at(stamp))),
        )
        assert all(source.is_foreign(message) for message in foreign)
        send(source, 'tensions', *foreign, joint_state(stamp, left=stamp, right=2), *foreign)
    assert taken.values == [(float(stamp), 2.0) for stamp in range(1, 6)]
    assert not taken.drops


def test_joint_states_of_one_cable_each_are_joined(taken):
    """With one stamp or nearly so, in any order."""
    source = JointStateSource(taken.deliver, taken.drop, ('left', 'right'), lambda: 0.0015)
    send(
        source,
        'tensions',
        *(joint_state(10, left=1), joint_state(10, right=2)),
        *(joint_state(20, right=4), joint_state(21, left=3)),
        *(joint_state(30, left=5, wheel=0), joint_state(40, left=7), joint_state(41, right=8)),
    )
    assert taken.values == [(1.0, 2.0), (3.0, 4.0), (7.0, 8.0)]
    assert [reading.stamp for reading in taken.readings] == [at(10), at(21), at(41)]
    assert taken.reasons == [Reason.UNPAIRED]
    assert 'left of 0.030000000 s has no partner of its own' in taken.drops[0][1]


def test_a_pair_in_one_message_is_not_joined_with_half_of_another(taken):
    source = JointStateSource(taken.deliver, taken.drop, ('left', 'right'), lambda: 10.0)
    send(
        source,
        'tensions',
        *(joint_state(1, left=1), joint_state(2, left=3, right=4), joint_state(3, right=5)),
    )
    assert taken.values == [(3.0, 4.0)]
    assert taken.reasons == [Reason.UNPAIRED]


def test_stamps_out_of_order_and_repeated_ones_are_dropped(taken):
    source = JointStateSource(taken.deliver, taken.drop, ('l', 's'), lambda: 0.0005)
    send(source, 'tensions', *(joint_state(stamp, l=stamp, s=1) for stamp in (5, 7, 6, 7, 2, 8)))
    assert taken.values == [(5.0, 1.0), (7.0, 1.0), (8.0, 1.0)]
    assert taken.reasons == [
        *(Reason.OUT_OF_ORDER, Reason.REPEATED_STAMP, Reason.OUT_OF_ORDER),
    ]
    assert 'the stamp is 0.006000000 s, after 0.007000000 s' in taken.drops[0][1]


def test_a_stamp_of_0_is_none(taken):
    """So every message is taken, as it arrives."""
    source = JointStateSource(taken.deliver, taken.drop, ('l', 's'), lambda: 0.0005)
    send(source, 'tensions', *(joint_state(0, l=value, s=2) for value in (1, 2, 3)))
    assert taken.values == [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0)]
    send(source, 'tensions', joint_state(0, l=4), joint_state(0, s=5))
    assert taken.values[-1] == (4.0, 5.0)
    assert {reading.stamp for reading in taken.readings} == {None}
    assert not taken.drops


def test_a_topic_has_one_clock(taken):
    """Of a driver that has stamped its messages, one without a stamp is out of order."""
    source = JointStateSource(taken.deliver, taken.drop, ('l', 's'), lambda: 0.0005)
    send(source, 'tensions', *(joint_state(stamp, l=stamp, s=1) for stamp in (0, 5, 0, 6)))
    assert [reading.values[0] for reading in taken.readings] == [0.0, 5.0, 6.0]
    assert taken.reasons == [Reason.OUT_OF_ORDER]


@pytest.mark.parametrize('first', [1000, 10**9])
def test_a_driver_with_an_earlier_clock_is_taken_once_the_input_is_stale(first):
    """The same after one stamp far in the future."""
    order = StampOrder()
    assert order.objection(MILLISECOND * first) is None
    assert all(order.objection(MILLISECOND * stamp) for stamp in range(10, 20))
    order.is_loose = True
    order.forget()
    assert order.objection(MILLISECOND * first) is None
    order.is_loose = True
    assert order.objection(MILLISECOND * 20)
    assert order.objection(MILLISECOND * 21)
    assert order.objection(MILLISECOND * 22) is None
    order.is_loose = False
    assert order.objection(MILLISECOND * 22)
    assert order.objection(MILLISECOND * 21)
    assert order.objection(MILLISECOND * 23) is None


def test_stamps_that_do_not_rise_are_never_taken():
    """Going backwards, standing still, or to and fro; until the order is forgotten."""
    for early in (range(999, 0, -1), [5] * 999, [5, 6] * 500):
        order = StampOrder()
        assert order.objection(MILLISECOND * 1000) is None
        order.is_loose = True
        for stamp in early:
            assert order.objection(MILLISECOND * stamp)
        assert order.objection(MILLISECOND * 1001) is None
        order.forget()
        assert order.objection(MILLISECOND * 1) is None


def test_a_bad_stamp_of_bad_content_does_not_shut_a_stale_input(taken):
    """What came of no tensions has not made the stamps sound."""
    source = JointStateSource(taken.deliver, taken.drop, ('l', 's'), lambda: 0.0005)
    source.loosen()
    send(source, 'tensions', joint_state(10**9, l=math.nan, s=math.nan))
    send(source, 'tensions', *(joint_state(stamp, l=stamp, s=1) for stamp in range(10, 20)))
    assert len(taken.readings) > 5
    source.tighten()
    send(source, 'tensions', *(joint_state(stamp, l=stamp, s=1) for stamp in range(5)))
    assert taken.readings[-1].values[0] == 19.0


@pytest.mark.parametrize('phase', [0.0, 0.4, 0.8, 1.0, 1.2, 1.6])
def test_load_cells_that_run_freely_lose_no_reading(phase, taken):
    """At any phase, with jitter, though max_skew exceeds their period."""
    source = WrenchPairSource(taken.deliver, taken.drop, 'z', lambda: 0.005)
    generator = random.Random(1)
    sent = []
    for number in range(1, 1001):
        for topic, offset in (('tension_l', 0.0), ('tension_s', phase)):
            time = 2.0 * number + offset + generator.uniform(-0.05, 0.05)
            sent.append((time, topic))
    for time, topic in sorted(sent):
        message = wrench(0, z=1)
        message.header.stamp = Time(nanosec=int(time * 1e6) % 10**9, sec=int(time * 1e6) // 10**9)
        send(source, topic, message)
    assert len(taken.readings) >= 998


@pytest.mark.parametrize(
    ('component', 'expected'), [('x', 2.0), ('y', -3.0), ('z', 6.0), ('norm', 7.0)]
)
def test_the_component_of_the_force_is_taken(component, expected, taken):
    source = WrenchPairSource(taken.deliver, taken.drop, component, lambda: 0.0)
    send(source, 'tension_l', wrench(1, 2, -3, 6))
    send(source, 'tension_s', wrench(1, 2, -3, 6))
    assert taken.values == [(expected, expected)]


def test_load_cells_are_paired_by_stamp_and_the_rest_is_dropped(taken):
    source = WrenchPairSource(taken.deliver, taken.drop, 'z', lambda: 0.001)
    send(source, 'tension_l', wrench(10, z=1), wrench(20, z=2), wrench(30, z=3))
    send(source, 'tension_s', wrench(11, z=4), wrench(31, z=6))
    assert taken.values == [(1.0, 4.0), (3.0, 6.0)]
    # The later stamp, that is, when both had been measured.
    assert [reading.stamp for reading in taken.readings] == [at(11), at(31)]
    assert taken.reasons == [Reason.UNPAIRED]
    assert 'tension_l of 0.020000000 s has no partner of its own within max_skew, 0.001 s' in str(
        taken.drops
    )


def test_a_lost_message_does_not_shift_the_pairs_after_it(taken):
    """Though the stamps of two readings are nearer than max_skew."""
    source = WrenchPairSource(taken.deliver, taken.drop, 'z', lambda: 0.005)
    for stamp in range(0, 100, 2):
        if stamp != 50:
            send(source, 'tension_l', wrench(stamp, z=stamp))
        if stamp != 70:
            send(source, 'tension_s', wrench(stamp + 1 if stamp > 80 else stamp, z=stamp))
    mixed = [pair for pair in taken.values if pair[0] != pair[1]]
    assert len(mixed) <= 2
    assert taken.reasons == [Reason.UNPAIRED] * 2
    assert taken.values[-1] == (98.0, 98.0)


def test_of_a_load_cell_that_is_alone_no_more_waits_than_is_useful(taken):
    source = WrenchPairSource(taken.deliver, taken.drop, 'z', lambda: 0.001)
    send(source, 'tension_l', *(wrench(stamp, z=1) for stamp in range(1, MOST_WAITING + 51)))
    assert taken.reasons == [Reason.UNPAIRED] * 50
    source.forget()
    assert len(taken.drops) == MOST_WAITING + 50
    send(source, 'tension_l', wrench(1, z=1))
    send(source, 'tension_s', wrench(1, z=2))
    assert taken.values == [(1.0, 2.0)]


def test_a_load_cell_that_was_in_the_future_pairs_again_when_it_began_anew(taken):
    source = WrenchPairSource(taken.deliver, taken.drop, 'z', lambda: 0.001)
    send(source, 'tension_l', wrench(10**9, z=1))
    for stamp in range(1, 10):
        send(source, 'tension_l', wrench(stamp, z=1))
        send(source, 'tension_s', wrench(stamp, z=2))
    assert not taken.readings
    source.loosen()
    for stamp in range(10, 20):
        send(source, 'tension_l', wrench(stamp, z=1))
        send(source, 'tension_s', wrench(stamp, z=2))
    assert len(taken.readings) >= 7


@given(
    # A stamp of 0 is none.
    st.lists(st.tuples(st.booleans(), st.integers(1, 60)), max_size=80),
    st.integers(0, 5),
)
def test_every_message_of_a_load_cell_is_paired_dropped_or_waiting(sent, skew):
    """Whatever comes: each is accounted for once, and no pair is skewed by more than allowed."""
    taken = Taken()
    source = WrenchPairSource(taken.deliver, taken.drop, 'z', lambda: skew * 1e-3)
    for is_l, stamp in sent:
        topic = 'tension_l' if is_l else 'tension_s'
        send(source, topic, wrench(stamp, z=stamp))
    source.forget()
    assert len(sent) == 2 * len(taken.readings) + len(taken.drops)
    for reading in taken.readings:
        assert abs(reading.values[0] - reading.values[1]) <= skew
        assert nanoseconds(reading.stamp) == 1e6 * max(reading.values)
    times = [nanoseconds(reading.stamp) for reading in taken.readings]
    assert times == sorted(set(times))


def test_a_slack_cable_is_not_negative_by_rounding():
    for raw in (0.1, 0.3, 0.7, 1.1, 12.34):
        for gain in (0.1, -0.3, 1.7):
            calibration = CableScale(gain, -gain * raw, 10.0)
            for value in (raw, math.nextafter(raw, 0.0), math.nextafter(raw, 100.0)):
                tension, fault = scaled('tension_l', value, calibration)
                assert fault is None
                assert tension == 0.0


@pytest.mark.parametrize(
    ('value', 'reason'),
    [
        (math.nan, Reason.NOT_FINITE),
        (math.inf, Reason.NOT_FINITE),
        (-math.inf, Reason.NOT_FINITE),
        (1e308, Reason.NOT_FINITE),
        (1.0, Reason.NEGATIVE),
        (-100.0, Reason.IMPLAUSIBLE),
        (100.0, Reason.IMPLAUSIBLE),
        (-1.0, None),
        (0.25, None),
        (-10.125, None),
    ],
)
def test_what_is_measured_becomes_newtons_or_is_refused(value, reason):
    tension, fault = scaled('tension_l', value, CableScale(-20.0, 5.0, 207.5))
    assert (fault[0] if fault else None) is reason
    if fault:
        assert 'tension_l is ' in fault[1]
        assert 'allowed is 0 to 207.5 N' in fault[1]
    else:
        assert tension == -20.0 * value + 5.0
