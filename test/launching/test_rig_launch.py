"""`ros2 launch tendon_statics rig.launch.py`, where ROS 2 has launch (its wheels do not)."""

import itertools
import json
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
from lifecycle_msgs.srv import GetState
from rclpy.node import Node
from ros_programs import Program, ask, spinning, wait_for
from sensor_msgs.msg import JointState
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.files.installed_files import installed_config
from tendon_statics.launching.rig_file import load_rig

LAUNCH = ('ros2', 'launch', 'tendon_statics', 'rig.launch.py')

pytestmark = pytest.mark.skipif(
    shutil.which('ros2') is None
    or subprocess.run(('ros2', 'launch', '--help'), capture_output=True).returncode != 0,
    reason='there is no ros2 launch',
)


class Audience(Node):
    """Keeps the estimates of every joint."""

    def __init__(self, context, namespaces):
        super().__init__('audience', context=context)
        self.estimates = {namespace: [] for namespace in namespaces}
        for namespace, estimates in self.estimates.items():
            self.create_subscription(
                Estimate, f'{namespace}/estimator/estimate', estimates.append, 1000
            )

    def topics(self):
        return {name for name, _ in self.get_topic_names_and_types()}

    def enclaves(self):
        return {enclave for *_, enclave in self.get_node_names_and_namespaces_with_enclaves()}


def test_the_example_rig_runs_in_simulation_and_ends_on_ctrl_c():
    """Every joint estimates from its own kind of driver, under the names that it was given."""
    joints = load_rig(installed_config('rig.yaml'))
    namespaces = [joint.namespace for joint in joints]
    with (
        spinning(lambda context: Audience(context, namespaces)) as audience,
        Program.running_command([*LAUNCH, 'simulate:=true']) as rig,
    ):

        def has_estimates():
            assert rig.process.poll() is None, rig.output()
            return all(audience.estimates.values())

        wait_for('estimates of every joint', has_estimates)
        for joint in joints:
            (frame,) = {e.header.frame_id for e in audience.estimates[joint.namespace]}
            assert frame == joint.names.frame_id
        named = {'/distal/actuators/measured_js', '/distal/statics/measured_js'}
        named |= {'/proximal/tensions', '/gripper/tension_l', '/gripper/tension_s'}
        assert named <= audience.topics()
        assert not {'/distal/tensions', '/gripper/tensions'} & audience.topics()
        enclaves = {
            f'/tendon_statics/{joint.namespace}/{node}'
            for joint, node in itertools.product(joints, ('estimator', 'pulley_driver'))
        }
        wait_for('the nodes in their enclaves', lambda: enclaves <= audience.enclaves())
        # To launch alone, which passes it on.
        assert rig.end(signal.SIGINT) == 0
        books = re.findall(r'Sent: (\{.*\})', rig.output())
        assert len(books) == len(joints)
        assert all(json.loads(book)['messages'] > 0 for book in books)
        assert rig.output().count('process has finished cleanly') == 2 * len(joints)
        assert 'does not have' not in rig.output()


def estimator_of(rig, namespace):
    """Number of the process of a joint's estimator, which launch has started."""
    for number in map(
        int, re.findall(r'estimator-\d+\]: process started with pid \[(\d+)\]', rig)
    ):
        command = Path(f'/proc/{number}/cmdline')
        if command.exists() and f'__ns:=/{namespace}' in command.read_text():
            return number
    return None


@pytest.mark.parametrize('respawn', ['true', 'false'])
def test_an_estimator_that_dies_is_named_and_comes_back_if_it_is_to(respawn):
    arguments = ('simulate:=true', f'respawn:={respawn}', 'respawn_delay:=0.2', 'log_level:=error')
    with (
        spinning(lambda context: Audience(context, ['distal'])) as audience,
        Program.running_command([*LAUNCH, *arguments]) as rig,
    ):
        estimates = audience.estimates['distal']
        wait_for('estimates', lambda: estimates)
        os.kill(estimator_of(rig.output(), 'distal'), signal.SIGKILL)
        then = 'it is started again' if respawn == 'true' else 'the rest goes on without it'
        named = f'/distal/estimator ended with -9: {then}'
        wait_for('it to be said', lambda: named in rig.output())
        if respawn == 'true':
            estimates.clear()
            wait_for('estimates again', lambda: estimates)
        assert rig.end(signal.SIGINT) == 0
        assert rig.output().count(' ended with ') == 1


def test_a_lifecycle_manager_may_start_the_rig():
    with (
        spinning(lambda context: Audience(context, ['distal'])) as audience,
        Program.running_command([*LAUNCH, 'autostart:=false']) as rig,
    ):
        client = audience.create_client(GetState, '/distal/estimator/get_state')
        assert ask(client, GetState.Request()).current_state.label == 'unconfigured'
        assert rig.end(signal.SIGINT) == 0


def test_a_bad_rig_file_starts_nothing_and_is_one_line(tmp_path):
    path = tmp_path / 'rig.yaml'
    path.write_text('- namespace: left\n  design_file: missing.yaml\n')
    with Program.running_command([*LAUNCH, f'rig_file:={path}']) as rig:
        assert rig.wait() == 1
        (line,) = [line for line in rig.output().splitlines() if 'ERROR' in line]
        assert f'{path}: joint 1: design_file is' in line
        assert 'process started' not in rig.output()


def test_an_arm_runs_in_a_rig_beside_a_unit(tmp_path):
    """Its estimator hears its driver, its joints have the names that its description has."""
    config = installed_config('arm.yaml').parent
    rig_file = tmp_path / 'rig.yaml'
    rig_file.write_text(
        f'- namespace: snake\n  design_file: {config}/arm.yaml\n  simulation: {{rate: 50}}\n'
        f'- namespace: gripper\n  design_file: {config}/preliminary_design.yaml\n'
    )
    heard = []
    with (
        spinning(lambda context: Audience(context, ['gripper'])) as audience,
        Program.running_command([*LAUNCH, f'rig_file:={rig_file}', 'simulate:=true']) as rig,
    ):
        topic = 'snake/arm_estimator/joint_states'
        audience.create_subscription(JointState, topic, heard.append, 1000)

        def has_both():
            assert rig.process.poll() is None, rig.output()
            return heard and audience.estimates['gripper']

        wait_for('arm and unit', has_both)
        assert heard[0].header.frame_id == 'snake/base'
        arm, _ = load_rig(rig_file)
        named = {
            joint.get('name') for joint in ElementTree.fromstring(arm.description()).iter('joint')
        }
        assert set(heard[0].name) == named - {'snake/tip_end'}
        assert rig.end(signal.SIGINT) == 0
        assert rig.output().count('process has finished cleanly') == 4
        assert 'does not have' not in rig.output()
