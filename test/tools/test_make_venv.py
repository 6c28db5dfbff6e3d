"""`tools/make_venv.bash`: what it says before it makes or downloads anything."""

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
    for name in ('make_venv.bash', 'ros_root.bash'):
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
