"""A real browser without a window, for pages that this machine serves."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

NAMES = ('chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable')

OPTIONS = [
    # Nothing but this machine, so that whatever a page needs from elsewhere is missing.
    '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1, EXCLUDE localhost',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-gpu',
    '--disable-sync',
    '--no-first-run',
]


class BrowserMissingError(RuntimeError):
    """There is no Chromium here; the text says how to get one."""


@contextmanager
def chromium() -> Iterator[Browser]:
    """Run the Chromium of this machine, or else the one that Playwright has installed.

    Raises
    ------
    BrowserMissingError
        If there is neither.
    """
    program = next((found for name in NAMES if (found := shutil.which(name))), None)
    # Chromium's sandbox is refused to root.
    options = [*OPTIONS, *(['--no-sandbox'] if os.geteuid() == 0 else [])]
    with sync_playwright() as playwright:
        if program is None and not Path(playwright.chromium.executable_path).exists():
            raise BrowserMissingError(
                'no Chromium is on this machine: apt install chromium (Debian), or '
                'playwright install --with-deps chromium'
            )
        browser = playwright.chromium.launch(executable_path=program, args=options)
        try:
            yield browser
        finally:
            browser.close()


class Drawings:
    """Counts what a server sends to a Bokeh page; make it before the page is opened."""

    def __init__(self, page: Page) -> None:
        self.sent = 0
        """Messages of changes"""
        self.streamed = 0
        """Messages that move the lines on; there is one with each drawing of something new"""
        page.on('websocket', lambda socket: socket.on('framereceived', self._count))

    def _count(self, frame: object) -> None:
        text = str(frame)
        self.sent += '"PATCH-DOC"' in text
        self.streamed += '"ColumnsStreamed"' in text
