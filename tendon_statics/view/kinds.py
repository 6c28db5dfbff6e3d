"""What there is to hear of a unit, and of an arm."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from std_msgs.msg import String
from tendon_statics_interfaces.msg import ArmEstimate, Estimate, JointRegimes

from ..files.arm_settings import arm_in
from ..files.estimator_parameters import DESIGN
from ..files.parameter_kinds import SettingError
from ..node.outputs.arm_messages import AdmissibleAngles
from ..physics import DesignError, JointDesign, design_fields
from .arm_values import arm_names, arm_sample
from .unit_sample import UNIT_NAMES, unit_sample


@dataclass(frozen=True)
class Kind:
    """A kind of estimator: what it publishes, and what it can be asked."""

    name: str
    estimates: type
    """Type of the messages by which it is found"""
    regimes_on: str
    """Topic below the node's name that says what holds in place of an estimate"""
    regimes: type
    first_regime: Callable[[Any], str]
    """Returns it from such a message"""
    asked: tuple[str, ...]
    """Parameters that tell what it is an estimator of"""
    model_of: Callable[[Mapping[str, Any]], Any]
    """Makes a `JointDesign` or an `Arm` of their values; None if they tell none"""
    names_of: Callable[[Any], Sequence[str]]
    """Returns the names of what is drawn over time of an estimate"""
    sample: Callable[[Any], Mapping[str, float]]
    """Returns the values of that"""
    admissible: type | None = None
    """Of the messages on ``~/admissible_angles`` that say where friction can hold it, where the
    estimates do not"""


def _design(values: Mapping[str, Any]) -> JointDesign | None:
    given = {name.removeprefix(DESIGN): value for name, value in values.items()}
    try:
        return JointDesign.from_mapping(given)
    except DesignError:  # as of an estimator that is not configured yet
        return None


def _arm(values: Mapping[str, Any]) -> Any:
    try:
        return arm_in(values['arm_file'])
    except (KeyError, SettingError):  # as of an estimator on another machine
        return None


UNIT = Kind(
    name='unit',
    estimates=Estimate,
    regimes_on='regime',
    regimes=String,
    first_regime=lambda message: message.data,
    asked=tuple(f'{DESIGN}{field.name}' for field in design_fields()),
    model_of=_design,
    names_of=lambda _estimate: UNIT_NAMES,
    sample=unit_sample,
)

ARM = Kind(
    name='arm',
    estimates=ArmEstimate,
    regimes_on='regimes',
    regimes=JointRegimes,
    first_regime=lambda message: next(iter(message.regimes), ''),
    asked=('arm_file',),
    model_of=_arm,
    names_of=arm_names,
    sample=arm_sample,
    admissible=AdmissibleAngles,
)

KINDS = (UNIT, ARM)
