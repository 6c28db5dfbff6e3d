"""Follow an arm through a load cycle: which joints move when, and where the tip is.

    python examples/arm.py [ARM_FILE RECORDING]

Without files it takes the arm of five units and the load cycle that travel with the project. A
recording is a table with one column of tensions, at the base, for each cable of the arm, or a bag.
"""

import sys
from math import degrees

from tendon_statics import (
    ArmTracker,
    TendonStaticsError,
    default_design_path,
    load_arm,
    load_arm_recording,
)

LOAD_CELLS = 0.01
"""N; their standard deviation"""

shared = default_design_path().parent
files = sys.argv[1:] or (shared / 'arm.yaml', shared / 'arm_tensions.csv')
arm = load_arm(files[0])
recording = load_arm_recording(files[1], arm)

tracker = ArmTracker(arm)  # straight at first
moving: list[int] = []
for number, tensions in enumerate(recording.tensions(), start=1):
    angles, before = tracker.bend_angles, moving
    try:
        state = tracker.update(dict(zip(arm.cable_names, tensions, strict=True)))
    except TendonStaticsError as error:
        print(f'sample {number}: {error}')  # and the arm is where it was
        continue
    if state.tip is None:
        print(f'sample {number}: a joint is slack, which leaves all angles open')
        continue
    pairs = zip(angles, tracker.bend_angles, strict=True)
    moving = [joint for joint, (old, new) in enumerate(pairs, start=1) if old != new]
    if moving != before:
        print(
            f'sample {number}: moving {moving or "none"}; tip at {1000.0 * state.tip.x:+.2f} mm, '
            f'{degrees(state.tip.tilt):+.1f}°'
        )

at = ', '.join(f'{degrees(angle):+.1f}°' for angle in tracker.bend_angles)
print(f'\nIn the end the joints are at {at}.')
stddev = state.tip_stddev(LOAD_CELLS)
if stddev is not None:
    print(f'The tip is known to {1000.0 * stddev.x:.2f} mm, with {LOAD_CELLS} N of noise.')
