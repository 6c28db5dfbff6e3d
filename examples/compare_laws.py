"""Compare the contact laws: what each makes of a unit, and which one a recording speaks for.

    python examples/compare_laws.py [RECORDING]

Without a recording it takes the session that travels with the project.
"""

import sys
from dataclasses import replace
from math import degrees, radians
from pathlib import Path

from tendon_statics import (
    compare_laws,
    default_design_path,
    load_design,
    load_recording,
    mark_motion,
    solve,
    tensions_for,
)
from tendon_statics.physics import CONTACT_LAWS

design = load_design(default_design_path())
recording = (
    sys.argv[1] if len(sys.argv) > 1 else default_design_path().with_name('recorded_session.mcap')
)

print('The preliminary design under each law')
for law in CONTACT_LAWS:
    unit = replace(design, contact_law=law)
    slips = tensions_for(unit, radians(10.0), total_tension=3.0)
    answer = solve(unit, 1.0, 2.0)
    angle = '' if answer.bend_angle is None else f' at {degrees(answer.bend_angle):.2f}°'
    print(
        f'  {law:16} at 1 N and 2 N: {answer.regime}{angle}; about to slip at 10° from '
        f'{slips.tension_l:.3f} N and {slips.tension_s:.3f} N'
    )

session = mark_motion(load_recording(recording), step=radians(3.0))
found = compare_laws(design, session, bend_angle_stddev=radians(0.29), pressure_stddev=8.0)
print(f'\nWhat {len(session)} samples of {Path(recording).name} say')
for fit in found.fits:
    if fit.calibration is None:
        print(f'  {fit.law:16} {fit.failure}')
        continue
    values = ', '.join(
        f'{parameter.name} {parameter.value:.4g} ± {parameter.standard_error:.2g}'
        for parameter in fit.calibration.parameters
        if parameter.value is not None and parameter.standard_error is not None
    )
    out = 'ruled out' if fit.is_ruled_out else 'possible'
    print(f'  {fit.law:16} {out}: {values}')
print(f'\n{found.statement}.')
for advice in found.advice:
    print(f'It would tell: {advice.text}.')
