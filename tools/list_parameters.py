"""Print the parameters of the estimator but for the design's, for the README."""

from __future__ import annotations

import json

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.estimator_parameters import ESTIMATOR_PARAMETERS
from tendon_statics.files.parameter_kinds import Parameter


def main() -> None:
    """Print the table."""
    print(table(ESTIMATOR_PARAMETERS))


def table(parameters: tuple[Parameter, ...], *, says_fixed: bool = True) -> str:
    """Name, default, what is allowed and meaning of parameters."""
    rows = [
        (
            f'`{parameter.name}`',
            f'`{json.dumps(parameter.default)}`',
            parameter.allowed,
            parameter.description
            + ('; fixed at the start' if parameter.is_fixed and says_fixed else ''),
        )
        for parameter in parameters
    ]
    return markdown_table(('parameter', 'default', 'allowed', ''), rows)


if __name__ == '__main__':
    main()
