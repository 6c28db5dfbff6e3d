"""`calibrate`: known truths come back, at the stated rate, and what cannot be known is said."""

import dataclasses
import math

import numpy as np
import pytest
from designs import PRELIMINARY
from law_sessions import SessionPlan, session_of, unit_of
from slips import (
    BEND_ANGLE_STDDEV,
    PRESSURE_STDDEV,
    TENSION_STDDEV,
    TRUTH,
    measured,
    recording,
    session,
    slipping_samples,
)
from thoroughness import few_of

from tendon_statics import CalibrationError, Recording, calibrate
from tendon_statics.physics import design_parameters, paper
from tendon_statics.physics.calibration.boundary_distance import boundary_distance
from tendon_statics.physics.calibration.load_cells import LoadCells
from tendon_statics.physics.calibration.parameters import Model

THREE = ('mass', 'cable_offset', 'friction_coefficient')
STARTS = {'mass': 0.0196, 'friction_coefficient': 0.6, 'stiffness': 0.0}
PUBLISHED = Recording([paper.TENSION_L], [paper.TENSION_S], [paper.BEND_ANGLE], [paper.PRESSURE])


def truth_of(fit):
    return np.array([getattr(TRUTH, name) for name in fit])


def tension_ratio(design):
    """ΔT / T at which a unit without weight slips."""
    arm = design.ball_radius + design.cable_offset
    friction = design.friction_coefficient
    return friction / (1.0 + friction) * design.ball_radius / arm


@pytest.mark.parametrize('factor', [0.5, 0.9, 2.0])
def test_the_published_point_gives_back_the_two_identified_values(factor):
    """The closed form of `paper.identify_mass_and_offset` is the independent method."""
    start = dataclasses.replace(
        PRELIMINARY,
        mass=factor * PRELIMINARY.mass,
        cable_offset=factor * PRELIMINARY.cable_offset,
    )
    fitted = calibrate(start, PUBLISHED, ('mass', 'cable_offset'))
    closed = paper.identify_mass_and_offset(start)
    assert fitted.design.mass == pytest.approx(closed.mass, rel=1e-7)
    assert fitted.design.cable_offset == pytest.approx(closed.cable_offset, rel=1e-7)
    assert fitted.design.mass == pytest.approx(PRELIMINARY.mass, rel=1e-7)
    assert fitted.design == dataclasses.replace(
        PRELIMINARY, mass=fitted.design.mass, cable_offset=fitted.design.cable_offset
    )
    assert any('nothing tests the fit' in warning for warning in fitted.warnings)


@pytest.mark.parametrize('with_pressure', [True, False])
def test_exact_data_give_the_truth_back(with_pressure):
    samples = slipping_samples(12, np.random.default_rng(3))
    fitted = calibrate(PRELIMINARY, recording(samples, with_pressure))
    values = [parameter.value for parameter in fitted.parameters]
    assert values == pytest.approx(truth_of(THREE), rel=1e-4)
    assert fitted.residuals.largest < 1e-3
    assert fitted.counts['slipping'] == 12
    assert fitted.counts['with pressure'] == (12 if with_pressure else 0)


def once_in_a_thousand(count, rate):
    """So many of `count` or fewer are covered at a rate no oftener than that."""
    from scipy.stats import binom  # Here, as each worker loads this file.

    return binom.ppf(0.001, count, rate)


def deviations_and_cover(fits, names=THREE):
    """Errors of fitted values in standard errors, and how many intervals hold the truth."""
    truth = truth_of(names)
    covered, deviations = np.zeros(len(names)), []
    for fitted in fits:
        values = np.array([parameter.value for parameter in fitted.parameters])
        errors = np.array([parameter.standard_error for parameter in fitted.parameters])
        low, high = np.array([parameter.interval for parameter in fitted.parameters]).T
        covered += (low <= truth) & (truth <= high)
        deviations.append((values - truth) / errors)
    return np.array(deviations), covered


