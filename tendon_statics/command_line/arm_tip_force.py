"""``tendon-statics arm tip-force``: what pushes at the tip, as far as all joints tell."""

from __future__ import annotations

import argparse
import math
from typing import Any

from ..files.arm_file import load_arm_uncertainties
from ..physics import ArmTipForce, arm_tip_force
from ..physics.tip_force import SIDES
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
    group.add_argument(
        '--slipping',
        type=_slipping_joint,
        nargs='+',
        default=(),
        metavar='N=SIDE',
        help='joints that are slipping, and towards which cables, s or l, such as 4=s: friction '
        'is at its limit there; default: all may be at rest',
    )
    add_level_option(group)
    add_tension_stddev_option(parser, default=0.0)
    add_bend_angle_stddev_option(parser, default=0.0)
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the intervals, which joints bound them, and those of each joint by itself."""
    arm, angles, load = arm_from(options)
    uncertainties = load_arm_uncertainties(options.arm)

    def ask(**noise: Any) -> ArmTipForce:
        return arm_tip_force(
            *(arm, tensions_from(options.tensions)),
            bend_angles=angles,
            direction=options.direction,
            load=load,
            at_stop=options.at_stop,
            slipping=dict(options.slipping),
            level=options.level,
            **noise,
        )

    deviations = options.tension_stddev, math.radians(options.bend_angle_stddev_deg)
    found = ask()
    noisy = ask(
        tension_stddev=deviations[0],
        bend_angle_stddev=deviations[1],
        design_covariance=uncertainties,
    )
    if options.format == 'json':
        print_json(
            {
                'exact_intervals': finite_ends(found.intervals),
                'intervals': finite_ends(noisy.intervals),
                'level': noisy.level,
                'probability_free': noisy.probability_free,
                'at_limit': noisy.at_limit,
                'force': noisy.force,
                'force_stddev': noisy.force_stddev,
                'bounding_joints': noisy.bounding_joints,
                'joint_intervals': [finite_ends(one) for one in found.joint_intervals],
            }
        )
        return
    facts = [('explained by', intervals_text(found.intervals))]
    facts += [('bounded by', text) for text in _bounds(found)]
    if any((*deviations, *uncertainties)):
        noise = f'{deviations[0]:g} N on each tension, {options.bend_angle_stddev_deg:g} deg'
        noise += ' on each angle'
        if any(uncertainties):
            noise += ', and the uncertainty of the designs'
        at_level = f'{intervals_text(noisy.intervals)}, with {noise}'
        facts += [
            (f'at {100.0 * noisy.level:g} %', at_level),
            *(('bounded by', text) for text in _bounds(noisy)),
            ('free tip', f'{percent(noisy.probability_free)} probable'),
        ]
    if noisy.force is not None and noisy.force_stddev is not None:
        facts.append(('force', f'{noisy.force:+.4f} N, deviation {noisy.force_stddev:.4f} N'))
    print(fact_lines(facts))
    rows = [
        [str(number), f'{math.degrees(angle):.3f}', intervals_text(intervals, nothing='no force')]
        for number, (angle, intervals) in enumerate(
            zip(angles, found.joint_intervals, strict=True), start=1
        )
    ]
    print('\n' + markdown_table(('joint:', 'bend angle [deg]:', 'explained by'), rows))


def _slipping_joint(text: str) -> tuple[int, str]:
    joint, _, side = text.partition('=')
    if joint.isdecimal() and side in SIDES:
        return int(joint), side
    raise argparse.ArgumentTypeError(f'it is {text!r}, needed is N=SIDE, say 4=s or 4=l')


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
