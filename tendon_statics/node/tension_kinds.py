"""The kinds of messages that tensions come in, by name; it needs no ROS."""

TENSION_SOURCES = ('array', 'joint_state', 'wrench_pair')
"""What the parameter ``tension_source`` may be; the first is the default."""
