"""What a middleware may leave out of a message's info: its number, and when it arrived."""

import time

import pytest
from list_entities import alone
from ros_programs import wait_for
from std_msgs.msg import Float64MultiArray

from tendon_statics.node.estimator import Estimator

FAST_DDS, CYCLONE_DDS = 'Fast DDS', 'Cyclone DDS'


def infos(middleware, count):
    """The infos of messages of which each third is lost."""
    now = time.time_ns()
    for index in range(count):
        yield {
            FAST_DDS: {
                'source_timestamp': now - 3_000_000,
                'received_timestamp': now - 2_000_000,
                'publication_sequence_number': index + index // 2 + 1,
                'reception_sequence_number': None,
            },
            CYCLONE_DDS: {
                'source_timestamp': now - 3_000_000,
                'received_timestamp': 0,
                'publication_sequence_number': None,
                'reception_sequence_number': None,
            },
            'nothing at all': {},
            'nothing known': dict.fromkeys(
                ('received_timestamp', 'publication_sequence_number'), None
            ),
        }[middleware]


@pytest.mark.parametrize('middleware', [FAST_DDS, CYCLONE_DDS, 'nothing at all', 'nothing known'])
def test_every_message_is_answered_whatever_the_middleware_leaves_out(middleware):
    message = Float64MultiArray(data=[1.0, 2.0])
    with alone(Estimator, '-p', 'input_timeout:=60.0') as node:
        published = []
        node._outputs.publish = lambda *given, **_: published.append(given[1]())
        (tensions,) = [of for of in node.subscriptions if of.topic_name == '/tensions']
        before = time.time()
        for info in infos(middleware, 10):
            tensions.callback(message, info)
        node._reports.report_period()
        node._reports.report_period()
        node._reports.report_period()
        values = node.health.values()
    assert values['pairs solved'] == values['messages received'] == '10'
    lost = values['messages lost on the way']
    assert lost == ('4' if middleware == FAST_DDS else 'not counted')
    # Without a time of arrival it is that at which the message is taken.
    times = [stamp.sec + 1e-9 * stamp.nanosec for stamp in published]
    assert len(times) == 10
    assert all(before - 0.1 <= at <= time.time() for at in times)
    assert all(at >= before - 0.003 for at in times)
    assert (times[0] < before) == (middleware == FAST_DDS)


@pytest.mark.parametrize('middleware', [FAST_DDS, CYCLONE_DDS])
def test_what_waited_for_a_busy_node_is_no_gap_where_its_arrival_is_known(middleware):
    """An angle that is followed stays assured though the node is late by more than the timeout."""
    timeout = 0.05
    tracking = ('estimation:=tracking', f'input_timeout:={timeout}')
    arguments = [part for value in tracking for part in ('-p', value)]
    with alone(Estimator, *arguments) as node:
        published = []
        node._outputs.publish = lambda estimate, *_, **__: published.append(estimate)
        (tensions,) = [of for of in node.subscriptions if of.topic_name == '/tensions']
        for info in infos(middleware, 2):
            tensions.callback(Float64MultiArray(data=[1.0, 1.5]), info)
            taken = time.monotonic()
            wait_for('the timeout', lambda since=taken: time.monotonic() > since + 2.0 * timeout)
    assert [estimate.angle_assured for estimate in published] == [True, middleware == FAST_DDS]
