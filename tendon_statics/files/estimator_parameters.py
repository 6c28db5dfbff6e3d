"""The estimator's parameters: one table, from which all that is said and done of them comes.

The node declares, reads and checks them by it, the files of a unit are checked by it, the node's
reference shows it, and what is not in it is named as unknown.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..estimation.methods import METHODS
from ..estimation.settings import Settings
from ..physics.design import DesignParameter, JointDesign, design_fields
from .cable_parameters import (
    BIASES,
    CABLE_NAMES,
    GAINS,
    MAX_TENSIONS,
    SLACK_THRESHOLDS,
    TENSION_SOURCE,
    WRENCH_COMPONENT,
)
from .measuring_parameters import (
    AUTOSTART,
    CONFIDENCE,
    EXECUTOR,
    FILTER_LAG,
    GRAVITY_DIRECTION,
    GRAVITY_SOURCE,
    IMU_MOUNTING,
    INPUT_TIMEOUT,
    LOAD_TIMEOUT,
    MARKERS,
    MAX_CLOCK_OFFSET,
    MAX_SKEW,
    MEASURED_BEND_ANGLE_STDDEV,
    PLAUSIBILITY,
    SERVICE_DEPTH,
    TARE,
    TENSION_BIAS_STDDEV,
    TENSION_STDDEV,
    TIP_DIRECTION,
    TIP_FORCE,
    TIP_FORCE_LEVEL,
    TIP_WRENCH,
)
from .parameter_kinds import (
    ChoiceParameter,
    ListParameter,
    NumberParameter,
    Parameter,
    TextParameter,
    in_their_types,
)

ESTIMATIONS = tuple(METHODS)

DESIGN = 'design.'
"""What the names of the design's parameters begin with"""

NUMBERS = (
    TENSION_STDDEV,
    CONFIDENCE,
    FILTER_LAG,
    TENSION_BIAS_STDDEV,
    MEASURED_BEND_ANGLE_STDDEV,
    NumberParameter(
        'initial_bend_angle',
        Settings.initial_bend_angle,
        'angle of a remembered unit at the start and after `~/reset`, within its stops',
        minimum=-0.5 * math.pi,
        maximum=0.5 * math.pi,
        unit='rad',
    ),
    INPUT_TIMEOUT,
    MAX_SKEW,
    MAX_CLOCK_OFFSET,
    *GAINS,
    *BIASES,
    *MAX_TENSIONS,
    *SLACK_THRESHOLDS,
    *PLAUSIBILITY,
    LOAD_TIMEOUT,
    NumberParameter(
        'tip_distance',
        Settings.tip_distance,
        "distance along the unit's axis at which the force of `tip_wrench` acts, and the one "
        'that `tip_force` looks for',
        minimum=-10.0,
        maximum=10.0,
        unit='m',
    ),
    TIP_FORCE_LEVEL,
    *TARE,
)
"""Those that are numbers and may change while the node runs, beside the design's"""

VECTORS = (GRAVITY_DIRECTION, IMU_MOUNTING, TIP_DIRECTION)

LISTS = (
    ListParameter(
        'design_uncertainty.parameters',
        (),
        "names of the design's numbers that are not exact, as `calibrate` writes them",
    ),
    ListParameter(
        'design_uncertainty.covariance',
        (),
        'their covariance in SI units, row by row; standard deviations and probabilities then '
        'include it',
        of_numbers=True,
    ),
)

CHANGEABLE = (*NUMBERS, *VECTORS, *LISTS)
"""All that may change while the node runs, beside the design's"""

WIRING = (
    TENSION_SOURCE,
    CABLE_NAMES,
    WRENCH_COMPONENT,
    ChoiceParameter(
        'estimation',
        ESTIMATIONS[0],
        "`equilibrium`: each pair of tensions by itself, the paper's model; `tracking`: the node "
        'remembers where the unit was, and publishes the angle for every valid message except '
        'with slack cables; `filtering`: the same, but it treats tensions as noisy and gives '
        'intervals and probabilities',
        choices=ESTIMATIONS,
    ),
    GRAVITY_SOURCE,
    TIP_WRENCH,
    TIP_FORCE,
    TextParameter(
        'frame_id',
        'joint',
        'frame of the joint, in every stamped message: origin in the centre of the ball, Z along '
        'the unit at zero bend, X towards cable s',
    ),
    TextParameter(
        'joint_name',
        'bend',
        'name of the joint in `~/joint_state`, and hardware id in `/diagnostics`',
    ),
    MARKERS,
    EXECUTOR,
    SERVICE_DEPTH,
    AUTOSTART,
)
"""How the estimator is connected, which is fixed at the start"""

ESTIMATOR_PARAMETERS: tuple[Parameter, ...] = (*WIRING, *CHANGEABLE)
"""All but the design's, see `design_table`"""


def design_table(default: JointDesign | None = None) -> tuple[Parameter, ...]:
    """Return the design's parameters; what is not given has the value of a design, if any."""
    return tuple(
        NumberParameter(
            DESIGN + field.name,
            getattr(default, field.name, math.nan),
            f'{field.description} ({field.symbol})',
            minimum=field.minimum,
            maximum=field.maximum,
            unit=field.unit,
        )
        if isinstance(field, DesignParameter)
        else ChoiceParameter(
            DESIGN + field.name,
            getattr(default, field.name, ''),
            field.description,
            choices=field.choices,
            is_fixed=False,
        )
        for field in design_fields()
    )


def as_kept(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values by name as the node keeps them, such as the number for its text."""
    return in_their_types((*ESTIMATOR_PARAMETERS, *design_table()), values)


def known_names() -> set[str]:
    """Return the names of all parameters."""
    return {parameter.name for parameter in ESTIMATOR_PARAMETERS} | {
        DESIGN + field.name for field in design_fields()
    }
