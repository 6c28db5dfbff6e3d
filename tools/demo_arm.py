"""Drive the installed estimator of an arm over real ROS 2 and print where the arm goes.

Starts ``arm_estimator`` and ``pulley_driver`` as processes of their own, on this machine only and
in a ROS domain that nobody else uses, plays the drive cycle of an arm of five units, and ends what
it started.
"""

from __future__ import annotations

import math
import subprocess
import sys

from demo import end, say
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for
from tendon_statics_interfaces.msg import ArmEstimate

from tendon_statics import Arm, ArmTracker, Regime, load_arm
from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.reading.load import load_arm_recording

RATE = 50.0
"""Rows a second"""
SHOWN = 14
"""Rows of those that are printed, spread over the session"""

WHAT_NEXT = """
What next:
  make demo ARM=1 VIEW=1                   the arm again and again, live in the browser
  source tools/env.bash                    in bash: the programs on the PATH, then
  tendon-statics arm report config/arm.yaml config/arm_tensions.csv --output arm.html
                                           the same session as a page, with figures
  docs/tutorials/an_arm.md                 describe an arm of your own, and follow it
  docs/arm.md                              the model, and how joints slip together
"""


class Audience(Node):
    """Keeps what the estimator says of the arm."""

    def __init__(self, context: Context) -> None:
        super().__init__('audience', context=context)
        self.estimates: list[ArmEstimate] = []
        self.ear = self.create_subscription(
            ArmEstimate,
            'arm_estimator/arm_estimate',
            self.estimates.append,
            QoSProfile(depth=5000),
        )


def main() -> None:
    """Run the demo."""
    files = installed_config('arm.yaml'), installed_config('arm_tensions.csv')
    arm = load_arm(files[0])
    rows = load_arm_recording(files[1], arm).tensions()
    say('starting the estimator of an arm of five units, on this machine only')
    # Of what is played no row is to be lost, and no answer to one.
    of_arm = ('--ros-args', '-p', f'arm_file:={files[0]}')
    kept = (
        *('-p', 'qos_overrides./tensions.subscription.reliability:=reliable'),
        *('-p', f'qos_overrides./tensions.subscription.depth:={len(rows)}'),
        *('-p', f'qos_overrides./arm_estimator/arm_estimate.publisher.depth:={len(rows)}'),
    )
    with (
        own_domain(),
        spinning(Audience) as audience,
        Program.running('arm_estimator', *of_arm, *kept) as estimator,
    ):
        wait_for('the estimator', lambda: audience.ear.get_publisher_count() > 0)
        say(f'its drive cycle, {RATE:g} rows a second: config/arm_tensions.csv')
        values = (f'file:={files[1]}', f'rate:={RATE}', 'loop:=false', 'awaited_subscribers:=1')
        played = [part for value in values for part in ('-p', value)]
        with Program.running('pulley_driver', *of_arm, *played) as driver:
            wait_for('an answer to every row', lambda: len(audience.estimates) == len(rows))
            end('pulley_driver', driver)
        end('arm_estimator', estimator)
    print_table(audience.estimates)
    check(arm, audience.estimates)
    print(
        f'Each of the {len(audience.estimates)} answers is what ArmTracker says of the same '
        'tensions, to the last bit. All that was started has ended.'
    )
    print(WHAT_NEXT, end='')


def print_table(estimates: list[ArmEstimate]) -> None:
    """Print where joints and tip were, a line for each of some rows; a mark says what slipped."""
    marks = {Regime.SLIPPING.value: '~', Regime.DRIVEN_TO_STOP.value: '|'}
    count = len(estimates)
    chosen = [estimates[round(n * (count - 1) / (SHOWN - 1))] for n in range(SHOWN)]
    rows = []
    for of in chosen:
        angles = [
            f'{math.degrees(angle):.2f}{marks.get(regime, " ")}'
            for angle, regime in zip(of.bend_angles, of.regimes, strict=True)
        ]
        tip = (1e3 * of.tip_x, 1e3 * of.tip_z, math.degrees(of.tip_tilt))
        rows.append(
            [*(f'{of_cable:.2f}' for of_cable in of.tensions), *angles]
            + [f'{value:.1f}' for value in tip]
        )
    cables = [f'{name} [N]:' for name in chosen[0].cable_names]
    joints = [f'θ{number} [deg]:' for number in range(1, len(chosen[0].joint_names) + 1)]
    print(markdown_table([*cables, *joints, 'tip x [mm]:', 'z [mm]:', 'tilt [deg]:'], rows))
    print('\n~ slips, | is pressed on its stop, else friction holds the joint.')


def check(arm: Arm, estimates: list[ArmEstimate]) -> None:
    """Hold what came over ROS against the library."""
    tracker = ArmTracker(arm)
    for number, of in enumerate(estimates, start=1):
        state = tracker.update(dict(zip(of.cable_names, of.tensions, strict=True)))
        if tuple(of.bend_angles) != state.bend_angles:
            raise RuntimeError(f'answer {number} has {of.bend_angles}, not {state.bend_angles}')


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        sys.exit('demo interrupted')
    except (TimeoutError, RuntimeError, AssertionError, subprocess.TimeoutExpired) as error:
        sys.exit(f'demo failed: {error}')
