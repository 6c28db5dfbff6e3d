"""YAML as ROS reads it, with errors for people."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from ..physics.errors import TendonStaticsError

if TYPE_CHECKING:
    from yaml import MarkedYAMLError


class YamlFileError(TendonStaticsError, ValueError):
    """A file is not valid YAML."""


class LinedMapping(dict[Any, Any]):
    """A mapping that knows in which lines of the file its keys stand."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: dict[Any, int] = {}


def read_yaml(path: Path, *, aliases: bool = True) -> object:
    """Read a YAML file; whole numbers become integers, all others floats.

    Parameters
    ----------
    aliases : bool
        Whether one part may stand for another, which ROS does not read in parameter files.

    Raises
    ------
    YamlFileError
        If the file cannot be read, is not valid YAML, has a key twice, or a number that readers of
        YAML differ in; the text does not name the file.
    """
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise YamlFileError(f'it cannot be read: {error.strerror}') from None
    except UnicodeDecodeError:
        raise YamlFileError('it is not a text file in UTF-8') from None
    return read_yaml_text(text, aliases=aliases)


def read_yaml_text(text: str, *, aliases: bool = True) -> object:
    """Read what stands in a YAML file, as `read_yaml` does.

    Raises
    ------
    YamlFileError
        As there.
    """
    import yaml  # Here, so that the physics can be used where PyYAML is not installed.

    try:
        return yaml.load(text, _loader(aliases))
    except YamlFileError:
        raise
    except yaml.MarkedYAMLError as error:
        line = _line_of(error, text)
        place = f' in line {line}' if line else ''
        raise YamlFileError(f'it is not valid YAML{place}: {error.problem}') from None
    except Exception as error:
        # PyYAML lets through whatever its constructors raise at odd content.
        raise YamlFileError(f'it is not valid YAML: {" ".join(str(error).split())}') from None


@cache
def _loader(aliases: bool) -> Any:
    """Return the class that reads; with aliases, or refusing them."""
    import yaml

    class Loader(yaml.SafeLoader):
        """SafeLoader that reads numbers as ROS does and refuses a key given twice."""

        yaml_implicit_resolvers: ClassVar = {
            first: [(tag, pattern) for tag, pattern in resolvers if tag not in _YAML_1_1_TAGS]
            for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
        }

        def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
            seen = set()
            for key, _ in node.value:
                if key.value in seen:
                    line = key.start_mark.line + 1
                    raise YamlFileError(f'{key.value} is given a second time in line {line}')
                if isinstance(key, yaml.ScalarNode):
                    seen.add(key.value)
            return super().construct_mapping(node, deep)

        def construct_map(self, node: yaml.MappingNode) -> Iterator[LinedMapping]:
            mapping = LinedMapping()
            yield mapping
            mapping.update(self.construct_mapping(node))
            mapping.lines = {key.value: key.start_mark.line + 1 for key, _ in node.value}

        def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
            if not aliases and self.check_event(yaml.AliasEvent):
                event = self.peek_event()
                raise YamlFileError(
                    f'*{event.anchor} in line {event.start_mark.line + 1} stands for another part '
                    'of the file, which ROS does not read; write that part out'
                )
            return super().compose_node(parent, index)

        def refuse_number(self, node: yaml.ScalarNode) -> None:
            text = self.construct_scalar(node)
            raise YamlFileError(
                f'{text} in line {node.start_mark.line + 1} is another number to ROS, '
                f'{_as_ros_reads(text)}, than to most readers; write decimal digits without a 0 '
                'before them'
            )

        def construct_number(self, node: yaml.ScalarNode) -> float:
            text = self.construct_scalar(node).lower()
            number = float(text.replace('.inf', 'inf').replace('.nan', 'nan'))
            is_integer = text.lstrip('+-').isdigit() and abs(number) < _TOO_LARGE_FOR_AN_INTEGER
            return int(text) if is_integer else number

    Loader.add_constructor('tag:yaml.org,2002:map', Loader.construct_map)
    # launch_ros writes every list of parameters so, and ROS passes over the tag.
    Loader.add_constructor('tag:yaml.org,2002:python/tuple', Loader.construct_yaml_seq)
    Loader.add_implicit_resolver(_NUMBER_TAG, _NUMBER, list('-+.0123456789'))
    Loader.add_constructor(_NUMBER_TAG, Loader.construct_number)
    # Before all others: the first that fits counts.
    for first in '-+0':
        Loader.yaml_implicit_resolvers[first] = [
            (_AMBIGUOUS_TAG, _AMBIGUOUS),
            *Loader.yaml_implicit_resolvers.get(first, ()),
        ]
    Loader.add_constructor(_AMBIGUOUS_TAG, Loader.refuse_number)
    return Loader


def _line_of(error: MarkedYAMLError, text: str) -> int | None:
    """Return the line to look at, counted from 1.

    What has no colon, or no end, PyYAML notices in a later line than it stands in.
    """
    is_late = error.context == 'while scanning a simple key' or _AT_END.search(error.problem or '')
    marks = (error.problem_mark, error.context_mark)
    mark = next(filter(None, reversed(marks) if is_late else marks), None)
    return min(mark.line, text.rstrip().count('\n')) + 1 if mark else None


_AT_END = re.compile('stream end|end of stream')

_TOO_LARGE_FOR_AN_INTEGER = 2.0**63  # of ROS

# PyYAML's numbers and times are those of YAML 1.1: 1e-3 is text, 1_0 is 10, 1:30 is 90, 010 is 8.
_YAML_1_1_TAGS = {f'tag:yaml.org,2002:{name}' for name in ('float', 'int', 'timestamp')}
_NUMBER_TAG = 'tag:yaml.org,2002:float'
_NUMBER = re.compile(
    r'^[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?$|^[-+]?\.(?:inf|Inf|INF)$'
    r'|^\.(?:nan|NaN|NAN)$'
)

_AMBIGUOUS_TAG = 'tag:yaml.org,2002:int'
_AMBIGUOUS = re.compile(r'^[-+]?0(?:[0-9]+|[xX][0-9a-fA-F]+)$')


def _as_ros_reads(text: str) -> str:
    """What C's strtoll makes of an integer, with the base told by its first digits."""
    sign, digits = ('-' if text.startswith('-') else ''), text.lstrip('+-')
    base = 16 if digits[1:2] in ('x', 'X') else 8 if digits[:1] == '0' else 10
    try:
        return f'{sign}{int(digits, base)}'
    except ValueError:
        return f'{sign}{float(digits):.17g}'
