"""`tools/make_venv.bash`: what it says before it makes or downloads anything."""

import os
import shutil
import subprocess

import pytest
from make_docs import ROOT


@pytest.mark.parametrize(
    ('folder', 'foreign'), [('two words', ' '), ('Gelenkprüfstand', 'ü'), ("joint's", "'")]
)
def test_a_path_with_which_the_build_would_fail_is_named(folder, foreign, tmp_path):
    tools = tmp_path / folder / 'tools'
    tools.mkdir(parents=True)
    for name in ('make_venv.bash', 'ros_distro.bash'):
        shutil.copy(ROOT / 'tools' / name, tools)
    done = subprocess.run(
        ['bash', tools / 'make_venv.bash'], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stdout == ''
    (line,) = done.stderr.splitlines()
    assert line.startswith(f"tendon_statics: the path of this folder, {tools.parent}, has '")
    assert foreign in line.partition(' has ')[2]
    assert 'move the folder' in line
    assert [path.name for path in tools.parent.iterdir()] == ['tools']


@pytest.mark.parametrize('command', ['tools/make_venv.bash', '. tools/env.bash', 'make setup'])
def test_a_distribution_that_is_not_supported_is_named(command):
    done = subprocess.run(
        ['bash', '-c', command],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
        env={**os.environ, 'ROS_DISTRO': 'humble'},
    )
    assert done.returncode != 0
    line = done.stderr.splitlines()[0]
    assert line == (
        "tendon_statics: ROS_DISTRO is 'humble': it takes jazzy, the default, or kilted"
    )


def test_each_distribution_has_a_set_up_of_its_own():
    made = {}
    for distro, given in (('jazzy', ''), ('jazzy', 'jazzy'), ('kilted', 'kilted')):
        done = subprocess.run(
            ['bash', '-c', '. tools/ros_distro.bash; echo "$_made $_apt_root"'],
            capture_output=True,
            text=True,
            check=True,
            cwd=ROOT,
            env={**os.environ, 'ROS_DISTRO': given},
        )
        made[given], root = done.stdout.rstrip('\n').split(' ')
        assert root == f'/opt/ros/{distro}'
        assert (ROOT / 'tools' / f'requirements-{distro}.txt').exists()
    assert made == {'': '', 'jazzy': '', 'kilted': 'build/kilted/'}


def test_this_folder_has_no_such_path():
    """Or the tests would not run; the letters that are allowed are those of usual paths."""
    allowed = 'ABCz09/_.,+@~=-'
    script = (ROOT / 'tools' / 'make_venv.bash').read_text()
    (line,) = [line for line in script.splitlines() if line.startswith('foreign=')]
    done = subprocess.run(
        ['bash', '-c', f'PWD={allowed}; {line}; printf %s "$foreign"'],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == ''