@pytest.mark.parametrize('noise', [1.0, 3.0])
@pytest.mark.parametrize(
    ('fit', 'with_pressure', 'count'),
    [(THREE, True, 12), (THREE, True, 40), (('mass', 'friction_coefficient'), False, 40)],
)
def test_intervals_cover_the_truth_at_their_stated_rate(fit, with_pressure, count, noise):
    """Also where the noise is three times the stated, and not by being wide."""
    seeds = few_of(200)
    start = dataclasses.replace(
        TRUTH, **{name: getattr(PRELIMINARY, name) for name in fit if name != 'cable_offset'}
    )
    pool = slipping_samples(300, np.random.default_rng(4))

    def fits():
        for seed in range(seeds):
            rng = np.random.default_rng(seed)
            samples = measured(rng.choice(pool, count), rng, noise)
            data = recording(samples, with_pressure)
            yield calibrate(start, data, fit, pressure_stddev=PRESSURE_STDDEV)

    deviations, covered = deviations_and_cover(fits(), fit)
    # Where the noise is known from 12 slips alone, 92 % are covered.
    rate = 0.95 if noise == 1.0 else 0.92
    assert (covered > once_in_a_thousand(seeds, rate)).all(), covered
    spread = np.std(deviations, axis=0)
    assert (spread > 1.0 - 4.0 / math.sqrt(2.0 * seeds)).all(), spread
    assert (abs(np.mean(deviations, axis=0)) < 5.0 / math.sqrt(seeds)).all()


@pytest.mark.parametrize('ramp', [1, 80, 400])
def test_held_samples_do_not_bias_what_slips_tell(ramp):
    """Neither the many that slow ramps bring next to the boundary, nor those at a stop."""
    seeds = few_of(60)
    pool = slipping_samples(300, np.random.default_rng(4))

    def fits():
        for seed in range(seeds):
            rng = np.random.default_rng(seed)
            data = session(rng.choice(pool, 15), rng, ramp)
            yield calibrate(PRELIMINARY, data, pressure_stddev=PRESSURE_STDDEV)

    deviations, covered = deviations_and_cover(fits())
    assert (abs(np.mean(deviations, axis=0)) < 3.0 / math.sqrt(seeds)).all()
    assert (covered > once_in_a_thousand(seeds, 0.95)).all(), covered


@pytest.mark.parametrize(
    ('law', 'fit', 'cells'),
    [
        ('merged', ('mass', 'friction_coefficient', 'bias_l', 'bias_s'), (1.0, 1.0, 0.03, -0.05)),
        ('friction_circle', ('mass', 'friction_coefficient', 'stiffness'), LoadCells()),
        ('elastic_seat', ('friction_coefficient', 'gain_l', 'gain_s'), (1.05, 0.97, 0.0, 0.0)),
        ('elastic_seat', ('mass', 'stiffness', 'bias_s'), (1.0, 1.0, 0.0, 0.04)),
    ],
)
def test_backbone_and_load_cells_of_any_law_come_back(law, fit, cells):
    """Exact to the model without noise; with it the intervals hold the truth at their rate."""
    plan = SessionPlan(slips=40, tilts=(0.0, 1.0, -1.0))
    truth = unit_of(law, stiffness=0.004 if 'stiffness' in fit else 0.0)
    start = dataclasses.replace(
        truth,
        **{
            name: value
            for name, value in (
                ('mass', 0.0196),
                ('friction_coefficient', 0.6),
                ('stiffness', 0.0),
            )
            if name in fit
        },
    )
    cells = LoadCells(*cells)
    true = [Model(truth, cells).value(name) for name in fit]

    def fitted(seed, noise):
        quiet = plan._replace(
            tension_stddev=noise * TENSION_STDDEV, bend_angle_stddev=noise * BEND_ANGLE_STDDEV
        )
        data, _ = session_of(truth, quiet, np.random.default_rng(seed))
        data = dataclasses.replace(
            data,
            tension_l=(data.tension_l - cells.bias_l) / cells.gain_l,
            tension_s=(data.tension_s - cells.bias_s) / cells.gain_s,
        )
        return calibrate(start, data, fit)

    exact = fitted(0, 0.0)
    assert [of.value for of in exact.parameters] == pytest.approx(true, rel=1e-4, abs=1e-6)
    assert exact.cells == pytest.approx(cells, abs=1e-5)
    seeds = few_of(40)
    covered = np.zeros(len(fit))
    for seed in range(seeds):
        intervals = [of.interval for of in fitted(seed, 1.0).parameters]
        covered += [
            low <= value <= high for (low, high), value in zip(intervals, true, strict=True)
        ]
    assert (covered >= once_in_a_thousand(seeds, 0.95)).all(), covered


def test_the_covariance_is_that_of_errors_and_correlations():
    rng = np.random.default_rng(21)
    data = recording(measured(slipping_samples(40, rng), rng))
    fitted = calibrate(PRELIMINARY, data, ('bias_l', 'mass', 'friction_coefficient'))
    uncertainty = fitted.uncertainty
    assert uncertainty.parameters == ('mass', 'friction_coefficient')
    for parameter in fitted.parameters[1:]:
        assert uncertainty.stddev(parameter.name) == pytest.approx(parameter.standard_error)
    first, second = (uncertainty.stddev(name) for name in uncertainty.parameters)
    expected = fitted.correlation[1, 2] * first * second
    assert uncertainty.covariance[0][1] == pytest.approx(expected)
    alone = calibrate(PRELIMINARY, data, ('mass', 'friction_coefficient')).uncertainty
    assert alone.stddev('friction_coefficient') < uncertainty.stddev('friction_coefficient')


