"""`compare_laws`: the true law where an experiment can tell it, none where it cannot, and why."""

import dataclasses
import json
import math

import numpy as np
import pytest
from brute import LAWS
from designs import PRELIMINARY
from law_sessions import SessionPlan, recorded, session_of, slips_of, unit_of
from thoroughness import few_of

from tendon_statics import CalibrationError, Load, compare_laws
from tendon_statics.physics.calibration.experiments import predicted_slips
from tendon_statics.physics.calibration.law_comparison import RATIO
from tendon_statics.physics.calibration.load_cells import LoadCells
from tendon_statics.physics.calibration.parameters import Model

KNOWN_OFFSET = ('mass', 'friction_coefficient')
TILTED = SessionPlan(tilts=(0.0, 1.0, -1.0))


def compared(truth, plan, seed, fit=KNOWN_OFFSET, known=('cable_offset',), **options):
    recording, pressure_stddev = session_of(truth, plan, np.random.default_rng(seed))
    values = {name: getattr(truth, name) for name in (*known, 'contact_width')}
    start = dataclasses.replace(PRELIMINARY, **values)
    return compare_laws(
        start,
        recording,
        fit,
        pressure_stddev=pressure_stddev,
        load=Load(tip_distance=plan.tip_distance),
        **options,
    )


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize(
    ('plan', 'changes', 'fit', 'known'),
    [
        (SessionPlan(pressure_stddev=0.02), {'contact_width': 0.002}, KNOWN_OFFSET, ()),
        (SessionPlan(), {}, ('mass',), ('friction_coefficient',)),
    ],
    ids=['pressure', 'friction known'],
)
def test_the_true_law_is_told_where_the_experiment_can_tell(law, plan, changes, fit, known):
    for seed in range(few_of(8)):
        found = compared(unit_of(law, **changes), plan, seed, fit, ('cable_offset', *known))
        assert found.told == law, found.statement
        assert found.possible == [law]
        assert found.best.calibration.design.contact_law == law
        assert found.advice == ()
        assert f'the data tell {law}' in found.statement


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('changes', [{}, {'mass': 1e-4}], ids=['upright', 'light'])
def test_no_law_is_told_where_friction_makes_up_for_it(law, changes):
    """An upright unit has one effective coefficient: each law has a friction that gives it."""
    for seed in range(few_of(8)):
        found = compared(unit_of(law, **changes), SessionPlan(), seed, with_advice=False)
        assert found.told is None
        assert law in found.possible
        assert 'the data cannot tell' in found.statement


@pytest.mark.parametrize('law', LAWS)
def test_what_would_tell_is_said_and_does(law):
    truth = unit_of(law)
    found = compared(truth, SessionPlan(), 1)
    texts = [advice.text for advice in found.advice]
    assert any('measured pressure' in text for text in texts), texts
    assert any(text.startswith('a friction_coefficient that is measured') for text in texts)
    assert all(advice.difference >= 2.0 * math.log(RATIO) - 1e-9 for advice in found.advice)
    known = compared(truth, SessionPlan(), 1, ('mass',), ('cable_offset', 'friction_coefficient'))
    assert known.told == law


def test_a_tilted_base_and_a_weight_tell_laws_apart_that_one_pose_does_not():
    """Noise-free, so that the difference is the one which an experiment has on average."""
    differences = {}
    for name, plan in (
        ('upright', SessionPlan()),
        ('tilted', TILTED),
        ('weight', SessionPlan(tip_forces=((0.0, 0.0), (0.0, -0.4)), tip_distance=0.016)),
    ):
        truth = unit_of('merged')
        rows, loads = slips_of(truth, plan, np.random.default_rng(2))
        exact = plan._replace(tension_stddev=0.0, bend_angle_stddev=0.0)
        recording, _ = recorded(rows, loads, exact, np.random.default_rng(2))
        start = dataclasses.replace(PRELIMINARY, cable_offset=truth.cable_offset)
        found = compare_laws(
            start, recording, KNOWN_OFFSET, load=Load(tip_distance=0.016), with_advice=False
        )
        assert found.best.law == 'merged'
        differences[name] = found.fits[1].difference
    assert differences['tilted'] > 1.5 * differences['upright'], differences
    assert differences['weight'] > 1.5 * differences['upright'], differences


