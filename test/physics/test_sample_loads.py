"""`SampleLoads`: in arrays what `Load` is for one sample."""

import math
import random

import numpy as np
import pytest
from brute import random_case

from tendon_statics import Load, TensionError
from tendon_statics.physics.sample_loads import SampleLoads, seating_tension
from tendon_statics.physics.tensions import Tensions, taut_slip


def of_loads(loads, distance):
    directions = np.array([load.gravity_direction for load in loads])
    return SampleLoads.of(
        Load(tip_distance=distance),
        len(loads),
        base_tilt=np.arctan2(directions[:, 0], -directions[:, 2]),
        base_roll=np.arcsin(directions[:, 1]),
        tip_force_x=[load.tip_force[0] for load in loads],
        tip_force_z=[load.tip_force[1] for load in loads],
    )


def random_loads(count, draw, distance):
    return [
        Load(
            (draw.gauss(0.0, 1.0), draw.gauss(0.0, 1.0), draw.gauss(0.0, 1.0)),
            (draw.gauss(0.0, 0.3), draw.gauss(0.0, 0.3)),
            distance,
        )
        for _ in range(count)
    ]


def test_the_dead_load_is_that_of_each_load():
    draw = random.Random(1)
    loads = random_loads(50, draw, 0.03)
    design = random_case(draw).design
    found = of_loads(loads, 0.03)
    alone = np.array([load.on(design) for load in loads]).T
    for part, expected in zip(found.on(design), alone, strict=True):
        assert part == pytest.approx(expected, abs=1e-12)
    again = np.array([load.on(design) for load in found.loads()]).T
    assert again == pytest.approx(alone, abs=1e-12)


def test_what_was_not_recorded_is_as_the_load_has_it():
    load = Load.tilted(0.3, (0.1, -0.2), 0.05)
    assert SampleLoads.of(load, 2).loads() == [load, load]
    turned = SampleLoads.of(load, 2, base_tilt=[0.0, math.pi])
    assert [of.base_tilt for of in turned.loads()] == pytest.approx([0.0, math.pi])
    assert [of.tip_force for of in turned.loads()] == [(0.1, -0.2)] * 2


def test_a_joint_is_seated_where_a_single_pair_is():
    draw = random.Random(2)
    for _ in range(60):
        case = random_case(draw)
        least = float(seating_tension(case.design, case.load.on(case.design)))
        for share, seats in ((1.0 + 1e-6, True), (1.0 - 1e-6, False)):
            half = 0.5 * share * least
            if seats:
                assert taut_slip(case.design, Tensions(half, half), case.load).total > 0.0
            elif half > 0.0:
                with pytest.raises(TensionError):
                    taut_slip(case.design, Tensions(half, half), case.load)
