"""Make docs/view.png: the live page, as Chromium shows it, after most of a minute."""

from __future__ import annotations

import sys
from io import BytesIO
from pathlib import Path

from browser import BrowserMissingError, chromium
from live_rig import live_rig
from PIL import Image

PICTURE = Path(__file__).resolve().parents[1] / 'docs' / 'view.png'

SAMPLES = 500
"""Drawn before the picture is taken, of which most of a minute has room"""

FULL = f"""(page) => {{
  const data = (name) => page.get_model_by_name(name).data
  return data("history").time.length > {SAMPLES} && data("body").angle.length > 0 &&
    Number.isFinite(data("history").slip_margin.at(-1))
}}"""
"""Whether there is a minute to see, and a unit at an angle"""


def main() -> None:
    """Write the picture."""
    with live_rig() as rig, chromium() as browser:
        page = browser.new_page(viewport={'width': 1280, 'height': 900})
        page.goto(rig.url)
        page.wait_for_function(
            f'window.Bokeh && Bokeh.documents.length > 0 && ({FULL})(Bokeh.documents[0])',
            timeout=120e3,
        )
        shot = BytesIO(page.screenshot(full_page=True))
    # Few colours, of which the rare ones count too: those of the regimes.
    method = Image.Quantize.MAXCOVERAGE
    Image.open(shot).convert('RGB').quantize(256, method).save(PICTURE, optimize=True)
    print(f'{PICTURE.name}: {PICTURE.stat().st_size / 1024:.0f} kB')


if __name__ == '__main__':
    try:
        main()
    except (BrowserMissingError, RuntimeError, TimeoutError) as error:
        sys.exit(f'no picture: {error}')
