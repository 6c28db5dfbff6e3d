"""The names of a joint, in which the estimator and robot_state_publisher have to agree."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from ..files.parameter_file import node_parameter
from ..files.yaml_file import YamlFileError, read_yaml
from ..physics.errors import TendonStaticsError


class JointNameError(TendonStaticsError, ValueError):
    """A name of a joint cannot be told; the text is for the user."""


class JointNames(NamedTuple):
    """The names of a joint; the fields are the names of the estimator's parameters."""

    frame_id: str = 'joint'
    joint_name: str = 'bend'


class ArmNames(NamedTuple):
    """Those of an arm, likewise."""

    frame_id: str
    arm_name: str
    joint_names: tuple[str, ...]
    """From the base on"""


def check_joint_name(parameter: str, value: object) -> str:
    """Return a name if it is one, or raise a `JointNameError`."""
    if not isinstance(value, str) or not value:
        raise JointNameError(f'{parameter} is {value!r}, but a text that is not empty is needed')
    return value


def load_joint_names(path: str | Path, estimator: str, default: JointNames) -> JointNames:
    """Read which names an estimator takes from a ROS parameter file.

    Parameters
    ----------
    estimator : str
        Full name of the node.
    default : JointNames
        The names that are not in the file.

    Raises
    ------
    JointNameError
        If the file cannot be read or a name is no text; the text names the file.
    """
    try:
        content = read_yaml(Path(path))
        found = {name: node_parameter(content, estimator, name) for name in JointNames._fields}
        return default._replace(
            **{
                name: check_joint_name(name, value)
                for name, value in found.items()
                if value is not None
            }
        )
    except (YamlFileError, JointNameError) as error:
        raise JointNameError(f'{path}: {error}') from None
