"""The service ``~/load_design``: a unit's parameter file, as a whole or not at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter

from ..files.design_file import design_values
from ..files.estimator_parameters import DESIGN, ESTIMATOR_PARAMETERS, LISTS, as_kept
from ..files.known_parameters import check_parameters_of_ros
from ..files.parameter_file import (
    node_parameters,
    parameters_in,
    read_parameters,
)
from ..files.parameter_form import ParameterFileError
from ..files.parameter_kinds import SettingError
from ..physics import DesignError, JointDesign
from .outputs import messages

if TYPE_CHECKING:
    from .estimator import Estimator

LARGEST = 100_000
"""Bytes; the node is not to read for long"""


def load_design(
    node: Estimator, request: messages.LoadDesign.Request, response: messages.LoadDesign.Response
) -> messages.LoadDesign.Response:
    """Set all that a file, or its text, gives the node; refuse all if any of it is not valid."""
    try:
        content = _content(request.file, request.text)
        parameters = as_kept(node_parameters(content, node.get_fully_qualified_name()))
        check_parameters_of_ros(parameters)
        values = _whole(parameters)
    except (ParameterFileError, SettingError, DesignError) as error:
        return messages.refuse(response, f'{request.file or "text"}: {error}')
    before = {name: node.get_parameter(name).value for name in values}
    result = node.changes.set_together(
        Parameter(name, value=value) for name, value in values.items()
    )
    if not result.successful:
        return messages.refuse(response, f'{request.file or "text"}: {result.reason}')
    changes = [
        f'{name} was {before[name]!r} and is {value!r}'
        for name in values
        if (value := node.get_parameter(name).value) != before[name]
    ]
    response.success = True
    response.message = '; '.join(
        [', '.join(changes) or 'nothing in it differs from before', *_left(node, parameters)]
    )
    return response


def _content(file: str, text: str) -> object:
    """Read the one of the two that is given.

    Raises
    ------
    ParameterFileError
        If it is both or none, or cannot be read.
    """
    if bool(file) == bool(text):
        raise ParameterFileError('give one of the two, file or text')
    if len(text) > LARGEST:
        raise ParameterFileError(f'it is longer than {LARGEST} characters')
    if text:
        return parameters_in(text)
    path = Path(file)
    try:
        if path.exists() and not path.is_file():  # a pipe would be waited for
            raise ParameterFileError('it is not a file')
        if path.exists() and path.stat().st_size > LARGEST:
            raise ParameterFileError(f'it is larger than {LARGEST} bytes')
    except (OSError, ValueError) as error:  # a name that is too long, a folder that is closed
        raise ParameterFileError(f'it cannot be read: {error}') from None
    return read_parameters(path)


def _whole(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is to be set: the whole design, how well it is known, and what else may change.

    Raises
    ------
    DesignError
        If there is no design, or not the whole of one.
    """
    given = design_values(parameters)
    if not given:
        raise DesignError('there is no design in it')
    try:
        design = JointDesign.from_mapping(given)
    except DesignError as error:
        raise DesignError(f'{DESIGN if error.key else ""}{error}') from None
    others = {
        parameter.name: parameters[parameter.name]
        for parameter in ESTIMATOR_PARAMETERS
        if parameter.name in parameters and not parameter.is_fixed
    }
    # Without a word on how well this design is known, none on the one before may stay.
    others |= {of.name: list(of.default) for of in LISTS if of.name not in parameters}
    return {DESIGN + name: value for name, value in asdict(design).items()} | others


def _left(node: Estimator, parameters: Mapping[str, Any]) -> list[str]:
    """Say which parameters are fixed while the node runs, and other in the file."""
    fixed = []
    for name in (of.name for of in ESTIMATOR_PARAMETERS if of.is_fixed and of.name in parameters):
        given = node.table.in_its_type(Parameter(name, value=parameters[name]))
        if given.value != node.get_parameter(name).value:
            fixed.append(f'{name} = {parameters[name]!r}')
    return [f'only a new start of the node takes {", ".join(fixed)}'] if fixed else []
