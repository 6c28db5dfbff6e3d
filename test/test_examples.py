"""The examples run as they stand, and say what they are to say."""

import itertools
import json
import os
import subprocess
import sys
import time
from contextlib import suppress

import pytest
from ament_index_python.packages import PackageNotFoundError, get_package_prefix
from ctrl_c import assert_ends_by_ctrl_c
from make_docs import ROOT
from ros_programs import Program, wait_for

from tendon_statics import default_design_path, load_design

EXAMPLES = ROOT / 'examples'

CARELESS = """
import rclpy
rclpy.init()
node = rclpy.create_node('careless')
timer = node.create_timer(0.0, lambda: (timer.cancel(), print('spins')))
rclpy.spin(node)
"""

TIME_LIMIT = 300.0
"""s; more than ten times what one takes"""


def run_script(name, *arguments, folder):
    """Run a script to its end and return what it printed."""
    done = subprocess.run(
        [sys.executable, EXAMPLES / name, *map(str, arguments)],
        cwd=folder,
        env={**os.environ, 'MPLBACKEND': 'agg'},
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def example(name):
    """Run a script that ends by a signal only."""
    return Program.running_command([sys.executable, '-u', EXAMPLES / name])


def test_the_notebook_finds_the_stand_in_unit(tmp_path):
    notebook = json.loads((EXAMPLES / 'calibration.ipynb').read_text(encoding='utf-8'))
    cells = [''.join(of['source']) for of in notebook['cells'] if of['cell_type'] == 'code']
    (tmp_path / 'notebook.py').write_text('\n\n'.join(cells), encoding='utf-8')
    printed = run_script(tmp_path / 'notebook.py', folder=tmp_path)
    assert 'no warnings' in printed
    fitted = load_design(tmp_path / 'fitted.yaml')
    assert fitted.mass == pytest.approx(0.024, abs=0.005)
    assert fitted.cable_offset == pytest.approx(0.0041, abs=0.0004)
    assert fitted.friction_coefficient == pytest.approx(0.92, abs=0.04)


def test_comparing_laws_says_what_the_recording_tells(tmp_path):
    printed = run_script('compare_laws.py', folder=tmp_path)
    assert 'merged           at 1 N and 2 N: equilibrium at 17.14°' in printed
    assert 'friction_circle  at 1 N and 2 N: held' in printed
    assert 'elastic_seat     ruled out' in printed
    assert 'the data cannot tell merged and friction_circle apart' in printed


def test_an_arm_is_followed_through_its_load_cycle(tmp_path):
    printed = run_script('arm.py', folder=tmp_path)
    assert printed.startswith('sample 18: moving [5]; tip at +0.00 mm')
    assert 'moving [1, 2, 3, 4, 5]' in printed
    assert 'In the end the joints are at -29.4°, -21.7°, -13.0°, -28.1°, -18.0°.' in printed
    assert 'The tip is known to 0.55 mm' in printed


def test_an_arm_is_followed_past_rows_that_are_none(tmp_path):
    table = tmp_path / 'tensions.csv'
    rows = '1,1,1,1\n1,1,-1,1\n1,1,0,1\n1,1,1,1\n'
    table.write_text(f'l_mid,s_mid,l_tip,s_tip\n{rows}', encoding='utf-8')
    arm = default_design_path().with_name('arm.yaml')
    printed = run_script('arm.py', arm, table, folder=tmp_path)
    assert 'sample 2: the tension of cable l_tip is -1.0 N' in printed
    assert 'sample 3: a joint is slack' in printed


def test_what_pushes_is_a_set_at_rest_and_a_number_in_motion(tmp_path):
    printed = run_script('tip_force.py', folder=tmp_path)
    assert 'at rest         -1.189 to +0.075 N, at 95 %' in printed
    assert 'slipping to s   +0.059 N ± 0.010 N' in printed
    assert 's_tip 1.3 N     -0.155 to +0.032 N\n    joint 1 would slip below, joint 4' in printed


def test_the_subscriber_prints_changes_of_regime_and_says_when_nothing_comes(listener):
    with listener.estimator(), example('subscriber.py') as subscriber:
        wait_for('that', lambda: 'no estimate for 2 s' in subscriber.output())
        for pair, text in (
            ((1.0, 2.0), 'equilibrium: 17.14° ± 7.04°, 405.6 Pa\n'),
            ((1.0, 1.5), 'held: the tensions do not tell the angle\n'),
            ((1.0, 3.0), 'driven_to_stop: 30.00° ± 0.00°'),
        ):
            # Again and again, since the first may come before the two have found each other.
            deadline = time.monotonic() + TIME_LIMIT
            while text not in subscriber.output():
                assert time.monotonic() < deadline, subscriber.output()
                listener.publish(*pair)
                with suppress(TimeoutError):
                    wait_for(text, lambda t=text: t in subscriber.output(), time_limit=0.2)
        assert_ends_by_ctrl_c(subscriber)
        lines = subscriber.output().splitlines()
        assert all(line != after for line, after in itertools.pairwise(lines))


def test_the_client_waits_for_its_answer_within_a_callback(listener):
    with listener.estimator(), example('service_client.py') as client:
        wait_for('tensions for an angle', lambda: '11°: cable l' in client.output())
        assert_ends_by_ctrl_c(client)


def test_the_client_says_that_no_estimator_is_running():
    with example('service_client.py') as client:
        wait_for('that', lambda: 'no estimator is running: start one' in client.output())
        assert_ends_by_ctrl_c(client)


def test_a_script_that_does_not_expect_ctrl_c_does_not_pass_for_one_that_does():
    with Program.running_command([sys.executable, '-u', '-c', CARELESS]) as careless:
        wait_for('that it spins', lambda: 'spins' in careless.output())
        with pytest.raises(AssertionError):
            assert_ends_by_ctrl_c(careless)


@pytest.fixture(scope='module')
def ask_estimator(tmp_path_factory):
    """Build the client in C++, without warnings, and return its path."""
    try:
        get_package_prefix('rclcpp')
    except PackageNotFoundError:
        pytest.skip('there is no rclcpp')
    folder = tmp_path_factory.mktemp('cpp_client')
    for command in (
        ('cmake', '-S', EXAMPLES / 'cpp_client', '-B', folder, '-DCMAKE_CXX_FLAGS=-Werror'),
        ('cmake', '--build', folder),
    ):
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT)
        assert done.returncode == 0, done.stdout + done.stderr
    return folder / 'ask_estimator'


