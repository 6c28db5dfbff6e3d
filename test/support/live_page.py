"""The live page as a browser shows it."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from socketserver import BaseRequestHandler, ThreadingTCPServer
from threading import Thread
from typing import Any

from browser import Drawings
from playwright.sync_api import Browser
from ros_programs import TIME_LIMIT, Program, wait_for

_MODEL = 'Bokeh.documents[0].get_model_by_name'


def view_url(view: Program) -> str:
    """Wait until a view serves its page, and return where."""
    wait_for('the page', lambda: 'Ready: ' in view.output() or view.process.poll() is not None)
    assert 'Ready: ' in view.output(), view.output()
    return view.output().split('Ready: ')[1].split()[0]


@contextmanager
def forwarded(url: str) -> Iterator[str]:
    """Serve a page at another port of this machine too, as `ssh -L` does; give that address."""
    host, port = url.removeprefix('http://').split(':')

    class Forward(BaseRequestHandler):
        def handle(self) -> None:
            with socket.create_connection((host, int(port))) as server:
                back = Thread(target=_pour, args=(server, self.request))
                back.start()
                _pour(self.request, server)
                back.join()

    with ThreadingTCPServer(('127.0.0.1', 0), Forward) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f'http://localhost:{server.server_address[1]}'
        finally:
            server.shutdown()
            thread.join()


def _pour(source: socket.socket, sink: socket.socket) -> None:
    with suppress(OSError):  # of a side that has gone
        while data := source.recv(65536):
            sink.sendall(data)
    with suppress(OSError):
        sink.shutdown(socket.SHUT_RDWR)


class LivePage:
    """One tab of a browser with the page in it; it is closed at the end of a `with`."""

    def __init__(self, browser: Browser, url: str, **options: Any) -> None:
        self.tab = browser.new_page(**options)
        self.tab.set_default_timeout(1e3 * TIME_LIMIT)
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.tab.on('request', lambda request: self.requests.append(request.url))
        self.tab.on('requestfailed', lambda request: self.errors.append(request.url))
        self.tab.on('pageerror', lambda error: self.errors.append(str(error)))
        self.drawings = Drawings(self.tab)
        self.tab.goto(url)
        self.tab.wait_for_function('window.Bokeh && Bokeh.documents.length > 0')

    def data(self, source: str) -> dict[str, Any]:
        """What a source of the page holds now, in the browser."""
        found: dict[str, Any] = self.tab.evaluate(
            f'const data = {_MODEL}("{source}").data;'
            'Object.fromEntries(Object.entries(data).map(([key, value]) => [key, [...value]]))'
        )
        return found

    def get(self, model: str, attribute: str) -> Any:
        """What a model of the page has, in the browser."""
        return self.tab.evaluate(f'{_MODEL}("{model}").{attribute}')

    def wait(self, condition: str) -> None:
        """Wait until something holds in the browser; `model("name")` is one of the page's."""
        self.tab.wait_for_function(
            f'(() => {{ const model = (name) => {_MODEL}(name); return {condition} }})()'
        )

    def wait_for_words(self, *words: str) -> None:
        """Wait until the page shows all of these words."""
        for word in words:
            self.tab.get_by_text(word).first.wait_for()

    def choose(self, estimator: str) -> None:
        """Choose in the drop-down."""
        self.tab.get_by_role('combobox').select_option(estimator)

    def press(self, label: str) -> None:
        """Press a button."""
        self.tab.get_by_role('button', name=label).click()

    def wait_for_drawings(self, count: int) -> None:
        """Wait until so many have come since the tab was opened."""

        def come() -> bool:
            # What comes to the browser is only counted while something is asked of it.
            self.tab.wait_for_timeout(20.0)
            return self.drawings.streamed >= count

        wait_for(f'{count} drawings', come)

    def __enter__(self) -> LivePage:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the tab."""
        self.tab.close()
