"""The load and the contact law of an answer, in words and for JSON."""

from __future__ import annotations

import math
from typing import Any

from ..physics import UPRIGHT, JointDesign, Load
from ..physics.contact import CONTACT_LAWS
from .tables import Facts

DEFAULT_LAW = next(iter(CONTACT_LAWS))


def setting_facts(design: JointDesign, load: Load) -> Facts:
    """Say the contact law and the load, each where it is not the paper's."""
    facts = []
    if design.contact_law != DEFAULT_LAW:
        facts.append(('contact law', f'{design.contact_law}, for {design.law.fits}'))
    if load != UPRIGHT:
        facts.append(('load', load_text(load)))
    return facts


def load_text(load: Load, tip: str = '') -> str:
    """Say what acts beside the cables, and where the tip force does: `tip`, or its distance."""
    _, across, _ = load.gravity_direction
    parts = []
    if tilt := load.base_tilt:
        parts.append(
            f'base tilted by {math.degrees(abs(tilt)):.4g} deg towards cable '
            f'{"l" if tilt < 0.0 else "s"}'
        )
    if across:
        share = 100.0 * math.sqrt(1.0 - across**2)
        parts.append(f'{share:.4g} % of gravity in the plane of bending')
    if any(load.tip_force):
        x, z = load.tip_force
        parts.append(
            f'tip force {x:+g} N in X and {z:+g} N in Z at {tip or f"{load.tip_distance:g} m"}'
        )
    return ', '.join(parts) or 'upright, nothing at the tip'


def load_dict(load: Load) -> dict[str, Any]:
    """Return the load ready for JSON: N, m, rad."""
    return {
        'gravity_direction': list(load.gravity_direction),
        'base_tilt': load.base_tilt,
        'tip_force': list(load.tip_force),
        'tip_distance': load.tip_distance,
    }
