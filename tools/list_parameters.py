"""Print the parameters of the estimator but for the design's, for docs/node_reference.md."""

from __future__ import annotations

import json

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.estimator_parameters import ESTIMATOR_PARAMETERS
from tendon_statics.files.parameter_kinds import Parameter, VectorParameter


def main() -> None:
    """Print the table."""
    print(table(ESTIMATOR_PARAMETERS))


def table(parameters: tuple[Parameter, ...], *, says_fixed: bool = True) -> str:
    """Name, default, what is allowed and meaning of parameters."""
    rows = [
        (
            f'`{parameter.name}`',
            kind_of(parameter.default),
            f'`{json.dumps(parameter.default)}`',
            # Of a number it ends with the unit.
            parameter.allowed
            + (
                f', {parameter.unit}'
                if isinstance(parameter, VectorParameter) and parameter.unit
                else ''
            ),
            parameter.description
            + ('; fixed at the start' if parameter.is_fixed and says_fixed else ''),
        )
        for parameter in parameters
    ]
    return markdown_table(('parameter', 'type', 'default', 'allowed', 'meaning'), rows)


def allowed(parameter: Parameter) -> str:
    """Say what a parameter may be, with its unit; what is allowed of a number ends with it."""
    unit = parameter.unit if isinstance(parameter, VectorParameter) else ''
    return f'{parameter.allowed}, {unit}' if unit else parameter.allowed


def kind_of(default: object) -> str:
    """Return the type as ROS calls it, say ``double`` or ``string[]``."""
    if isinstance(default, tuple):
        return kind_of(default[0]) + '[]'
    return {bool: 'bool', int: 'integer', float: 'double', str: 'string'}[type(default)]


if __name__ == '__main__':
    main()
