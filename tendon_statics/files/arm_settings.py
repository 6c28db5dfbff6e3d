"""From the values of the parameters of an arm's estimator to what it computes with."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ..estimation.arm_follower import ARM_METHODS
from ..estimation.arm_settings import ArmSettings
from ..physics import DesignUncertainty
from ..physics.arm import Arm
from ..physics.arm.joints import check_bend_angles
from ..physics.errors import ArmError, BendAngleError
from .arm_file import load_arm, load_arm_uncertainties
from .arm_parameters import (
    ARM_ESTIMATIONS,
    ARM_NUMBERS,
    ARM_PARAMETERS,
    ARM_VECTORS,
    CABLES,
    INITIAL_BEND_ANGLES,
    cable_prefix,
    cable_table,
)
from .installed_files import installed_config
from .measuring_values import cable_scale, check_directions, measuring_in, numbers_in
from .parameter_kinds import SettingError, check_given


def arm_in(arm_file: str) -> Arm:
    """Read the arm that the parameter ``arm_file`` names, the installed example if it is empty.

    Raises
    ------
    SettingError
        If it cannot be read, or is no arm.
    """
    path = Path(arm_file) if arm_file else installed_config('arm.yaml')
    try:
        return load_arm(path)
    except ArmError as error:
        raise SettingError(f'arm_file: {error}') from None


def uncertainties_in(arm_file: str) -> tuple[DesignUncertainty | None, ...]:
    """Return how well the units of the arm that the parameter ``arm_file`` names are known.

    Raises
    ------
    SettingError
        If what a file says of that is no covariance of design parameters.
    """
    path = Path(arm_file) if arm_file else installed_config('arm.yaml')
    try:
        return load_arm_uncertainties(path)
    except ArmError as error:
        raise SettingError(f'arm_file: {error}') from None


def joint_names(arm: Arm, given: Iterable[str], arm_name: str) -> tuple[str, ...]:
    """Return the names of the joints, from the base on.

    Raises
    ------
    SettingError
        If those that are given are not one for each joint, all different.
    """
    names, count = tuple(given), len(arm.units)
    if not names:
        return tuple(f'{arm_name}_joint_{number}' for number in range(1, count + 1))
    if len(names) != count or len(set(names)) != count or not all(names):
        raise SettingError(
            f'joint_names is {list(names)!r}, but the arm has {count} joints: as many different '
            'names are needed, from the base on, or none'
        )
    return names


def check_cables(arm: Arm, values: Mapping[str, Any]) -> None:
    """Check that what is given of cables is of those that the arm has.

    Raises
    ------
    SettingError
        If a cable, or what is said of it, is not known.
    """
    known = {parameter.name for parameter in cable_table(arm.cable_names)}
    for name, value in values.items():
        if name.startswith(CABLES) and name not in known:
            raise SettingError(
                f'{name} is {value!r}, but there is no such parameter; the cables are '
                f'{", ".join(arm.cable_names)}, and each has gain, bias, max_tension and '
                'slack_threshold'
            )


def check_arm_parameters(arm: Arm, values: Mapping[str, Any]) -> None:
    """Check what is given of the parameters of an arm's estimator, one by one.

    Raises
    ------
    SettingError
        If a value is not allowed; the text names the parameter, its value and what is allowed.
    """
    check_given((*ARM_PARAMETERS, *cable_table(arm.cable_names)), values)
    check_directions(values)


def arm_settings_from(
    arm: Arm,
    values: Mapping[str, Any],
    names: tuple[str, ...] = (),
    design_uncertainties: tuple[DesignUncertainty | None, ...] | None = None,
) -> ArmSettings:
    """Make settings of the values of parameters by name; what is not given has its default.

    Foreign names are left alone.

    Parameters
    ----------
    names : tuple of str
        Of the joints, from the base on; empty: as by default.
    design_uncertainties : tuple of DesignUncertainty or None
        As of `ArmSettings`.

    Raises
    ------
    SettingError
        If a value is not valid, or the joints cannot begin at their angles, which no other
        parameter can mend; the text names the parameter, its value and what is allowed.
    """
    check_arm_parameters(arm, values)
    number = numbers_in(values, cable_table(arm.cable_names))
    start = tuple(map(float, values.get(INITIAL_BEND_ANGLES.name, ())))
    if start:
        try:
            check_bend_angles(arm, start)
        except BendAngleError as error:
            raise SettingError(f'{INITIAL_BEND_ANGLES.name}: {error}') from None
    settings = ArmSettings(
        arm,
        names or joint_names(arm, (), 'arm'),
        cables=tuple(cable_scale(cable_prefix(name), number) for name in arm.cable_names),
        initial_bend_angles=start,
        design_uncertainties=design_uncertainties,
        **measuring_in(values, ARM_NUMBERS, ARM_VECTORS, ArmSettings),
    )
    estimation = values.get('estimation', ARM_ESTIMATIONS[0])
    if refusal := ARM_METHODS[estimation].refusal(settings):
        raise SettingError(refusal)
    return settings
