"""Joint designs in the YAML files that a ROS node takes with ``--params-file``."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..physics.design import JointDesign, design_fields
from ..physics.design_uncertainty import DesignUncertainty, check_flat, check_names
from ..physics.errors import DesignError
from .installed_files import installed_config
from .output_file import output_file
from .parameter_file import (
    dotted_parameters,
    node_parameters,
    parameter_blocks,
    read_parameters,
)
from .parameter_form import ParameterFileError

_PREFIX = 'design.'
UNCERTAINTY = 'design_uncertainty.'
"""What the names of the parameters begin with that say how well the design is known"""

_UNCERTAIN = f'{UNCERTAINTY}parameters'
_COVARIANCE = f'{UNCERTAINTY}covariance'


def load_design(path: str | Path) -> JointDesign:
    """Read a joint design from a ROS parameter file.

    The design stands under ``ros__parameters: design:`` of one node name or of ``/**``; what else
    the file holds, say parameters of other nodes, is left alone.

    Raises
    ------
    DesignError
        If the file cannot be read, holds no design or more than one, or the design is not valid;
        the text names the file, the key, the value and what is allowed.
    """
    path = Path(path)
    try:
        designs = _designs(read_parameters(path))
        if not designs:
            raise DesignError(
                'there is no design in it; it stands under "/**: ros__parameters: design:"'
            )
        if len(designs) > 1:
            raise DesignError(f'it has a design under each of {", ".join(designs)}; keep one')
        return JointDesign.from_mapping(next(iter(designs.values())))
    except ParameterFileError as error:
        raise DesignError(f'{path}: {error}') from None
    except DesignError as error:
        key = _PREFIX + error.key if error.key else ''
        raise DesignError(f'{path}: {"design." if error.key else ""}{error}', key=key) from None


def load_design_uncertainty(path: str | Path, node: str = '') -> DesignUncertainty | None:
    """Read how well a design is known from a ROS parameter file; None if that does not say it.

    It stands in ``design_uncertainty.parameters``, names, and ``design_uncertainty.covariance``,
    numbers in SI row by row, as `save_design` writes them.

    Parameters
    ----------
    node : str
        Full name of the estimator; empty: the one that the file names, or any.

    Raises
    ------
    DesignError
        If the file cannot be read, or what it says is no covariance of design parameters.
    """
    path = Path(path)
    try:
        return uncertainty_in(node_parameters(read_parameters(path), node))
    except ParameterFileError as error:
        raise DesignError(f'{path}: {error}') from None
    except DesignError as error:
        raise DesignError(f'{path}: {error}', key=error.key) from None


def uncertainty_in(parameters: Mapping[str, object]) -> DesignUncertainty | None:
    """Return what parameters by dotted name say of how well the design is known.

    Raises
    ------
    DesignError
        If it is no covariance of design parameters.
    DesignMisfitError
        If each of the two is right by itself, and there are not as many numbers as names need.
    """
    names, covariance = parameters.get(_UNCERTAIN), parameters.get(_COVARIANCE)
    if names in (None, []) and covariance in (None, []):
        return None
    for key, values in ((_UNCERTAIN, names), (_COVARIANCE, covariance)):
        if not isinstance(values, (list, tuple)):
            raise DesignError(f'{key} is {values!r}, a list is needed', key=key)
    with _named():
        return DesignUncertainty.of_flat(names, covariance)  # type: ignore[arg-type]


def check_uncertainty(parameters: Mapping[str, Any]) -> None:
    """Check what is given of how well the design is known, names and numbers each by itself.

    Raises
    ------
    DesignError
        If one is not a design parameter, or the numbers are no covariance.
    """
    with _named():
        check_names(list(parameters.get(_UNCERTAIN) or ()))
        check_flat(list(parameters.get(_COVARIANCE) or ()))


@contextmanager
def _named() -> Iterator[None]:
    """Say what of a parameter file is at fault where a `DesignUncertainty` is."""
    try:
        yield
    except DesignError as error:
        key = UNCERTAINTY + error.key
        raise type(error)(f'{UNCERTAINTY}{error}', key=key) from None


def save_design(
    path: str | Path,
    design: JointDesign,
    comment: str = '',
    parameters: Mapping[str, object] | None = None,
    uncertainty: DesignUncertainty | None = None,
) -> None:
    """Write a design to a ROS parameter file that `load_design` and the node take.

    The numbers are written with all their digits.

    Parameters
    ----------
    comment : str
        Text at the beginning of the file.
    parameters : mapping
        What else the node is to take from it, by dotted name: numbers, texts, lists of these.
    uncertainty : DesignUncertainty, optional
        How well the design is known, in place of what `parameters` say of that.

    Raises
    ------
    OutputError
        If the file cannot be written; what was there then stays.
    """
    lines = [f'# {line}'.rstrip() for line in comment.splitlines()]
    lines += ['/**:', '  ros__parameters:']
    others = dict(parameters or {})
    if uncertainty is not None:
        others[_UNCERTAIN] = list(uncertainty.parameters)
        others[_COVARIANCE] = uncertainty.flat
    lines += [
        f'    {name}: {_yaml(value)}'
        for name, value in others.items()
        if not name.startswith(_PREFIX)
    ]
    lines.append('    design:')
    for field in design_fields():
        value = getattr(design, field.name)
        entry = f'{field.name}: {value if isinstance(value, str) else repr(value)}'
        meaning = f'{field.symbol}, {field.description}' if field.symbol else field.description
        unit = field.unit or ('1' if field.symbol else field.allowed)
        lines.append(f'      {entry:<44}  # [{unit}] {meaning}')
    with output_file(Path(path)) as temporary:
        temporary.write_text('\n'.join(lines) + '\n', encoding='utf-8')


def default_design_path() -> Path:
    """The installed ``preliminary_design.yaml``.

    Raises
    ------
    FileNotFoundError
        If the package was copied without its data files.
    """
    return installed_config('preliminary_design.yaml')


def _yaml(value: object) -> str:
    """Write a parameter's value in one line as ROS reads it: as JSON, but for what that lacks."""
    import json  # Here, for who only solves should not wait for it.

    if isinstance(value, list):
        return f'[{", ".join(map(_yaml, value))}]'
    if isinstance(value, float) and not math.isfinite(value):
        return '.nan' if math.isnan(value) else f'{"-" * (value < 0.0)}.inf'
    return json.dumps(value, ensure_ascii=False)


def _designs(content: object) -> dict[str, dict[str, object]]:
    """Node name → the design given for it, for every node that has one."""
    found = {}
    for name, block in parameter_blocks(content):
        design = design_values(dotted_parameters(block))
        if design:
            found[name] = design
    return found


def design_values(parameters: Mapping[str, object]) -> dict[str, object]:
    """Those parameters that are of the design, by their names in it."""
    return {
        name.removeprefix(_PREFIX): value
        for name, value in parameters.items()
        if name.startswith(_PREFIX)
    }
