"""What of the quality of service of a topic can be overridden at the start, by parameters."""

from __future__ import annotations

from rclpy.qos import QoSPolicyKind

OVERRIDABLE = (
    QoSPolicyKind.HISTORY,
    QoSPolicyKind.DEPTH,
    QoSPolicyKind.RELIABILITY,
    QoSPolicyKind.DURABILITY,
)
"""ROS's default for this, and the durability: whether who joins later hears the last messages"""
