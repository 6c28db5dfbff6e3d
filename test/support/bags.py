"""Bags for tests, written by another library than the one that reads them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from make_docs import ROOT
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
ESTIMATE = 'tendon_statics_interfaces/msg/Estimate'
STORE.register(
    get_types_from_msg(
        (ROOT / 'interfaces/msg/Estimate.msg').read_text(encoding='utf-8'), ESTIMATE
    )
)
ORIGIN = 1_700_000_000_000_000_000
"""ns"""


def array(*data: float) -> Any:
    """A ``Float64MultiArray``."""
    layout = STORE.types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0)
    return STORE.types['std_msgs/msg/Float64MultiArray'](layout=layout, data=np.array(data))


def number(value: float) -> Any:
    """A ``Float64``."""
    return STORE.types['std_msgs/msg/Float64'](data=value)


def text(value: str) -> Any:
    """A ``String``."""
    return STORE.types['std_msgs/msg/String'](data=value)


def header(time: float | None, origin: int = ORIGIN) -> Any:
    """A header with a stamp in s after an origin in ns, or none."""
    stamp = STORE.types['builtin_interfaces/msg/Time']
    nanoseconds = 0 if time is None else origin + round(time * 1e9)
    seconds, rest = divmod(nanoseconds, 10**9)
    return STORE.types['std_msgs/msg/Header'](
        stamp=stamp(sec=seconds, nanosec=rest), frame_id='joint'
    )


def joint_state(
    names: Iterable[str],
    effort: Iterable[float] = (),
    position: Iterable[float] = (),
    time: float | None = None,
    origin: int = ORIGIN,
) -> Any:
    """A ``JointState``."""
    return STORE.types['sensor_msgs/msg/JointState'](
        header=header(time, origin),
        name=list(names),
        position=np.array(list(position)),
        velocity=np.array([]),
        effort=np.array(list(effort)),
    )


def wrench(x: float, y: float, z: float, time: float) -> Any:
    """A ``WrenchStamped``."""
    vector = STORE.types['geometry_msgs/msg/Vector3']
    force, torque = vector(x=x, y=y, z=z), vector(x=0.0, y=0.0, z=0.0)
    return STORE.types['geometry_msgs/msg/WrenchStamped'](
        header=header(time),
        wrench=STORE.types['geometry_msgs/msg/Wrench'](force=force, torque=torque),
    )


def quaternion(x: float, y: float, z: float, w: float) -> Any:
    """A ``Quaternion``."""
    return STORE.types['geometry_msgs/msg/Quaternion'](x=x, y=y, z=z, w=w)


def pose(orientation: Any, time: float) -> Any:
    """A ``PoseStamped`` at the origin."""
    point = STORE.types['geometry_msgs/msg/Point'](x=0.0, y=0.0, z=0.0)
    return STORE.types['geometry_msgs/msg/PoseStamped'](
        header=header(time),
        pose=STORE.types['geometry_msgs/msg/Pose'](position=point, orientation=orientation),
    )


def imu(time: float, orientation: Any = None, acceleration: Iterable[float] = (0, 0, 9.81)) -> Any:
    """An ``Imu``; without an orientation, as REP 145 says it."""
    vector = STORE.types['geometry_msgs/msg/Vector3']
    x, y, z = (float(part) for part in acceleration)
    unknown = np.zeros(9)
    if orientation is None:
        unknown[0] = -1.0
    return STORE.types['sensor_msgs/msg/Imu'](
        header=header(time),
        orientation=orientation or quaternion(0.0, 0.0, 0.0, 0.0),
        orientation_covariance=unknown,
        angular_velocity=vector(x=0.0, y=0.0, z=0.0),
        angular_velocity_covariance=np.zeros(9),
        linear_acceleration=vector(x=x, y=y, z=z),
        linear_acceleration_covariance=np.zeros(9),
    )


def estimate(tension_l: float, tension_s: float, time: float) -> Any:
    """An ``Estimate`` with nothing in it but the tensions."""
    _, fields = STORE.fielddefs[ESTIMATE]
    values: dict[str, Any] = {name: 0.0 for name, _ in fields}
    truths = ('angle_assured', 'load_assured', 'stable', 'branch_consistent')
    values |= dict.fromkeys(truths, False)
    values |= dict.fromkeys(('root_count', 'iterations'), 0)
    values |= {
        'header': header(time),
        'regime': '',
        'contact_law': '',
        'admissible_angles': np.array([]),
    }
    values |= {'tension_l': tension_l, 'tension_s': tension_s}
    return STORE.types[ESTIMATE](**values)


def write_bag(
    folder: Path, messages: Iterable[tuple[str, float, Any]], plugin: str = 'MCAP'
) -> Path:
    """Write messages, each with topic and time of recording in s after `ORIGIN`.

    Returns the bag's file in the folder.
    """
    with Writer(folder, version=9, storage_plugin=StoragePlugin[plugin]) as writer:
        connections: dict[str, Any] = {}
        for topic, time, message in messages:
            kind = message.__msgtype__
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=STORE)
            data = STORE.serialize_cdr(message, kind)
            writer.write(connections[topic], ORIGIN + round(time * 1e9), data)
    (file,) = [path for path in folder.iterdir() if path.suffix != '.yaml']
    return file
