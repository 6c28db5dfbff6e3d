"""How angle and pressure follow tilt and design, against differences of `solve` itself."""

import dataclasses
import math
import random
from collections import Counter

import brute
import pytest
from designs import PRELIMINARY
from thoroughness import some_of

from tendon_statics import DesignError, Load, Regime, StickSlipTracker, TensionError, solve
from tendon_statics.physics import design_parameters

NAMES = ('base_tilt', *(parameter.name for parameter in design_parameters()))


def changed(case: brute.Case, name: str, change: float):
    """Solve with one parameter changed; None where that cannot be, or has another regime."""
    design, load = case.design, case.load
    if name == 'base_tilt':
        load = Load.tilted(load.base_tilt + change, load.tip_force, load.tip_distance)
    else:
        try:
            design = dataclasses.replace(design, **{name: getattr(design, name) + change})
        except DesignError:
            return None
    try:
        return solve(design, case.tension_l, case.tension_s, load)
    except TensionError:
        return None


def step(case: brute.Case, name: str) -> float:
    if name == 'stiffness':
        return 1e-4 * case.design.ball_radius * (case.tension_l + case.tension_s)
    if name in ('com_distance', 'cable_offset'):
        return 1e-4 * case.design.ball_radius
    if name == 'base_tilt' or name.endswith('angle'):
        return 1e-4
    return 1e-4 * getattr(case.design, name)


def difference(case: brute.Case, name: str):
    """Slopes of angle and pressure over two widths, so that a kink or a fold shows."""
    found = []
    for width in (step(case, name), 0.5 * step(case, name)):
        ends = [changed(case, name, sign * width) for sign in (-1.0, 1.0)]
        regime = solve(case.design, case.tension_l, case.tension_s, case.load).regime
        if any(end is None or end.regime is not regime for end in ends):
            return None
        low, high = ends
        found.append(
            tuple(
                (getattr(high, of) - getattr(low, of)) / (2.0 * width)
                for of in ('bend_angle', 'pressure')
            )
        )
    wide, narrow = found
    if wide != pytest.approx(narrow, rel=1e-3, abs=1e-12):
        return None
    # Richardson's, without the error of the second order.
    return tuple((4.0 * b - a) / 3.0 for a, b in zip(wide, narrow, strict=True))


def test_they_are_the_slopes_of_solve_for_units_of_every_law():
    draw = random.Random(31)
    compared: Counter = Counter()
    for case in [brute.random_case(draw) for _ in range(some_of(200))]:
        answer = solve(case.design, case.tension_l, case.tension_s, case.load)
        if answer.bend_angle is None:
            assert answer.bend_angle_derivatives is None
            assert answer.pressure_derivatives is None
            continue
        assert tuple(answer.bend_angle_derivatives) == NAMES
        assert tuple(answer.pressure_derivatives) == NAMES
        for name in NAMES:
            slopes = difference(case, name)
            if slopes is None:
                continue
            found = (answer.bend_angle_derivatives[name], answer.pressure_derivatives[name])
            rounding = 1e-8 / step(case, name)
            scales = (1.0, answer.pressure)
            for slope, its, scale in zip(found, slopes, scales, strict=True):
                assert slope == pytest.approx(its, rel=1e-4, abs=rounding * scale), (name, case)
            compared.update([case.design.contact_law, str(answer.regime), name])
    kinds = (*brute.LAWS, 'equilibrium', 'driven_to_stop', *NAMES)
    assert min(compared[kind] for kind in kinds) >= some_of(40), compared


def test_a_degree_of_tilt_is_a_degree_of_bend_under_the_papers_case():
    """Its moment of weight and its friction both hang on tilt and angle by their sum alone."""
    answer = solve(PRELIMINARY, 1.0, 2.0)
    assert answer.bend_angle_derivatives['base_tilt'] == pytest.approx(-1.0, abs=1e-7)
    assert answer.pressure_derivatives['base_tilt'] == pytest.approx(0.0, abs=1e-4)
    assert answer.bend_angle_derivatives['contact_width'] == 0.0
    assert answer.pressure_derivatives['contact_width'] == pytest.approx(-answer.pressure)


@pytest.mark.parametrize(('tensions', 'side'), [((1.0, 3.0), 1.0), ((3.0, 1.0), -1.0)])
def test_at_the_stop_the_angle_follows_the_stop_alone(tensions, side):
    derivatives = solve(PRELIMINARY, *tensions).bend_angle_derivatives
    assert derivatives.pop('max_bend_angle') == side
    assert set(derivatives.values()) == {0.0}


@pytest.mark.parametrize(
    'ends',
    [
        {'cable_offset': 0.0, 'com_distance': 1.0, 'mass': 0.01},
        {'stiffness': 0.0, 'contact_end_angle': math.pi / 2, 'contact_law': 'elastic_seat'},
        {'contact_start_angle': 0.0, 'contact_width': 1e-6},
    ],
)
def test_at_the_ends_of_the_ranges_too(ends):
    design = dataclasses.replace(PRELIMINARY, **ends)
    answer = solve(design, 0.02, 3.0)
    assert answer.regime is Regime.DRIVEN_TO_STOP
    assert all(map(math.isfinite, answer.pressure_derivatives.values()))


def test_one_sided_differences_are_as_good():
    design = dataclasses.replace(PRELIMINARY, cable_offset=0.0)
    at_end, inside = (
        solve(dataclasses.replace(design, cable_offset=offset), 1.0, 3.2) for offset in (0.0, 1e-7)
    )
    assert at_end.regime is Regime.EQUILIBRIUM
    slopes = [a.bend_angle_derivatives['cable_offset'] for a in (at_end, inside)]
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-3)


def test_a_tracked_unit_has_them_at_its_stop_at_most():
    tracker = StickSlipTracker(PRELIMINARY)
    assert tracker.update(1.0, 1.5).bend_angle_derivatives is None
