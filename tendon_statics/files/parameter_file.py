"""ROS parameter files: which parameters stand under which node name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TypeVar

from .parameter_form import ParameterFileError, check_form, in_line
from .yaml_file import YamlFileError, read_yaml, read_yaml_text

T = TypeVar('T')

ESTIMATOR = 'estimator'
"""Name of the node that computes with a unit, in whatever namespace"""

ESTIMATORS = (ESTIMATOR, 'arm_estimator')
"""Nodes for which a parameter file that is for others alone is refused"""


def read_parameters(path: Path) -> object:
    """Read a parameter file, as strictly as ROS and this package need it to mean one thing.

    Raises
    ------
    ParameterFileError
        If it cannot be read, is not valid YAML, has not the form that ROS takes, or means
        different things to different readers.
    """
    try:
        content = read_yaml(path, aliases=False)
    except YamlFileError as error:
        raise ParameterFileError(str(error)) from None
    check_form(content)
    return content


def parameters_in(text: str) -> object:
    """Read what stands in a parameter file, as `read_parameters` does.

    Raises
    ------
    ParameterFileError
        As there.
    """
    try:
        content = read_yaml_text(text, aliases=False)
    except YamlFileError as error:
        raise ParameterFileError(str(error)) from None
    check_form(content)
    return content


def parameter_blocks(content: object, name: str = '') -> Iterator[tuple[str, object]]:
    """Every ``ros__parameters`` of a file with the node name, namespaces nested or not."""
    if isinstance(content, Mapping):
        for key, value in content.items():
            if key == 'ros__parameters':
                yield name, value
            else:
                yield from parameter_blocks(value, f'{name}/{key}'.replace('//', '/'))


def only_for(content: object) -> str:
    """Say that a node ``/estimator`` takes nothing from a file; empty if it does."""
    plain = f'/{ESTIMATOR}'
    if any(fits(name, plain) for name, _ in parameter_blocks(content)):
        return ''
    return (
        f'it is addressed to {", ".join(_addressed(content))} alone, so a node started as {plain} '
        'would refuse it; /** is for every node'
    )


def _addressed(content: object, name: str = '', place: str = '') -> Iterator[str]:
    """The names that a file has parameters for, with the lines in which they stand."""
    if isinstance(content, Mapping):
        for key, value in content.items():
            if key == 'ros__parameters':
                yield name + place
            else:
                full = f'{name}/{key}'.replace('//', '/')
                yield from _addressed(value, full, in_line(content, key))


def dotted_parameters(block: object) -> dict[str, object]:
    """Parameters of a block by dotted name.

    Raises
    ------
    ParameterFileError
        If one is given twice, as ``design.mass`` and below ``design:``, say.
    """
    found: dict[str, object] = {}
    for name, value in _flatten(block):
        if name in found:
            raise ParameterFileError(f'{name} is given twice')
        found[name] = value
    return found


def node_parameters(content: object, node: str = '') -> dict[str, object]:
    """The parameters that a node takes, by dotted name.

    As in ROS, of several blocks whose names fit the node the last one counts, be it ``/**`` or the
    node's own.

    Parameters
    ----------
    node : str
        Full name with the namespace; empty: the one estimator that the file names, or any.

    Raises
    ------
    ParameterFileError
        If the file is for other nodes only, names several estimators and it is not said which, or
        has a parameter twice in one block.
    """
    found: dict[str, object] = {}
    for block in fitting_blocks([*parameter_blocks(content)], node, [*_addressed(content)]):
        found |= dotted_parameters(block)
    return found


def fitting_blocks(
    blocks: Sequence[tuple[str, T]], node: str = '', addressed: Sequence[str] = ()
) -> list[T]:
    """Of blocks with their node names those that a node takes, in the order of the file.

    Parameters
    ----------
    node : str
        Full name with the namespace; empty: the one estimator that the file names, or any.
    addressed : sequence of str
        How the error is to name the blocks, say with the lines in which they stand.

    Raises
    ------
    ParameterFileError
        As `node_parameters` does.
    """
    node = node or _estimator_in([name for name, _ in blocks])
    fitting = [block for name, block in blocks if fits(name, node)]
    if blocks and not fitting:
        raise ParameterFileError(
            f'it is addressed to {", ".join(addressed or dict(blocks))}, so {node} takes nothing '
            f'from it: write {node} there, or /** for every node'
        )
    return fitting


def node_parameter(content: object, node: str, parameter: str) -> object:
    """The value that a node takes for one parameter; None if the file has none for it.

    Parameters
    ----------
    node : str
        Full name with the namespace.
    parameter : str
        Name without dots.
    """
    found = None
    for name, parameters in parameter_blocks(content):
        if isinstance(parameters, Mapping) and parameter in parameters and fits(name, node):
            found = parameters[parameter]
    return found


def check_parameter_files(
    arguments: Sequence[str], node: str = '', beside: Sequence[str] = ()
) -> None:
    """Check the parameter files of a node, as strictly as their strictest reader does.

    Parameters
    ----------
    arguments : sequence of str
        Of the program, in which files follow ``--params-file``.
    node : str
        Full name of the node. A file that is for other nodes only is refused: the node would
        compute with another unit than is meant. Empty: this is not checked.
    beside : sequence of str
        Full names of other nodes; files that are for one of them are left alone, as a file may
        serve several.

    Raises
    ------
    ParameterFileError
        If one means different things to different readers, or is for other nodes; the text names
        it.
    """
    for option, value in pairwise(arguments):
        if option != '--params-file':
            continue
        try:
            content = read_parameters(Path(value))
            names = [name for name, _ in parameter_blocks(content)]
            is_shared = any(fits(name, other) for name in names for other in beside)
            if node and not is_shared:
                node_parameters(content, node)
        except ParameterFileError as error:
            raise ParameterFileError(f'{value}: {error}') from None


def fits(name: str, node: str) -> bool:
    """Whether a node name with wildcards, ``*`` for one part and ``**`` for any, is a node's."""
    pattern = re.escape(name).replace(r'/\*\*', r'(?:/\w+)*').replace(r'/\*', r'/\w+')
    return re.fullmatch(pattern, node) is not None


def _estimator_in(names: list[str]) -> str:
    """Full name of the one estimator among the names of blocks; ``/estimator`` if there is none.

    Raises
    ------
    ParameterFileError
        If there are several.
    """
    estimators = [name for name in names if name.endswith(f'/{ESTIMATOR}') and '*' not in name]
    several = list(dict.fromkeys(estimators))
    if len(several) > 1:
        raise ParameterFileError(
            f'it has parameters for each of {", ".join(several)}; say which with --node'
        )
    return several[0] if several else f'/{ESTIMATOR}'


def _flatten(parameters: object, prefix: str = '') -> Iterator[tuple[str, object]]:
    """Dotted name and value of every parameter of a block."""
    if isinstance(parameters, Mapping):
        for key, value in parameters.items():
            yield from _flatten(value, f'{prefix}.{key}' if prefix else str(key))
    elif prefix:
        yield prefix, parameters
