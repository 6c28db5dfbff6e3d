"""The unit at its angle, with what friction allows and where the angle is believed to be."""

from __future__ import annotations

import math
from typing import Any

from bokeh.models import ColumnDataSource

from ..physics import JointDesign, Load
from .drawing import (
    INK,
    LOADS,
    PALE,
    UPRIGHT,
    columns,
    draw_loads,
    empty_frame,
    loads_of,
    name_sides,
)
from .estimate_values import angle_interval, colour_of, load_of, pairs_of

# Lengths are in radii of the ball, so that units of every size fit the frame.
WIDTH, BOTTOM, TOP = 3.3, -1.7, 3.3
ARCS = (0.05, 0.25, 0.3, 0.42)
"""Where the arcs begin and end beyond the corners of the unit: the admissible band, then the
interval of the angle"""


class UnitFigure:
    """Draws one unit in its joint frame: Z upwards, X towards cable s to the right."""

    def __init__(self) -> None:
        self.root = empty_frame('unit', WIDTH, BOTTOM, TOP)
        self._base = ColumnDataSource({'width': [], 'height': [], 'y': []})
        self._stops = ColumnDataSource({'x': [], 'y': []})
        self._arcs = ColumnDataSource(_arcs([]), name='arcs')
        self._body = ColumnDataSource(_body(None, math.nan, ''), name='body')
        self._arrows = ColumnDataSource(columns(LOADS, []), name='arrows')
        self._drawn: Any = None
        self._glyphs()

    def _glyphs(self) -> None:
        plot = self.root
        plot.rect(x=0.0, y='y', width='width', height='height', color=PALE, source=self._base)
        plot.segment(
            x0=0.0, y0=0.0, x1='x', y1='y', color=INK, line_dash='dotted', source=self._stops
        )
        plot.annular_wedge(
            x=0.0,
            y=0.0,
            inner_radius='inner',
            outer_radius='outer',
            start_angle='start',
            end_angle='end',
            color='colour',
            fill_alpha='alpha',
            line_alpha=0.8,
            source=self._arcs,
        )
        plot.rect(
            x='x',
            y='y',
            width='width',
            height='height',
            angle='angle',
            fill_color='colour',
            fill_alpha=0.35,
            line_color='colour',
            line_width=2,
            source=self._body,
        )
        plot.segment(
            x0=0.0,
            y0=0.0,
            x1='tip_x',
            y1='tip_y',
            color=INK,
            line_width=2,
            line_dash='dashed',
            source=self._body,
        )
        plot.circle(x=0.0, y=0.0, radius=1.0, fill_color=PALE, line_color='#bbbbbb')
        name_sides(plot, 2.5, -1.5, 'cable')
        draw_loads(plot, self._arrows)

    def draw_design(self, design: JointDesign) -> None:
        """Draw what stays: the base and the stops."""
        reach = _reach(design) + ARCS[-1]
        self._base.data = {'width': [1.1], 'height': [1.4], 'y': [-0.8]}
        stops = (-design.max_bend_angle, design.max_bend_angle)
        self._stops.data = {
            'x': [reach * math.sin(stop) for stop in stops],
            'y': [reach * math.cos(stop) for stop in stops],
        }

    def draw(self, design: JointDesign, estimate: Any, *, present: bool = True) -> None:
        """Draw an estimate, grey if it is not of now; what it does not determine is left out."""
        angle, reach = estimate.bend_angle, _reach(design)
        band_inner, band_outer, inner, outer = (reach + beyond for beyond in ARCS)
        colour = colour_of(estimate, present=present)
        arcs = [
            (low, high, band_inner, band_outer, colour, 0.35)
            for low, high in pairs_of(list(estimate.admissible_angles))
        ]
        interval = angle_interval(estimate)
        if interval:
            arcs.append((*interval, inner, outer, INK, 0.6))
        load = load_of(estimate)
        new = arcs, angle, colour, load
        if new == self._drawn:
            return
        if self._drawn is None or arcs != self._drawn[0]:
            self._arcs.data = _arcs(arcs)
        self._body.data = _body(design, angle, colour)
        arrows = columns(LOADS, _loads(design, angle, load))
        if arrows != self._arrows.data:
            self._arrows.data = arrows
        self._drawn = new

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""
        self._base.data = {'width': [], 'height': [], 'y': []}
        self._stops.data = {'x': [], 'y': []}
        self._arcs.data = _arcs([])
        self._body.data = _body(None, math.nan, '')
        self._arrows.data = columns(LOADS, [])
        self._drawn = None


def _top(design: JointDesign) -> float:
    """How far the drawing of the unit reaches from the centre, in radii of the ball."""
    return min(max(1.6, 1.5 * abs(design.com_distance) / design.ball_radius), 2.0)


def _reach(design: JointDesign) -> float:
    """How far the corners of the drawn unit are from the centre, in radii of the ball."""
    return math.hypot(_top(design), _half_width(design))


def _half_width(design: JointDesign) -> float:
    return min(1.12 * (1.0 + design.cable_offset / design.ball_radius), 2.0)


def _arcs(rows: list[Any]) -> dict[str, list[Any]]:
    return columns(
        ('start', 'end', 'inner', 'outer', 'colour', 'alpha'),
        [(UPRIGHT - high, UPRIGHT - low, *look) for low, high, *look in rows],
    )


def _body(design: JointDesign | None, angle: float, colour: str) -> dict[str, list[Any]]:
    names = ('x', 'y', 'width', 'height', 'angle', 'tip_x', 'tip_y', 'colour')
    if design is None or not math.isfinite(angle):
        return columns(names, [])
    top, bottom = _top(design), 0.1
    height, middle = top - bottom, 0.5 * (top + bottom)
    reach = _reach(design) + ARCS[-1]
    sine, cosine = math.sin(angle), math.cos(angle)
    row = (
        middle * sine,
        middle * cosine,
        2.0 * _half_width(design),
        height,
        -angle,
        reach * sine,
        reach * cosine,
        colour,
    )
    return columns(names, [row])


def _loads(design: JointDesign, angle: float, load: Load | None) -> list[tuple[Any, ...]]:
    """Gravity in the corner, and the force where it acts, as far as that is known."""
    tip = None
    if load is not None and math.isfinite(angle):
        away = min(load.tip_distance / design.ball_radius, 1.3 * _top(design))
        tip = away * math.sin(angle), away * math.cos(angle)
    return loads_of(load, (-2.8, 2.6), tip, half=0.4, length=0.8)
