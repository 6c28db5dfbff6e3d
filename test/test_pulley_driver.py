"""The installed node ``pulley_driver``: what it plays, and how it refuses."""

import pytest
from rclpy.node import Node
from ros_programs import Program, spinning, wait_for
from std_msgs.msg import Float64MultiArray

from tendon_statics.installed_files import installed_config
from tendon_statics.recordings.load import load_recording


class Audience(Node):
    """Keeps what the driver plays."""

    def __init__(self, context):
        super().__init__('audience', context=context)
        self.rows = []
        self.create_subscription(Float64MultiArray, 'tensions', self.keep, 1000)

    def keep(self, message):
        """Keep one row."""
        self.rows.append(tuple(message.data))


@pytest.fixture
def played():
    with spinning(Audience) as audience:
        yield audience.rows


def test_it_plays_every_row_once_in_order(played):
    arguments = ('awaited_subscribers:=1', 'loop:=false', 'rate:=200.0')
    with Program.running(
        'pulley_driver', '--ros-args', *(part for a in arguments for part in ('-p', a))
    ) as program:
        wait_for('the last row', lambda: 'Played' in program.output())
        rows = load_recording(installed_config('demo_tensions.csv')).tensions()
        wait_for('every row', lambda: len(played) == len(rows))
        assert played == rows
        assert program.end() == 0


def test_it_begins_anew_with_the_file_it_is_given(tmp_path, played):
    path = tmp_path / 'run.csv'
    path.write_text('tension_l,tension_s\n1,2\n3,4\n')
    with Program.running(
        'pulley_driver', '--ros-args', '-p', f'file:={path}', '-p', 'rate:=200.0'
    ) as program:
        wait_for('a second round', lambda: len(played) >= 5)
        assert played[:2] in ([(1.0, 2.0), (3.0, 4.0)], [(3.0, 4.0), (1.0, 2.0)])
        assert program.end() == 0


@pytest.mark.parametrize(
    ('argument', 'named'),
    [('file:=/missing.csv', '/missing.csv: it cannot be read'), ('rate:=0.0', 'rate')],
)
def test_what_it_cannot_play_is_one_line_and_exit_code_1(argument, named):
    with Program.running('pulley_driver', '--ros-args', '-p', argument) as program:
        assert program.wait() == 1
        (line,) = program.output().splitlines()
        assert line.startswith('pulley_driver cannot start: ')
        assert named in line
