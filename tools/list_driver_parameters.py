"""Print the parameters of the pulley driver, for docs/rig.md."""

from __future__ import annotations

from list_parameters import table

from tendon_statics.files.driver_parameters import DRIVER_PARAMETERS


def main() -> None:
    """Print the table."""
    print(table(DRIVER_PARAMETERS, says_fixed=False))


if __name__ == '__main__':
    main()
