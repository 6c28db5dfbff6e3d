"""What may stand under each key of a rig file: one function a key.

They raise a `ValueError` that says what is wrong with the value.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..files.arm_file import is_arm_file, load_arm
from ..files.arm_parameters import ARM_TENSION_SOURCES
from ..files.cable_parameters import TENSION_SOURCES
from ..files.design_file import load_design
from ..physics.arm import Arm
from ..physics.design import JointDesign
from ..physics.errors import ArmError, DesignError
from ..recordings.errors import RecordingError
from ..recordings.reading.load import load_arm_recording, load_recording
from .joint_names import JointNames, check_joint_name


def _namespace(value: object, _folder: Path) -> str:
    if not isinstance(value, str) or not _NAMESPACE.fullmatch(value):
        raise ValueError(
            'a name of letters, digits and _ is needed that does not begin with a digit, or '
            'several with / between them'
        )
    return value.strip('/')


def _design_file(value: object, folder: Path) -> tuple[Path, JointDesign | Arm]:
    """Read the design of a unit, or an arm of several."""
    path = _path(value, folder)
    try:
        return path, load_arm(path) if is_arm_file(path) else load_design(path)
    except (ArmError, DesignError) as error:
        raise ValueError(str(error)) from None


def _tension_source(value: object, _folder: Path) -> str:
    if value not in TENSION_SOURCES:
        raise ValueError(f'allowed is one of {", ".join(TENSION_SOURCES)}')
    return str(value)


def check_for_arm(tension_source: str) -> None:
    """Check that an arm's cables can be measured so, or raise a `ValueError`."""
    if tension_source not in ARM_TENSION_SOURCES:
        raise ValueError(f'allowed of an arm is one of {", ".join(ARM_TENSION_SOURCES)}')


def check_recording(path: Path, design: JointDesign | Arm) -> None:
    """Check that a recording of a unit or an arm can be played, or raise a `ValueError`."""
    try:
        if isinstance(design, Arm):
            load_arm_recording(path, design).whole()
        else:
            load_recording(path).whole()
    except RecordingError as error:
        raise ValueError(str(error)) from None


def _path(value: object, folder: Path) -> Path:
    if not isinstance(value, str) or not value:
        raise ValueError('the path of a file is needed')
    return folder.absolute() / value


def _parameters(value: object, _folder: Path) -> dict[str, Any]:
    parameters = _by_dotted_name(value)
    for name in JointNames._fields:
        if name in parameters:
            check_joint_name(name, parameters[name])
    return parameters


def _simulation(value: object, _folder: Path) -> dict[str, Any]:
    return _by_dotted_name(value)


def _by_dotted_name(value: object) -> dict[str, Any]:
    parameters: dict[str, Any] = {}
    try:
        pairs = _flatten(value)
    except RecursionError:
        raise ValueError('a mapping is in itself') from None
    for name, item in pairs:
        if name in parameters:
            raise ValueError(f'{name} is given twice')
        home = _HOMES.get(name.split('.')[0])
        if home:
            raise ValueError(f'{name} does not belong here, it has a key of its own: {home}')
        parameters[name] = item
    return parameters


def _flatten(value: object, prefix: str = '') -> list[tuple[str, Any]]:
    """Dotted name and value of every parameter."""
    if isinstance(value, Mapping):
        return [
            pair
            for key, inner in value.items()
            for pair in _flatten(inner, f'{prefix}.{key}' if prefix else str(key))
        ]
    if not prefix:
        raise ValueError('a mapping of names of parameters to values is needed')
    kinds = {type(item) for item in value} if isinstance(value, list) else {type(value)}
    if len(kinds) != 1 or not kinds <= _PARAMETER_TYPES:
        raise ValueError(
            f'{prefix} is {value!r}, but a parameter is a number, text, true or false, or a list '
            'of one kind of these'
        )
    return [(prefix, value)]


def _remappings(value: object, _folder: Path) -> dict[str, str]:
    if not isinstance(value, Mapping) or not all(
        isinstance(name, str) and name for pair in value.items() for name in pair
    ):
        raise ValueError('a mapping of names to other names is needed')
    for name in [name for pair in value.items() for name in pair]:
        if not _TOPIC.fullmatch(name):
            raise ValueError(
                f'{name!r} is no name of a topic or service; it is written as tensions, '
                '/left/tensions or ~/joint_state'
            )
    return dict(value)


_NAMESPACE = re.compile(r'/?[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z_][A-Za-z0-9_]*)*/?')

# Not __ns or __node, which move the node itself.
_TOPIC = re.compile(r'(?!__)(?:~?/)?[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z_][A-Za-z0-9_]*)*')

_HOMES = {
    'design': 'design_file',
    'arm_file': 'design_file',
    'tension_source': 'tension_source',
    'recording': 'recording',
    'file': 'recording',
}
"""What is no parameter in a rig file → the key that it has"""

_PARAMETER_TYPES = {bool, int, float, str}

READERS: Mapping[str, Callable[[object, Path], Any]] = {
    'namespace': _namespace,
    'design_file': _design_file,
    'tension_source': _tension_source,
    'parameters': _parameters,
    'remappings': _remappings,
    'recording': _path,
    'simulation': _simulation,
}
