"""Style and forms, where `colcon test` looks for them; `make lint` has the types too."""

import subprocess
import sys
from importlib.util import find_spec

import pytest
from make_docs import ROOT


@pytest.mark.skipif(find_spec('ruff') is None, reason='ruff is not installed')
@pytest.mark.parametrize('command', [('check',), ('format', '--check')], ids=lambda c: c[0])
def test_the_code_has_its_style(command):
    done = subprocess.run(
        [sys.executable, '-m', 'ruff', *command, '.'],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize('folder', ['.', 'interfaces', 'examples/cpp_client'])
def test_a_package_has_the_form_that_the_tools_of_ros_take(folder):
    package = pytest.importorskip('catkin_pkg.package')
    warnings = []
    found = package.parse_package(str(ROOT / folder), warnings=warnings)
    found.validate(warnings=warnings)
    assert warnings == []


def test_the_interfaces_are_found_by_themselves_and_only_so():
    """As docs/releasing.md has it: the tools stop at the outer package."""
    packages = pytest.importorskip('catkin_pkg.packages')
    assert set(packages.find_packages(str(ROOT))) == {'.'}
    (found,) = packages.find_packages(str(ROOT / 'interfaces')).values()
    assert found.name == 'tendon_statics_interfaces'
