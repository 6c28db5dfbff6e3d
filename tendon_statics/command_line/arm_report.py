"""``tendon-statics arm report``: a recorded session of an arm as one HTML file."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from ..files.arm_file import design_files_of
from ..files.output_file import OutputError
from ..physics import Arm
from ..physics.arm import Cable
from . import figure_tip_force
from .arm_recording import (
    FollowedArm,
    add_arm_recording_options,
    add_arm_tip_force_options,
    followed_arm,
)
from .arm_replay_text import arm_facts, arm_tip_force_facts, joint_table
from .figure_arm import SIZE, TIP_SIZE, draw_arm, draw_tip
from .figures import svg_of
from .options import UsageError, say_written
from .origin import origin_facts
from .page import fact_table, paragraph, table, warning, write_page
from .recording_options import report_damage
from .report_text import arm_meaning

PARAMETERS = (
    *('length', 'ball_radius', 'cable_offset', 'com_distance', 'mass', 'friction_coefficient'),
    *('max_bend_angle', 'stiffness', 'contact_law'),
)
"""Of each unit that are shown; the checksum stands for all"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_recording_options(parser)
    add_arm_tip_force_options(parser)
    parser.add_argument(
        '--output', type=Path, required=True, metavar='FILE.html', help='the report'
    )


def run(options: argparse.Namespace) -> int:
    """Read, follow the arm, and write the page."""
    path: Path = options.output
    if path.suffix != '.html':
        raise OutputError(f'{path}: a report is written to a file ending in .html')
    followed = followed_arm(options, figure_tip_force.MOST)
    recording = followed.replay.recording
    parts = []
    if recording.damage:
        parts.append(warning(f'Not all of it could be read: {recording.damage_summary}'))
    files = [Path(options.arm), *design_files_of(options.arm)]
    files += [Path(options.parameters)] if options.parameters else []
    parts += [
        f'<h2>Recording, with {Path(options.arm).name}</h2>',
        *_replay_part(followed),
        *_tip_force_part(followed),
        '<h2>Arm</h2>',
        *_arm_part(followed.settings.arm),
        '<h2>How to make it again</h2>',
        fact_table(origin_facts(options, recording, files)),
    ]
    write_page(path, f'Recorded session {recording.name} of an arm', parts)
    say_written(path, options)
    return report_damage(recording)


def _replay_part(followed: FollowedArm) -> Iterator[str]:
    """What the model says of the recording, joint by joint, in figures and what they mean."""
    replayed = followed.replay
    yield fact_table(arm_facts(replayed, followed.hints))
    yield table(*joint_table(replayed))
    yield paragraph(arm_meaning(replayed, followed.settings))
    try:
        yield svg_of(lambda drawing: draw_arm(drawing, replayed), SIZE)
    except UsageError as error:
        yield warning(str(error))
        return
    yield svg_of(lambda drawing: draw_tip(drawing, replayed), TIP_SIZE)


def _tip_force_part(followed: FollowedArm) -> list[str]:
    """What the recording tells of a force at the tip, if it is asked for."""
    tips = followed.tips
    if tips is None:
        return []
    return [
        '<h2>Force at the tip</h2>',
        fact_table(arm_tip_force_facts(followed)),
        svg_of(
            lambda drawing: figure_tip_force.draw_tip_forces(
                drawing, followed.replay.recording, tips
            ),
            figure_tip_force.SIZE,
        ),
    ]


def _arm_part(arm: Arm) -> list[str]:
    """What the arm is: its units and cables."""
    rows = [
        [str(number), _plain(unit.length)]
        + [_plain(getattr(unit.design, name)) for name in PARAMETERS[1:]]
        for number, unit in enumerate(arm.units, start=1)
    ]
    cables = [
        [cable.name, cable.side, str(cable.last_unit), _offset(cable)] for cable in arm.cables
    ]
    return [
        table(('unit:', *PARAMETERS), rows),
        paragraph('In SI units, from the base to the tip.'),
        table(('cable', 'side', 'ends at unit:', 'offset'), cables),
        fact_table([('cable friction coefficient', f'{arm.cable_friction_coefficient:g}')]),
    ]


def _offset(cable: Cable) -> str:
    return "the designs'" if cable.offset is None else f'{cable.offset:.7g} m'


def _plain(value: float | str) -> str:
    return value if isinstance(value, str) else f'{value:.7g}'