def test_a_load_that_is_not_known_of_a_sample_leaves_it_out():
    rng = np.random.default_rng(22)
    samples = slipping_samples(10, rng)
    tilt = np.zeros(10)
    tilt[3] = math.nan
    data = recording(samples, base_tilt=tilt, tip_force_x=[0.0] * 9 + [math.nan])
    fitted = calibrate(PRELIMINARY, data)
    assert fitted.counts['without a base tilt'] == 1
    assert fitted.counts['without a tip force'] == 1
    assert fitted.counts['slipping'] == 8


def test_two_friction_coefficients_that_hold_as_much_are_said():
    """An elastic seat holds most at one coefficient, and less on either side of it."""
    truth = unit_of('elastic_seat')
    data, _ = session_of(truth, SessionPlan(), np.random.default_rng(23))
    for friction in (0.2, 1.3):
        start = dataclasses.replace(truth, friction_coefficient=friction)
        fitted = calibrate(start, data)
        assert any('other values fit as well' in warning for warning in fitted.warnings)


def test_it_agrees_with_a_fit_of_every_true_sample_beside_the_parameters():
    """Orthogonal distance regression: the true tensions and angles are unknowns too."""
    from scipy.optimize import least_squares

    rng = np.random.default_rng(5)
    # With less noise than stated the soft L1 loss is next to the square.
    samples = measured(slipping_samples(15, rng), rng, share=0.2)
    fit = ('mass', 'friction_coefficient')
    start = dataclasses.replace(TRUTH, mass=PRELIMINARY.mass)
    fitted = calibrate(start, recording(samples, with_pressure=False), fit)
    stddevs = np.array([TENSION_STDDEV, TENSION_STDDEV, BEND_ANGLE_STDDEV])
    scale = truth_of(fit)

    def residuals(unknowns):
        values = dict(zip(fit, unknowns[:2] * scale, strict=True))
        design = dataclasses.replace(TRUTH, **values)
        true = samples[:, :3] + unknowns[2:].reshape(-1, 3) * stddevs
        missing = np.full(len(true), math.nan)
        # So heavily weighted that it is an equation.
        on_boundary = 1e5 * boundary_distance(design, *true.T, missing, fitted.noise).excess
        return np.concatenate([unknowns[2:], on_boundary])

    whole = least_squares(residuals, np.concatenate([[1.0, 1.0], np.zeros(45)]), xtol=1e-12)
    for index, parameter in enumerate(fitted.parameters):
        other = whole.x[index] * scale[index]
        assert abs(parameter.value - other) < 0.01 * parameter.standard_error


def test_outliers_do_not_rule_the_fit():
    rng = np.random.default_rng(6)
    samples = measured(slipping_samples(60, rng), rng)
    samples[::10, 1] += 0.5
    fitted = calibrate(PRELIMINARY, recording(samples), pressure_stddev=PRESSURE_STDDEV)
    for parameter, truth in zip(fitted.parameters, truth_of(THREE), strict=True):
        assert abs(parameter.value - truth) < 4.0 * parameter.standard_error
        assert abs(parameter.value - truth) < 0.2 * truth
    assert fitted.residuals.outliers >= 5


def test_a_held_sample_counts_only_where_it_is_beyond_the_boundary():
    rng = np.random.default_rng(7)
    samples = measured(slipping_samples(20, rng), rng)
    alone = calibrate(PRELIMINARY, recording(samples))
    inside = samples.copy()
    inside[:, :2] = np.sort(samples[:, :2]).mean(axis=1, keepdims=True)  # equal tensions
    both = np.concatenate([samples, inside])
    state = ['slipping'] * 20 + ['held'] * 20
    with_held = calibrate(PRELIMINARY, recording(both, state=state))
    assert with_held.counts['held'] == 20
    assert with_held.design.mass == pytest.approx(alone.design.mass, rel=1e-6)
    assert with_held.residuals.hold_violations == 0

    beyond = samples.copy()
    strong = np.argmax(beyond[:, :2], axis=1)
    beyond[np.arange(20), strong] += 0.2  # would have slipped long since
    both = np.concatenate([samples, beyond])
    contradicted = calibrate(PRELIMINARY, recording(both, state=state))
    assert tension_ratio(contradicted.design) > 1.02 * tension_ratio(alone.design)
    assert any('holds lie beyond' in warning for warning in contradicted.warnings)


