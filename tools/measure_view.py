"""Measure what the live page costs the processor while tensions come at 500 Hz."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable

from browser import BrowserMissingError, Drawings, chromium
from live_rig import LiveRig, live_rig

from tendon_statics.command_line.tables import markdown_table

RATE = 500.0
"""Hz"""

ALLOWED = 0.25
"""Share of a core that one page may take"""

MOST_DRAWINGS = 20.0
"""Per second"""

SETTLING = 12.0
"""Seconds after which a page is loaded, or is gone"""


def main() -> int:
    """Print the table; return 1 if more is taken than is allowed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        '--seconds', type=float, default=20.0, help='of each measurement; default: %(default)s'
    )
    parser.add_argument('--arm', action='store_true', help='of an arm, in place of a unit')
    options = parser.parse_args()
    seconds = options.seconds
    with (
        live_rig(rate=RATE, estimation='tracking', is_arm=options.arm) as rig,
        chromium() as browser,
    ):
        closed, _ = measured(rig, lambda: time.sleep(seconds))
        page = browser.new_page(viewport={'width': 1280, 'height': 900})
        drawings = Drawings(page)
        page.goto(rig.url)
        page.wait_for_timeout(1e3 * SETTLING)
        before = drawings.streamed
        # What comes to the browser is only counted while it is waited for.
        opened, of_estimator = measured(rig, lambda: page.wait_for_timeout(1e3 * seconds))
        drawn = (drawings.streamed - before) / seconds
        page.close()
        time.sleep(SETTLING)
        closed_again, _ = measured(rig, lambda: time.sleep(seconds))
    rows = [
        ('no page', f'{closed:.3f}', '0'),
        ('a page in Chromium', f'{opened:.3f}', f'{drawn:.1f}'),
        ('its tab closed', f'{closed_again:.3f}', '0'),
    ]
    print(markdown_table(('open', 'share of a core:', 'drawings per second:'), rows))
    print(f'\nThe estimator beside it takes {of_estimator:.3f} of a core, at {RATE:g} Hz.')
    print(f'Allowed are {ALLOWED:g} of a core and {MOST_DRAWINGS:g} drawings per second.')
    return int(opened > ALLOWED or drawn > 1.02 * MOST_DRAWINGS)


def measured(rig: LiveRig, wait: Callable[[], None]) -> tuple[float, float]:
    """Return the shares of a core that view and estimator take while it waits."""
    programs = (rig.view, rig.estimator)
    begin, before = time.monotonic(), [program.cpu_time() for program in programs]
    wait()
    took = time.monotonic() - begin
    taken = [program.cpu_time() for program in programs]
    view, estimator = ((b - a) / took for a, b in zip(before, taken, strict=True))
    return view, estimator


if __name__ == '__main__':
    try:
        sys.exit(main())
    except (BrowserMissingError, RuntimeError, TimeoutError) as error:
        sys.exit(f'not measured: {error}')
