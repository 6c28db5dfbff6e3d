"""How the base of a unit is turned, by the parameters of its estimator."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..estimation.orientation import roll_and_pitch
from ..files.estimator_parameters import VECTORS
from ..files.measuring_parameters import GRAVITY_SOURCES
from ..files.parameter_file import node_parameter
from ..files.yaml_file import YamlFileError, read_yaml
from ..physics import Load
from ..physics.errors import TendonStaticsError


class BaseTurnError(TendonStaticsError, ValueError):
    """It cannot be told how a base is turned; the text is for the user."""


def load_base_turn(
    path: str | Path, estimator: str, given: Mapping[str, Any] | None = None
) -> tuple[float, float] | None:
    """Read how the base is turned from a ROS parameter file: roll and pitch in rad.

    It is None if gravity's direction is not given, or comes from a sensor: then whatever
    publishes the sensor's transform turns the base.

    Parameters
    ----------
    estimator : str
        Full name of the node.
    given : mapping
        Parameters that count in place of the file's.

    Raises
    ------
    BaseTurnError
        If the file cannot be read, or the direction is none; the text names the file.
    """
    found: dict[str, Any] = {}
    try:
        content = read_yaml(Path(path))
        for name in ('gravity_source', 'gravity_direction'):
            found[name] = (given or {}).get(name, node_parameter(content, estimator, name))
        direction = found['gravity_direction']
        if direction is None or found['gravity_source'] not in (None, GRAVITY_SOURCES[0]):
            return None
        (parameter,) = (vector for vector in VECTORS if vector.name == 'gravity_direction')
        parameter.check(direction)
        x, y, z = map(float, direction)
        return roll_and_pitch(Load((x, y, z)).gravity_direction)
    except (YamlFileError, ValueError) as error:  # SettingError and LoadError are such
        raise BaseTurnError(f'{path}: {error}') from None
