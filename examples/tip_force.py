"""What pushes at the tip: of a unit, of a recording, of an arm.

    python examples/tip_force.py

Friction leaves the force open within a set while nothing moves. The script shows the set of one
state, what is left of it while the unit slips, how the contact law and lubrication change it, and
the set of an arm, whose joints all carry the force.
"""

from dataclasses import replace
from math import radians

from tendon_statics import arm_tip_force, default_design_path, load_arm, load_design, tip_force

ACROSS = (1.0, 0.0)  # towards cable s; fixed in the joint frame, or in that of an arm's base
dry = load_design(default_design_path())
arm = load_arm(default_design_path().with_name('arm.yaml'))


def said(intervals):
    """Say closed intervals of forces in N."""
    if not intervals:
        return 'no force explains it'
    return ' or '.join(f'{low:+.3f} to {high:+.3f} N' for low, high in intervals)


# Tensions and angle as they were measured, and how well.
measured = {'bend_angle': radians(5.0), 'direction': ACROSS, 'distance': 0.02}
noise = {'tension_stddev': 0.01, 'bend_angle_stddev': radians(0.5)}
print('The preliminary design at 5°, with 1 N and 1.9 N')
found = tip_force(dry, 1.0, 1.9, **measured, **noise)
print(f'  at rest         {said(found.intervals)}, at {100.0 * found.level:g} %')
print(f'  nothing pushes  {100.0 * found.probability_free:.0f} % probable')
found = tip_force(dry, 1.0, 1.9, **measured, **noise, slipping='s')
print(f'  slipping to s   {found.force:+.3f} N ± {found.force_stddev:.3f} N')

print('The same, by contact law and friction, exact')
for law in ('merged', 'friction_circle', 'elastic_seat'):
    for friction in (1.05, 0.2):
        unit = replace(dry, contact_law=law, friction_coefficient=friction)
        exact = tip_force(unit, 1.0, 1.9, **measured).intervals
        print(f'  {law:16} {friction:<5} {said(exact)}')

print('An arm of five units, straight')
for tension in (1.0, 1.3, 1.7):
    pulled = {'l_mid': 1.0, 's_mid': 1.0, 'l_tip': 1.0, 's_tip': tension}
    common = arm_tip_force(arm, pulled, bend_angles=[0.0] * 5, direction=ACROSS)
    print(f'  s_tip {tension} N     {said(common.intervals)}')
    for below, above in common.bounding_joints:
        print(f'    joint {below} would slip below, joint {above} above')
