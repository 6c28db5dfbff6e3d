"""What the field does to recordings, a small input of each kind, and what is right of each."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import bags
import numpy as np
import pyarrow
import yaml
from bags import ORIGIN, STORE
from make_docs import ROOT
from pyarrow import parquet

from tendon_statics import default_design_path

CABLES = ('cable_l', 'cable_s')
STEP = 10_000_000
"""ns between messages"""

UNIT = 'unit_with_gains.yaml'
WINCHES = ('winch_l', 'winch_s')
OF_UNIT = {
    'tension_source': 'joint_state',
    'cable_names': [*WINCHES],
    'cable_l.gain': 0.001,
    'cable_s.gain': 0.001,
    'cable_l.bias': -0.1,
}


@dataclasses.dataclass(frozen=True)
class Case:
    """A recording, how it is to be read, and what is to be said of it."""

    says: Sequence[str] = ()
    """Parts of what `replay` prints"""
    code: int = 0
    """With which verbs that read it end"""
    tensions: tuple[tuple[float, float], ...] = ()
    """The first samples, in N"""
    samples: int | None = None
    refused: str = ''
    """Part of the one line with which it is refused"""
    options: Sequence[str] = ()
    design: str = ''
    """Unit's file; empty: the default"""
    names: tuple[str, str] = CABLES
    """Of the cables in joint states"""
    valid: int | None = None
    """Samples that are; None: all"""
    drops: dict[str, int] = dataclasses.field(default_factory=dict)
    """What the node drops beside, since it cannot look ahead or has no recorder's clock; of all
    of which a note of the verbs tells"""
    foreign: int = 0
    """Messages about neither cable"""


LOG = 'its times are those of recording (--clock stamp|log)'
RAMP = ((1.0, 1.5), (1.0, 1.505), (1.0, 1.51))

CASES = {
    'slack_tiny.csv': Case(['slack 2'], tensions=((1.0, 1.0), (0.01, 0.01)), samples=4),
    'slack_reads_a_little_above_zero.csv': Case(['slack']),
    'drive_off_nan.csv': Case(['invalid       not finite 2'], samples=4, valid=2),
    'hour_gap.csv': Case(['longest gap 3.6e+03 s'], samples=2),
    'one_spike.csv': Case(['warning       tension_s goes from'], samples=4),
    'raw_counts_for_unit_with_gains.csv': Case(
        ['tension = 0.001 · reading -0.1 N', 'tension = 0.001 · reading +0 N'],
        tensions=((1.0, 2.0), (1.0, 2.01)),
        samples=2,
        design=UNIT,
        names=WINCHES,
    ),
    'counts_unmarked.csv': Case(
        ['warning ', 'cable_l.gain', 'invalid       implausible 3'], samples=3, valid=0
    ),
    'degrees_all_held.csv': Case(['warning ', 'bend_angle [deg]'], samples=3),
    'percent_time_header.csv': Case(['time: the column %time, in s'], tensions=((1.0, 1.5),)),
    'excel_de.csv': Case(
        ['separated by semicolon', 'with a comma'], tensions=((1.0, 1.5), (1.0, 1.6)), samples=2
    ),
    'tabs.csv': Case(['separated by tab'], tensions=((1.0, 1.5), (1.0, 1.6)), samples=2),
    'labview.csv': Case(['of LabVIEW'], tensions=((1.01, 1.52), (1.02, 1.53)), samples=2),
    'ts.parquet': Case(['of timestamps'], tensions=((1.0, 1.5), (1.0, 1.6)), samples=5),
    'topic_without_slash.mcap': Case(tensions=RAMP, samples=50),
    'two_types_on_one_topic.mcap': Case(refused='--tension-source array|joint_state', code=2),
    'bag_one_cable_a_message': Case(tensions=((1.0, 2.0),), samples=100),
    'bag_shared_joint_states': Case(tensions=RAMP, samples=100, foreign=100),
    'bag_twice': Case(
        ['recorded more than once: 100 copies'],
        tensions=RAMP,
        samples=100,
        drops={'repeated stamp': 100},
    ),
    'bag_zero_then_stamped': Case(['70 of 100 messages', LOG], samples=100),
    'bag_neg_stamp': Case(
        ['1 of 100 stamps', 'before 1970', LOG], samples=100, drops={'out of order': 1}
    ),
    'bag_jump_back_ramp': Case(
        ['go back from', 'at message 61 of 100', LOG], samples=100, drops={'out of order': 40}
    ),
    'bag_boot_stamps': Case(
        ['s behind the times of recording', 'so all topics go by the times of recording'],
        tensions=RAMP,
        samples=100,
    ),
    'bag_split_missing': Case(code=1, tensions=RAMP, samples=88),
    'bag_split_stray': Case(['left out, as metadata.yaml does not list it'], samples=8),
}
"""Name of a file or folder → what is right of it"""

