"""The URDF of one unit, for robot_state_publisher."""

from __future__ import annotations

from pathlib import Path
from xml.parsers.expat import ExpatError

from ament_index_python.packages import get_package_share_directory

from ..physics.errors import TendonStaticsError
from .apt_package import apt_package
from .joint_names import JointNames


class DescriptionError(TendonStaticsError, RuntimeError):
    """A unit cannot be described; the text is for the user."""


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
    try:
        import xacro
    except ModuleNotFoundError as error:
        raise DescriptionError(
            f'xacro, which makes the description of the unit, is not installed ({error}): '
            f'apt install {apt_package("xacro")}, or pip install xacro'
        ) from None
    urdf = Path(get_package_share_directory('tendon_statics')) / 'urdf' / 'unit.urdf.xacro'
    arguments = {
        # xacro would take a relative one to start from the folder of its own file.
        'design_file': str(Path(design_file).absolute()),
        'name': unit,
        'parent': names.frame_id,
        'joint_name': names.joint_name,
    }
    if base_turn is not None:
        roll, pitch = base_turn
        arguments |= {
            'base': f'{names.frame_id}_base',
            'base_roll': repr(roll),
            'base_tilt': repr(pitch),
        }
    try:
        description: str = xacro.process_file(str(urdf), mappings=arguments).toxml()
    except (xacro.XacroException, ExpatError) as error:
        raise DescriptionError(
            f'{design_file}: xacro makes no description of it: {" ".join(str(error).split())}'
        ) from None
    return description
