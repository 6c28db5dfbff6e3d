"""ROS parameter files: which parameters stand under which node name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping


def parameter_blocks(content: object, name: str = '') -> Iterator[tuple[str, object]]:
    """Every ``ros__parameters`` of a file with the node name, namespaces nested or not."""
    if isinstance(content, Mapping):
        for key, value in content.items():
            if key == 'ros__parameters':
                yield name, value
            else:
                yield from parameter_blocks(value, f'{name}/{key}'.replace('//', '/'))


def node_parameter(content: object, node: str, parameter: str) -> object:
    """The value that a node takes for one parameter; None if the file has none for it.

    As in ROS, of all blocks whose name fits the node the last counts, be it ``/**`` or the node's
    own.

    Parameters
    ----------
    node : str
        Full name with the namespace.
    parameter : str
        Name without dots.
    """
    found = None
    for name, parameters in parameter_blocks(content):
        if isinstance(parameters, Mapping) and parameter in parameters and _fits(name, node):
            found = parameters[parameter]
    return found


def _fits(name: str, node: str) -> bool:
    """Whether a node name with wildcards, ``*`` for one part and ``**`` for any, is a node's."""
    pattern = re.escape(name).replace(r'/\*\*', r'(?:/\w+)*').replace(r'/\*', r'/\w+')
    return re.fullmatch(pattern, node) is not None
