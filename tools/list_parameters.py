"""Print the parameters of the estimators but for the design's, for docs/node_reference.md."""

from __future__ import annotations

import json

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.arm_parameters import ARM_PARAMETERS, cable_table
from tendon_statics.files.estimator_parameters import ESTIMATOR_PARAMETERS
from tendon_statics.files.parameter_kinds import ListParameter, Parameter, VectorParameter


def main(of: str = 'unit') -> None:
    """Print the table of the estimator of a unit, or of an arm."""
    of_arm = (*ARM_PARAMETERS, *cable_table(('NAME',)))
    print(table(of_arm if of == 'arm' else ESTIMATOR_PARAMETERS))


def table(parameters: tuple[Parameter, ...], *, says_fixed: bool = True) -> str:
    """Name, default, what is allowed and meaning of parameters."""
    rows = [
        (
            f'`{parameter.name}`',
            kind_of(parameter),
            f'`{json.dumps(parameter.default)}`',
            allowed(parameter),
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


def kind_of(parameter: Parameter) -> str:
    """Return the type as ROS calls it, say ``double`` or ``string[]``."""
    names = {bool: 'bool', int: 'integer', float: 'double', str: 'string'}
    if isinstance(parameter, ListParameter):
        return 'double[]' if parameter.of_numbers else 'string[]'
    if isinstance(parameter.default, tuple):
        return f'{names[type(parameter.default[0])]}[]'
    return names[type(parameter.default)]


if __name__ == '__main__':
    main()
