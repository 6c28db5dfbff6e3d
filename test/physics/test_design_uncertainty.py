"""`DesignUncertainty`: what a covariance of design parameters is, and the file it stands in."""

import dataclasses

import numpy as np
import pytest
from designs import PRELIMINARY

from tendon_statics import (
    DesignError,
    DesignUncertainty,
    load_design,
    load_design_uncertainty,
    save_design,
    solve,
)
from tendon_statics.files.unit_file import load_unit

TWO = DesignUncertainty(('mass', 'friction_coefficient'), ((4e-6, 1e-5), (1e-5, 9e-4)))


def test_it_comes_back_from_a_file_to_the_last_digit(tmp_path):
    rng = np.random.default_rng(1)
    factor = rng.normal(size=(3, 3)) * [[1e-3], [1e-4], [1e-2]]
    names = ('mass', 'cable_offset', 'friction_coefficient')
    covariance = factor @ factor.T
    before = DesignUncertainty(
        names, tuple(map(tuple, (0.5 * (covariance + covariance.T)).tolist()))
    )
    path = tmp_path / 'unit.yaml'
    save_design(path, PRELIMINARY, parameters={'tension_stddev': 0.02}, uncertainty=before)
    assert load_design_uncertainty(path) == before
    assert load_unit(path).uncertainty == before
    assert load_unit(path).get('tension_stddev') == 0.02
    assert load_design(path) == PRELIMINARY
    again = tmp_path / 'again.yaml'
    save_design(again, PRELIMINARY, parameters=load_unit(path).parameters)
    assert load_design_uncertainty(again) == before
    save_design(again, PRELIMINARY, parameters=load_unit(path).parameters, uncertainty=TWO)
    assert load_design_uncertainty(again) == TWO


def test_deviations_are_the_roots_of_the_diagonal():
    assert TWO.stddev('mass') == pytest.approx(2e-3)
    assert TWO.stddev('friction_coefficient') == pytest.approx(0.03)
    assert TWO.stddev('gravity') == 0.0
    assert DesignUncertainty.of_flat(TWO.parameters, TWO.flat) == TWO
    assert DesignUncertainty((), ()).flat == []


def test_the_deviations_of_an_answer_cover_the_design():
    """As draws of tensions and design have it, solved one by one."""
    random = np.random.default_rng(3)
    small = DesignUncertainty(TWO.parameters, tuple((1e-2 * np.array(TWO.covariance)).tolist()))
    answer = solve(PRELIMINARY, 1.0, 2.0)
    noise = 1e-4
    drawn = [
        solve(
            dataclasses.replace(
                PRELIMINARY,
                **{
                    name: getattr(PRELIMINARY, name) + 0.1 * change
                    for name, change in zip(TWO.parameters, changes, strict=True)
                },
            ),
            *(tension + random.normal(0.0, noise) for tension in (1.0, 2.0)),
        )
        for changes in random.multivariate_normal([0.0, 0.0], TWO.covariance, 4000)
    ]
    drawn = [one for one in drawn if one.regime == 'equilibrium']
    assert len(drawn) > 3900
    for name in ('bend_angle', 'pressure'):
        spread = np.std([getattr(one, name) for one in drawn])
        stddev = getattr(answer, f'{name}_stddev')
        assert stddev(noise, small) == pytest.approx(spread, rel=0.06)
        assert stddev(noise) < 0.5 * spread
        assert stddev(noise, DesignUncertainty((), ())) == stddev(noise)


def test_a_file_that_does_not_say_has_none(tmp_path):
    path = tmp_path / 'unit.yaml'
    save_design(path, PRELIMINARY)
    assert load_design_uncertainty(path) is None


@pytest.mark.parametrize(
    ('names', 'covariance', 'named'),
    [
        (['weight'], [1.0], "'weight', which is no design parameter"),
        (['contact_law'], [1.0], "'contact_law', which is no design parameter"),
        (['mass', 'mass'], [1.0, 0.0, 0.0, 1.0], 'mass twice'),
        (['mass'], [1.0, 2.0], '2 numbers; 1 parameters need 1'),
        (['mass'], [-1.0], 'a variance below 0'),
        (['mass', 'gravity'], [1.0, 0.5, 0.4, 1.0], 'not symmetric'),
        (['mass', 'gravity'], [1.0, 2.0, 2.0, 1.0], 'a variance below 0'),
        (['mass'], ['much'], "'much', a finite number"),
        (['mass'], [float('nan')], 'nan, a finite number'),
        ('mass', [1.0], "'mass', a list is needed"),
        (['mass'], None, 'covariance is None, a list is needed'),
    ],
)
def test_what_is_no_covariance_is_refused_with_file_and_key(tmp_path, names, covariance, named):
    path = tmp_path / 'unit.yaml'
    parameters = {'design_uncertainty.parameters': names}
    if covariance is not None:
        parameters['design_uncertainty.covariance'] = covariance
    save_design(path, PRELIMINARY, parameters=parameters)
    path.write_text(path.read_text().replace('[NaN]', '[.nan]'))
    for read in (load_design_uncertainty, load_unit):
        with pytest.raises(DesignError) as caught:
            read(path)
        assert str(path) in str(caught.value)
        assert 'design_uncertainty.' in str(caught.value)
        assert named in str(caught.value)
    assert load_design(path) == PRELIMINARY
