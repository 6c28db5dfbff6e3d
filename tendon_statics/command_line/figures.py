"""How every figure of the project looks and is written."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from ..estimation.regimes import red_green_blue
from ..files.output_file import output_file
from .options import UsageError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ('.pdf', '.png', '.svg')

SIZE = (6.4, 4.0)
"""Width and height in inches, unless a figure has its own"""

# Okabe and Ito's palette, distinct with any colour vision and in grey print.
BLUE, ORANGE, GREEN, VERMILION = '#0072B2', '#E69F00', '#009E73', '#D55E00'
SKY, GREY = '#56B4E9', '#999999'

TENSION_L, TENSION_S = GREEN, ORANGE
"""Colours of the cables' tensions, in the layouts for other programs too"""

HOLDS = '#cfe3f1'
"""Colour of the angles and margins that friction can hold"""

_STYLE = {
    'axes.axisbelow': True,
    'axes.grid': True,
    'axes.spines.right': False,
    'axes.spines.top': False,
    'figure.constrained_layout.use': True,
    'font.size': 10,
    'grid.color': '#dddddd',
    'lines.linewidth': 1.8,
    'savefig.dpi': 150,
    # The same data make the same file.
    'svg.hashsalt': 'tendon_statics',
}

Result = TypeVar('Result')


def pale(colour: str) -> str:
    """Return a colour such as ``#56B4E9`` as an area has it, below lines and letters."""
    parts = (0.4 * part + 0.6 for part in red_green_blue(colour))
    return '#' + ''.join(f'{round(255 * part):02x}' for part in parts)


@contextmanager
def _styled(size: tuple[float, float]) -> Iterator[Figure]:
    """Give a figure to draw on.

    Raises
    ------
    UsageError
        If matplotlib is missing.
    """
    try:
        import matplotlib as mpl

        from .laid_out_figure import LaidOutFigure
    except ImportError:
        raise UsageError(
            'figures need matplotlib: install python3-matplotlib or pip install matplotlib'
        ) from None
    with mpl.rc_context(_STYLE):
        yield LaidOutFigure(figsize=size)


def write_figure(
    path: Path, draw: Callable[[Figure], Result], size: tuple[float, float] = SIZE
) -> Result:
    """Draw a figure and write it to `path`, by its ending; return what `draw` does.

    Raises
    ------
    UsageError
        If the ending is not one of `FORMATS`, or matplotlib is missing.
    OutputError
        If the file cannot be written.
    """
    if path.suffix not in FORMATS:
        raise UsageError(f'{path}: a figure is written to a file ending in {", ".join(FORMATS)}')
    with _styled(size) as drawing:
        result = draw(drawing)
        metadata = {'Date': None} if path.suffix == '.svg' else {}
        with output_file(path) as temporary:
            drawing.savefig(temporary, metadata=metadata)
    return result


def svg_of(draw: Callable[[Figure], object], size: tuple[float, float] = SIZE) -> str:
    """Draw a figure and return it as an SVG element, to stand within a page.

    Raises
    ------
    UsageError
        If matplotlib is missing.
    """
    with _styled(size) as drawing:
        draw(drawing)
        text = StringIO()
        drawing.savefig(text, format='svg', metadata={'Date': None})
    return text.getvalue()[text.getvalue().index('<svg') :]