@pytest.mark.parametrize(
    ('fit', 'with_pressure', 'named'),
    [
        (('mass', 'gravity'), True, 'mass and gravity are not identifiable apart'),
        (('mass', 'max_bend_angle'), True, 'max_bend_angle is not identifiable: the data do not'),
        (('mass', 'contact_width'), False, 'contact_width is not identifiable'),
        (
            ('mass', 'gravity', 'cable_offset', 'contact_width'),
            False,
            'mass and gravity are not identifiable apart',
        ),
        (THREE, False, 'cable_offset and friction_coefficient are correlated'),
    ],
)
def test_what_the_data_do_not_determine_is_said_with_the_reason(fit, with_pressure, named):
    rng = np.random.default_rng(8)
    samples = measured(slipping_samples(40, rng), rng)
    fitted = calibrate(TRUTH, recording(samples, with_pressure), fit)
    assert any(named in warning for warning in fitted.warnings), fitted.warnings
    undetermined = fitted.undetermined
    assert all(p.interval is None for p in fitted.parameters if p.name in undetermined)
    assert (fitted.design is None) == bool(undetermined)
    for name in ('max_bend_angle', 'gravity'):
        assert (name in undetermined) == (name in fit)
    if 'cable_offset' in fit:
        assert 'cable_offset' not in undetermined
        assert math.isnan(fitted.correlation[0, 0]) == ('gravity' in fit)


def test_too_few_equations_are_said():
    samples = slipping_samples(1, np.random.default_rng(9))
    fitted = calibrate(PRELIMINARY, recording(samples), THREE)
    assert '2 equations cannot determine 3 parameters' in fitted.warnings[0]
    assert any('not identifiable apart from each other' in warning for warning in fitted.warnings)
    assert fitted.undetermined == list(THREE)


def test_equations_that_nothing_meets_are_said_even_if_none_is_to_spare():
    sample = Recording([1.0], [2.0], [0.299], [900.0])
    fitted = calibrate(PRELIMINARY, sample, ('mass', 'cable_offset'))
    assert any('no values within their ranges' in warning for warning in fitted.warnings)
    assert not any('nothing tests the fit' in warning for warning in fitted.warnings)
    for parameter in fitted.parameters:
        assert parameter.interval[0] <= parameter.value <= parameter.interval[1]
        assert parameter.interval[1] * PRELIMINARY.gravity < 3.0  # the weight stays below T


def test_data_that_no_design_comes_near_are_refused():
    rng = np.random.default_rng(17)
    samples = measured(slipping_samples(20, rng), rng)
    samples[:, :2] *= 1000.0  # mN taken for N
    with pytest.raises(CalibrationError, match='wrong units, signs or states'):
        calibrate(PRELIMINARY, recording(samples))


def test_a_value_at_the_end_of_its_range_is_said():
    samples = slipping_samples(20, np.random.default_rng(10), TRUTH)
    start = dataclasses.replace(PRELIMINARY, friction_coefficient=0.4)
    fitted = calibrate(start, recording(samples, with_pressure=False), ('cable_offset',))
    assert fitted.design.cable_offset == pytest.approx(0.0, abs=1e-12)
    assert any('cable_offset is at the end of its range' in w for w in fitted.warnings)


def test_a_standard_error_as_large_as_the_value_is_said():
    rng = np.random.default_rng(11)
    light = dataclasses.replace(TRUTH, mass=1e-4)
    samples = measured(slipping_samples(20, rng, light), rng)
    fitted = calibrate(light, recording(samples), ('mass',))
    assert any('mass is hardly identifiable' in warning for warning in fitted.warnings)
    assert fitted.parameters[0].interval[0] == 0.0  # no mass is negative


def test_noise_beyond_the_stated_enlarges_the_errors_and_is_said():
    rng = np.random.default_rng(12)
    samples = measured(slipping_samples(60, rng), rng)
    stated, understated = (
        calibrate(
            PRELIMINARY,
            recording(samples),
            tension_stddev=share * TENSION_STDDEV,
            bend_angle_stddev=share * BEND_ANGLE_STDDEV,
            pressure_stddev=share * PRESSURE_STDDEV,
        )
        for share in (1.0, 0.1)
    )
    for one, other in zip(stated.parameters, understated.parameters, strict=True):
        assert 0.6 < other.standard_error / one.standard_error < 1.7
    assert understated.residuals.scale == pytest.approx(10.0 * stated.residuals.scale, rel=0.1)
    assert any('the distances scatter' in warning for warning in understated.warnings)
    assert not any('scatter' in warning for warning in stated.warnings)


