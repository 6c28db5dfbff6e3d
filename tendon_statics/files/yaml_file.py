"""YAML as ROS reads it, with errors for people."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, ClassVar


class YamlFileError(ValueError):
    """A file is not valid YAML."""


def read_yaml(path: Path) -> object:
    """Read a YAML file; whole numbers become integers, all others floats.

    Raises
    ------
    YamlFileError
        If the file cannot be read or is not valid YAML; the text does not name the file.
    """
    import yaml  # Here, so that the physics can be used where PyYAML is not installed.

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

        def construct_number(self, node: yaml.ScalarNode) -> float:
            text = self.construct_scalar(node).lower()
            number = float(text.replace('.inf', 'inf').replace('.nan', 'nan'))
            is_integer = text.lstrip('+-').isdigit() and abs(number) < _TOO_LARGE_FOR_AN_INTEGER
            return int(text) if is_integer else number

    Loader.add_implicit_resolver(_NUMBER_TAG, _NUMBER, list('-+.0123456789'))
    Loader.add_constructor(_NUMBER_TAG, Loader.construct_number)
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise YamlFileError(f'it cannot be read: {error.strerror}') from None
    except UnicodeDecodeError:
        raise YamlFileError('it is not a text file in UTF-8') from None
    try:
        return yaml.load(text, Loader)
    except YamlFileError:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f' in line {mark.line + 1}' if mark else ''
        raise YamlFileError(f'it is not valid YAML{place}: {error.problem}') from None
    except Exception as error:
        # PyYAML lets through whatever its constructors raise at odd content.
        raise YamlFileError(f'it is not valid YAML: {" ".join(str(error).split())}') from None


_TOO_LARGE_FOR_AN_INTEGER = 2.0**63  # of ROS

# PyYAML's numbers and times are those of YAML 1.1: 1e-3 is text, 1_0 is 10, 1:30 is 90, 010 is 8.
_YAML_1_1_TAGS = {f'tag:yaml.org,2002:{name}' for name in ('float', 'int', 'timestamp')}
_NUMBER_TAG = 'tag:yaml.org,2002:float'
_NUMBER = re.compile(
    r'^[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?$|^[-+]?\.(?:inf|Inf|INF)$'
    r'|^\.(?:nan|NaN|NAN)$'
)
