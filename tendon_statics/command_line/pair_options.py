"""What the figures of one pair of tensions have in common."""

from __future__ import annotations

import argparse

from ..physics import Equilibrium, JointDesign, Load, Regime, paper, solve
from .load_text import setting_facts
from .options import (
    UsageError,
    add_design_option,
    add_load_options,
    add_tension_options,
    design_and_load,
)


def add_pair_options(parser: argparse.ArgumentParser) -> None:
    """Add the two tensions, by default the paper's, the load, and ``--design``."""
    add_tension_options(parser, defaults=(paper.TENSION_L, paper.TENSION_S))
    add_load_options(parser)
    add_design_option(parser)


def pair_from(options: argparse.Namespace) -> tuple[JointDesign, Equilibrium]:
    """Return the design and its answer to the two tensions."""
    design, load = design_and_load(options)
    equilibrium = solve(design, options.tension_l, options.tension_s, load)
    if equilibrium.regime is Regime.SLACK:
        raise UsageError('there is nothing to draw: a cable is slack, which is outside the model')
    return design, equilibrium


def pair_title(equilibrium: Equilibrium) -> str:
    """Name the regime and the tensions, and law and load where they are not the paper's."""
    tensions = (
        f'{equilibrium.regime} at T_l = {equilibrium.tension_l:g} N, '
        f'T_s = {equilibrium.tension_s:g} N'
    )
    return '\n'.join([tensions, *setting_title(equilibrium.design, equilibrium.load)])


def setting_title(design: JointDesign, load: Load) -> list[str]:
    """Return a line of law and load where they are not the paper's, or none."""
    settings = '; '.join(text for _, text in setting_facts(design, load))
    return [settings] if settings else []


def between(start: float, end: float, count: int = 41) -> list[float]:
    """Return evenly spaced numbers with both ends."""
    return [start + (end - start) * index / (count - 1) for index in range(count)]
