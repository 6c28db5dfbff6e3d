"""The stand-in driver's parameters: one table, as the estimator has one."""

from __future__ import annotations

from .cable_parameters import BIASES, CABLE_NAMES, GAINS, TENSION_SOURCE, WRENCH_COMPONENT
from .fault_settings import fault_parameters
from .parameter_kinds import NumberParameter, Parameter, SwitchParameter, TextParameter

OWN = (
    TextParameter(
        'file',
        '',
        'recording of tensions to play, CSV, Parquet or a bag; empty: `demo_tensions.csv`',
    ),
    SwitchParameter('loop', True, 'whether to begin anew after the last row'),
    NumberParameter(
        'rate',
        10.0,
        'readings per second, of real time also with `use_sim_time`',
        minimum=0.01,
        maximum=20000.0,
        unit='Hz',
        is_fixed=True,
    ),
    NumberParameter(
        'count',
        0,
        'readings after which it sends no more; 0: endless',
        minimum=0,
        maximum=10**15,
        is_fixed=True,
    ),
    NumberParameter(
        'awaited_subscribers',
        0,
        'subscribers on each topic of tensions that it has to have found before the first reading',
        minimum=0,
        maximum=100,
        is_fixed=True,
    ),
)

DRIVER_PARAMETERS: tuple[Parameter, ...] = (
    *OWN,
    *(TENSION_SOURCE, CABLE_NAMES, WRENCH_COMPONENT),
    *(gain.fixed() for gain in GAINS),
    *(bias.fixed() for bias in BIASES),
    *fault_parameters(),
)
"""All; those of the tensions are the estimator's, so that one file serves both"""
