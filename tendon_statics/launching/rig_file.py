"""The joints of a rig in one YAML list, as ``launch/rig.launch.py`` takes it."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..files.cable_parameters import TENSION_SOURCES
from ..files.yaml_file import YamlFileError, read_yaml
from ..physics.design import JointDesign
from ..physics.errors import TendonStaticsError
from .base_turn import load_base_turn
from .joint_names import JointNameError, JointNames, load_joint_names
from .rig_values import READERS


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

    @property
    def base_turn(self) -> tuple[float, float] | None:
        """Roll and pitch in rad of its base, where gravity's direction is given."""
        return load_base_turn(self.design_file, f'/{self.namespace}/estimator', self.parameters)

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
            f'there are {", ".join(READERS)}'
        )
    values: dict[str, Any] = {}
    for key, value in entry.items():
        if key not in READERS:
            raise RigFileError(
                f'joint {number}: {key} is {value!r}, but there is no such key; '
                f'there are {", ".join(READERS)}',
                key=str(key),
            )
        try:
            values[key] = READERS[key](value, folder)
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
