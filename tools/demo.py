"""Drive the installed estimator over real ROS 2 and print what it publishes.

Starts ``estimator`` and ``pulley_driver`` as processes of their own, on this machine only and in
a ROS domain that nobody else uses, plays two recordings, and ends what it started.
"""

from __future__ import annotations

import math
import signal
import subprocess
import sys

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from estimator_client import EstimatorClient
from rclpy.context import Context
from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.installed_files import installed_config
from tendon_statics.physics import paper
from tendon_statics.recordings.reading.load import load_recording

DETERMINED = (Estimate.EQUILIBRIUM, Estimate.DRIVEN_TO_STOP)
PAPERS_CASE = (paper.TENSION_L, paper.TENSION_S)
RATE = 20.0
"""Rows a second"""
MOST_SESSIONS = 10
"""Until one was sound; on a machine that is not very busy the first is"""

LEVELS = {
    DiagnosticStatus.OK: 'OK',
    DiagnosticStatus.WARN: 'WARN',
    DiagnosticStatus.ERROR: 'ERROR',
    DiagnosticStatus.STALE: 'STALE',
}

WHAT_NEXT = """
What next:
  make demo VIEW=1                                     a unit that is followed, live in the browser
  source tools/env.bash                                in bash: the programs on the PATH, then
  tendon-statics solve --tension-l 1 --tension-s 2     the same without ROS
  docs/tutorials/first_estimate.md                     a quarter of an hour with model and node
  docs/tutorials/own_unit.md                           your unit: measure, calibrate, check
  docs/friction.md                                     why there is often no angle
"""


class Audience(EstimatorClient):
    """Also keeps what the estimator says on ``/diagnostics``."""

    def __init__(self, context: Context) -> None:
        super().__init__(context, {})  # The driver alone sends tensions; one more is a warning.
        self.statuses: list[DiagnosticStatus] = []
        self.create_subscription(DiagnosticArray, '/diagnostics', self._keep_status, 100)

    def _keep_status(self, message: DiagnosticArray) -> None:
        self.statuses += message.status


def main() -> None:
    """Run the demo."""
    say('starting the estimator, as a process of its own, on this machine only')
    design = str(installed_config('preliminary_design.yaml'))
    # Of what is played no row is to be lost, not even the first.
    reliable = ('-p', 'qos_overrides./tensions.subscription.reliability:=reliable')
    with (
        own_domain(),
        spinning(Audience) as listener,
        listener.estimator('--params-file', design, *reliable) as estimator,
    ):
        say(f'a sound session, {RATE:g} rows a second: config/demo_tensions.csv')
        status = play_until_sound(listener)
        print(f'\n/diagnostics: {LEVELS[status.level]}, {status.message}')

        say('every regime there is: config/every_regime.csv')
        play(listener, 'every_regime.csv')
        print('\nWhere friction holds the unit, tensions do not tell its angle: none is given.')

        say('the service ~/solve')
        answer = listener.solve(*PAPERS_CASE)
        print(
            f'{PAPERS_CASE[0]:g} N and {PAPERS_CASE[1]:g} N: {answer.regime}, '
            f'{math.degrees(answer.bend_angle):.2f} deg '
            f'± {math.degrees(answer.bend_angle_stddev):.2f}, {answer.pressure:.1f} Pa'
        )
        end('estimator', estimator)
    published = (round(math.degrees(answer.bend_angle), 2), round(answer.pressure, 1))
    if published != (round(math.degrees(paper.BEND_ANGLE), 2), paper.PRESSURE):
        raise RuntimeError(f'the published case came back as {published}')
    print("That is the paper's result. All that was started has ended.")
    print(WHAT_NEXT, end='')


def say(what: str) -> None:
    """Say at once what is being done."""
    print(f'\n== {what}', flush=True)


def play_until_sound(listener: Audience) -> DiagnosticStatus:
    """Play the sound session until a second of it is reported, and return that report.

    The first report tells of the second in which the estimator was found, too.
    """
    for attempt in range(MOST_SESSIONS):
        if attempt:
            why = ''.join(f': {status.message}' for status in listener.statuses[-1:])
            say(f'once more, since no second was sound{why}')
        play(listener, 'demo_tensions.csv', times=4)
        for status in listener.statuses:
            if status.level == DiagnosticStatus.OK:
                return status
    return listener.statuses[-1]


def play(listener: Audience, name: str, times: int = 1) -> None:
    """Play an installed recording over ``/tensions`` and print what comes back of it."""
    path = installed_config(name)
    rows = load_recording(path).tensions()
    count = times * len(rows)
    listener.forget()
    listener.statuses.clear()
    values = (f'file:={path}', f'rate:={RATE}', f'count:={count}', 'awaited_subscribers:=1')
    arguments = [part for value in values for part in ('-p', value)]
    with Program.running('pulley_driver', '--ros-args', *arguments) as driver:
        wait_for('an answer to every row', lambda: has_answers(listener, count))
        end('pulley_driver', driver)
    print_table(rows, listener)


def has_answers(listener: EstimatorClient, count: int) -> bool:
    """Whether all that belongs to so many messages has come."""
    determined = sum(regime in DETERMINED for regime in listener.regimes)
    valid = sum(regime != 'invalid' for regime in listener.regimes)
    numbers = (listener.bend_angles, listener.joint_pressures, listener.unit_poses)
    return (
        len(listener.regimes) == count
        and all(len(kept) == determined for kept in numbers)
        and len(listener.estimates) == valid
    )


def print_table(rows: list[tuple[float, float]], listener: EstimatorClient) -> None:
    """Print what came back over the topics, a line for each row, of the first time played."""
    angles, pressures = iter(listener.bend_angles), iter(listener.joint_pressures)
    estimates = iter(listener.estimates)
    lines = []
    for tensions, regime in zip(rows, listener.regimes, strict=False):
        angle = stddev = pressure = roots = ''
        if regime != 'invalid':
            estimate = next(estimates)
            roots = str(estimate.root_count)
        if regime in DETERMINED:
            angle = f'{math.degrees(next(angles)):.2f}'
            stddev = f'{math.degrees(estimate.bend_angle_stddev):.2f}'
            pressure = f'{next(pressures):.1f}'
        note = "the paper's case" if tensions == PAPERS_CASE else ''
        tension_l, tension_s = (f'{tension:g}' for tension in tensions)
        lines.append((tension_l, tension_s, regime, angle, stddev, pressure, roots, note))
    header = ('T_l [N]:', 'T_s [N]:', 'regime', 'angle [deg]:', '± [deg]:', 'pressure [Pa]:')
    print(markdown_table((*header, 'roots:', ''), lines))


def end(name: str, program: Program) -> None:
    """End a program as Ctrl-C does."""
    code = program.end(signal.SIGINT)
    if code != 0:
        raise RuntimeError(f'{name} ended with exit code {code}:\n{program.output()}')


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        sys.exit('demo interrupted')
    except (TimeoutError, RuntimeError, AssertionError, subprocess.TimeoutExpired) as error:
        sys.exit(f'demo failed: {error}')
