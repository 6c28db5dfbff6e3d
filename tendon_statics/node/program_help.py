"""What the programs that are nodes say of themselves: ``--help`` and ``--version``."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..files.parameter_kinds import Parameter

WHAT = {
    'estimator': 'Bend angle and joint pressure of one unit from its cable tensions, as a node.',
    'arm_estimator': 'Bend angles and pressures of an arm from its cable tensions, as a node.',
    'pulley_driver': 'Plays recorded tensions where a rig has motor drivers, as a node.',
    'view': 'A live page in the browser of what the estimators say, as a node.',
}
"""Program → what it does"""


def node_help(name: str, arguments: Sequence[str]) -> str:
    """Return what a program is to print in place of running; empty if it is to run.

    Both options count wherever they stand, since no argument of ROS is called so.
    """
    if '--version' in arguments:
        from importlib.metadata import version

        return f'{name} {version("tendon_statics")}'
    if '--help' in arguments or '-h' in arguments:
        return _help(name)
    return ''


def _help(name: str) -> str:
    from ..files.arm_parameters import ARM_PARAMETERS, cable_table
    from ..files.driver_parameters import DRIVER_PARAMETERS
    from ..files.estimator_parameters import ESTIMATOR_PARAMETERS
    from ..files.view_parameters import VIEW_PARAMETERS

    tables = {
        'estimator': ESTIMATOR_PARAMETERS,
        'arm_estimator': ARM_PARAMETERS,
        'pulley_driver': DRIVER_PARAMETERS,
        'view': VIEW_PARAMETERS,
    }
    lines = [
        f'usage: {name} [--help] [--version] [--ros-args ROS-ARGUMENTS]',
        '',
        WHAT[name],
        '',
        *(f'  {name} --ros-args {given:28} {what}' for given, what in _examples(name)),
        '',
        'parameters, with their defaults and what is allowed:',
        *_lines(tables[name]),
    ]
    if name == 'estimator':
        lines.append("  design....: the unit's design; `tendon-statics design` lists it")
    elif name == 'arm_estimator':
        lines += _lines(cable_table(('NAME',)))
    return '\n'.join(lines)


def _examples(name: str) -> Iterator[tuple[str, str]]:
    """Arguments of ROS, and what they give."""
    if name == 'arm_estimator':
        yield '-p arm_file:=arm.yaml', "the arm's own file"
    if name != 'view':
        yield '--params-file unit.yaml', 'parameters from a file'
    yield '-p NAME:=VALUE', 'one parameter'
    if name != 'view':  # It finds the topics by itself, in every namespace.
        yield '-r tensions:=driver/tensions', 'another name of a topic'
        yield '-r __ns:=/left', 'a namespace'


def _lines(parameters: Iterable[Parameter]) -> list[str]:
    found = []
    for parameter in parameters:
        allowed = f', {parameter.allowed}' if parameter.allowed else ''
        found.append(f'  {parameter.name} ({json.dumps(parameter.default)}{allowed})')
        found.append(f'      {parameter.description.replace("`", "")}')
    return found
