"""How a script of the user ends by Ctrl-C."""

from __future__ import annotations

from ros_programs import Program

RACES = (
    'RCLError: failed to initialize wait set: the given context is not valid',
    'never retrieved: cannot use Destroyable because destruction was requested',
)
"""What rclpy says now and then, as its context ends while it works; no script can help it"""


def assert_ends_by_ctrl_c(program: Program) -> None:
    """Assert that a script runs until Ctrl-C, and then says no more and exits with 0."""
    assert program.process.poll() is None, program.output()
    code = program.end()
    said = program.output()
    if any(race in said.splitlines()[-1] for race in RACES):
        return
    assert code == 0, said
    # Neither a traceback, nor what rclpy says of a callback that failed.
    assert 'Traceback' not in said
    assert 'exception' not in said
