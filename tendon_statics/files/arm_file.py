"""Arms in one YAML file."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from ..physics.arm import Arm, ArmUnit, Cable
from ..physics.design import JointDesign
from ..physics.design_uncertainty import DesignUncertainty
from ..physics.errors import ArmError, DesignError
from .design_file import load_design, load_design_uncertainty
from .yaml_file import YamlFileError, read_yaml

Part = TypeVar('Part')

_ARM_KEYS = ('units', 'cables', 'cable_friction_coefficient')
_UNIT_KEYS = ('design_file', 'design', 'length')
_CABLE_KEYS = tuple(field.name for field in dataclasses.fields(Cable))


def load_arm(path: str | Path) -> Arm:
    """Read an arm from a YAML file.

    Its keys are ``units``, a list from the base to the tip, of mappings with ``length`` in m and
    either ``design_file``, a parameter file as `load_design` takes it, or ``design``, a mapping of
    design parameters; ``cables``, a list of mappings with ``name``, ``side`` (``l`` or ``s``),
    ``last_unit``, counted from 1 at the base, and as the case may be ``offset`` in m; and
    ``cable_friction_coefficient``, without which the cables have no friction. Relative paths start
    from the file's own folder. SI units, angles in radians.

    Raises
    ------
    ArmError
        If the file cannot be read, a key is unknown, missing or given twice, or a value is not
        allowed; the text names the file, the place, the value and what is allowed.
    """
    path = Path(path)
    try:
        content = _mapping(read_yaml(path), 'the file', _ARM_KEYS, needed=('units', 'cables'))
        designs: dict[Path, JointDesign] = {}

        def unit(values: Mapping[str, Any]) -> ArmUnit:
            return ArmUnit(_design(values, path.parent, designs), values['length'])

        units = _each(content, 'units', _UNIT_KEYS, ('length',), unit)
        needed = ('name', 'side', 'last_unit')
        cables = _each(content, 'cables', _CABLE_KEYS, needed, lambda values: Cable(**values))
        return Arm(tuple(units), tuple(cables), content.get('cable_friction_coefficient', 0.0))
    except (ArmError, DesignError, YamlFileError) as error:
        raise ArmError(f'{path}: {error}', key=getattr(error, 'key', '')) from None


def load_arm_uncertainties(path: str | Path) -> tuple[DesignUncertainty | None, ...]:
    """Read how well each unit's design is known, from the base on, from the files of an arm.

    A file of a design says it as `load_design_uncertainty` takes it; None of one that does not,
    and of a design that stands in the arm's own file.

    Raises
    ------
    ArmError
        If a file cannot be read, or what it says is no covariance of design parameters.
    """
    path = Path(path)
    try:
        units = read_yaml(path)['units']  # type: ignore[index]
        known = {name: load_design_uncertainty(name) for name in design_files_of(path)}
    except (DesignError, YamlFileError) as error:
        raise ArmError(f'{path}: {error}', key=getattr(error, 'key', '')) from None
    return tuple(
        known[path.parent / unit['design_file']] if 'design_file' in unit else None
        for unit in units
    )


def is_arm_file(path: str | Path) -> bool:
    """Whether a YAML file is meant to be an arm, by its keys; False too if it cannot be read."""
    try:
        content = read_yaml(Path(path))
    except YamlFileError:
        return False
    return isinstance(content, Mapping) and 'units' in content


def design_files_of(path: str | Path) -> list[Path]:
    """Return the files of designs that an arm's file names, each once, in its order."""
    path = Path(path)
    units = read_yaml(path)['units']  # type: ignore[index]
    named = (unit['design_file'] for unit in units if 'design_file' in unit)
    return [path.parent / name for name in dict.fromkeys(named)]


def _design(
    values: Mapping[str, Any], folder: Path, designs: dict[Path, JointDesign]
) -> JointDesign:
    """Return a unit's design, each file being read once."""
    if ('design' in values) == ('design_file' in values):
        raise ArmError('one of design_file and design is needed', key='design_file')
    if 'design' in values:
        inline = values['design']
        if not isinstance(inline, Mapping):
            raise ArmError(
                f'design is {inline!r}, but a mapping of design parameters is needed; '
                'a file is named by design_file',
                key='design',
            )
        try:
            return JointDesign.from_mapping(inline)
        except DesignError as error:
            key = f'design.{error.key}' if error.key else 'design'
            raise ArmError(f'design.{error}' if error.key else str(error), key=key) from None
    name = values['design_file']
    if not isinstance(name, str) or not name:
        raise ArmError(f'design_file is {name!r}, the name of a file is needed', key='design_file')
    file = folder / name
    if file not in designs:
        designs[file] = load_design(file)
    return designs[file]


def _each(
    content: Mapping[str, Any],
    name: str,
    keys: tuple[str, ...],
    needed: tuple[str, ...],
    make: Callable[[Mapping[str, Any]], Part],
) -> list[Part]:
    """Make something of every entry of a list."""
    entries = content[name]
    if not isinstance(entries, list):
        raise ArmError(f'{name} is {entries!r}, but a list is needed', key=name)
    found = []
    for number, entry in enumerate(entries, start=1):
        place = f'{name}[{number}]'
        try:
            found.append(make(_mapping(entry, place, keys, needed)))
        except (ArmError, DesignError) as error:
            text = str(error) if str(error).startswith(place) else f'{place}: {error}'
            key = f'{place}.{error.key}' if error.key else place
            raise ArmError(text, key=key) from None
    return found


def _mapping(
    value: object, what: str, keys: tuple[str, ...], needed: tuple[str, ...]
) -> Mapping[str, Any]:
    """Return a value that is a mapping with some keys and no others."""
    there = ', '.join(keys)
    if not isinstance(value, Mapping):
        raise ArmError(f'{what} is {value!r}, but a mapping is needed; its keys are {there}')
    for key, given in value.items():
        if key not in keys:
            raise ArmError(
                f'{key} is {given!r}, but there is no such key; there are {there}', key=str(key)
            )
    for key in needed:
        if key not in value:
            raise ArmError(f'{key} is missing', key=key)
    return value
