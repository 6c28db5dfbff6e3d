"""Print how wide the interval of a tip force is, and what a biased load cell makes of it.

For docs/tip_force.md: ``widths``, over friction and tension; ``bias``, of one load cell.
"""

from __future__ import annotations

import argparse
import dataclasses
import sys

from tendon_statics import (
    JointDesign,
    default_design_path,
    load_design,
    tip_force_intervals,
)
from tendon_statics.command_line.tables import markdown_table

LAWS = ('merged', 'friction_circle', 'elastic_seat')
FRICTIONS = (1.05, 0.5, 0.2, 0.1, 0.05)
TENSIONS = (0.5, 1.0, 3.0, 10.0)
ACROSS = (1.0, 0.0)
DISTANCE = 0.02
"""m"""

BIAS = 0.03
"""N, of cable s"""


def designs(law: str) -> dict[float, JointDesign]:
    """Return the preliminary design with a contact law, from dry to lubricated."""
    design = dataclasses.replace(load_design(default_design_path()), contact_law=law)
    return {mu: dataclasses.replace(design, friction_coefficient=mu) for mu in FRICTIONS}


def at_rest(design: JointDesign, total: float, bias: float = 0.0) -> tuple[float, float]:
    """Return the interval in N across a straight unit with even tensions."""
    ((low, high),) = tip_force_intervals(
        *(design, 0.5 * total, 0.5 * total + bias),
        bend_angle=0.0,
        direction=ACROSS,
        distance=DISTANCE,
    )
    return low, high


def widths() -> str:
    """How wide the interval is, in mN."""
    header = ('law', 'μ', *(f'T = {total:g} N:' for total in TENSIONS))
    rows = []
    for law in LAWS:
        for mu, design in designs(law).items():
            ends = (at_rest(design, total) for total in TENSIONS)
            rows.append((law, f'{mu:g}', *(f'{1e3 * (high - low):.0f}' for low, high in ends)))
    return markdown_table(header, rows)


def biases() -> str:
    """How far the ends of the interval move, which are what a slipping unit tells."""
    header = ('μ', 'T [N]:', 'exact [mN]:', 'biased [mN]:')
    rows = []
    for mu, design in designs('elastic_seat').items():
        for total in (1.0, 3.0):
            ends = at_rest(design, total), at_rest(design, total, BIAS)
            rows.append((f'{mu:g}', f'{total:g}', *map(_millinewtons, ends)))
    return markdown_table(header, rows)


def _millinewtons(interval: tuple[float, float]) -> str:
    return ' to '.join(f'{1e3 * end:+.0f}' for end in interval)


TABLES = {'widths': widths, 'bias': biases}


def main(*arguments: str) -> int:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('table', choices=TABLES)
    print(TABLES[parser.parse_args(arguments or None).table]())
    return 0


if __name__ == '__main__':
    sys.exit(main())
