"""What a unit's parameter file says beside its design: how its cables are measured."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from ..physics.admissible import check_bend_angle
from ..physics.design import JointDesign
from ..physics.design_uncertainty import DesignUncertainty
from ..physics.errors import BendAngleError, DesignError
from ..tensions.cable_scale import CableScale
from .design_file import design_values, uncertainty_in
from .number_parameter import SettingError
from .parameter_file import ParameterFileError, node_parameters, read_parameters
from .unit_parameters import (
    CABLES,
    ESTIMATIONS,
    NUMBERS,
    TENSION_SOURCES,
    WRENCH_COMPONENTS,
)

CHOICES = {
    'tension_source': TENSION_SOURCES,
    'wrench_component': WRENCH_COMPONENTS,
    'estimation': ESTIMATIONS,
}


@dataclasses.dataclass(frozen=True)
class Unit:
    """A unit's design, and how its tensions are measured, as the estimator takes it."""

    design: JointDesign
    cable_l: CableScale
    cable_s: CableScale
    parameters: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    """All that the file gives the estimator, by dotted name, as it stands there"""
    uncertainty: DesignUncertainty | None = None
    """How well the design is known, if the file says it"""

    def get(self, name: str) -> Any:
        """Return what the file sets a parameter to; None if it does not."""
        return self.parameters.get(name)

    @property
    def misspelt(self) -> list[str]:
        """What of the parameters looks like one that is meant otherwise, a sentence each."""
        known = [*CHOICES, 'cable_names', *(number.name for number in NUMBERS)]
        found = []
        for name in self.parameters:
            if name in known or name.startswith(('design.', 'qos_overrides.')):
                continue
            close = get_close_matches(name, known, 1, cutoff=0.85)
            if close:
                found.append(f'{name} is no parameter of the estimator; is {close[0]} meant?')
        return found


def load_unit(path: str | Path, node: str = '') -> Unit:
    """Read a unit from a ROS parameter file: what the estimator takes from the same file.

    Parameters
    ----------
    node : str
        Full name of the estimator; empty: the one that the file names, or any.

    Raises
    ------
    DesignError
        If the file cannot be read, is not for that node, holds no design, or a value is not
        allowed; the text names the file, the key, the value and what is allowed.
    """
    path = Path(path)
    try:
        parameters = node_parameters(read_parameters(path), node)
        design = design_values(parameters)
        if not design:
            raise DesignError(
                'there is no design in it; it stands under "/**: ros__parameters: design:"'
            )
        made = JointDesign.from_mapping(design)
    except ParameterFileError as error:
        raise DesignError(f'{path}: {error}') from None
    except DesignError as error:
        key = f'design.{error.key}' if error.key else ''
        raise DesignError(f'{path}: {"design." if error.key else ""}{error}', key=key) from None
    try:
        return _unit(made, parameters)
    except (SettingError, DesignError) as error:
        raise DesignError(f'{path}: {error}', key=getattr(error, 'key', '')) from None


def _unit(design: JointDesign, parameters: dict[str, object]) -> Unit:
    """Check the parameters as the estimator does.

    Raises
    ------
    SettingError
        If one is not allowed.
    DesignError
        If what they say of how well the design is known is no covariance.
    """
    for number in NUMBERS:
        if number.name in parameters:
            number.check(parameters[number.name])
    for name, choices in CHOICES.items():
        if name in parameters and parameters[name] not in choices:
            raise SettingError(
                f'{name} is {parameters[name]!r}, allowed is {" or ".join(choices)}'
            )
    if 'cable_names' in parameters:
        check_cable_names(parameters['cable_names'])
    initial: Any = parameters.get('initial_bend_angle', 0.0)
    try:
        check_bend_angle(design, initial)
    except BendAngleError as error:
        raise SettingError(f'initial_{error}') from None
    cable_l, cable_s = (cable_scale(cable, parameters) for cable in CABLES)
    return Unit(design, cable_l, cable_s, parameters, uncertainty_in(parameters))


def cable_scale(cable: str, parameters: Mapping[str, Any]) -> CableScale:
    """Make a cable's scale of the parameters by name; what is not given has its default.

    Raises
    ------
    SettingError
        If its gain is 0.
    """
    given = {
        field: float(parameters[f'{cable}.{field}'])
        for field in CableScale._fields
        if f'{cable}.{field}' in parameters
    }
    scale = CableScale(**given)
    if scale.gain == 0.0:
        raise SettingError(
            f'{cable}.gain is 0.0, with which the tension does not follow what is measured'
        )
    return scale


def check_cable_names(value: Any) -> tuple[str, str]:
    """Return the names of cables l and s, or raise a `SettingError` unless they are two."""
    names = list(value) if isinstance(value, (list, tuple)) else value
    if not (
        isinstance(names, list)
        and len(names) == 2
        and all(isinstance(name, str) and name for name in names)
        and names[0] != names[1]
    ):
        raise SettingError(
            f'cable_names is {names!r}, two different names are needed, of cables l and s'
        )
    return names[0], names[1]
