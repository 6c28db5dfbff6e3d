# %% [markdown]
# # Calibrating a unit from a recorded session
#
# A notebook as a script: each `# %%` begins a cell. VS Code, Spyder and PyCharm run it as it is,
# and `jupytext --to notebook examples/calibration.py` makes a notebook of it. It runs as a whole
# with `python examples/calibration.py`, too.
#
# The session comes with the project. It was recorded from a stand-in unit that weighs 24 g, has
# a cable offset of 4.1 mm and a friction coefficient of 0.92: these are what the fit should find.

# %%
import sys
from math import radians
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from tendon_statics import (
    calibrate,
    default_design_path,
    load_design,
    load_recording,
    mark_motion,
    save_design,
    slip_margin,
)

RECORDING = default_design_path().with_name('recorded_session.mcap')
OUTPUT = Path(sys.argv[1]) if len(sys.argv) > 1 else Path('fitted.yaml')

# %% [markdown]
# ## Look at it first
#
# Both tensions, and the measured angle. Where both cables are slack the operator brings the unit
# to an angle by hand; then one cable is pulled until the unit slips.

# %%
session = load_recording(RECORDING)
figure, (of_tensions, of_angle) = plt.subplots(2, sharex=True, layout='constrained')
of_tensions.plot(session.time, session.tension_l, label='cable l')
of_tensions.plot(session.time, session.tension_s, label='cable s')
of_tensions.set_ylabel('tension [N]')
of_tensions.legend()
of_angle.plot(session.time, np.degrees(session.bend_angle), '.', markersize=2)
of_angle.set(xlabel='time [s]', ylabel='bend angle [°]')
plt.show()

# %% [markdown]
# ## Which samples say something
#
# Only a unit about to slip lies on the boundary of friction. The sample before the angle moves by
# more than 3° is one; all that do not move are held, and must not lie beyond that boundary.

# %%
session = mark_motion(session, step=radians(3.0))
states, counts = np.unique(session.state, return_counts=True)
print(dict(zip(states.tolist(), counts.tolist(), strict=True)))

# %% [markdown]
# ## Fit
#
# The noise is that of the sensors: 10 mN, 0.29° and 8 Pa. Standard errors are of that noise,
# unless the data scatter more.

# %%
start = load_design(default_design_path())
fitted = calibrate(
    start,
    session,
    fit=('mass', 'cable_offset', 'friction_coefficient'),
    tension_stddev=0.01,
    bend_angle_stddev=radians(0.29),
    pressure_stddev=8.0,
)
for parameter in fitted.parameters:
    low, high = parameter.interval
    print(
        f'{parameter.name:22} {parameter.value:.4g} ± {parameter.standard_error:.2g}, '
        f'95 % from {low:.4g} to {high:.4g}; it began at {parameter.start:.4g}'
    )
print(*fitted.warnings or ['no warnings'], sep='\n')

# %% [markdown]
# ## Does it meet the data?
#
# Distances from the boundary of slip, in units of their own noise. With the right noise and model
# their root mean square is about 1, and none is far beyond 3.

# %%
slipping = fitted.roles == 'slipping'
print(fitted.residuals)
figure, axes = plt.subplots(layout='constrained')
axes.axhspan(-2, 2, color='#e6f1f8')
axes.plot(np.degrees(session.bend_angle[slipping]), fitted.distance.standardised[slipping], 'o')
axes.set(xlabel='measured bend angle [°]', ylabel='distance [standard deviations]')
plt.show()

# %% [markdown]
# ## Is it of any use?
#
# That the fit meets the data it was fitted to says little. So fit once more, to the first half,
# and look at slips of the second half, which it has not seen. At a slip a right design uses just
# all of its friction: the slip margin is 1 or −1.


# %%
def fit(samples):
    """Fit to some of the samples."""
    return calibrate(start, samples, bend_angle_stddev=radians(0.29), pressure_stddev=8.0).design


def margins_off(design, samples):
    """By how much the margin of each slip misses ±1; without those that rest at the stop."""
    off = []
    for state, angle, pair in zip(
        samples.state, samples.bend_angle, samples.tensions(), strict=True
    ):
        if state == 'slipping' and min(pair) > 0.1 and abs(angle) < 0.9 * design.max_bend_angle:
            off.append(abs(slip_margin(design, *pair, angle)) - 1.0)
    return np.array(off)


half = session.time < np.median(session.time)
seen, unseen = session.part(half), session.part(~half)
for name, design in (('start', start), ('fitted to the first half', fit(seen))):
    off = margins_off(design, unseen)
    print(
        f'{name}: {len(off)} slips of the second half, root mean square of the error '
        f'{100.0 * np.sqrt(np.mean(off**2)):.1f} % of the friction limit'
    )

# %% [markdown]
# ## Keep it
#
# The file is one that the node and every `--design` take.

# %%
save_design(OUTPUT, fitted.design, uncertainty=fitted.uncertainty)
print(f'wrote {OUTPUT}')
