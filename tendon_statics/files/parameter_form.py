"""The form of a ROS parameter file: what rcl would refuse, said with the line and what to do."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ..physics.errors import TendonStaticsError

PARAMETERS = 'ros__parameters'

_NODE_NAME = re.compile(r'/?(?:\w+|\*{1,2})(?:/(?:\w+|\*{1,2}))*/?', re.ASCII)

_HOW = f'parameters stand under the name of a node and {PARAMETERS}, say "/**: {PARAMETERS}:"'


class ParameterFileError(TendonStaticsError, ValueError):
    """A file that is no parameter file, or none for the node; the text does not name it."""


def check_form(content: object) -> None:
    """Check what was read of a parameter file; one that is empty has nothing against it.

    Raises
    ------
    ParameterFileError
        If it is not names of nodes with their parameters, or ROS takes no such values.
    """
    if content is None:
        return
    if not isinstance(content, Mapping):
        raise ParameterFileError(f'it is no parameter file: {_HOW}')
    for key, value in content.items():
        if key == PARAMETERS:
            raise ParameterFileError(f'{PARAMETERS}{in_line(content, key)} has no node: {_HOW}')
        _check_node(content, str(key), value)


def in_line(content: object, key: object) -> str:
    """Say in which line a key of a mapping stands, as far as that is known."""
    line = getattr(content, 'lines', {}).get(key)
    return f' in line {line}' if line else ''


def _check_node(content: Mapping[object, object], key: str, value: object) -> None:
    place = in_line(content, key)
    if not isinstance(value, Mapping):
        raise ParameterFileError(f'{key}{place} is not below {PARAMETERS}: {_HOW}')
    if not _NODE_NAME.fullmatch(key):
        raise ParameterFileError(
            f'{key}{place} is no name of a node, which has letters, digits and _, with / between '
            'namespaces'
        )
    for inner, of_inner in value.items():
        if inner != PARAMETERS:
            _check_node(value, str(inner), of_inner)
        elif isinstance(of_inner, Mapping):
            for fault in _faults(of_inner):
                raise ParameterFileError(fault)
        else:
            raise ParameterFileError(
                f'{PARAMETERS}{in_line(value, inner)} has no parameters below it, as name: value'
            )


PLAIN = {bool, int, float, str}
"""What a parameter may be, or a list of one of them"""


def _faults(parameters: Mapping[object, object]) -> Iterator[str]:
    """Say which values ROS does not take."""
    for key, value in parameters.items():
        place = in_line(parameters, key)
        if isinstance(value, Mapping):
            yield from _faults(value)
        elif value is None:
            yield f'{key}{place} has no value; give it one or take the line out'
        elif isinstance(value, list):
            kinds = {type(item) for item in value}
            if kinds == {int, float}:
                yield (
                    f'{key}{place} has whole and other numbers, which ROS does not mix: write '
                    f'{[float(item) for item in value]}'
                )
            elif len(kinds) > 1 or not kinds <= PLAIN:
                yield f'{key}{place} is {value!r}, but ROS takes lists of one kind of values only'
        elif type(value) not in PLAIN:
            yield (
                f'{key}{place} is {value!r}, but ROS takes numbers, texts, true and false, and '
                'lists of one of these'
            )
