"""How every figure of the project looks and is written."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..output_file import output_file
from .options import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMATS = ('.pdf', '.png', '.svg')

# Okabe and Ito's palette, told apart with any colour vision and in grey print.
BLUE, ORANGE, GREEN, VERMILION = '#0072B2', '#E69F00', '#009E73', '#D55E00'

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


@contextmanager
def figure(path: Path, width: float = 6.4, height: float = 4.0) -> Iterator[Axes]:
    """Give axes to draw on; write them to `path` by its ending. Width and height in inches.

    Raises
    ------
    UsageError
        If the ending is not one of `FORMATS`, or matplotlib is missing.
    OutputError
        If the file cannot be written.
    """
    if path.suffix not in FORMATS:
        raise UsageError(f'{path}: a figure is written to a file ending in {", ".join(FORMATS)}')
    try:
        import matplotlib as mpl
        from matplotlib.figure import Figure
    except ImportError:
        raise UsageError(
            'figures need matplotlib: install python3-matplotlib or pip install matplotlib'
        ) from None
    with mpl.rc_context(_STYLE):
        drawing = Figure(figsize=(width, height))
        yield drawing.subplots()
        metadata = {'Date': None} if path.suffix == '.svg' else {}
        with output_file(path) as temporary:
            drawing.savefig(temporary, metadata=metadata)
