"""The joints of a rig in one YAML list, as ``launch/rig.launch.py`` takes it."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..joint_names import JointNameError, JointNames, check_joint_name, load_joint_names
from ..physics.design import JointDesign
from ..physics.errors import DesignError, TendonStaticsError
from ..recordings.errors import RecordingError
from ..recordings.reading.load import load_recording
from .design_file import load_design
from .unit_parameters import TENSION_SOURCES
from .yaml_file import YamlFileError, read_yaml


class RigFileError(TendonStaticsError, ValueError):
    """A file that describes no rig.

    Attributes
    ----------
    key : str
        The key of the joint that is at fault; empty if none is.
    """

    def __init__(self, text: str, key: str = '') -> None:
        super().__init__(text)
        self.key = key


@dataclasses.dataclass(frozen=True)
class RigJoint:
    """One joint of a rig: an estimator, and in simulation the driver that it listens to."""

    namespace: str
    """without slashes at its ends"""
    design_file: Path
    design: JointDesign
    """what is in `design_file`"""
    names: JointNames
    """of the joint: from the parameters, else the design file, else after the namespace"""
    tension_source: str = TENSION_SOURCES[0]
    parameters: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    """of the estimator, by dotted name"""
    remappings: Mapping[str, str] = dataclasses.field(default_factory=dict)
    recording: Path | None = None
    """tension file that is played in simulation; None for the one that the driver has"""
    simulation: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    """parameters of the driver in simulation, by dotted name"""

    @property
    def joint_state_topic(self) -> str:
        """Where the estimator's ``~/joint_state`` is, seen from the namespace."""
        topic = 'estimator/joint_state'
        for name, other in self.remappings.items():
            if self._seen_from_namespace(name) == topic:
                return self._seen_from_namespace(other)
        return topic

    def _seen_from_namespace(self, name: str) -> str:
        """The estimator's name of a topic, however it is written, in one way of writing."""
        return re.sub('^~/', 'estimator/', name).removeprefix(f'/{self.namespace}/')

    def estimator_parameters(self) -> dict[str, Any]:
        """All parameters of the estimator."""
        # The design too, for a design file may hold it under the name of another node.
        return {
            **{f'design.{name}': value for name, value in dataclasses.asdict(self.design).items()},
            'tension_source': self.tension_source,
            **self.parameters,
            **self.names._asdict(),
        }

    def driver_parameters(self) -> dict[str, Any]:
        """All parameters of the driver in simulation: what it shares with the estimator first."""
        return {
            'tension_source': self.tension_source,
            **self.parameters,
            **({'file': str(self.recording)} if self.recording else {}),
            **self.simulation,
        }


def load_rig(path: str | Path) -> list[RigJoint]:
    """Read the joints of a rig; what their paths lead to is read too.

    The file is a list of mappings with the keys ``namespace`` and ``design_file`` and, where
    needed, ``tension_source``, ``parameters``, ``remappings``, ``recording`` and ``simulation``.
    Relative paths start from the file's own folder.

    Raises
    ------
    RigFileError
        If the file cannot be read, is no such list, or two joints have one namespace; the text
        names the file, the joint, the key, the value and what is allowed.
    """
    path = Path(path)
    try:
        content = read_yaml(path)
        if not isinstance(content, list) or not content:
            raise RigFileError(
                'it is not a list of joints, each with its namespace and design_file'
            )
        joints: list[RigJoint] = []
        for number, entry in enumerate(content, start=1):
            joint = _joint(entry, number, path.parent)
            if any(joint.namespace == other.namespace for other in joints):
                raise RigFileError(
                    f'joint {number}: namespace is {joint.namespace!r}, which another joint has '
                    'already; each needs its own',
                    key='namespace',
                )
            joints.append(joint)
    except (RigFileError, YamlFileError) as error:
        raise RigFileError(f'{path}: {error}', key=getattr(error, 'key', '')) from None
    return joints


def _joint(entry: object, number: int, folder: Path) -> RigJoint:
    if not isinstance(entry, Mapping):
        raise RigFileError(
            f'joint {number} is {entry!r}, but a mapping of keys to values is needed; '
            f'there are {", ".join(_READERS)}'
        )
    values: dict[str, Any] = {}
    for key, value in entry.items():
        if key not in _READERS:
            raise RigFileError(
                f'joint {number}: {key} is {value!r}, but there is no such key; '
                f'there are {", ".join(_READERS)}',
                key=str(key),
            )
        try:
            values[key] = _READERS[key](value, folder)
        except ValueError as error:
            raise RigFileError(f'joint {number}: {key} is {value!r}: {error}', key=key) from None
    for key in ('namespace', 'design_file'):
        if key not in values:
            raise RigFileError(f'joint {number}: {key} is missing', key=key)
    design_file, design = values.pop('design_file')
    names = _names(design_file, values['namespace'], values.get('parameters', {}), number)
    return RigJoint(design_file=design_file, design=design, names=names, **values)


def _names(
    design_file: Path, namespace: str, parameters: Mapping[str, Any], number: int
) -> JointNames:
    default = JointNames(f'{namespace}/joint', namespace.replace('/', '_'))
    try:
        names = load_joint_names(design_file, f'/{namespace}/estimator', default)
    except JointNameError as error:
        raise RigFileError(f'joint {number}: design_file: {error}', key='design_file') from None
    given = {name: parameters[name] for name in JointNames._fields if name in parameters}
    return names._replace(**given)


# One function a key. They raise a ValueError that says what is wrong with the value.


def _namespace(value: object, _folder: Path) -> str:
    if not isinstance(value, str) or not _NAMESPACE.fullmatch(value):
        raise ValueError(
            'a name of letters, digits and _ is needed that does not begin with a digit, or '
            'several with / between them'
        )
    return value.strip('/')


def _design_file(value: object, folder: Path) -> tuple[Path, JointDesign]:
    path = _path(value, folder)
    try:
        return path, load_design(path)
    except DesignError as error:
        raise ValueError(str(error)) from None


def _tension_source(value: object, _folder: Path) -> str:
    if value not in TENSION_SOURCES:
        raise ValueError(f'allowed is one of {", ".join(TENSION_SOURCES)}')
    return str(value)


def _recording(value: object, folder: Path) -> Path:
    path = _path(value, folder)
    try:
        load_recording(path).whole()
    except RecordingError as error:
        raise ValueError(str(error)) from None
    return path


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
    'tension_source': 'tension_source',
    'recording': 'recording',
    'file': 'recording',
}
"""What is no parameter in a rig file → the key that it has"""

_PARAMETER_TYPES = {bool, int, float, str}

_READERS: Mapping[str, Callable[[object, Path], Any]] = {
    'namespace': _namespace,
    'design_file': _design_file,
    'tension_source': _tension_source,
    'parameters': _parameters,
    'remappings': _remappings,
    'recording': _recording,
    'simulation': _simulation,
}
