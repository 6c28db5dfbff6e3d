"""How a script of the user ends by Ctrl-C."""

from __future__ import annotations

from ros_programs import Program

RACE = 'RCLError: failed to initialize wait set: the given context is not valid'
"""What rclpy raises of itself if its context ends just before it waits; no script can help it"""


def assert_ends_by_ctrl_c(program: Program) -> None:
    """Assert that a script runs until Ctrl-C, and then says no more and exits with 0."""
    assert program.process.poll() is None, program.output()
    code = program.end()
    said = program.output()
    if RACE in said.splitlines()[-1]:
        return
    assert code == 0, said
    # Neither a traceback, nor what rclpy says of a callback that failed.
    assert 'Traceback' not in said
    assert 'exception' not in said
