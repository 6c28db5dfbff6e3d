"""The node ``view``: a live page in the browser of what the estimators say."""

from __future__ import annotations

import os
from typing import Any

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from ..files.view_parameters import OWN_MACHINE, VIEW_PARAMETERS
from ..node.outputs.messages import INTERFACES_MISSING
from ..node.parameters.declaration import declare_all
from ..node.parameters.unknown import warn_of_unknown_parameters
from ..node.program import StartError
from .ros_job import ros_job

TICK = 0.1
"""Seconds between two looks at signals, services and answers"""

MOST_IN_A_TICK = 5
"""Services and answers that are taken in one look"""


class View(Node):
    """Serves the page, and hears the estimators that somebody looks at.

    It only reads: it publishes nothing of its own, and of services it calls those alone that read
    parameters. While no page is open it hears nothing either.

    Raises
    ------
    StartError
        If a library is missing, or the port is taken.
    """

    executor_kind = 'own'

    def __init__(self) -> None:
        super().__init__('view')
        values = declare_all(self, VIEW_PARAMETERS)
        warn_of_unknown_parameters(self)
        if INTERFACES_MISSING:
            raise StartError(
                f'the page needs tendon_statics_interfaces, which is not there: '
                f'{INTERFACES_MISSING}; build the package in interfaces/'
            )
        try:
            from .page import Page
            from .server import PageServer, allowed_hosts
            from .watch import Watches
        except ModuleNotFoundError as error:
            raise StartError(
                f'the page needs Bokeh, and {error}: pip install bokeh, or in the folder of '
                "tendon_statics: pip install '.[view]'"
            ) from None
        self.watches = Watches(self, values['rate'])
        self._rate = values['rate']
        self._own_executor = SingleThreadedExecutor(context=self.context)
        self._own_executor.add_node(self)

        def make_page(document: Any) -> None:
            Page(document, self, self.watches, values['rate'], values['estimator'])

        address = values['address']
        self.server = PageServer(
            make_page,
            address,
            values['port'],
            allowed_hosts(address, OWN_MACHINE, values['host']),
        )
        self.port = self.server.port
        if address != OWN_MACHINE:
            self.get_logger().warning(
                f'Anyone who can reach {address} can see the page: it has no password and is not '
                'encrypted. Through SSH the default address is enough'
            )
        self.get_logger().info(f'Ready: http://{address}:{self.port}')

    @property
    def domain(self) -> str:
        """The ROS domain, as a person reads it."""
        return os.environ.get('ROS_DOMAIN_ID') or '0'

    def spin(self) -> None:
        """Serve until the context ends, in one thread with all that it hears."""
        from tornado.ioloop import PeriodicCallback

        jobs = (
            PeriodicCallback(self._tend, 1e3 * TICK),
            PeriodicCallback(ros_job(self.context, self._poll), 1e3 / self._rate),
        )
        for job in jobs:
            job.start()
        self.server.loop.start()

    def _tend(self) -> None:
        try:
            for _ in range(MOST_IN_A_TICK if self.watches else 1):
                if not self.context.ok():
                    break
                self._own_executor.spin_once(timeout_sec=0.0)
        except ExternalShutdownException:
            pass
        if not self.context.ok():
            self.server.loop.stop()

    def _poll(self) -> None:
        if self.watches:
            self.watches.poll()

    def destroy_node(self) -> None:
        """Close the pages, let go of the port, and destroy the node."""
        if hasattr(self, 'server'):
            self.watches.close()
            self.server.close()
            self._own_executor.shutdown()
        super().destroy_node()