DAMAGE = {'bag_split_missing': 'split_5.mcap is missing, which metadata.yaml lists'}
"""What is named as damage"""

TABLES = [name for name in CASES if not name.endswith('.mcap') and not name.startswith('bag_')]
BAGS = [name for name in CASES if name.startswith('bag_')]


def collected() -> Path | None:
    """Folder of such cases beside the clone, as users have sent them, where there is one."""
    marks = sorted(ROOT.parent.glob('*/cases/publish_foreign_joints.py'))
    return marks[0].parent if marks else None


def write_cases(folder: Path) -> Path:
    """Write an input of each kind; return the folder."""
    for name, text in _TABLES.items():
        (folder / name).write_text(text, encoding='utf-8')
    start = pyarrow.array([ORIGIN + STEP * k for k in range(5)], pyarrow.timestamp('ns'))
    columns = {
        'time': start,
        'tension_l': [1.0] * 5,
        'tension_s': [1.5 + 0.1 * k for k in range(5)],
    }
    parquet.write_table(pyarrow.table(columns), folder / 'ts.parquet')
    design = default_design_path().read_text(encoding='utf-8')
    lines = ''.join(f'    {name}: {value}\n' for name, value in OF_UNIT.items())
    (folder / UNIT).write_text(design.replace('    design:', f'{lines}    design:'))
    octal = design.replace('mass: ', 'mass: 010  # ')
    (folder / 'mass_octal.yaml').write_text(octal, encoding='utf-8')
    _write_bags(folder)
    return folder


def _rows(*rows: Sequence[float], titles: str = 'time,tension_l,tension_s') -> str:
    return '\n'.join([titles, *(','.join(map(str, row)) for row in rows)]) + '\n'


def _slack_session() -> str:
    """Held, then slack within the noise while somebody bends the unit, then pulled again."""
    rng = np.random.default_rng(3)
    noise = np.abs(rng.normal(0.0, 0.008, (20, 2)))
    rows = [
        *((0.05 * k, 1.0, 1.0, 0.0) for k in range(10)),
        *((0.5 + 0.05 * k, *noise[k].round(4), 0.02 * k) for k in range(20)),
        *((1.5 + 0.05 * k, 1.0, 1.1, 0.4) for k in range(10)),
    ]
    return _rows(*rows, titles='time,tension_l,tension_s,bend_angle')


_ANGLED = 'time,tension_l,tension_s,bend_angle [deg]'
_TABLES = {
    'slack_tiny.csv': _rows(
        *((0, 1, 1, 0), (0.1, 0.01, 0.01, 0), (0.2, 0.012, 0.008, 18), (0.3, 1, 1, 18)),
        titles=_ANGLED,
    ),
    'slack_reads_a_little_above_zero.csv': _slack_session(),
    'drive_off_nan.csv': _rows(
        *((0, 1, 1, 0), (0.1, 'nan', 'nan', 0), (0.2, 'nan', 'nan', 15), (0.3, 1, 1, 15)),
        titles=_ANGLED,
    ),
    'hour_gap.csv': _rows((0, 1, 1, 0), (3600, 1, 1, 15), titles=_ANGLED),
    'one_spike.csv': _rows(
        *((1.0, 1.5), (1.0, 4.2), (1.0, 1.5), (1.0, 1.5)), titles='tension_l,tension_s'
    ),
    'raw_counts_for_unit_with_gains.csv': _rows((0, 1100, 2000), (0.1, 1100, 2010)),
    'counts_unmarked.csv': _rows(
        *((9000, 14000), (9000, 14100), (9000, 14200)), titles='tension_l,tension_s'
    ),
    'degrees_all_held.csv': _rows(
        *((0, 1, 1.5, 11), (1, 1, 1.5, 14), (2, 1, 1.6, 16)),
        titles='time,tension_l,tension_s,bend_angle',
    ),
    'percent_time_header.csv': _rows((1.0, 1.0, 1.5), titles='%time,tension_l,tension_s'),
    'excel_de.csv': 'time;tension_l;tension_s\n0,0;1,0;1,5\n0,01;1,0;1,6\n',
    'tabs.csv': 'time\ttension_l\ttension_s\n0.0\t1.0\t1.5\n0.01\t1.0\t1.6\n',
    'labview.csv': (
        'LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\n'
        'Decimal_Separator\t,\nMulti_Headings\tNo\nX_Columns\tOne\n***End_of_Header***\t\n'
        'Channels\t2\t\nX_Value\ttension_l\ttension_s\tComment\n'
        '0,000000\t1,01\t1,52\n0,010000\t1,02\t1,53\n'
    ),
}


def _state(stamp: float | None, effort: Sequence[float], names: Sequence[str] = CABLES) -> Any:
    """A joint state with a stamp in s after the origin, or none."""
    return bags.joint_state(names, effort=effort, time=stamp)


