"""The kinds of messages that tensions come in."""

TENSION_SOURCES = ('array', 'joint_state', 'wrench_pair')
"""What the parameter ``tension_source`` may be; the first is the default."""

WRENCH_COMPONENTS = ('z', 'x', 'y', 'norm')
"""What the parameter ``wrench_component`` may be; the first is the default."""
