"""Parameter files with some values changed and all else, comments too, as it stands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .output_file import OutputError, output_file
from .parameter_file import fitting_blocks, node_parameters, read_parameters
from .parameter_form import ParameterFileError


def edit_parameters(
    path: Path, output: Path, values: Mapping[str, float], node: str = '', comment: str = ''
) -> None:
    """Write a parameter file with other values of some of an estimator's parameters.

    A value is put in place of that which the node takes; one that is not there stands first in
    the last block that the node takes.

    Parameters
    ----------
    path : Path
        A file that `node_parameters` takes.
    output : Path
        May be the same.
    values : mapping
        By dotted name.
    node : str
        Full name of the estimator; empty: the one that the file names, or any.
    comment : str
        Line for the top of the file, in place of one there with the same first word.

    Raises
    ------
    OutputError
        If the file is written so that it cannot be changed, or the output cannot be written.
    """
    with path.open(encoding='utf-8', newline='') as file:
        text = file.read()
    expected = {**node_parameters(read_parameters(path), node), **values}
    for name, value in values.items():
        text = _with_value(text, node, name, repr(value))
    if comment:
        text = _with_comment(text, comment)
    with output_file(output) as temporary:
        temporary.write_text(text, encoding='utf-8', newline='')
        try:
            written = node_parameters(read_parameters(temporary), node)
        except ParameterFileError:
            written = {}
        if written != expected:
            raise OutputError(
                f'{output}: {path.name} is written so that it cannot be changed; write '
                f'{" and ".join(f"{name}: {value!r}" for name, value in values.items())} there'
            )


def _with_value(text: str, node: str, name: str, value: str) -> str:
    import yaml  # Here, so that the physics can be used where PyYAML is not installed.

    blocks = fitting_blocks([*_blocks(yaml, yaml.compose(text, yaml.SafeLoader))], node)
    there = [of for block in blocks for dotted, of in _flat(yaml, block) if dotted == name]
    if there:
        start, end = there[-1].start_mark.index, there[-1].end_mark.index
        return f'{text[:start]}{" " * (start == end)}{value}{text[end:]}'
    block = [block for block in blocks if block.value][-1]
    first = block.value[0][0].start_mark
    after = ', ' if block.flow_style else '\n' + ' ' * first.column
    return f'{text[: first.index]}{name}: {value}{after}{text[first.index :]}'


def _with_comment(text: str, comment: str) -> str:
    first, *others = text.splitlines(keepends=True)
    kept = ''.join(others) if first.startswith(f'# {comment.split()[0]} ') else text
    return f'# {comment}\n{kept}'


def _blocks(yaml: Any, node: Any, name: str = '') -> Iterator[tuple[str, Any]]:
    """Every block of parameters as a mapping of YAML, as `parameter_blocks` gives its content."""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if key.value == 'ros__parameters':
                yield name, value
            else:
                yield from _blocks(yaml, value, f'{name}/{key.value}'.replace('//', '/'))


def _flat(yaml: Any, node: Any, prefix: str = '') -> Iterator[tuple[str, Any]]:
    """Dotted name and value, as YAML, of every parameter of a block."""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            yield from _flat(yaml, value, f'{prefix}.{key.value}' if prefix else key.value)
    elif prefix:
        yield prefix, node
