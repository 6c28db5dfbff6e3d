"""The rooms of the package: who may import whom. Arrows point down, and there is no circle."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import tendon_statics

ROOT = Path(tendon_statics.__file__).resolve().parent
PACKAGE = 'tendon_statics'

BELOW = {
    'physics': (),
    'tensions': ('physics',),
    'estimation': ('physics', 'tensions'),
    'files': ('estimation', 'physics', 'tensions'),
    'recordings': ('files', 'estimation', 'physics', 'tensions'),
    'node': ('files', 'estimation', 'physics', 'tensions'),
    'driver': ('node', 'recordings', 'files', 'physics'),
    'launching': ('recordings', 'files', 'estimation', 'physics'),
    'command_line': ('recordings', 'files', 'estimation', 'physics', 'tensions'),
}
"""Room → those that it may import from, itself aside"""

WITHOUT_ROS = ('physics', 'tensions', 'estimation', 'files', 'recordings', 'command_line')
OF_ROS = ('rclpy', 'launch', 'launch_ros')

MODULES = {
    '.'.join((PACKAGE, *path.relative_to(ROOT).with_suffix('').parts)).removesuffix(
        '.__init__'
    ): path
    for path in ROOT.rglob('*.py')
}


def imported(module: str, *, also_for_types: bool) -> Iterator[str]:
    """Full names of the modules that a module imports, anywhere in it."""
    path = MODULES[module]
    parent = module if path.name == '__init__.py' else module.rpartition('.')[0]
    tree = ast.parse(path.read_text(encoding='utf-8'))
    for_types = {
        id(node)
        for block in ast.walk(tree)
        if isinstance(block, ast.If) and 'TYPE_CHECKING' in ast.dump(block.test)
        for node in ast.walk(block)
    }
    for node in ast.walk(tree):
        if id(node) in for_types and not also_for_types:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ''
            if node.level:
                above = '.'.join(parent.split('.')[: len(parent.split('.')) - node.level + 1])
                base = f'{above}.{base}'.rstrip('.')
            for alias in node.names:
                name = f'{base}.{alias.name}'
                yield name if name in MODULES else base


def room_of(module: str) -> str:
    parts = module.split('.')
    return parts[1] if parts[0] == PACKAGE and len(parts) > 1 else ''


def test_the_rooms_are_those_that_there_are():
    assert {room_of(module) for module in MODULES} - {''} == set(BELOW)
    assert [path.name for path in ROOT.glob('*.py')] == ['__init__.py']


@pytest.mark.parametrize('room', BELOW)
def test_a_room_imports_only_from_those_below(room):
    for module in MODULES:
        if room_of(module) == room:
            rooms = {room_of(name) for name in imported(module, also_for_types=True)}
            assert rooms - {'', room} <= set(BELOW[room]), module


def test_there_is_no_circle_of_modules():
    graph = {
        module: {name for name in imported(module, also_for_types=False) if name in MODULES}
        for module in MODULES
        if module != PACKAGE
    }
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        raise AssertionError(' → '.join(error.args[1])) from None


@pytest.mark.parametrize('room', WITHOUT_ROS)
def test_what_needs_no_ros_imports_none(room):
    for module in MODULES:
        if room_of(module) == room:
            tops = {name.split('.')[0] for name in imported(module, also_for_types=False)}
            messages = {top for top in tops if top.endswith('_msgs')}
            assert not tops & set(OF_ROS), module
            assert not messages, module
