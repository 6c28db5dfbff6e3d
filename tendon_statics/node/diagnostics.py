"""What the estimator says on ``/diagnostics``."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from ..estimation.health import Health, Level
from .inputs.load import LoadInputs
from .inputs.subscriptions import Subscriptions
from .outputs.publishers import Outputs

if TYPE_CHECKING:
    from .managed_estimator import ManagedEstimator

_LEVELS = {
    Level.OK: DiagnosticStatus.OK,
    Level.WARN: DiagnosticStatus.WARN,
    Level.STALE: DiagnosticStatus.STALE,
    Level.ERROR: DiagnosticStatus.ERROR,
}


def status_of(
    health: Health,
    name: str,
    hardware_id: str,
    publishers: Mapping[str, int],
    *,
    more: Mapping[str, str] | None = None,
    findings: Iterable[str] = (),
    one_publisher: bool = True,
    note: str = '',
) -> DiagnosticStatus:
    """Say how the estimator is.

    Parameters
    ----------
    publishers : mapping
        Topic that tensions come on → number of its publishers.
    more : mapping
        What else was counted, by what it is.
    findings : iterable of str
        What else is not as it should be, each a warning.
    one_publisher : bool
        Whether each topic is to have one publisher alone.
    note : str
        In place of what there is to say, if there is one.
    """
    found = health.findings()
    level = Level.STALE if note else health.level
    warnings = [
        f'{count} publishers on {topic}, one is expected'
        for topic, count in publishers.items()
        if count > 1 and one_publisher
    ]
    warnings += findings
    if warnings:
        level = max(level, Level.WARN)
    said = found + warnings
    if said and health.worst_part:
        said.append(health.worst_part)
    values = {
        **health.values(),
        **{f'publishers on {topic}': str(count) for topic, count in publishers.items()},
        **(more or {}),
    }
    return DiagnosticStatus(
        level=_LEVELS[level],
        name=name,
        message=note or '; '.join(said) or health.summary or 'no tensions came yet',
        hardware_id=hardware_id,
        values=[KeyValue(key=key, value=value) for key, value in values.items()],
    )


class Reports:
    """Reports each second, and at once what got worse."""

    def __init__(
        self,
        node: ManagedEstimator[Any, Any],
        outputs: Outputs,
        inputs: Subscriptions,
        load: LoadInputs,
    ) -> None:
        self._node = node
        self._outputs = outputs
        self._inputs = inputs
        self._load = load
        self._reported_level = Level.OK

    def report_period(self) -> None:
        """Report, and forget what is reported only once."""
        health = self._node.health
        if health.counts_lost and (count := self._inputs.settle_losses()):
            health.note_lost(count)
        health.look_closer()
        self.report()
        health.begin_period()
        self._load.begin_period()
        self._reported_level = health.level

    def report_change(self, *, recovered: bool = False) -> None:
        """Report at once what got worse, or that tensions come again; the rest can wait.

        So a regime that changes with every message does not flood ``/diagnostics``.
        """
        for remark in self._node.health.take_what_is_to_log():
            self._node.get_logger().warning(f'{remark.value[0].upper()}{remark.value[1:]}')
        if recovered or self._node.health.level > self._reported_level:
            self.report()

    def report(self, note: str = '') -> None:
        """Report now, a note in place of what there is to say, if there is one."""
        node, health = self._node, self._node.health
        self._reported_level = health.level
        health.counts_lost &= self._inputs.losses_are_counted
        status = status_of(
            health,
            f'{node.get_fully_qualified_name().lstrip("/")}: estimation',
            node.wiring.hardware_id,
            self._inputs.publishers_of_tensions(),
            more={**self._load.values(), **node.values_to_report()},
            findings=(
                *self._load.findings(time.monotonic()),
                *self._inputs.misfits(),
                *filter(None, (node.changes.misfit, self._namesakes())),
            ),
            one_publisher=self._inputs.expects_one_publisher,
            note=note,
        )
        self._outputs.report(status)

    def _namesakes(self) -> str:
        """Say that others have the node's name; empty if none has."""
        own = self._node.get_fully_qualified_name()
        names = self._node.get_node_names_and_namespaces()
        count = sum(f'{namespace.rstrip("/")}/{name}' == own for name, namespace in names)
        if count < 2:
            return ''
        return (
            f'{count} nodes are called {own}, and each publishes; one that was killed is known '
            'for a while yet'
        )
