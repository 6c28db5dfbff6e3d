"""The stand-in driver's parameters: one table, as the estimator has one."""

from __future__ import annotations

from collections.abc import Sequence

from .arm_parameters import ARM_WIRING, cable_prefix, cable_table
from .cable_parameters import BIASES, CABLE_NAMES, GAINS, TENSION_SOURCE, WRENCH_COMPONENT
from .fault_settings import fault_parameters
from .parameter_kinds import NumberParameter, Parameter, SwitchParameter, TextParameter

OWN = (
    TextParameter(
        'file',
        '',
        'recording of tensions to play, CSV, Parquet or a bag; empty: `demo_tensions.csv`, or of '
        'an arm `arm_tensions.csv`',
    ),
    TextParameter(
        'arm_file',
        '',
        'file of the arm whose cables are played, all in one message: `tension_source` and '
        '`cables.<name>.gain` and `bias` are then those of `arm_estimator`; empty: a unit',
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

OF_UNIT: tuple[Parameter, ...] = (
    *(TENSION_SOURCE, CABLE_NAMES, WRENCH_COMPONENT),
    *(gain.fixed() for gain in GAINS),
    *(bias.fixed() for bias in BIASES),
)
"""How a unit's tensions are measured, as its estimator has it, so that one file serves both"""

DRIVER_PARAMETERS: tuple[Parameter, ...] = (*OWN, *OF_UNIT, *fault_parameters())
"""All, where no arm is played"""


def of_arm(cable_names: Sequence[str]) -> tuple[Parameter, ...]:
    """Return the same of an arm with cables of these names."""
    (source,) = (parameter for parameter in ARM_WIRING if parameter.name == TENSION_SOURCE.name)
    scales = {parameter.name: parameter for parameter in cable_table(cable_names)}
    names = (f'{cable_prefix(name)}{of}' for name in cable_names for of in ('gain', 'bias'))
    return (source, *(scales[name].fixed() for name in names))
