"""The joints and arms of a rig in one YAML list, as ``launch/rig.launch.py`` takes it."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..files.arm_settings import joint_names
from ..files.cable_parameters import TENSION_SOURCES
from ..files.parameter_kinds import SettingError
from ..files.yaml_file import YamlFileError, read_yaml
from ..physics.arm import Arm
from ..physics.design import JointDesign
from ..physics.errors import TendonStaticsError
from .base_turn import load_base_turn
from .description import arm_description, unit_description
from .joint_names import ArmNames, JointNameError, JointNames, load_joint_names
from .rig_values import READERS, check_for_arm, check_recording


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
    """One joint of a rig, or an arm of several: an estimator, and in simulation its driver."""

    namespace: str
    """without slashes at its ends"""
    design_file: Path
    design: JointDesign | Arm
    """what is in `design_file`"""
    names: JointNames | ArmNames
    """from the parameters, else the design file of a joint, else after the namespace"""
    tension_source: str = TENSION_SOURCES[0]
    parameters: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    """of the estimator, by dotted name"""
    remappings: Mapping[str, str] = dataclasses.field(default_factory=dict)
    recording: Path | None = None
    """tension file that is played in simulation; None for the one that the driver has"""
    simulation: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    """parameters of the driver in simulation, by dotted name"""

    @property
    def estimator(self) -> str:
        """Program and node that estimates it."""
        return 'arm_estimator' if isinstance(self.design, Arm) else 'estimator'

    @property
    def parameter_files(self) -> list[Path]:
        """Files of ROS parameters, which that of an arm is not."""
        return [] if isinstance(self.design, Arm) else [self.design_file]

    @property
    def joint_state_topic(self) -> str:
        """Where the estimator's joint states are, seen from the namespace."""
        topic = f'{self.estimator}/joint_state{"s" * isinstance(self.design, Arm)}'
        for name, other in self.remappings.items():
            if self._seen_from_namespace(name) == topic:
                return self._seen_from_namespace(other)
        return topic

    def _seen_from_namespace(self, name: str) -> str:
        """The estimator's name of a topic, however it is written, in one way of writing."""
        return re.sub('^~/', f'{self.estimator}/', name).removeprefix(f'/{self.namespace}/')

    @property
    def base_turn(self) -> tuple[float, float] | None:
        """Roll and pitch in rad of its base, where gravity's direction is given."""
        return load_base_turn(self.design_file, f'/{self.namespace}/estimator', self.parameters)

    def description(self) -> str:
        """The URDF of it, for robot_state_publisher.

        Raises
        ------
        DescriptionError
            If xacro is not installed.
        """
        names = self.names
        if isinstance(names, ArmNames):
            prefix = f'{self.namespace}/'
            return arm_description(
                self.design_file, names.frame_id, names.joint_names, prefix, self.base_turn
            )
        return unit_description(self.design_file, names, f'{self.namespace}/unit', self.base_turn)

    def estimator_parameters(self) -> dict[str, Any]:
        """All parameters of the estimator."""
        design: dict[str, Any] = {'arm_file': str(self.design_file)}
        if not isinstance(self.design, Arm):
            # A design file may hold it under the name of another node.
            design = {f'design.{name}': of for name, of in dataclasses.asdict(self.design).items()}
        return {
            **design,
            'tension_source': self.tension_source,
            **self.parameters,
            **{name: _plain(of) for name, of in self.names._asdict().items()},
        }

    def driver_parameters(self) -> dict[str, Any]:
        """All parameters of the driver in simulation: what it shares with the estimator first."""
        return {
            **({'arm_file': str(self.design_file)} if isinstance(self.design, Arm) else {}),
            'tension_source': self.tension_source,
            **self.parameters,
            **({'file': str(self.recording)} if self.recording else {}),
            **self.simulation,
        }


def load_rig(path: str | Path) -> list[RigJoint]:
    """Read the joints of a rig; what their paths lead to is read too.

    The file is a list of mappings with the keys ``namespace`` and ``design_file`` and, where
    needed, ``tension_source``, ``parameters``, ``remappings``, ``recording`` and ``simulation``.
    The design file of an arm is its file, as `load_arm` takes it.
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
    values = {**({'tension_source': 'joint_state'} if isinstance(design, Arm) else {}), **values}
    try:
        key = 'tension_source'
        if isinstance(design, Arm):
            check_for_arm(values[key])
        key = 'recording'
        if key in values:
            check_recording(values[key], design)
    except ValueError as error:
        raise RigFileError(
            f'joint {number}: {key} is {str(entry[key])!r}: {error}', key=key
        ) from None
    parameters = values.get('parameters', {})
    if isinstance(design, Arm):
        names: JointNames | ArmNames = _arm_names(design, values['namespace'], parameters, number)
    else:
        names = _names(design_file, values['namespace'], parameters, number)
    return RigJoint(design_file=design_file, design=design, names=names, **values)


def _arm_names(arm: Arm, namespace: str, parameters: Mapping[str, Any], number: int) -> ArmNames:
    name = parameters.get('arm_name', namespace.replace('/', '_'))
    try:
        joints = joint_names(arm, parameters.get('joint_names', ()), name)
    except SettingError as error:
        raise RigFileError(f'joint {number}: parameters: {error}', key='parameters') from None
    return ArmNames(parameters.get('frame_id', f'{namespace}/base'), name, joints)


def _plain(value: object) -> object:
    return list(value) if isinstance(value, tuple) else value


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
