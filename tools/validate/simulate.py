"""Run all simulations: some minutes."""

from __future__ import annotations

import math
import sys
from dataclasses import replace

import mujoco

from . import bristles, foundation
from .constructions import BALL_RADIUS, CASES, HANGING, Construction, TightSeat
from .convergence import trials
from .rest_angle import rest_angles
from .results import Onset, Results
from .rigid_body import Settings
from .slip_onset import held_moment

DENSE_FROM = 1.0
"""Friction coefficient from which on a tight seat touches with so few pads that it needs more"""
DENSE = replace(Settings(), rings=6, azimuths=36)


def simulate() -> Results:
    """Simulate all cases, one after the other."""
    mujoco.set_mju_user_warning(lambda text: print(f'MuJoCo: {text}', file=sys.stderr))
    _say('slip onset')
    onsets = tuple(_onset(construction, friction) for construction, friction in CASES)
    _say('rest angles')
    angles = tuple(math.degrees(angle) for angle in rest_angles(HANGING))
    _say('convergence')
    return Results(f'MuJoCo {mujoco.__version__}', onsets, angles, tuple(trials()))


def _onset(construction: Construction, friction: float) -> Onset:
    settings = Settings()
    of_foundation = None
    if isinstance(construction, TightSeat):
        settings = DENSE if friction >= DENSE_FROM else settings
        pads = construction.pads(*foundation.FINE)
        of_foundation = foundation.capacity(pads, friction, tension=1.0) / BALL_RADIUS
    return Onset(
        construction.name,
        friction,
        held_moment(construction, friction, settings),
        bristles.held_moment(construction, friction),
        of_foundation,
    )


def _say(what: str) -> None:
    print(f'== simulating: {what}', file=sys.stderr, flush=True)
