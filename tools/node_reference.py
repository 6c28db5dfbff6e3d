"""Print the tables of docs/node_reference.md: what estimators have, as the nodes themselves say.

Topics, services, types and quality of service come from the running nodes; only what each is for
is written here. A topic or service without such a line, or a line without one, is an error.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from functools import cache
from pathlib import Path
from typing import NamedTuple

from list_entities import arm_estimator, estimator
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.arm_parameters import ARM_WIRING
from tendon_statics.files.estimator_parameters import WIRING
from tendon_statics.files.parameter_kinds import ChoiceParameter, Parameter, SwitchParameter
from tendon_statics.node.inputs.subscriptions import type_name

INTERFACES = Path(__file__).resolve().parents[1] / 'interfaces'

MEANINGS = {
    'tensions': 'tensions of cables l and s: `[T_l, T_s]` in `data`, or by name in `effort`, in '
    'one message or two. Every message is solved',
    'tension_l': 'in place of `tensions`: the load cell of cable l',
    'tension_s': 'in place of `tensions`: the load cell of cable s',
    'imu': 'an IMU that is mounted on the base',
    'base_pose': 'the joint frame in a frame whose Z is up',
    'tip_wrench': 'the force on the tip in the joint frame, at `tip_distance`',
    'measured_bend_angle': 'rad, from an encoder or a camera: `tracking` puts the unit '
    'there, `filtering` takes it with its noise and compares it with the model, and `~/tip_force` '
    'is worked out from it',
    '~/regime': 'for every message, except one whose stamp is late or repeated; a subscriber with '
    '`transient_local` gets the last one at once',
    '~/bend_angle': 'rad; only where determined',
    '~/joint_pressure': 'Pa (N/m while `contact_width` is left at 1 m); only where determined',
    '~/slip_margin': 'signed share of the friction limit that is in use at that angle: within ±1 '
    'friction can hold; only where the angle is determined',
    '~/admissible_angles': 'rad, pairs of ends of the intervals in which friction can hold the '
    'unit; for every valid message without a slack cable',
    '~/unit_pose': "the unit's centre of gravity in the joint frame, with covariance; only where "
    'determined',
    '~/joint_state': 'the bend angle for robot_state_publisher and RViz; only where determined',
    '~/estimate': 'the whole result, stamped; for every valid message, NaN where not determined',
    '~/committed_estimate': 'the same, `filter_lag` later, when it is final, with the stamp of '
    'its own tensions, which are smoothed',
    '~/tip_force': 'what pushes at the tip, as intervals along `tip_direction`; at most 50 a '
    'second ([force at the tip](tip_force.md))',
    '~/tip_wrench': 'that force, only while friction is at its limit and an angle is measured',
    '~/markers': 'for RViz: the unit, the admissible angles, the regime as a colour, gravity and '
    'tip force as arrows',
    '/diagnostics': 'the health of the node, every second and at once when it gets worse',
    '~/solve': "one pair of tensions in N, with the node's present design, and with its load or "
    'another; `max_tension` does not apply',
    '~/solve_inverse': 'the two tensions for a bend angle and a pressure or total tension (the '
    'other is left 0)',
    '~/solve_tip_force': 'the forces at the tip that explain a pair of tensions and an angle',
    '~/load_design': "take a unit's parameter file, by its path or as text: everything in it that "
    'may change or, with a reason, nothing',
    '~/reset': 'put a tracked unit at `initial_bend_angle`',
    '~/tare': 'set the biases so that the mean of the last `tare_time` of slack cables is 0; '
    'refused unless both were still',
    '~/solve_latest': 'the newest valid pair received, with the present design; the result as '
    'JSON in `message`, with its `age` in s, how many invalid messages came since '
    '(`invalid_since`), and how many measured angles were rejected (`rejected_corrections`)',
}
"""Name, without the namespace → what it is for, for the estimator of a unit"""

MEANINGS_OF_ARM = {
    'tensions': "tensions of the arm's cables: all or some of them by name in `effort`, or all "
    "in `data`, in the order of the arm's file. The arm is followed with every message",
    'imu': MEANINGS['imu'],
    'base_pose': "the base's frame in a frame whose Z is up",
    'tip_wrench': "the force on the end of the last unit, in the base's frame",
    'measured_joint_states': 'rad in `position`, from encoders or cameras, of all joints or some '
    'by name: those joints are put there',
    '~/joint_states': 'the bend angles of all joints for robot_state_publisher and RViz; only '
    'where determined',
    '~/tip_pose': "the end of the last unit in the base's frame, with covariance; only where "
    'all angles are assured and their deviations known',
    '~/arm_estimate': 'the whole result, stamped; for every valid message, NaN where not '
    'determined',
    '~/committed_estimate': MEANINGS['~/committed_estimate'],
    '~/admissible_angles': 'the intervals in which friction can hold each joint while the others '
    'stay; at most 20 a second, with none while the arm is slack',
    '~/regimes': 'of each joint, for every message, except one whose stamp is late or repeated; '
    'a subscriber with `transient_local` gets the last one at once',
    '~/tip_force': 'the forces on the end of the last unit along `tip_direction` that all joints '
    'explain, where their angles are known; at most 50 a second, and at most a fifth of the time '
    'of the node',
    '~/tip_wrench': 'that force, only while a joint is at the limit of friction and the angles of '
    'all are measured',
    '~/markers': 'for RViz: the units, the angles at which friction can hold each joint while '
    'the others stay, the regimes as colours, gravity and tip force as arrows',
    '/diagnostics': MEANINGS['/diagnostics'] + ', with the worst joint',
    '~/solve_arm': 'where tensions would take the arm from given angles, or from where it is, '
    "under the node's load or another",
    '~/solve_tip_force': 'the forces on the end of the last unit that explain tensions and angles '
    'of all joints',
    '~/reset': 'put the joints at `initial_bend_angles`',
    '~/tare': MEANINGS['~/tare'].replace('both were', 'all were'),
    '~/solve_latest': MEANINGS['~/solve_latest'].replace('pair received', 'tensions received'),
}
"""The same for the estimator of an arm"""


class Kind(NamedTuple):
    """A node whose reference is printed."""

    make: Callable[..., AbstractContextManager[Node]]
    wiring: Sequence[Parameter]
    meanings: Mapping[str, str]


KINDS = {
    'unit': Kind(estimator, WIRING, MEANINGS),
    'arm': Kind(arm_estimator, ARM_WIRING, MEANINGS_OF_ARM),
}

OF_ROS = ('/rosout', '/parameter_events', '~/transition_event')
"""Topics that every managed node has; ROS's own services are recognised by their types"""

