"""The estimator's parameters that say how a unit is measured: names, defaults, ranges."""

from __future__ import annotations

import math

from ..physics.tensions import MAX_TENSION
from ..tensions.cable_scale import CableScale
from .number_parameter import NumberParameter

TENSION_SOURCES = ('array', 'joint_state', 'wrench_pair')
"""What the parameter ``tension_source`` may be; the first is the default."""

WRENCH_COMPONENTS = ('z', 'x', 'y', 'norm')
"""What ``wrench_component`` may be; the first is the default."""

ESTIMATIONS = ('equilibrium', 'tracking')
"""What ``estimation`` may be; the first is the default."""

CABLES = ('cable_l', 'cable_s')

_DEFAULT = CableScale()

GAINS = tuple(
    NumberParameter(
        *(f'{cable}.gain', _DEFAULT.gain, -1e6, 1e6, 'N'),
        'newtons per unit of what is measured: tension = gain * value + bias; not 0',
    )
    for cable in CABLES
)
BIASES = tuple(
    NumberParameter(
        *(f'{cable}.bias', _DEFAULT.bias, -1e6, 1e6, 'N'), 'tension at the measured value 0'
    )
    for cable in CABLES
)
MAX_TENSIONS = tuple(
    NumberParameter(
        *(f'{cable}.max_tension', _DEFAULT.max_tension, 0.001, MAX_TENSION, 'N'),
        'above it a tension is implausible',
    )
    for cable in CABLES
)

NUMBERS = (
    NumberParameter(
        *('tension_stddev', 0.01, 0.0, 1000.0, 'N'),
        'standard deviation of each measured tension, the two independent',
    ),
    NumberParameter(
        *('initial_bend_angle', 0.0, -0.5 * math.pi, 0.5 * math.pi, 'rad'),
        'where a tracked unit is at the start and after ~/reset, within its stops',
    ),
    NumberParameter(
        *('input_timeout', 0.5, 0.001, 3600.0, 's'),
        'without valid tensions for so long the input is stale',
    ),
    NumberParameter(
        *('max_skew', 0.005, 0.0, 10.0, 's'),
        'wrench_pair: most that the stamps of two load cells may differ in a pair',
    ),
    *GAINS,
    *BIASES,
    *MAX_TENSIONS,
)
"""Those that may change while the node runs, beside the design's"""