def _ramp(count: int = 100, first: int = 0) -> Iterator[tuple[str, float, Any]]:
    for index in range(first, first + count):
        time = 0.01 * index
        yield '/tensions', time + 0.002, _state(time, [1.0, 1.5 + 0.005 * index])


def _write_bags(folder: Path) -> None:
    def angle(time: float) -> tuple[str, float, Any]:
        return '/measured_bend_angle', time, bags.number(0.1)

    def write(name: str, *messages: tuple[str, float, Any]) -> None:
        bags.write_bag(folder / name, sorted(messages, key=lambda message: message[1]))

    times = 0.01 * np.arange(100)
    write(
        'bag_one_cable_a_message',
        *(('/tensions', t, _state(t, [1.0], CABLES[:1])) for t in times),
        *(('/tensions', t + 0.001, _state(t, [2.0], CABLES[1:])) for t in times),
    )
    write(
        'bag_shared_joint_states',
        *_ramp(),
        *(('/tensions', t + 0.004, _state(t, [], ['wheel', 'grip'])) for t in times),
        *(angle(t + 0.003) for t in times),
    )
    write('bag_twice', *_ramp(), *_ramp())
    slow = 5.0 * times
    stamps: list[float | None] = [None] * 70 + [1.0 + t for t in slow[70:]]
    values = [[1.0, 1.0 + 0.02 * min(k, 60) - 0.02 * max(k - 90, 0)] for k in range(100)]
    write(
        'bag_zero_then_stamped',
        *(('/tensions', slow[k], _state(stamps[k], values[k])) for k in range(100)),
    )
    back = [t - 37.0 * (k >= 60) for k, t in enumerate(slow)]
    write(
        'bag_jump_back_ramp',
        *(('/tensions', slow[k], _state(back[k], values[k])) for k in range(100)),
    )
    before = [*times[:50], -1e-9 * ORIGIN - 1.0, *times[51:]]
    write(
        'bag_neg_stamp',
        *(('/tensions', times[k], _state(before[k], values[k])) for k in range(100)),
    )
    boot = [
        bags.joint_state(CABLES, effort=[1.0, 1.5 + 0.005 * k], time=12.3 + t, origin=0)
        for k, t in enumerate(times)
    ]
    write(
        'bag_boot_stamps',
        *(('/tensions', t, message) for t, message in zip(times, boot, strict=True)),
        *(angle(t + 0.001) for t in times),
    )
    _write_split(folder / 'bag_split_missing')
    bags.write_bag(folder / 'bag_split_stray', _ramp(8))
    stray = [('/tensions', 0.01 * k, _state(0.01 * k, [9.0, 9.0])) for k in range(5)]
    bags.write_bag(folder / 'stray', stray).rename(folder / 'bag_split_stray/old_0.mcap')
    _write_types(folder)


def _write_split(folder: Path) -> None:
    """Write twelve files with eight messages each, of which the sixth is then missing."""
    folder.mkdir()
    names = [f'split_{number}.mcap' for number in range(12)]
    for number, name in enumerate(names):
        part = bags.write_bag(folder / f'part_{number}', _ramp(8, 8 * number))
        part.rename(folder / name)
    (folder / names[5]).unlink()
    information = {'version': 9, 'relative_file_paths': names, 'message_count': 96}
    content = yaml.safe_dump({'rosbag2_bagfile_information': information})
    (folder / 'metadata.yaml').write_text(content, encoding='utf-8')


def _write_types(folder: Path) -> None:
    """Write a topic without its slash, and one with two types."""
    from mcap.writer import Writer

    array, state = 'std_msgs/msg/Float64MultiArray', 'sensor_msgs/msg/JointState'
    arrays = [bags.array(1.0, 1.5 + 0.005 * k) for k in range(50)]
    states = [_state(0.01 * k, [1.0, 2.0]) for k in range(25, 50)]
    for name, topic, messages in (
        ('topic_without_slash', 'tensions', arrays),
        ('two_types_on_one_topic', '/tensions', arrays[:25] + states),
    ):
        with (folder / f'{name}.mcap').open('wb') as stream:
            writer = Writer(stream)
            writer.start(profile='ros2')
            channels = {}
            for kind in (array, state):
                definition, _ = STORE.generate_msgdef(kind, ros_version=2)
                schema = writer.register_schema(kind, 'ros2msg', definition.encode())
                if any(message.__msgtype__ == kind for message in messages):
                    channels[kind] = writer.register_channel(topic, 'cdr', schema)
            for index, message in enumerate(messages):
                kind, time = message.__msgtype__, ORIGIN + STEP * index
                data = bytes(STORE.serialize_cdr(message, kind))
                writer.add_message(channels[kind], time, data, time)
            writer.finish()
