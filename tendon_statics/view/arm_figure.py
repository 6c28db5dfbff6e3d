"""The arm at its angles, with the interval of each and where the tip is believed to be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bokeh.models import ColumnDataSource

from ..physics import Arm
from ..physics.arm.shape import joint_centres
from .arm_values import JointSaid, joints_said, tip_said
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
FAN = 0.8
"""How far the interval of a joint's angle is drawn, in lengths of its unit"""

SOURCES = {
    'units': ('x0', 'z0', 'x1', 'z1', 'colour'),
    'joints': ('x', 'z', 'radius'),
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
        plot.wedge(
            x='x',
            y='z',
            radius='radius',
            start_angle='start',
            end_angle='end',
            color=INK,
            fill_alpha=0.35,
            source=of['fans'],
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

    def draw(self, arm: Arm, estimate: Any, *, present: bool = True) -> None:
        """Draw an estimate, grey if it is not of now; what it does not determine is left out."""
        joints, reach = joints_said(estimate), sum(unit.length for unit in arm.units)
        angles = tuple(joint.angle for joint in joints)
        if len(joints) != len(arm.units) or not all(map(math.isfinite, angles)):
            self.clear()
            return
        centres = [(x / reach, z / reach) for x, z in joint_centres(arm, angles)]
        units = [
            (*start, *end, colour_of_regime(regime_named(joint.regime), present=present))
            for start, end, joint in zip(centres[:-1], centres[1:], joints, strict=True)
        ]
        small = 0.22 * min(1.0 / len(joints), 0.15)
        self._show(
            units=units,
            joints=[(*centre, small) for centre in centres[:-1]],
            fans=_fans(arm, joints, centres, reach),
            stops=_stops(arm, angles, centres, reach),
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


def _fans(
    arm: Arm, joints: Sequence[JointSaid], centres: Sequence[tuple[float, float]], reach: float
) -> list[tuple[float, ...]]:
    """The interval of each angle, from its joint on, as the unit before it lies."""
    fans: list[tuple[float, ...]] = []
    tilt = 0.0
    for unit, joint, centre in zip(arm.units, joints, centres, strict=False):
        if joint.interval:
            low, high = joint.interval
            ends = (UPRIGHT - tilt - high, UPRIGHT - tilt - low)
            fans.append((*centre, FAN * unit.length / reach, *ends))
        tilt += joint.angle
    return fans


def _stops(
    arm: Arm, angles: Sequence[float], centres: Sequence[tuple[float, float]], reach: float
) -> list[tuple[float, ...]]:
    """The ends of where each joint can bend."""
    lines: list[tuple[float, ...]] = []
    tilt = 0.0
    for unit, angle, (x, z) in zip(arm.units, angles, centres, strict=False):
        size = FAN * unit.length / reach
        for stop in (-unit.design.max_bend_angle, unit.design.max_bend_angle):
            lines.append(
                (x, z, x + size * math.sin(tilt + stop), z + size * math.cos(tilt + stop))
            )
        tilt += angle
    return lines


def _tip(estimate: Any, reach: float) -> list[tuple[float, ...]]:
    """The box of the intervals that hold the tip."""
    said = tip_said(estimate)
    if said['x'].interval is None or said['z'].interval is None:
        return []
    return [tuple(end / reach for end in (*said['x'].interval, *said['z'].interval))]
