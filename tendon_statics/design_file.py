"""Joint designs in the YAML files that a ROS node takes with ``--params-file``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .installed_files import installed_config
from .physics.design import JointDesign
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
        """SafeLoader that reads 1e-3 as ROS does and refuses a key given twice."""

        def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
            keys = [key.value for key, _ in node.value if key.tag != 'tag:yaml.org,2002:merge']
            for key in keys:
                if keys.count(key) > 1:
                    raise DesignError(f'{key} is given twice, line {node.start_mark.line + 1} on')
            return super().construct_mapping(node, deep)

    # YAML 1.1, PyYAML's, takes a number without a point for text: 1e-3.
    Loader.add_implicit_resolver(
        'tag:yaml.org,2002:float', re.compile(r'^[-+]?\d+[eE][-+]?\d+$'), list('-+0123456789')
    )
    try:
        return yaml.load(path.read_text(encoding='utf-8'), Loader)
    except OSError as error:
        raise DesignError(f'it cannot be read: {error.strerror}') from None
    except UnicodeDecodeError:
        raise DesignError('it is not a text file in UTF-8') from None
    except yaml.YAMLError as error:
        raise DesignError(f'it is not valid YAML: {" ".join(str(error).split())}') from None


def _designs(content: object) -> dict[str, dict[str, object]]:
    """Node name → the design given for it, for every node that has one."""
    found = {}
    for name, parameters in _parameter_blocks(content):
        design = {
            key[len(_PREFIX) :]: value
            for key, value in _flatten(parameters)
            if key.startswith(_PREFIX)
        }
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
