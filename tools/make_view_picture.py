"""Make docs/view.png and docs/view_arm.png: the live page after most of a minute, in Chromium."""

from __future__ import annotations

import sys
from io import BytesIO
from pathlib import Path

from browser import BrowserMissingError, chromium
from live_rig import live_rig
from PIL import Image
from playwright.sync_api import Browser

DOCS = Path(__file__).resolve().parents[1] / 'docs'

OF_UNIT = """
  data("history").time.length > 500 && data("body").angle.length > 0 &&
    Number.isFinite(data("history").slip_margin.at(-1))
"""
"""Whether most of a minute is to be seen, and a unit at an angle"""

OF_ARM = """
  data("arm_history")?.time.length > 250 &&
    Math.abs(data("arm_history").tip_x.at(-1)) > 10
"""
"""Whether most of a minute is to be seen, and an arm that is bent"""


def main() -> None:
    """Write the pictures."""
    with chromium() as browser:
        take(browser, DOCS / 'view.png', OF_UNIT, is_arm=False)
        take(browser, DOCS / 'view_arm.png', OF_ARM, is_arm=True)


def take(browser: Browser, path: Path, condition: str, *, is_arm: bool) -> None:
    """Write the picture of the page of a unit or an arm once something holds in the browser."""
    with live_rig(is_arm=is_arm) as rig:
        page = browser.new_page(viewport={'width': 1280, 'height': 900})
        page.goto(rig.url)
        page.wait_for_function(
            'window.Bokeh && Bokeh.documents.length > 0 && ((data) => '
            f'{condition})'
            '((name) => Bokeh.documents[0].get_model_by_name(name)?.data)',
            timeout=300e3,
        )
        shot = BytesIO(page.screenshot(full_page=True))
        page.close()
    picture = Image.open(shot).convert('RGB')
    # Areas keep their colours; only what softens the edges of letters has to take the nearest.
    counts = sorted(picture.getcolors(picture.width * picture.height), reverse=True)
    palette = Image.new('P', (1, 1))
    palette.putpalette([part for _, colour in counts[:256] for part in colour])
    picture.quantize(palette=palette, dither=Image.Dither.NONE).save(path, optimize=True)
    print(f'{path.name}: {path.stat().st_size / 1024:.0f} kB')


if __name__ == '__main__':
    try:
        main()
    except (BrowserMissingError, RuntimeError, TimeoutError) as error:
        sys.exit(f'no picture: {error}')
