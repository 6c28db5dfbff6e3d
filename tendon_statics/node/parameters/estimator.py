"""The estimator's parameters on its node: declared at the start, read whenever they change."""

from __future__ import annotations

from typing import NamedTuple

from rclpy.node import Node

from ...estimation.settings import Settings
from ...files.design_file import UNCERTAINTY, default_design_path, load_design
from ...files.estimator_parameters import CHANGEABLE, DESIGN, WIRING, design_table
from ...files.parameter_kinds import SettingError
from ...files.unit_settings import check_parameters, settings_from
from ...physics import DesignError, JointDesign, design_fields
from .declaration import declare_all
from .table import NodeTable


class Wiring(NamedTuple):
    """What is fixed while the node runs; the fields are the names of the parameters."""

    tension_source: str
    cable_names: tuple[str, str]
    wrench_component: str
    estimation: str
    gravity_source: str
    tip_wrench: bool
    tip_force: bool
    frame_id: str
    joint_name: str
    markers: bool
    executor: str
    service_depth: int
    autostart: bool

    @property
    def hardware_id(self) -> str:
        """In ``/diagnostics``."""
        return self.joint_name


def declare_wiring(node: Node) -> Wiring:
    """Declare what is fixed and return what it is set to.

    Raises
    ------
    SettingError
        If a value is not allowed.
    """
    return Wiring(**declare_all(node, WIRING))


def declare_settings(node: Node, table: NodeTable[Settings]) -> set[str]:
    """Declare what may change; `NodeTable.read` has what it is set to.

    Returned are the names of those of the design that were not given.

    Design parameters that are left out come from the installed preliminary design, with a warning
    if only a part is given. Values that are not allowed are kept, for `NodeTable.read` to refuse.

    Raises
    ------
    SettingError
        If there is no design parameter of a name that was given.
    """
    default = load_design(default_design_path())
    # rclpy has no public view of overrides that nobody declares; a misspelt key would be ignored.
    overrides = node._parameter_overrides
    if DESIGN[:-1] in overrides:
        value = overrides[DESIGN[:-1]].value
        raise SettingError(f'design is {value!r}, but its parameters have names: {DESIGN}mass')
    given = [name.removeprefix(DESIGN) for name in overrides if name.startswith(DESIGN)]
    known = {field.name for field in design_fields()}
    for name in given:
        if name not in known:
            try:
                JointDesign.from_mapping({name: overrides[DESIGN + name].value})
            except DesignError as error:
                raise SettingError(f'{DESIGN}{error}') from None
    left_out = [
        field.name
        for field in design_fields()
        if field.name not in given and field.default is None
    ]
    if not given:
        node.get_logger().warning(
            "No design.* parameters came, so this is the paper's preliminary design, two values "
            'of which are identified, not measured'
        )
    elif left_out:
        node.get_logger().warning(
            'The parameters give a part of the design only; taken from the preliminary design: '
            + ', '.join(f'{DESIGN}{name} = {getattr(default, name)!r}' for name in left_out)
        )
    table.declare_changeable(node)
    return {DESIGN + name for name in left_out}


def unit_table() -> NodeTable[Settings]:
    """Return the table of a unit's estimator; the design's defaults come from a file."""
    design = design_table(load_design(default_design_path()))
    return NodeTable(
        WIRING,
        (*design, *CHANGEABLE),
        check_parameters,
        settings_from,
        (DESIGN, UNCERTAINTY),
        'the design',
    )
