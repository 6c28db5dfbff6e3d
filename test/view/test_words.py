"""What the page says in words."""

import math

import estimates
import pytest
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from std_msgs.msg import Header
from tendon_statics_interfaces.msg import Estimate

from tendon_statics import Regime, default_design_path, load_design, solve
from tendon_statics.node.outputs.messages import fill_estimate
from tendon_statics.view.estimate_values import angle_interval, load_of, regime_probabilities
from tendon_statics.view.unit_sample import unit_sample
from tendon_statics.view.words import diagnostics_words, nobody, state_words, waiting

DESIGN = load_design(default_design_path())
PUBLISHED, HELD, SLACK = (1.0, 2.0), (1.0, 1.5), (0.0, 2.0)


def estimate_of(*tensions, load_assured=True):
    result = solve(DESIGN, *tensions)
    message = fill_estimate(Estimate(), estimates.estimate_of(result), Header())
    message.load_assured = load_assured
    return message


@pytest.mark.parametrize('tensions', [PUBLISHED, HELD, SLACK, (1.0, 3.0)])
def test_the_regime_is_named_and_explained(tensions):
    words = state_words(estimate_of(*tensions), '', 0.0)
    assert solve(DESIGN, *tensions).regime.value.split('_')[0] in words
    assert 's ago' not in words


def test_what_is_not_determined_has_no_number():
    words = state_words(estimate_of(*HELD), '', 0.0)
    assert words.count('not determined') == 3
    assert 'nan' not in words


def test_doubts_are_named():
    words = state_words(estimate_of(*PUBLISHED, load_assured=False), '', 0.0)
    assert 'No message tells the load' in words
    assert 'slides on to the stop' in words
    tracked = estimate_of(1.0, 3.0)
    tracked.angle_assured = False
    assert 'its angle is not assured' in state_words(tracked, '', 0.0)
    assert 'assured' not in state_words(estimate_of(1.0, 3.0), '', 0.0)


@pytest.mark.parametrize('said', ['invalid', 'stale'])
def test_what_stands_in_place_of_an_estimate_takes_precedence(said):
    words = state_words(estimate_of(*PUBLISHED), said, 12.0)
    assert f'>{said} <small>12 s ago' in words


def test_an_estimator_with_an_unknown_regime_is_shown_by_its_own_word():
    estimate = estimate_of(*PUBLISHED)
    estimate.regime = 'floating'
    assert 'floating' in state_words(estimate, '', 0.0)


def test_texts_from_elsewhere_are_no_markup():
    status = DiagnosticStatus(
        level=DiagnosticStatus.WARN,
        message='<script>alert(1)</script>',
        values=[KeyValue(key='dropped: <b>', value='<img src=x>')],
    )
    words = diagnostics_words(status, 0.0) + nobody('<i>', '/left/<u>')
    estimate = estimate_of(*PUBLISHED)
    estimate.regime = '<script>'
    words += state_words(estimate, '', 0.0)
    for markup in ('<script', '<img', '<i>', '<u>', 'dropped: <b>'):
        assert markup not in words


@pytest.mark.parametrize(
    ('level', 'word'),
    [
        (DiagnosticStatus.OK, 'OK'),
        (DiagnosticStatus.WARN, 'WARN'),
        (DiagnosticStatus.ERROR, 'ERROR'),
        (DiagnosticStatus.STALE, 'STALE'),
    ],
)
def test_the_level_of_diagnostics_is_a_word(level, word):
    assert f'>{word}</b>' in diagnostics_words(DiagnosticStatus(level=level), 0.0)


def test_counts_of_diagnostics_are_shown_where_they_are_not_0():
    values = [KeyValue(key='dropped: negative', value='3'), KeyValue(key='rate [Hz]', value='50')]
    words = diagnostics_words(DiagnosticStatus(values=values), 0.0)
    assert 'dropped: negative: 3' in words
    values[0].value = '0'
    words = diagnostics_words(DiagnosticStatus(values=values), 0.0)
    assert 'dropped' not in words
    assert 'rate [Hz]: 50' in words


def test_the_interval_is_that_of_the_estimator_if_it_gives_one():
    estimate = Estimate(bend_angle=0.2, bend_angle_stddev=0.05)
    estimate.bend_angle_low, estimate.bend_angle_high = 0.05, 0.4
    assert angle_interval(estimate) == (0.05, 0.4)
    estimate.bend_angle_low = math.nan
    assert angle_interval(estimate) == pytest.approx((0.1, 0.3))


def test_probabilities_are_those_of_the_estimator_or_none():
    estimate = Estimate(probability_held=0.5, probability_driven_to_stop=0.5)
    assert regime_probabilities(estimate)[Regime.HELD] == 0.5
    estimate.probability_held = math.nan
    assert regime_probabilities(estimate) is None


def test_what_is_provisional_or_held_against_measurements_is_said():
    estimate = estimate_of(*PUBLISHED)
    assert 'may revise it' not in state_words(estimate, '', 0.0)
    assert 'consistency' not in state_words(estimate, '', 0.0)
    estimate.provisional, estimate.consistency = True, 0.25
    words = state_words(estimate, '', 0.0)
    assert 'may revise it' in words
    assert '0.250' in words


def test_the_load_is_read_as_it_was_taken():
    result = solve(DESIGN, *PUBLISHED)
    assert load_of(estimate_of(*PUBLISHED)) == result.load
    assert load_of(Estimate()) is None  # gravity without a direction


def test_a_sample_is_in_the_units_of_the_page():
    result, sample = solve(DESIGN, *PUBLISHED), unit_sample(estimate_of(*PUBLISHED))
    assert sample['angle'] == pytest.approx(math.degrees(result.bend_angle))
    assert sample['angle_low'] < sample['angle'] < sample['angle_high']
    (interval,) = result.admissible_angles
    found = sample['admissible_low_0'], sample['admissible_high_0']
    assert found == pytest.approx(tuple(map(math.degrees, interval)))
    assert sample['pressure'] == pytest.approx(result.pressure)
    assert (sample['tension_l'], sample['tension_s']) == PUBLISHED


def test_what_was_said_before_the_first_estimate_is_said():
    assert 'do tensions come' in waiting('/left/estimator', '')
    assert '>stale<' in waiting('/left/estimator', 'stale')
    assert 'No valid tensions come any more' in waiting('/left/estimator', 'stale')
