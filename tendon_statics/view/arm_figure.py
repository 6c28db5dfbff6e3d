"""The arm at its angles, with what friction allows and where all of it is believed to be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Any, NamedTuple

from bokeh.models import ColumnDataSource

from ..physics import Arm
from ..physics.arm.shape import joint_centres
from .arm_values import joints_said, tip_said
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
from .estimate_values import colour_of_regime, load_of, regime_named

# Lengths are in those of the straight arm, so that arms of every size fit the frame.
WIDTH, BOTTOM, TOP = 1.2, -0.5, 1.15
BAND, FAN = 1.3, 0.8
"""How far the stops of a joint and its admissible band are drawn, and the interval of its angle:
in lengths of its unit"""

SOURCES = {
    'units': ('x0', 'z0', 'x1', 'z1', 'colour'),
    'joints': ('x', 'z', 'radius'),
    'bands': ('x', 'z', 'radius', 'start', 'end', 'colour'),
    'fans': ('x', 'z', 'radius', 'start', 'end'),
    'stops': ('x0', 'z0', 'x1', 'z1'),
    'tip': ('left', 'right', 'bottom', 'top'),
    'loads': LOADS,
}
"""What is drawn → its columns"""

ENDS = {'x0': 'x0', 'y0': 'z0', 'x1': 'x1', 'y1': 'z1'}
"""What a line takes of a source for its ends"""


class ArmFigure:
    """Draws one arm in its base's frame: Z upwards, X towards cables s to the right."""

    def __init__(self) -> None:
        self.root = empty_frame('arm', WIDTH, BOTTOM, TOP)
        self._sources = {
            name: ColumnDataSource(columns(names, []), name=f'drawn_{name}')
            for name, names in SOURCES.items()
        }
        self._glyphs()

    def _glyphs(self) -> None:
        plot, of = self.root, self._sources
        plot.rect(x=0.0, y=-0.06, width=0.3, height=0.12, color=PALE)
        plot.segment(**ENDS, color=INK, line_dash='dotted', source=of['stops'])
        for name, colour, alpha in (('bands', 'colour', 0.3), ('fans', INK, 0.35)):
            plot.wedge(
                x='x',
                y='z',
                radius='radius',
                start_angle='start',
                end_angle='end',
                color=colour,
                fill_alpha=alpha,
                line_alpha=0.8,
                source=of[name],
            )
        plot.segment(**ENDS, color='colour', line_width=7, line_cap='round', source=of['units'])
        plot.circle(
            x='x', y='z', radius='radius', fill_color='white', line_color=INK, source=of['joints']
        )
        plot.quad(
            left='left',
            right='right',
            bottom='bottom',
            top='top',
            fill_color=INK,
            fill_alpha=0.2,
            line_color=INK,
            source=of['tip'],
        )
        name_sides(plot, 0.8, -0.45, 'cables')
        draw_loads(plot, of['loads'])

    def draw(
        self, arm: Arm, estimate: Any, admissible: Any = None, *, present: bool = True
    ) -> None:
        """Draw an estimate, grey if it is not of now; what it does not determine is left out.

        Parameters
        ----------
        admissible
            As of `joints_said`.
        """
        joints = joints_said(estimate, admissible)
        reach = sum(unit.length for unit in arm.units)
        angles = tuple(joint.angle for joint in joints)
        if len(joints) != len(arm.units) or not all(map(math.isfinite, angles)):
            self.clear()
            return
        centres = [(x / reach, z / reach) for x, z in joint_centres(arm, angles)]
        colours = [colour_of_regime(regime_named(of.regime), present=present) for of in joints]
        seats = _seats(arm, angles, centres, reach)
        drawn = list(zip(seats, joints, colours, strict=True))
        small = 0.22 * min(1.0 / len(joints), 0.15)
        self._show(
            units=[
                (*start, *end, colour)
                for start, end, colour in zip(centres[:-1], centres[1:], colours, strict=True)
            ],
            joints=[(*centre, small) for centre in centres[:-1]],
            bands=[
                (*seat.wedge(BAND, *band), colour)
                for seat, joint, colour in drawn
                for band in joint.bands or ()
            ],
            fans=[seat.wedge(FAN, *joint.interval) for seat, joint, _ in drawn if joint.interval],
            stops=[
                seat.line(BAND, side * unit.design.max_bend_angle)
                for seat, unit in zip(seats, arm.units, strict=True)
                for side in (-1, 1)
            ],
            tip=_tip(estimate, reach),
            # Gravity in the corner, and the force at the tip.
            loads=loads_of(load_of(estimate), (-0.95, 0.9), centres[-1], half=0.15, length=0.25),
        )

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""
        self._show(**{name: [] for name in SOURCES})

    def _show(self, **rows: Sequence[tuple[Any, ...]]) -> None:
        for name, of_source in rows.items():
            data = columns(SOURCES[name], of_source)
            if data != self._sources[name].data:
                self._sources[name].data = data


class _Seat(NamedTuple):
    """Where a joint is, and the unit before it lies: from there its angles count."""

    x: float
    z: float
    tilt: float
    """Sum of the angles before it, in rad"""
    length: float
    """Of the unit beyond it"""

    def wedge(self, share: float, low: float, high: float) -> tuple[float, ...]:
        """Between two angles of the joint, as far as a share of its unit."""
        ends = UPRIGHT - self.tilt - high, UPRIGHT - self.tilt - low
        return self.x, self.z, share * self.length, *ends

    def line(self, share: float, angle: float) -> tuple[float, ...]:
        """At an angle of the joint."""
        size, turned = share * self.length, self.tilt + angle
        end = self.x + size * math.sin(turned), self.z + size * math.cos(turned)
        return self.x, self.z, *end


def _seats(
    arm: Arm, angles: Sequence[float], centres: Sequence[tuple[float, float]], reach: float
) -> list[_Seat]:
    tilts = accumulate(angles, initial=0.0)
    return [
        _Seat(x, z, tilt, unit.length / reach)
        for unit, tilt, (x, z) in zip(arm.units, tilts, centres, strict=False)
    ]


def _tip(estimate: Any, reach: float) -> list[tuple[float, ...]]:
    """The box of the intervals that hold the tip."""
    said = tip_said(estimate)
    if said['x'].interval is None or said['z'].interval is None:
        return []
    return [tuple(end / reach for end in (*said['x'].interval, *said['z'].interval))]
