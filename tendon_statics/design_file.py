"""Joint designs in the YAML files that a ROS node takes with ``--params-file``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar

from .installed_files import installed_config
from .output_file import output_file
from .physics.design import JointDesign, design_parameters
from .physics.errors import DesignError

_PREFIX = 'design.'


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
        designs = _designs(_read_yaml(path))
        if not designs:
            raise DesignError(
                'there is no design in it; it stands under "/**: ros__parameters: design:"'
            )
        if len(designs) > 1:
            raise DesignError(f'it has a design under each of {", ".join(designs)}; keep one')
        return JointDesign.from_mapping(next(iter(designs.values())))
    except DesignError as error:
        key = _PREFIX + error.key if error.key else ''
        raise DesignError(f'{path}: {"design." if error.key else ""}{error}', key=key) from None


def save_design(path: str | Path, design: JointDesign, comment: str = '') -> None:
    """Write a design to a ROS parameter file that `load_design` and the node take.

    The numbers are written with all their digits.

    Parameters
    ----------
    comment : str
        Text at the beginning of the file.

    Raises
    ------
    OutputError
        If the file cannot be written; what was there then stays.
    """
    lines = [f'# {line}'.rstrip() for line in comment.splitlines()]
    lines += ['/**:', '  ros__parameters:', '    design:']
    for parameter in design_parameters():
        entry = f'{parameter.name}: {getattr(design, parameter.name)!r}'
        unit = parameter.unit or '1'
        lines.append(f'      {entry:<44}  # [{unit}] {parameter.symbol}, {parameter.description}')
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


def _read_yaml(path: Path) -> object:
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
                    raise DesignError(f'{key.value} is given a second time in line {line}')
                if isinstance(key, yaml.ScalarNode):
                    seen.add(key.value)
            return super().construct_mapping(node, deep)

        def construct_number(self, node: yaml.ScalarNode) -> float:
            text = self.construct_scalar(node).lower()
            return float(text.replace('.inf', 'inf').replace('.nan', 'nan'))

    Loader.add_implicit_resolver(_NUMBER_TAG, _NUMBER, list('-+.0123456789'))
    Loader.add_constructor(_NUMBER_TAG, Loader.construct_number)
    try:
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise DesignError(f'it cannot be read: {error.strerror}') from None
    except UnicodeDecodeError:
        raise DesignError('it is not a text file in UTF-8') from None
    try:
        return yaml.load(text, Loader)
    except DesignError:
        raise
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f' in line {mark.line + 1}' if mark else ''
        raise DesignError(f'it is not valid YAML{place}: {error.problem}') from None
    except Exception as error:
        # PyYAML lets through whatever its constructors raise at odd content.
        raise DesignError(f'it is not valid YAML: {" ".join(str(error).split())}') from None


# PyYAML's numbers and times are those of YAML 1.1: 1e-3 is text, 1_0 is 10, 1:30 is 90, 010 is 8.
_YAML_1_1_TAGS = {f'tag:yaml.org,2002:{name}' for name in ('float', 'int', 'timestamp')}
_NUMBER_TAG = 'tag:yaml.org,2002:float'
_NUMBER = re.compile(
    r'^[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?$|^[-+]?\.(?:inf|Inf|INF)$'
    r'|^\.(?:nan|NaN|NAN)$'
)


def _designs(content: object) -> dict[str, dict[str, object]]:
    """Node name → the design given for it, for every node that has one."""
    found = {}
    for name, parameters in _parameter_blocks(content):
        design: dict[str, object] = {}
        for key, value in _flatten(parameters):
            name_in_design = key.removeprefix(_PREFIX)
            if name_in_design in design:
                raise DesignError(f'{key} is given twice')
            if key.startswith(_PREFIX):
                design[name_in_design] = value
        if design:
            found[name] = design
    return found


def _parameter_blocks(content: object, name: str = '') -> Iterator[tuple[str, object]]:
    """Every ``ros__parameters`` of a file with the node name, namespaces nested or not."""
    if isinstance(content, Mapping):
        for key, value in content.items():
            if key == 'ros__parameters':
                yield name, value
            else:
                yield from _parameter_blocks(value, f'{name}/{key}'.replace('//', '/'))


def _flatten(parameters: object, prefix: str = '') -> Iterator[tuple[str, object]]:
    """Dotted name and value of every parameter of a block."""
    if isinstance(parameters, Mapping):
        for key, value in parameters.items():
            yield from _flatten(value, f'{prefix}.{key}' if prefix else str(key))
    else:
        yield prefix, parameters
