"""The server of the page: who may open it, and where."""

from __future__ import annotations

import asyncio
import logging
import socket
from collections.abc import Callable, Iterable

from bokeh.application import Application
from bokeh.application.handlers.function import FunctionHandler
from bokeh.document import Document
from bokeh.server.server import BaseServer
from bokeh.server.tornado import BokehTornado
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop
from tornado.netutil import bind_sockets

from ..node.program import StartError

LINGER = 10_000
"""ms that a page without a connection is kept: it may still be loading, or come back"""

LOOK_FOR_UNUSED = 1_000
"""ms between two looks for such pages"""


class PageServer:
    """Serves one page, made anew for each browser that opens it.

    All of its scripts come from this server, so that it works without the internet.

    Parameters
    ----------
    make_page : callable
        Puts a page into a document.
    address, port
        Where it listens; port 0 is any that is free.
    hosts
        Names by which browsers may call it, each with a port or ``*``.

    Raises
    ------
    StartError
        If it cannot listen there.
    """

    def __init__(
        self,
        make_page: Callable[[Document], None],
        address: str,
        port: int,
        hosts: Callable[[int], Iterable[str]],
    ) -> None:
        # Of its own, since a node may be made more than once in a process.
        self._events = asyncio.new_event_loop()
        asyncio.set_event_loop(self._events)
        self.loop = IOLoop.current()
        try:
            sockets = bind_sockets(port, address)
        except (OSError, UnicodeError) as error:
            self._end_loop()
            reason = getattr(error, 'strerror', None) or error
            raise StartError(
                f'address {address!r} with port {port} cannot be used ({reason}): '
                'choose others, for example -p port:=8781'
            ) from None
        self.port: int = sockets[0].getsockname()[1]
        # Bad requests and browsers that went away are not worth a message of this node.
        for name in ('tornado.access', 'bokeh.server.views.ws'):
            logging.getLogger(name).setLevel(logging.ERROR)
        application = BokehTornado(
            {'/': Application(FunctionHandler(make_page))},
            extra_websocket_origins=list(hosts(self.port)),
            unused_session_lifetime_milliseconds=LINGER,
            check_unused_sessions_milliseconds=LOOK_FOR_UNUSED,
            # No pings. One to a tab that has just been closed takes its session away before bokeh
            # has read what the tab still sent, and each of that is an error; and a page that is
            # drawn many times a second needs nothing else to keep its connection.
            keep_alive_milliseconds=0,
        )
        http = HTTPServer(application)
        http.add_sockets(sockets)
        self._server = BaseServer(self.loop, application, http)
        self._server.start()

    def close(self) -> None:
        """Let go of the port and of all pages."""
        self._server.stop()
        self._end_loop()

    def _end_loop(self) -> None:
        self.loop.close(all_fds=True)
        asyncio.set_event_loop(None)


def allowed_hosts(address: str, own_machine: str, host: str) -> Callable[[int], list[str]]:
    """Return which hosts a page may be called by, as a function of the port.

    Any other web page that a browser shows is kept from reading this one. Through SSH the browser
    calls it by its own name for itself, and by any port.
    """

    def hosts(port: int) -> list[str]:
        through_ssh = ['localhost:*', '127.0.0.1:*']
        if address == own_machine:
            return through_ssh
        names = {address, socket.gethostname(), socket.getfqdn(), host} - {''}
        addresses = ['*.*.*.*'] if address == '0.0.0.0' else []
        return [*through_ssh, *(f'{name.lower()}:{port}' for name in (*sorted(names), *addresses))]

    return hosts
