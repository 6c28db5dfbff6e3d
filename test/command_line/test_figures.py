"""What figures show, where a look at the file would not tell."""

import argparse
import io

import numpy as np
import pytest
from matplotlib import rc_context
from matplotlib.figure import Figure

from tendon_statics.command_line import figure_hysteresis, figure_map, figure_unit
from tendon_statics.command_line.laid_out_figure import LaidOutFigure
from tendon_statics.physics import paper


def drawn(figure, *arguments):
    """The axes of a figure, drawn with arguments of the command line."""
    parser = argparse.ArgumentParser()
    figure.add_arguments(parser)
    drawing = Figure(figsize=getattr(figure, 'SIZE', (6.4, 4.0)))
    figure.draw(drawing, parser.parse_args(arguments))
    return drawing.axes[0]


@pytest.mark.parametrize('tensions', [('1', '2'), ('0.5', '0.6'), ('4', '4')])
def test_slips_of_the_hysteresis_are_upright_and_inside_the_frame(tensions):
    axes = drawn(figure_hysteresis, '--tension-l', tensions[0], '--tension-s', tensions[1])
    path = axes.lines[0]
    assert path.get_drawstyle() == 'steps-post'
    low, high = axes.get_xlim()
    assert low < min(path.get_xdata())
    assert max(path.get_xdata()) < high
    slips = np.flatnonzero(np.abs(np.diff(path.get_ydata())) > 1.0)
    assert len(slips) >= 2


GRID = ('--tension-l-range', '0.8', '1.2', '--tension-s-range', '1.6', '2.4', '--points', '41')


@pytest.mark.parametrize('quantity', list(figure_map.QUANTITIES))
def test_a_map_marks_the_published_case_and_sets_the_stop_apart(quantity):
    axes = drawn(figure_map, *GRID, '--quantity', quantity)
    (mark,) = axes.lines
    assert (*mark.get_xdata(), *mark.get_ydata()) == (paper.TENSION_L, paper.TENSION_S)
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert any('stop' in label for label in labels) == (quantity != 'pressure')


def test_a_map_elsewhere_marks_nothing():
    assert not drawn(figure_map, '--tension-l-range', '2', '3', '--points', '21').lines


@pytest.mark.parametrize(
    ('figure', 'ending'), [(figure_hysteresis, 'svg'), (figure_map, 'png'), (figure_unit, 'pdf')]
)
def test_a_figure_that_is_drawn_once_is_what_is_drawn_twice(figure, ending):
    def written(kind):
        parser = argparse.ArgumentParser()
        figure.add_arguments(parser)
        file = io.BytesIO()
        metadata = {'png': None, 'svg': {'Date': None}, 'pdf': {'CreationDate': None}}[ending]
        with rc_context({'figure.constrained_layout.use': True, 'svg.hashsalt': 'a'}):
            drawing = kind()
            few = ('--points', '11') if figure is figure_map else ()
            figure.draw(drawing, parser.parse_args(few))
            drawing.savefig(file, format=ending, metadata=metadata)
        return file.getvalue()

    assert written(LaidOutFigure) == written(Figure)
