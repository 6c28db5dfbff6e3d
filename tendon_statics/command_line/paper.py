"""``tendon-statics paper``: the numbers behind docs/model.md, from the paper's published case."""

from __future__ import annotations

import argparse
import dataclasses
import math

from ..files.design_file import default_design_path, load_design
from ..physics import JointDesign, Regime, contact_coefficients, paper, solve
from ..physics.contact import CONTACT_LAWS
from ..physics.contact.zone import seat_constants
from .tables import markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    parser.add_argument('--section', choices=SECTIONS, help='one table only; default: all')


def run(options: argparse.Namespace) -> None:
    """Print the tables."""
    design = load_design(default_design_path())
    names = [options.section] if options.section else list(SECTIONS)
    print('\n\n'.join(SECTIONS[name](design) for name in names))


def _published(design: JointDesign) -> str:
    equilibrium = solve(design, paper.TENSION_L, paper.TENSION_S)
    if equilibrium.bend_angle is None or equilibrium.pressure is None:
        return f'With this design the published tensions give no angle: {equilibrium.regime}.'
    return markdown_table(
        ('result', 'paper:', 'here:'),
        [
            (
                'bend angle θ [deg]',
                f'{math.degrees(paper.BEND_ANGLE):.2f}',
                f'{math.degrees(equilibrium.bend_angle):.6f}',
            ),
            ('pressure p [Pa]', f'{paper.PRESSURE:.1f}', f'{equilibrium.pressure:.6f}'),
        ],
    )


def _bisection(design: JointDesign) -> str:
    found = paper.bisect(design, paper.TENSION_L, paper.TENSION_S)
    answer = solve(design, paper.TENSION_L, paper.TENSION_S)
    if found is None or answer.bend_angle is None:
        return 'With this design Eq. (4) has no change of sign from 0 to the stop.'
    angle, halvings = found
    return markdown_table(
        ('way to the root', 'steps:', 'bend angle θ [rad]:'),
        [
            ("plain bisection to 1e-10 rad, the paper's", str(halvings), f'{angle:.10f}'),
            (
                '`solve`: steps by a cubic, to such a bracket too',
                str(answer.iterations),
                f'{answer.bend_angle:.10f}',
            ),
        ],
    )


def _band(design: JointDesign) -> str:
    """Tensions of cable s at which the regime changes, that of cable l being the paper's."""
    published = solve(design, paper.TENSION_L, paper.TENSION_S)
    if published.regime is not Regime.EQUILIBRIUM:
        return f'With this design the published tensions give no angle: {published.regime}.'
    lower, upper = paper.equilibrium_band(design)
    return markdown_table(
        ('T_s at T_l = 1 N', 'regime'),
        [
            (f'1 N to {lower:.4f} N', Regime.HELD.value),
            (f'{lower:.4f} N to {upper:.4f} N', Regime.EQUILIBRIUM.value),
            (f'above {upper:.4f} N', Regime.DRIVEN_TO_STOP.value),
        ],
    )


def _errata(design: JointDesign) -> str:
    tensions = (paper.TENSION_L, paper.TENSION_S)

    def row(label: str, misprints: tuple[paper.Misprint, ...]) -> tuple[str, str, str]:
        pressure = paper.force_pressure(
            design, paper.TENSION_L, paper.TENSION_S, paper.BEND_ANGLE, misprints
        )
        residuals = [
            paper.moment_pressure(design, *tensions, angle) - right
            for angle in (0.0, design.max_bend_angle)
            if (right := paper.force_pressure(design, *tensions, angle, misprints)) is not None
        ]
        ends = ', '.join(f'{value:+.1f}' for value in residuals) or 'not real'
        return label, 'not real' if pressure is None else f'{pressure:+.1f}', ends

    every = tuple(paper.Misprint)
    return markdown_table(
        (
            'Eq. (4)',
            f'right-hand side at {math.degrees(paper.BEND_ANGLE):.2f}° [Pa]:',
            'left − right at 0° and at the stop [Pa]:',
        ),
        [
            row('as printed', every),
            *(
                row(f'all corrected but {misprint.name.lower().replace("_", " ")}', (misprint,))
                for misprint in every
            ),
            row('corrected', ()),
        ],
    )


def _identified(design: JointDesign) -> str:
    identified = paper.identify_mass_and_offset(design)
    return markdown_table(
        ('parameter', 'identified:', 'in the design file:'),
        [
            ('mass m [kg]', f'{identified.mass:.11f}', f'{design.mass:.11f}'),
            (
                'cable offset δ [m]',
                f'{identified.cable_offset:.11f}',
                f'{design.cable_offset:.11f}',
            ),
        ],
    )


def _signs(design: JointDesign) -> str:
    equilibrium = solve(design, paper.TENSION_L, paper.TENSION_S)
    if equilibrium.bend_angle is None or equilibrium.forces is None:
        return f'With this design the published tensions give no angle: {equilibrium.regime}.'
    arc = contact_coefficients(design, equilibrium.bend_angle)
    friction = design.friction_coefficient
    derivatives = (
        arc.pressure_x,
        arc.pressure_z,
        friction * arc.friction_x,
        friction * arc.friction_z,
    )
    names = ('pressure-induced, X_G', 'pressure-induced, Z_G', 'friction, X_G', 'friction, Z_G')
    symbols = ('F_FX = p w C_FX', 'F_FZ = p w C_FZ', 'F_fX = μ p w C_fX', 'F_fZ = μ p w C_fZ')
    return markdown_table(
        ('force', 'symbol', 'value [N]:', 'by p [N/Pa]:', 'sign'),
        [
            (
                name,
                symbol,
                f'{force:+.6f}',
                f'{derivative * design.contact_width:+.6e}',
                '+' if force > 0.0 else '−',
            )
            for name, symbol, force, derivative in zip(
                names, symbols, equilibrium.forces, derivatives, strict=True
            )
        ],
    )


def _laws(design: JointDesign) -> str:
    """What each contact law makes of the published tensions."""
    rows = []
    for law, of_law in CONTACT_LAWS.items():
        unit = dataclasses.replace(design, contact_law=law)
        tensions = (paper.TENSION_L, paper.TENSION_S)
        rows.append(
            (
                f'`{law}`',
                of_law.fits,
                f'{paper.bare_capacity(unit):.4f}',
                solve(unit, *tensions).regime.value,
                f'{paper.slipping_tension(unit):.3f}',
                f'{paper.slipping_friction(unit):.3f}',
            )
        )
    return markdown_table(
        (
            '`contact_law`',
            'for',
            'K/(r T) without a load:',
            'at 1 N and 2 N',
            'slips at T_l = 1 N from T_s [N]:',
            'slips at 1 N and 2 N below μ:',
        ),
        rows,
    )


ZONES = ((20.0, 50.0), (60.0, 88.49))
"""Contact zones in deg whose constants are shown: a seat near the axis, and the paper's"""


def _seat(_design: JointDesign) -> str:
    rows = []
    for start, end in ZONES:
        zone = seat_constants(math.radians(start), math.radians(end))
        constants = (zone.lever, zone.coupling, zone.axial_friction, zone.mean_pressure)
        rows.append((f'{start:g}° to {end:g}°', *(f'{value:.4f}' for value in constants)))
    return markdown_table(('zone', 'k_c:', 'c:', 'q:', '⟨cos t⟩/a:'), rows)


SECTIONS = {
    'published': _published,
    'bisection': _bisection,
    'band': _band,
    'errata': _errata,
    'identified': _identified,
    'signs': _signs,
    'laws': _laws,
    'seat': _seat,
}
"""Section → what makes its table."""
