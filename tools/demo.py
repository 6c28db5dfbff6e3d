"""Drive the installed estimator over real ROS 2 and print what it publishes.

Starts ``estimator`` and ``pulley_driver`` as processes of their own, on this machine only and in
a ROS domain that nobody else uses, plays the demo tensions once, and ends what it started.
"""

from __future__ import annotations

import math
import signal
import subprocess
import sys

from estimator_client import EstimatorClient
from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.installed_files import installed_config
from tendon_statics.physics import paper
from tendon_statics.recordings.reading.load import load_recording

DETERMINED = (Estimate.EQUILIBRIUM, Estimate.DRIVEN_TO_STOP)
PAPERS_CASE = (paper.TENSION_L, paper.TENSION_S)


def main() -> None:
    """Run the demo."""
    rows = load_recording(installed_config('demo_tensions.csv')).tensions()
    design = str(installed_config('preliminary_design.yaml'))
    # A recording that is played once is to lose no row, not even the first.
    reliable = ('-p', 'qos_overrides./tensions.subscription.reliability:=reliable')
    play = ('-p', 'awaited_subscribers:=1', '-p', 'loop:=false', '-p', 'rate:=20.0')
    with (
        own_domain(),
        spinning(EstimatorClient) as listener,
        listener.estimator('--params-file', design, *reliable) as estimator,
    ):
        with Program.running('pulley_driver', '--ros-args', *play) as driver:
            wait_for('an answer to every row', lambda: has_answers(listener, len(rows)))
            end('pulley_driver', driver)
        print_table(rows, listener)
        answer = listener.solve(*PAPERS_CASE)
        print(
            f'\n~/solve of {PAPERS_CASE[0]:g} N and {PAPERS_CASE[1]:g} N: {answer.regime}, '
            f'{math.degrees(answer.bend_angle):.2f} deg '
            f'± {math.degrees(answer.bend_angle_stddev):.2f}, {answer.pressure:.1f} Pa'
        )
        end('estimator', estimator)
    published = (round(math.degrees(answer.bend_angle), 2), round(answer.pressure, 1))
    if published != (round(math.degrees(paper.BEND_ANGLE), 2), paper.PRESSURE):
        raise RuntimeError(f'the published case came back as {published}')


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
    """Print what came back over the topics, a line for each row played."""
    angles, pressures = iter(listener.bend_angles), iter(listener.joint_pressures)
    estimates = iter(listener.estimates)
    lines = []
    for tensions, regime in zip(rows, listener.regimes, strict=True):
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
    print(f'\n{name} ended by SIGINT with exit code 0')


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        sys.exit('demo interrupted')
    except (TimeoutError, RuntimeError, AssertionError, subprocess.TimeoutExpired) as error:
        sys.exit(f'demo failed: {error}')
