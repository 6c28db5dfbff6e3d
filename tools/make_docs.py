"""Make again what the documentation takes from the program: tables and figures.

A page holds ``<!-- made by: tendon-statics ... -->``, or a tool of this folder in its place; what
that command prints stands between it and ``<!-- end -->``. Figures are files, listed here.
"""

from __future__ import annotations

import io
import os
import re
import shlex
import sys
from contextlib import redirect_stdout
from pathlib import Path

import friction_figures
import list_driver_parameters
import list_entities
import list_parameters
import list_permissions
import list_view_parameters
import measure_filter.figure
import node_reference
import tip_force_tables
import validate.figure
import validate.tables
from run_page import run_page

from tendon_statics.command_line.main import main as run

ROOT = Path(__file__).resolve().parents[1]
PAGES = (
    *('docs/arm.md', 'docs/calibration.md', 'docs/command_line.md', 'docs/contact_laws.md'),
    *('docs/filter.md', 'docs/recordings.md'),
    *('docs/model.md', 'docs/node.md', 'docs/node_reference.md', 'docs/rig.md'),
    *('docs/security.md', 'docs/tip_force.md', 'docs/validation.md', 'docs/view.md'),
)
TUTORIALS = tuple(
    f'docs/tutorials/{name}.md'
    for name in (
        *('first_estimate', 'own_unit', 'three_joints', 'bag_to_report'),
        *('an_arm', 'force_at_the_tip'),
    )
)
"""Pages whose blocks are run in order, as a reader would"""

SESSION = 'config/recorded_session.mcap'
FIGURES = {
    'docs/arm.svg': 'arm plot config/arm.yaml config/arm_tensions.csv',
    'docs/calibration.svg': f'plot calibration {SESSION} --motion-step-deg 3 '
    '--bend-angle-stddev-deg 0.29 --pressure-stddev 8',
    'docs/hysteresis.svg': 'plot hysteresis',
    'docs/map.svg': 'plot map --tension-l-range 0.8 1.2 --tension-s-range 1.6 2.4',
    'docs/recording.svg': f'plot recording {SESSION} --estimation filtering --tension-stddev 0.01',
    'docs/residual.svg': 'plot residual',
    'docs/tilted.svg': 'plot unit --base-tilt-deg 10',
    'docs/tip_force.svg': f'plot tip-force {SESSION} --direction 1 0 --distance 0.02',
    'docs/unit.svg': 'plot unit',
}

TOOLS = {
    'tools/list_driver_parameters.py': list_driver_parameters.main,
    'tools/list_entities.py': list_entities.main,
    'tools/list_parameters.py': list_parameters.main,
    'tools/list_permissions.py': list_permissions.main,
    'tools/node_reference.py': node_reference.main,
    'tools/tip_force_tables.py': tip_force_tables.main,
    'tools/list_view_parameters.py': list_view_parameters.main,
    'tools/validate/tables.py': validate.tables.main,
}

_BLOCK = re.compile(r'(<!-- made by: (.+?) -->\n).*?(<!-- end -->)', re.DOTALL)


def made(page: str) -> str:
    """Return the text of a page with all its blocks made anew."""

    def make(block: re.Match[str]) -> str:
        opening, command, closing = block.groups()
        program, *arguments = shlex.split(command)
        output = io.StringIO()
        with redirect_stdout(output):
            code = TOOLS[program](*arguments) if program in TOOLS else run(arguments)
        if code:
            raise RuntimeError(f'{command} ended with {code}')
        text = output.getvalue()
        if not text.startswith('|'):
            text = f'```text\n{text}```\n'
        return f'{opening}\n{text}\n{closing}'

    return _BLOCK.sub(make, page)


def make_page(name: str) -> None:
    """Rewrite a page."""
    os.chdir(ROOT)  # which the names of files in the pages are relative to
    path = ROOT / name
    path.write_text(made(path.read_text(encoding='utf-8')), encoding='utf-8')


def main() -> int:
    """Rewrite the pages and figures."""
    for name in PAGES:
        make_page(name)
    for name in TUTORIALS:
        path = ROOT / name
        path.write_text(run_page(path.read_text(encoding='utf-8')), encoding='utf-8')
    friction_figures.write(ROOT / 'docs')
    measure_filter.figure.write(ROOT / 'docs/filter.svg')
    for name, arguments in FIGURES.items():
        if run([*shlex.split(arguments), '--output', str(ROOT / name)]) != 0:
            return 1
    validate.figure.write()
    return 0


if __name__ == '__main__':
    sys.exit(main())
