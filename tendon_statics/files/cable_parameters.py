"""Parameters of how the tensions of both cables come, which estimator and driver share."""

from __future__ import annotations

from ..physics.tensions import MAX_TENSION
from ..tensions.cable_scale import CableScale
from .parameter_kinds import ChoiceParameter, NamePairParameter, NumberParameter

TENSION_SOURCES = ('array', 'joint_state', 'wrench_pair')
WRENCH_COMPONENTS = ('z', 'x', 'y', 'norm')

CABLES = ('cable_l', 'cable_s')

_SCALE = CableScale()

TENSION_SOURCE = ChoiceParameter(
    'tension_source',
    TENSION_SOURCES[0],
    '`array`: `Float64MultiArray` `[T_l, T_s]` on `tensions`; `joint_state`: `JointState` on '
    '`tensions`, with both cables or one in `effort`; `wrench_pair`: two `WrenchStamped` on '
    '`tension_l` and `tension_s`',
    choices=TENSION_SOURCES,
)
CABLE_NAMES = NamePairParameter(
    'cable_names', CABLES, '`joint_state`: names of cables l and s, whose tensions are in `effort`'
)
WRENCH_COMPONENT = ChoiceParameter(
    'wrench_component',
    WRENCH_COMPONENTS[0],
    "`wrench_pair`: component of a load cell's force",
    choices=WRENCH_COMPONENTS,
)
GAINS = tuple(
    NumberParameter(
        f'{cable}.gain',
        _SCALE.gain,
        'newtons per unit of the measured value: tension = gain · value + bias',
        minimum=-1e6,
        maximum=1e6,
        unit='N per unit',
        may_be_zero=False,
    )
    for cable in CABLES
)
BIASES = tuple(
    NumberParameter(
        f'{cable}.bias',
        _SCALE.bias,
        'tension at the measured value 0; `~/tare` sets it',
        minimum=-1e6,
        maximum=1e6,
        unit='N',
    )
    for cable in CABLES
)
MAX_TENSIONS = tuple(
    NumberParameter(
        f'{cable}.max_tension',
        _SCALE.max_tension,
        'a tension above it is implausible; set it to what the cable is made for',
        minimum=0.001,
        maximum=MAX_TENSION,
        unit='N',
    )
    for cable in CABLES
)
SLACK_THRESHOLDS = tuple(
    NumberParameter(
        f'{cable}.slack_threshold',
        _SCALE.slack_threshold,
        'the cable is slack up to this tension, and then until it exceeds 1.5 times as much; 0: '
        'three times `tension_stddev`',
        minimum=0.0,
        maximum=1000.0,
        unit='N',
    )
    for cable in CABLES
)
