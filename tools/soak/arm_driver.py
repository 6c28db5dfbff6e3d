"""A driver of an arm's cables as a process: sends tensions with faults, and says what it sent.

The stand-in driver of the package drives a single unit. This one plays the installed session of
the installed arm, round and round, as joint states of all cables.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import random
import signal
import threading
import time
from collections import Counter
from collections.abc import Sequence

import rclpy
from builtin_interfaces.msg import Time
from sensor_msgs.msg import JointState

from tendon_statics.files.installed_files import installed_config

FAULTS = {
    'nan': 0.01,
    'implausible': 0.001,
    'wrong_length': 0.01,
    'out_of_order': 0.01,
    'repeated_stamp': 0.01,
    'dropout': 0.01,
}
"""Fault → its probability per reading"""

MOST = 1_000_000
"""Readings of a driver that is to be ended from outside"""

BEHIND = 0.1
"""Seconds by which it may be late before it leaves readings out"""


def main() -> None:
    """Drive until all is sent, say so, and stay until a signal."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--count', type=int, required=True, help='readings; 0: until a signal')
    parser.add_argument('--rate', type=float, required=True, metavar='HZ')
    parser.add_argument('--with-faults', action='store_true')
    options = parser.parse_args()
    ended = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: ended.set())
    rclpy.init(signal_handler_options=rclpy.SignalHandlerOptions.NO)
    node = rclpy.create_node('arm_driver')
    publisher = node.create_publisher(JointState, 'tensions', 1000)
    while publisher.get_subscription_count() == 0 and not ended.wait(0.01):
        pass
    names, rows = _session()
    choice = random.Random(7)
    sent: Counter[str] = Counter(dict.fromkeys(('messages', 'good', 'skipped', *FAULTS), 0))
    newest, due = Time(), time.monotonic()
    for index in range(options.count or MOST):
        due += 1.0 / options.rate
        late = time.monotonic() - due
        if late > BEHIND:
            sent['skipped'] += 1
            continue
        if ended.wait(max(-late, 0.0)):
            break
        fault = _fault(choice) if options.with_faults and index else 'good'
        sent[fault] += 1
        if fault == 'dropout':
            continue
        sent['messages'] += 1
        now = node.get_clock().now().to_msg()
        message = JointState(name=names, effort=list(rows[index % len(rows)]))
        message.header.stamp = now
        if fault == 'good':
            newest = now
        _spoil(message, fault, newest)
        publisher.publish(message)
    print('Sent: ' + json.dumps(sent), flush=True)
    ended.wait()
    node.destroy_node()
    rclpy.shutdown()


def _spoil(message: JointState, fault: str, newest: Time) -> None:
    if fault == 'nan':
        message.effort[1] = math.nan
    elif fault == 'implausible':
        message.effort[0] = 1e6
    elif fault == 'wrong_length':
        message.effort = message.effort[:-1]
    elif fault == 'repeated_stamp':
        message.header.stamp = newest
    elif fault == 'out_of_order':
        message.header.stamp = Time(sec=newest.sec - 1, nanosec=newest.nanosec)


def _fault(choice: random.Random) -> str:
    drawn = choice.random()
    for fault, probability in FAULTS.items():
        drawn -= probability
        if drawn < 0.0:
            return fault
    return 'good'


def _session() -> tuple[list[str], list[Sequence[float]]]:
    text = installed_config('arm_tensions.csv').read_text(encoding='utf-8')
    titles, *rows = csv.reader(line for line in text.splitlines() if line[0] != '#')
    names = [title.removesuffix(' [N]') for title in titles[1:]]
    return names, [tuple(map(float, row[1:])) for row in rows]


if __name__ == '__main__':
    main()
