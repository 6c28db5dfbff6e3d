"""``tendon-statics arm tip-force``: what pushes at the tip, as far as all joints tell."""

from __future__ import annotations

import argparse
import math

from ..physics import ArmTipForce, arm_tip_force
from .arm_options import add_arm_options, add_tensions_option, arm_from, tensions_from
from .arm_recording import OF_ARM
from .options import (
    add_bend_angle_stddev_option,
    add_format_option,
    add_tension_stddev_option,
    print_json,
)
from .tables import fact_lines, markdown_table
from .tip_force import finite_ends, intervals_text, percent
from .tip_force_options import add_direction_option, add_level_option


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_options(parser)
    add_tensions_option(parser, '--tensions', 'the tensions at the base')
    group = add_direction_option(parser, OF_ARM, required=True)
    group.add_argument(
        '--at-stop',
        type=int,
        nargs='+',
        default=(),
        metavar='N',
        help='joints, counted from 1 at the base, that lean on their stop, which carries what '
        'friction does not',
    )
    add_level_option(group)
    add_tension_stddev_option(parser, default=0.0)
    add_bend_angle_stddev_option(parser, default=0.0)
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the intervals, which joints bound them, and those of each joint by itself."""
    arm, angles, load = arm_from(options)

    def ask(tension_stddev: float, bend_angle_stddev: float) -> ArmTipForce:
        return arm_tip_force(
            *(arm, tensions_from(options.tensions)),
            bend_angles=angles,
            direction=options.direction,
            load=load,
            at_stop=options.at_stop,
            tension_stddev=tension_stddev,
            bend_angle_stddev=bend_angle_stddev,
            level=options.level,
        )

    deviations = options.tension_stddev, math.radians(options.bend_angle_stddev_deg)
    found, noisy = ask(0.0, 0.0), ask(*deviations)
    if options.format == 'json':
        print_json(
            {
                'exact_intervals': finite_ends(found.intervals),
                'intervals': finite_ends(noisy.intervals),
                'level': noisy.level,
                'probability_free': noisy.probability_free,
                'bounding_joints': noisy.bounding_joints,
                'joint_intervals': [finite_ends(one) for one in found.joint_intervals],
            }
        )
        return
    facts = [('explained by', intervals_text(found.intervals))]
    facts += [('bounded by', text) for text in _bounds(found)]
    if any(deviations):
        noise = f'{deviations[0]:g} N on each tension, {options.bend_angle_stddev_deg:g} deg'
        at_level = f'{intervals_text(noisy.intervals)}, with {noise} on each angle'
        facts += [
            (f'at {100.0 * noisy.level:g} %', at_level),
            *(('bounded by', text) for text in _bounds(noisy)),
            ('free tip', f'{percent(noisy.probability_free)} probable'),
        ]
    print(fact_lines(facts))
    rows = [
        [str(number), f'{math.degrees(angle):.3f}', intervals_text(intervals, nothing='no force')]
        for number, (angle, intervals) in enumerate(
            zip(angles, found.joint_intervals, strict=True), start=1
        )
    ]
    print('\n' + markdown_table(('joint:', 'bend angle [deg]:', 'explained by'), rows))


def _bounds(found: ArmTipForce) -> list[str]:
    """Say for each interval which joint bounds it where."""
    texts = []
    for joints in found.bounding_joints:
        ends = [
            f'joint {joint} {where}'
            for joint, where in zip(joints, ('below', 'above'), strict=True)
            if joint is not None
        ]
        texts.append(', '.join(ends) or 'no joint')
    return texts
