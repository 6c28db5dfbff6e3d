"""The URDF of one unit, or of an arm, for robot_state_publisher."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from xml.parsers.expat import ExpatError

from ament_index_python.packages import get_package_share_directory

from ..physics.errors import TendonStaticsError
from .apt_package import apt_package
from .joint_names import JointNames


class DescriptionError(TendonStaticsError, RuntimeError):
    """A unit or arm cannot be described; the text is for the user."""


def unit_description(
    design_file: str | Path,
    names: JointNames,
    unit: str = 'unit',
    base_turn: tuple[float, float] | None = None,
) -> str:
    """Expand ``urdf/unit.urdf.xacro``.

    Parameters
    ----------
    design_file
        The YAML file with the unit's design.
    names
        Those of the estimator.
    unit
        The link of the unit.
    base_turn
        Roll and pitch in rad of the joint's frame in a link with Z up, which is then there too,
        with ``_base`` after the name of the frame.

    Raises
    ------
    DescriptionError
        If xacro is not installed, or the file does not fit it.
    """
    arguments = {
        'design_file': _absolute(design_file),
        'name': unit,
        'parent': names.frame_id,
        'joint_name': names.joint_name,
    }
    return _expanded('unit', design_file, arguments | _turned(names.frame_id, base_turn))


def arm_description(
    arm_file: str | Path,
    frame_id: str = 'base',
    joint_names: Sequence[str] = (),
    prefix: str = 'arm_',
    base_turn: tuple[float, float] | None = None,
) -> str:
    """Expand ``urdf/arm.urdf.xacro``: the links ``arm_unit_1`` and so on, ``arm_tip``.

    Parameters
    ----------
    arm_file
        The YAML file of the arm.
    frame_id
        The link that carries the first unit.
    joint_names
        From the base on; empty: ``joint_1`` and so on, after the prefix, as the node names them.
    prefix
        Before the names of links.
    base_turn
        As for a unit, of `frame_id`.

    Raises
    ------
    DescriptionError
        If xacro is not installed, or the file does not fit it.
    """
    arguments = {
        'arm_file': _absolute(arm_file),
        'parent': frame_id,
        'prefix': prefix,
        'joint_names': ' '.join(joint_names),
    }
    return _expanded('arm', arm_file, arguments | _turned(frame_id, base_turn))


def _absolute(path: str | Path) -> str:
    """Return a path that does not start from the folder of the xacro file."""
    return str(Path(path).absolute())


def _turned(frame_id: str, base_turn: tuple[float, float] | None) -> dict[str, str]:
    if base_turn is None:
        return {}
    roll, pitch = base_turn
    return {'base': f'{frame_id}_base', 'base_roll': repr(roll), 'base_tilt': repr(pitch)}


def _expanded(what: str, path: str | Path, arguments: dict[str, str]) -> str:
    try:
        import xacro
    except ModuleNotFoundError as error:
        raise DescriptionError(
            f'xacro, which makes the description of the {what}, is not installed ({error}): '
            f'apt install {apt_package("xacro")}, or pip install xacro'
        ) from None
    urdf = Path(get_package_share_directory('tendon_statics')) / 'urdf' / f'{what}.urdf.xacro'
    try:
        description: str = xacro.process_file(str(urdf), mappings=arguments).toxml()
    except (xacro.XacroException, ExpatError) as error:
        raise DescriptionError(
            f'{path}: xacro makes no description of it: {" ".join(str(error).split())}'
        ) from None
    return description