def test_what_cannot_be_used_is_counted_by_reason():
    good = slipping_samples(10, np.random.default_rng(13))
    stop = TRUTH.max_bend_angle
    bad = np.array(
        [
            [math.nan, 1.0, 0.1, 400.0],
            [-1.0, 1.0, 0.1, 400.0],
            [0.0, 1.0, 0.1, 400.0],
            [0.01, 0.02, 0.1, 400.0],
            [1.0, 2.0, math.nan, 400.0],
            [1.0, 3.0, stop, 400.0],
            [1.0, 3.0, stop + 0.1, 400.0],
            [1.0, 2.0, 0.1, 400.0],
        ]
    )
    state = ['slipping'] * 17 + ['moving']
    fitted = calibrate(PRELIMINARY, recording(np.concatenate([good, bad]), state=state))
    assert fitted.counts == {
        'slipping': 10,
        'with pressure': 10,
        'held': 0,
        'holds': 0,
        'of invalid tensions': 2,
        'slack': 1,
        'below the weight': 1,
        'without an angle': 1,
        'at the stop': 1,
        'beyond the stop': 1,
        'of no known state': 1,
    }
    assert np.isnan(fitted.distance.standardised).tolist() == [False] * 10 + [True] * 8


@pytest.mark.parametrize(
    ('data', 'options', 'named'),
    [
        (Recording([1.0], [2.0]), {}, 'no measured bend angle'),
        (Recording([1.0], [2.0], [math.nan]), {}, r'none of 1 samples.*1 without an angle'),
        (PUBLISHED, {'fit': ('weight',)}, "'weight', which is no design parameter"),
        (PUBLISHED, {'fit': ('mass', 'mass')}, 'mass twice'),
        (PUBLISHED, {'fit': ()}, 'no parameter'),
        (PUBLISHED, {'tension_stddev': 0.0}, 'tension_stddev is 0.0 N'),
        (PUBLISHED, {'tension_stddev': 1e-320}, 'allowed is 1e-09 to 1000 N'),
        (PUBLISHED, {'bend_angle_stddev': 1e300}, 'allowed is 0 to 1 rad'),
        (PUBLISHED, {'bend_angle_stddev': -1.0}, 'bend_angle_stddev is -1.0'),
        (PUBLISHED, {'pressure_stddev': math.nan}, 'pressure_stddev is nan'),
        (Recording([1.0], [2.0], [0.3], [1e308]), {'pressure_stddev': 8.0}, 'beyond all measure'),
        (Recording([1.0], [2.0], [0.3], time=[0.0]), {}, 'have no state that says which'),
    ],
)
def test_what_nothing_can_be_fitted_to_is_named(data, options, named):
    with pytest.raises(CalibrationError, match=named):
        calibrate(PRELIMINARY, data, **options)


def test_values_stay_where_the_model_has_an_answer():
    """Samples hardly above the weight: a search that left the model would find no residuals."""
    samples = slipping_samples(20, np.random.default_rng(14))
    samples[:, :2] *= 1.1 * TRUTH.weight / (samples[:, 0] + samples[:, 1]).max()
    samples[::4, :2] *= 8.0
    fitted = calibrate(dataclasses.replace(TRUTH, mass=0.001), recording(samples, False))
    least = (samples[:, 0] + samples[:, 1]).min()
    assert fitted.design.weight < least
    assert all(
        math.isfinite(getattr(fitted.design, parameter.name)) for parameter in design_parameters()
    )


def test_a_start_whose_weight_is_just_below_a_sample_is_no_obstacle():
    """The search ends below the least tensions, and has to begin there too."""
    samples = slipping_samples(20, np.random.default_rng(15))
    least = (samples[:, 0] + samples[:, 1]).min()
    start = dataclasses.replace(TRUTH, mass=(1.0 - 1e-9) * least / TRUTH.gravity)
    fitted = calibrate(start, recording(samples))
    assert fitted.design.mass == pytest.approx(TRUTH.mass, rel=1e-3)


def test_a_search_that_does_not_end_is_said(monkeypatch):
    monkeypatch.setattr('tendon_statics.physics.calibration.problem.MOST_DESIGNS', 2)
    samples = measured(slipping_samples(20, np.random.default_rng(16)), np.random.default_rng(16))
    with pytest.raises(CalibrationError, match='has not ended after 2 designs'):
        calibrate(PRELIMINARY, recording(samples))