def test_more_noise_than_stated_tells_nothing():
    plan = SessionPlan(slips=60, tension_stddev=0.03, bend_angle_stddev=math.radians(1.5))
    found = compared(unit_of('merged'), plan, 3)
    assert found.told is None
    assert not found.meets_data
    assert 'the data tell no law' in found.statement
    assert found.noise_scale > 2.0


def test_a_contact_width_that_is_not_known_is_fitted_where_it_counts():
    """A design says 1 m of it, with which a real pressure would rule out two laws at once."""
    truth = unit_of('merged', contact_width=0.003)
    plan = SessionPlan(pressure_stddev=0.02)
    recording, stddev = session_of(truth, plan, np.random.default_rng(4))
    start = dataclasses.replace(PRELIMINARY, cable_offset=truth.cable_offset)
    found = compare_laws(start, recording, KNOWN_OFFSET, pressure_stddev=stddev)
    fitted = {fit.law: fit.calibration for fit in found.fits}
    names = {law: [of.name for of in fit.parameters] for law, fit in fitted.items()}
    assert 'contact_width' in names['merged']
    assert 'contact_width' in names['friction_circle']
    assert 'contact_width' not in names['elastic_seat']
    assert 'merged' in found.possible
    assert fitted['merged'].design.contact_width == pytest.approx(0.003, rel=0.3)


def test_a_law_that_is_not_made_for_the_unit_is_left_out():
    truth = unit_of('friction_circle', contact_end_angle=math.radians(100.0))
    recording, _ = session_of(truth, SessionPlan(), np.random.default_rng(5))
    found = compare_laws(truth, recording, ('friction_coefficient',))
    (left_out,) = [fit for fit in found.fits if not fit.is_applicable]
    assert left_out.law == 'elastic_seat'
    assert '90 deg' in left_out.failure
    assert 'elastic_seat' not in found.possible
    json.dumps(found.as_dict(), allow_nan=False)


def test_laws_are_compared_on_the_same_samples():
    """Those that all of them take: the paper's takes no dead load above the tensions."""
    truth = unit_of('friction_circle', mass=0.1)
    plan = SessionPlan(totals=(0.7, 3.0))
    recording, _ = session_of(truth, plan, np.random.default_rng(6))
    found = compare_laws(truth, recording, ('friction_coefficient',), with_advice=False)
    counts = [fit.calibration.counts for fit in found.fits]
    assert counts[0]['below the weight'] > 0
    assert all(of == counts[0] for of in counts)


def test_an_unknown_law_is_named():
    from tendon_statics import calibrate

    recording, _ = session_of(unit_of('merged'), SessionPlan(), np.random.default_rng(7))
    with pytest.raises(CalibrationError, match='there are merged, friction_circle, elastic_seat'):
        calibrate(PRELIMINARY, recording, contact_law='dry')


@pytest.mark.parametrize('law', LAWS)
def test_predicted_slips_are_those_of_the_brute_force(law):
    from tendon_statics.physics.calibration.boundary_distance import Noise
    from tendon_statics.physics.calibration.samples import SortedSamples

    truth = unit_of(law, stiffness=0.003)
    rows, loads = slips_of(truth, TILTED, np.random.default_rng(8))
    exact = TILTED._replace(tension_stddev=0.0, bend_angle_stddev=0.0)
    recording, _ = recorded(rows, loads, exact, np.random.default_rng(8))
    cells = LoadCells(1.1, 0.9, 0.02, -0.03)
    measured = dataclasses.replace(
        recording,
        tension_l=(recording.tension_l - cells.bias_l) / cells.gain_l,
        tension_s=(recording.tension_s - cells.bias_s) / cells.gain_s,
    )
    samples = SortedSamples(truth, measured, Noise(0.01, 0.01, 1.0))
    found = predicted_slips(Model(truth, cells), samples, samples.loads, with_pressure=True)
    assert found.tension_l == pytest.approx(measured.tension_l, abs=1e-9)
    assert found.tension_s == pytest.approx(measured.tension_s, abs=1e-9)
    # The constants of the seat are summed up by two methods.
    assert found.pressure == pytest.approx(rows[:, 3], rel=1e-5)