OWN_SERVICES = ('tendon_statics_interfaces/', 'std_srvs/')
"""Packages of the services that are not ROS's own"""


def settings(wiring: Sequence[Parameter] = WIRING) -> Iterator[str]:
    """Each way to wire an estimator other than by default, one parameter at a time."""
    for parameter in wiring:
        if isinstance(parameter, ChoiceParameter):
            others = [choice for choice in parameter.choices if choice != parameter.default]
        elif isinstance(parameter, SwitchParameter):
            others = [str(not parameter.default).lower()]
        else:
            others = []
        yield from (f'{parameter.name}: {other}' for other in others)


def own_entities(node: Node) -> dict[tuple[str, str, str], str]:
    """What a node has besides ROS's own: (kind, name, type) → quality of service."""
    own = node.get_fully_qualified_name() + '/'
    found = {}
    for kind, endpoints in (('in', node.subscriptions), ('out', node.publishers)):
        for endpoint in endpoints:
            name = endpoint.topic_name.replace(own, '~/')
            qos = endpoint.qos_profile
            latched = qos.durability == DurabilityPolicy.TRANSIENT_LOCAL
            policies = [qos.reliability, *([qos.durability] if latched else [])]
            said = [policy.name.lower().replace('_', ' ') for policy in policies]
            quality = ', '.join([*said, str(qos.depth)])
            if name not in OF_ROS:
                found[kind, name, type_name(endpoint.msg_type)] = quality
    for service in node.services:
        interface = type_name(service.srv_type)
        if interface.startswith(OWN_SERVICES):
            found['service', service.service_name.replace(own, '~/'), interface] = ''
    return found


@cache
def reference(of: str = 'unit') -> list[tuple[str, str, str, str, str]]:
    """Kind, name, type, quality of service, and the setting required, of every entity."""
    make, wiring, meanings = KINDS[of]
    with make() as node:
        by_default = own_entities(node)
    rows = [(*key, quality, '') for key, quality in by_default.items()]
    for setting in settings(wiring):
        name, _, value = setting.partition(': ')
        # In quotes, since y alone is true in YAML; a switch is no text.
        value = value if value in ('true', 'false') else json.dumps(value)
        with make(f'{name}:={value}') as node:
            more = {k: v for k, v in own_entities(node).items() if k not in by_default}
        rows += [(*key, quality, f'`{setting}`') for key, quality in more.items()]
    if odd := {shown(name) for _, name, *_ in rows} ^ meanings.keys():
        raise RuntimeError(f'MEANINGS in {__file__} and the node differ in {sorted(odd)}')
    return rows


def shown(name: str) -> str:
    """A name as a page shows it: without the leading ``/`` of the node's namespace."""
    return name if name == '/diagnostics' else name.removeprefix('/')


def table(kind: str, of: str = 'unit') -> str:
    """Lay out all entities of a kind, in the order of the meanings, one line for each name."""
    meanings = KINDS[of].meanings
    order = list(meanings)
    by_name: dict[str, list[tuple[str, str, str]]] = {}
    for of_kind, name, interface, quality, setting in reference(of):
        if of_kind == kind:
            row = (f'`{interface.replace("/msg/", "/").replace("/srv/", "/")}`', quality, setting)
            by_name.setdefault(shown(name), []).append(row)
    lines = []
    for name in sorted(by_name, key=order.index):
        rows = by_name[name]
        types = list(dict.fromkeys(interface for interface, _, _ in rows))
        with_settings = [setting for *_, setting in rows]
        needed = ' or '.join(with_settings) if all(with_settings) else ''
        if len(types) > 1:
            types = [f'{a} with {setting}' if setting else a for a, _, setting in rows]
            needed = ''
        (quality,) = {quality for _, quality, _ in rows}
        cells = (f'`{name}`', ', or '.join(types), quality, needed, meanings[name])
        lines.append(cells[:2] + cells[4:] if kind == 'service' else cells)
    if kind == 'service':
        return markdown_table(('service', 'type', 'meaning'), lines)
    return markdown_table(('topic', 'type', 'quality, depth', 'only with', 'meaning'), lines)


def definition(name: str) -> str:
    """Return a message or service as its file defines it."""
    return (INTERFACES / name).read_text(encoding='utf-8').strip()


def main(what: str, of: str = 'unit') -> None:
    """Print a table (``in``, ``out`` or ``service``), or a file of interfaces/.

    With ``arm`` after it, the table is that of the estimator of an arm.
    """
    print(table(what, of) if what in ('in', 'out', 'service') else definition(what))


if __name__ == '__main__':
    main(*sys.argv[1:])
