"""What the parameters of every estimator say of how it is connected."""

from __future__ import annotations

from typing import Protocol


class CommonWiring(Protocol):
    """What is fixed while a node runs, whether it is of a unit or of an arm."""

    @property
    def estimation(self) -> str:
        """The way from tensions to an estimate."""

    @property
    def gravity_source(self) -> str:
        """Where gravity points."""

    @property
    def tip_wrench(self) -> bool:
        """Whether the force on the tip is measured."""

    @property
    def frame_id(self) -> str:
        """Of every stamped message."""

    @property
    def hardware_id(self) -> str:
        """In ``/diagnostics``."""

    @property
    def executor(self) -> str:
        """Which executor spins the node."""

    @property
    def service_depth(self) -> int:
        """Requests that wait at each service."""

    @property
    def autostart(self) -> bool:
        """Whether the node configures and activates itself."""
