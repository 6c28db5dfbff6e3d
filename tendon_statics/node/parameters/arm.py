"""The parameters of an arm's estimator on its node."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

from rclpy.node import Node

from ...estimation.arm_settings import ArmSettings
from ...files.arm_parameters import ARM_CHANGEABLE, ARM_WIRING, cable_table
from ...files.arm_settings import (
    arm_in,
    arm_settings_from,
    check_arm_parameters,
    joint_names,
    uncertainties_in,
)
from ...physics.arm import Arm
from .declaration import declare_all
from .table import NodeTable


class ArmWiring(NamedTuple):
    """What is fixed while the node runs; the fields are the names of the parameters."""

    arm_file: str
    tension_source: str
    estimation: str
    gravity_source: str
    tip_wrench: bool
    tip_force: bool
    frame_id: str
    arm_name: str
    joint_names: tuple[str, ...]
    markers: bool
    executor: str
    service_depth: int
    autostart: bool

    @property
    def hardware_id(self) -> str:
        """In ``/diagnostics``."""
        return self.arm_name


def declare_arm_wiring(node: Node) -> tuple[ArmWiring, Arm]:
    """Declare what is fixed; return what it is set to, with all joints named, and the arm.

    Raises
    ------
    SettingError
        If a value is not allowed, or the arm's file gives no arm.
    """
    given = ArmWiring(**declare_all(node, ARM_WIRING))
    if not given.arm_file:
        node.get_logger().warning('No arm_file came, so this is the arm of the installed example')
    arm = arm_in(given.arm_file)
    names = joint_names(arm, given.joint_names, given.arm_name)
    return given._replace(joint_names=names), arm


def arm_table(arm: Arm, wiring: ArmWiring) -> NodeTable[ArmSettings]:
    """Return the table of the estimator of an arm.

    Raises
    ------
    SettingError
        If a file of a design has an uncertainty that is none.
    """
    uncertainties = uncertainties_in(wiring.arm_file)
    return NodeTable(
        ARM_WIRING,
        (*ARM_CHANGEABLE, *cable_table(arm.cable_names)),
        partial(check_arm_parameters, arm),
        partial(
            arm_settings_from,
            arm,
            names=wiring.joint_names,
            design_uncertainties=uncertainties,
        ),
    )
