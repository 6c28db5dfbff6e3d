"""Who may import whom: rooms import from those below them, and no modules import in a circle."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest
from make_docs import ROOT

import tendon_statics
from tendon_statics.files.installed_files import installed_config

PACKAGE = Path(tendon_statics.__file__).parent

BELOW = {
    'physics': set(),
    'tensions': {'physics'},
    'estimation': {'physics', 'tensions'},
    'files': {'physics', 'tensions', 'estimation'},
    'recordings': {'physics', 'tensions', 'estimation', 'files'},
    'archive': {'physics', 'tensions', 'estimation', 'files', 'recordings'},
    'launching': {'physics', 'tensions', 'estimation', 'files', 'recordings'},
    'node': {'physics', 'tensions', 'estimation', 'files', 'recordings'},
    'driver': {'physics', 'tensions', 'estimation', 'files', 'recordings', 'node'},
    'view': {'physics', 'tensions', 'estimation', 'files', 'node'},
    'command_line': {'physics', 'tensions', 'estimation', 'files', 'recordings', 'archive'},
}
"""Room → those from which it may import, as docs/architecture.md shows them"""

ROOMS = sorted(path.parent.name for path in PACKAGE.glob('*/__init__.py'))

FILES = {
    '.'.join(path.relative_to(PACKAGE).with_suffix('').parts): path
    for path in sorted(PACKAGE.rglob('*.py'))
}
"""Module, from the package on → its file"""


def imports(module, *, at_once=False):
    """Names of what a module imports, with dots for the package's own; `at_once` when loaded."""
    path = FILES[module]
    package = ('', *path.relative_to(PACKAGE).parts[:-1])
    tree = ast.parse(path.read_text(encoding='utf-8'))
    for node in top_level(tree) if at_once else ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module
        elif isinstance(node, ast.ImportFrom):
            parts = package[: len(package) - node.level + 1]
            parts += tuple(node.module.split('.')) if node.module else ()
            yield from ('.'.join((*parts, alias.name)) for alias in node.names)


def top_level(tree):
    """Statements that run when a module is loaded: not in functions, nor for types alone."""
    for node in tree.body:
        if isinstance(node, ast.If) and 'TYPE_CHECKING' in ast.dump(node.test):
            continue
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            continue
        yield from ast.walk(node)


def module_of(name):
    """The module of the package that an imported name is, or is in."""
    name = name.removeprefix('.')
    while name and name not in FILES and f'{name}.__init__' not in FILES:
        name = name.rpartition('.')[0]
    return name if name in FILES else f'{name}.__init__' if name else '__init__'


@pytest.mark.parametrize('room', ROOMS)
def test_a_room_imports_only_from_those_below_it(room):
    for module in FILES:
        if not module.startswith(f'{room}.'):
            continue
        for name in imports(module):
            if name.startswith('.'):
                other = name.split('.')[1]
                assert other in BELOW[room] | {room} or other not in ROOMS, f'{module}: {name}'


def test_no_modules_import_each_other_in_a_circle():
    graph = {
        module: {module_of(name) for name in imports(module, at_once=True) if name.startswith('.')}
        - {module}
        for module in FILES
    }
    done, on_the_way = set(), []

    def visit(module):
        assert module not in on_the_way, ' → '.join([*on_the_way, module])
        if module in done:
            return
        on_the_way.append(module)
        for other in sorted(graph[module]):
            visit(other)
        done.add(on_the_way.pop())

    for module in graph:
        visit(module)


def test_ros_is_imported_where_it_belongs():
    for module in FILES:
        if module.startswith(('node.', 'driver.', 'launching.', 'view.')):
            continue
        for name in imports(module):
            assert name.split('.')[0] not in ('rclpy', 'launch', 'launch_ros'), f'{module}: {name}'


def test_the_page_on_the_architecture_names_every_room():
    text = (ROOT / 'docs/architecture.md').read_text(encoding='utf-8')
    assert set(ROOMS) <= set(BELOW)
    for room in ROOMS:
        assert f'| `{room}/` |' in text


def parts_of(room):
    """Return its modules, and its folders with a / after their names."""
    folder = PACKAGE / room
    modules = {path.stem for path in folder.glob('*.py')} - {'__init__'}
    return modules | {f'{path.parent.name}/' for path in folder.glob('*/__init__.py')}


def test_the_page_names_every_file_of_the_physics():
    text = (ROOT / 'docs/architecture.md').read_text(encoding='utf-8')
    section = text[text.index('## The physics') : text.index('## The way of one message')]
    named = set(re.findall(r'`(\w+)(?:\.py|(/))`', section)) - {('law', '')}
    assert {''.join(name) for name in named} == parts_of('physics')


def test_the_page_names_every_file_of_the_arm():
    text = (ROOT / 'docs/architecture.md').read_text(encoding='utf-8')
    table = text[text.index('| file of `physics/arm` |') : text.index('A formula is written once')]
    rows = [row.split('|')[1] for row in table.splitlines()[2:] if row]
    named = [name for row in rows for name in row.strip().split(', ')]
    assert sorted(named) == sorted(parts_of('physics/arm'))


def test_who_only_solves_does_not_wait_for_numpy():
    """Its import takes as long as all the rest, also with the file of a design."""
    code = (
        'import sys; from tendon_statics.command_line.main import main; '
        "main(['solve', '--tension-l', '1', '--tension-s', '2', *sys.argv[1:]]); "
        "sys.exit('numpy' in sys.modules)"
    )
    for given in ((), ('--design', str(installed_config('preliminary_design.yaml')))):
        subprocess.run([sys.executable, '-c', code, *given], check=True, stdout=subprocess.DEVNULL)
