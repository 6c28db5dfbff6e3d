"""Simulate and print the tables: ``python -m validate`` in tools/, or `make validate`.

What was simulated is kept in docs/validation.json. docs/validation.md and its figure are made from
that, here and by `make docs`, which needs no simulator.
"""

from __future__ import annotations

import sys

from make_docs import make_page

from . import figure, tables


def main() -> int:
    """Simulate, keep, print and draw."""
    try:
        from .simulate import simulate
    except ModuleNotFoundError as error:
        print(f'validate: {error.name} is missing: pip install "mujoco<4"', file=sys.stderr)
        return 1
    simulate().write()
    for name, table in tables.TABLES.items():
        print(f'{name}\n\n{table()}\n')
    figure.write()
    make_page('docs/validation.md')
    return 0


if __name__ == '__main__':
    sys.exit(main())
