"""The arm at its angles, with the interval of each and where the tip is believed to be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bokeh.models import Arrow, ColumnDataSource, NormalHead, Range1d
from bokeh.plotting import figure

from ..physics import Arm
from ..physics.arm.shape import joint_centres
from .arm_values import JointSaid, joints_said, tip_said
from .estimate_values import colour_of_regime, load_of
from .unit_figure import FORCE, GRAVITY, INK, PALE, UPRIGHT

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
    'loads': ('x0', 'z0', 'x1', 'z1', 'colour'),
}
"""What is drawn → its columns"""


class ArmFigure:
    """Draws one arm in its base's frame: Z upwards, X towards cables s to the right."""

    def __init__(self) -> None:
        self.root = figure(
            name='arm',
            x_range=Range1d(-WIDTH, WIDTH),
            y_range=Range1d(BOTTOM, TOP),
            aspect_ratio=2.0 * WIDTH / (TOP - BOTTOM),
            sizing_mode='stretch_width',
            toolbar_location=None,
            tools='',
            outline_line_color=None,
        )
        self.root.axis.visible = self.root.grid.visible = False
        self._sources = {
            name: ColumnDataSource(_columns(name, []), name=f'drawn_{name}') for name in SOURCES
        }
        self._glyphs()

    def _glyphs(self) -> None:
        plot, of = self.root, self._sources
        plot.rect(x=0.0, y=-0.06, width=0.3, height=0.12, color=PALE)
        plot.segment(
            x0='x0', y0='z0', x1='x1', y1='z1', color=INK, line_dash='dotted', source=of['stops']
        )
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
        plot.segment(
            x0='x0',
            y0='z0',
            x1='x1',
            y1='z1',
            color='colour',
            line_width=7,
            line_cap='round',
            source=of['units'],
        )
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
        plot.text(
            x=[-0.8, 0.8],
            y=[-0.45, -0.45],
            text=['cables l', 'cables s'],
            text_align='center',
            text_color=GRAVITY,
            text_font_size='13px',
        )
        plot.add_layout(
            Arrow(
                end=NormalHead(size=9, fill_color='colour', line_color='colour'),
                x_start='x0',
                y_start='z0',
                x_end='x1',
                y_end='z1',
                line_color='colour',
                line_width=2,
                source=of['loads'],
            )
        )

    def draw(self, arm: Arm, estimate: Any, *, present: bool = True) -> None:
        """Draw an estimate, grey if it is not of now; what it does not determine is left out."""
        joints, reach = joints_said(estimate), sum(unit.length for unit in arm.units)
        angles = tuple(joint.angle for joint in joints)
        if len(joints) != len(arm.units) or not all(map(math.isfinite, angles)):
            self.clear()
            return
        centres = [(x / reach, z / reach) for x, z in joint_centres(arm, angles)]
        units = [
            (*start, *end, colour_of_regime(joint.regime, present=present))
            for start, end, joint in zip(centres[:-1], centres[1:], joints, strict=True)
        ]
        small = 0.22 * min(1.0 / len(joints), 0.15)
        self._show(
            units=units,
            joints=[(*centre, small) for centre in centres[:-1]],
            fans=_fans(arm, joints, centres, reach),
            stops=_stops(arm, angles, centres, reach),
            tip=_tip(estimate, reach),
            loads=_loads(estimate, centres[-1]),
        )

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""
        self._show(**{name: [] for name in SOURCES})

    def _show(self, **rows: Sequence[tuple[Any, ...]]) -> None:
        for name, of_source in rows.items():
            data = _columns(name, of_source)
            if data != self._sources[name].data:
                self._sources[name].data = data


def _columns(name: str, rows: Sequence[tuple[Any, ...]]) -> dict[str, list[Any]]:
    return {column: [row[n] for row in rows] for n, column in enumerate(SOURCES[name])}


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


def _loads(estimate: Any, tip: tuple[float, float]) -> list[tuple[Any, ...]]:
    """Gravity in the corner, and the force at the tip."""
    load = load_of(estimate)
    if load is None:
        return []
    x, _, z = load.gravity_direction
    place_x, place_z = -0.95, 0.9
    arrows: list[tuple[Any, ...]] = [
        (
            *(place_x - 0.15 * x, place_z - 0.15 * z),
            *(place_x + 0.15 * x, place_z + 0.15 * z),
            GRAVITY,
        )
    ]
    force = math.hypot(*load.tip_force)
    if force > 0.0:
        along_x, along_z = (0.25 * part / force for part in load.tip_force)
        arrows.append((tip[0] - along_x, tip[1] - along_z, *tip, FORCE))
    return arrows
