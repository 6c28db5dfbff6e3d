"""Run the bench: ``python -m bench --json FILE`` in tools/, or `make bench`.

It ends with 1 if something could not be measured, not if a figure is missed.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import traceback
from dataclasses import asdict
from pathlib import Path

from tendon_statics.command_line.tables import markdown_table

from . import arm, arm_node, batch, filtering, messages, node, solver, start_up
from .rows import Row

GROUPS = (solver, batch, filtering, arm, start_up, messages, node, arm_node)
"""Each has a function `rows` that measures a group of rows"""

SHARES = {
    'where `solve(...).as_dict()` spends its time': solver.shares,
    'where `solve_batch`, all fields, spends its time': batch.shares,
    'where the node spends a message': node.shares,
}
"""What is split up → what measures the share of each part"""


def main() -> int:
    """Measure all groups; print the table and write it as JSON."""
    parser = argparse.ArgumentParser(description='Measure how fast the package is.')
    parser.add_argument('--json', type=Path, required=True, metavar='FILE')
    options = parser.parse_args()
    rows: list[Row] = []
    failed = []
    for group in GROUPS:
        name = group.__name__.rsplit('.', 1)[-1]
        print(f'== measuring: {name}', file=sys.stderr, flush=True)
        try:
            rows += group.rows()
        except Exception:
            traceback.print_exc()
            failed.append(name)
    shares: dict[str, dict[str, float]] = {}
    for whole, measure in SHARES.items():
        try:
            shares[whole] = measure()
        except Exception:
            traceback.print_exc()
            failed.append(whole)
    print(
        markdown_table(
            ('work', 'against', 'ratio:', 'to reach', 'reached'),
            [
                (
                    row.work,
                    row.against,
                    f'{row.ratio:.3g}',
                    row.target or '–',
                    {True: 'yes', False: 'no', None: '–'}[row.reached],
                )
                for row in rows
            ],
        )
    )
    for whole, parts in shares.items():
        print()
        print(
            markdown_table(
                (whole, 'share [%]:'),
                [(part, f'{100.0 * share:.0f}') for part, share in parts.items()],
            )
        )
    machine = {'cores': os.cpu_count(), 'python': platform.python_version()}
    options.json.parent.mkdir(parents=True, exist_ok=True)
    options.json.write_text(
        json.dumps({**machine, 'rows': [asdict(row) for row in rows], 'shares': shares}, indent=2)
        + '\n',
        encoding='utf-8',
    )
    if failed:
        print(f'bench: could not measure: {", ".join(failed)}', file=sys.stderr)
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
