"""Print the parameters of the live page, for docs/view.md."""

from __future__ import annotations

from list_parameters import table

from tendon_statics.files.view_parameters import VIEW_PARAMETERS


def main() -> None:
    """Print the table."""
    print(table(VIEW_PARAMETERS, says_fixed=False))


if __name__ == '__main__':
    main()
