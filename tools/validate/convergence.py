"""What the settings of the rigid-body simulation change."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from .constructions import CONVERGENCE_CASE, LOW_SEAT
from .results import Trial
from .rigid_body import Settings
from .slip_onset import held_moment, ramped_moment

CHANGES = {
    'turned 4 times faster': {'slowness': 0.016},
    'turned 2 times slower': {'slowness': 0.002},
    'time step halved': {'time_step': 5e-5, 'steps_per_contact_time': 20.0},
    'contact time halved': {'steps_per_contact_time': 5.0},
    'damping ratio 1.4': {'damping_ratio': 1.4},
    'impedance 0.99': {'impedance': 0.99},
    'friction impedance ratio 100': {'friction_impedance_ratio': 1e2},
    'friction impedance ratio 10^6': {'friction_impedance_ratio': 1e6},
    '20 no-slip iterations': {'no_slip_iterations': 20},
    'pressed in 100 times deeper': {'depth_factor': 100.0},
    'pressed in 1000 times deeper': {'depth_factor': 1000.0},
    '6 × 36 pads': {'rings': 6, 'azimuths': 36},
}

RAMPS = ((*CONVERGENCE_CASE, 0.6), (LOW_SEAT, 0.3, 0.25))
"""Construction, friction coefficient, and K / (r T) from which on the moment grows slowly"""
RATES = (0.4, 0.1, 0.025)
"""In 1/s"""


def trials() -> Iterator[Trial]:
    """Simulate with each change."""
    construction, friction = CONVERGENCE_CASE
    for setting, change in CHANGES.items():
        moment = held_moment(construction, friction, replace(Settings(), **change))
        yield Trial(setting, construction.name, friction, moment)
    softer = Settings(depth_factor=100.0)
    for construction, friction, start in RAMPS:
        for rate in RATES:
            moment = ramped_moment(construction, friction, softer, rate, start)
            setting = f'moment grows by {rate:g} r T a second'
            yield Trial(setting, construction.name, friction, moment)