def run_client(program, *arguments):
    """Run the client in C++ to its end."""
    return subprocess.run(
        [program, *arguments], capture_output=True, text=True, timeout=TIME_LIMIT
    )


def test_the_client_in_cpp_asks_and_says_why_there_is_no_answer(ask_estimator, listener):
    with listener.estimator():
        for pair, text in (
            (('1.0', '2.0'), 'equilibrium: 0.2991 +- 0.1229 rad, 405.6 Pa\n'),
            (('1.0', '1.5'), 'held: the tensions do not tell the angle\n'),
        ):
            done = run_client(ask_estimator, *pair)
            assert (done.returncode, done.stdout) == (0, text), done.stderr
        done = run_client(ask_estimator, '-1.0', '2.0')
        assert (done.returncode, done.stdout) == (1, '')
        assert 'tension_l is -1.0 N, allowed is 0 to' in done.stderr


def test_the_client_in_cpp_says_that_no_estimator_is_running(ask_estimator):
    done = run_client(ask_estimator, '1.0', '2.0')
    assert (done.returncode, done.stdout) == (1, '')
    assert 'no estimator is running' in done.stderr


def test_the_client_in_cpp_blames_no_estimator_for_ctrl_c(ask_estimator, listener):
    with Program.running_command([ask_estimator, '1.0', '2.0']) as client:
        wait_for('the client', lambda: 'ask_estimator' in listener.get_node_names())
        assert client.end() == 1
        assert 'estimator is running' not in client.output()


@pytest.mark.parametrize(
    ('arguments', 'text'),
    [
        (('1.0',), 'usage: ask_estimator TENSION_L TENSION_S, in N\n'),
        (('abc', '2.0'), "ask_estimator: 'abc' is no tension: give a number, in N\n"),
        (('1.0', '2.0x'), "ask_estimator: '2.0x' is no tension: give a number, in N\n"),
        (('1.0', '1e999'), "ask_estimator: '1e999' is no tension: give a number, in N\n"),
        (('1.0', '2.0', '--ros-args', '--no-such'), "unknown ROS arguments: '--no-such'\n"),
    ],
)
def test_the_client_in_cpp_takes_no_arguments_but_two_numbers(ask_estimator, arguments, text):
    done = run_client(ask_estimator, *arguments)
    assert (done.returncode, done.stdout) == (2, '')
    assert done.stderr.endswith(text)
