"""What differs between the nodes of a unit and of an arm."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rclpy.lifecycle import LifecycleNode

from ..estimation.estimate import AnyEstimate
from ..estimation.health import Health
from ..estimation.measuring import Measuring
from ..estimation.reading_estimator import ReadingEstimator
from .inputs.tension_source import TensionSource
from .one_at_a_time import OneAtATime
from .outputs.committed import CommittedOutput
from .outputs.publishers import Outputs
from .parameters.table import NodeTable
from .wiring import CommonWiring

if TYPE_CHECKING:
    from .tip_force import TipForces

S = TypeVar('S', bound=Measuring)
E = TypeVar('E', bound=AnyEstimate)


class KindOfEstimator(LifecycleNode, Generic[S, E]):
    """What a kind of estimator has to say of itself; `ManagedEstimator` does the rest.

    Attributes
    ----------
    table : NodeTable
        Its parameters.
    left_out : set of str
        Parameters of the design that nobody has set.
    """

    table: NodeTable[S]
    left_out: set[str]
    # Made in `_connect`, where they are asked for.
    _committed: CommittedOutput | None = None
    _tip_forces: TipForces | None = None

    @cached_property
    def default_callback_group(self) -> OneAtATime:
        """The group of all that the node has; rclpy takes it from here."""
        return OneAtATime()

    @abstractmethod
    def _declare(self) -> None:
        """Declare the parameters; set `table`, and what `wiring` returns."""

    @property
    @abstractmethod
    def wiring(self) -> CommonWiring:
        """How it is connected."""

    def _new_health(self, *, counts_lost: bool) -> Health:
        return Health(counts_lost=counts_lost)

    @abstractmethod
    def _new_outputs(self) -> Outputs:
        """Make what publishes estimates."""

    @abstractmethod
    def _new_source(self, max_skew: Callable[[], float]) -> TensionSource:
        """Make what tensions come from."""

    @abstractmethod
    def _connect(self) -> None:
        """Add what else it listens to, publishes and answers."""

    @abstractmethod
    def _new_core(self, settings: S) -> ReadingEstimator[S, E]:
        """Make what estimates with settings."""

    @property
    @abstractmethod
    def bias_parameters(self) -> Mapping[str, str]:
        """Cable, as people know it → the parameter of its bias, in the order of the cables."""

    def values_of_settings(self) -> dict[str, Any]:
        """What ``~/solve_latest`` says of the settings."""
        return {}

    def values_to_report(self) -> dict[str, str]:
        """What ``/diagnostics`` has of this kind of node alone."""
        return {}
