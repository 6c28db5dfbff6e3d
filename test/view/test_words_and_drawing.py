"""What the page says of a unit and what it draws of it are one, whatever comes."""

import math
import re

import estimates
import pytest
from std_msgs.msg import Header
from tendon_statics_interfaces.msg import Estimate

from tendon_statics import (
    Load,
    Regime,
    StickSlipFilter,
    StickSlipTracker,
    default_design_path,
    load_design,
    solve,
)
from tendon_statics.estimation.estimate import KnownLoad
from tendon_statics.estimation.filtered_estimate import FilteredEstimate
from tendon_statics.estimation.regimes import INVALID, STALE
from tendon_statics.estimation.settings import Settings
from tendon_statics.node.outputs.messages import fill_estimate
from tendon_statics.view.drawing import INK, UPRIGHT
from tendon_statics.view.estimate_values import GREY, OLD, is_present
from tendon_statics.view.unit_figure import UnitFigure
from tendon_statics.view.unit_sample import unit_sample
from tendon_statics.view.words import LAST_KNOWN, NO_DESIGN, NOT_DETERMINED, state_words

DESIGN = load_design(default_design_path())


def of_pair(*tensions):
    return fill_estimate(Estimate(), estimates.estimate_of(solve(DESIGN, *tensions)), Header())


def tracked(*pairs):
    tracker = StickSlipTracker(DESIGN)
    states = [tracker.update(*pair) for pair in pairs]
    return fill_estimate(Estimate(), estimates.estimate_of(states[-1]), Header())


def filtered(*pairs):
    unit = StickSlipFilter(DESIGN, tension_stddev=0.02)
    states = [unit.update(*pair, time=0.01 * n) for n, pair in enumerate(pairs)]
    estimate = FilteredEstimate(states[-1], KnownLoad(Load()), Settings(DESIGN), 0.0)
    return fill_estimate(Estimate(), estimate, Header())


def changed(estimate, **values):
    for name, value in values.items():
        setattr(estimate, name, value)
    return estimate


HELD, VERGE, DRIVEN, SLACK = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0), (0.0, 2.0)
STATES = {
    'held, the angle open': lambda: of_pair(*HELD),
    'on the verge of slipping': lambda: of_pair(*VERGE),
    'driven to the stop': lambda: of_pair(*DRIVEN),
    'slack': lambda: of_pair(*SLACK),
    'held where it was': lambda: tracked(DRIVEN, HELD),
    'held after a slack cable': lambda: tracked(HELD, SLACK, HELD),
    'tracked and slack': lambda: tracked(HELD, SLACK),
    'filtered': lambda: filtered(*[HELD] * 20),
    'filtered near slip': lambda: filtered(*[(1.0, 1.97)] * 20),
    'filtered and slack': lambda: filtered(*[HELD] * 20, SLACK),
    'filtered after a slack cable': lambda: filtered(*[HELD] * 20, SLACK, *[HELD] * 20),
    # From whoever publishes the type.
    'an interval, but no angle': lambda: changed(
        of_pair(*HELD), bend_angle_low=0.1, bend_angle_high=0.2
    ),
    'held, and nowhere': lambda: changed(of_pair(*HELD), admissible_angles=[]),
    'an interval without an end': lambda: changed(
        of_pair(*VERGE), bend_angle_low=-math.inf, bend_angle_high=0.4
    ),
    'an interval of many turns': lambda: changed(
        of_pair(*VERGE), bend_angle_low=-100.0, bend_angle_high=200.0
    ),
    'an infinite angle': lambda: changed(of_pair(*VERGE), bend_angle=math.inf),
    'a deviation of a pressure that is not known': lambda: changed(
        of_pair(*VERGE), pressure=math.nan
    ),
    'a regime of another kind': lambda: changed(of_pair(*VERGE), regime='floating'),
}
WHEN = {
    'now': ('', 0.0),
    'invalid': (INVALID, 0.0),
    'stale': (STALE, 1.0),
    'long ago': ('', OLD + 1.0),
}


def degrees_in(row):
    return [tuple(map(float, ends)) for ends in re.findall(r'(-?\d+\.\d) to (-?\d+\.\d)°', row)]


def rows_of(words):
    return dict(re.findall(r'<tr><th>(.*?)</th><td>(.*?)</td></tr>', words))


def drawn_arcs(figure):
    data = figure._arcs.data
    of = {'band': [], 'interval': []}
    for start, end, colour in zip(data['start'], data['end'], data['colour'], strict=True):
        ends = tuple(math.degrees(UPRIGHT - place) for place in (end, start))
        of['interval' if colour == INK else 'band'].append(ends)
    return of


def close(drawn, said):
    return len(drawn) == len(said) and all(
        one == pytest.approx(other, abs=0.051) for one, other in zip(drawn, said, strict=True)
    )


@pytest.fixture(scope='module')
def figure():
    """One for all, as on a page."""
    return UnitFigure()


@pytest.mark.parametrize('when', WHEN)
@pytest.mark.parametrize('state', STATES)
def test_words_and_drawing_are_one(figure, state, when):
    estimate = STATES[state]()
    said, age = WHEN[when]
    words = state_words(estimate, said, age)
    present = is_present(said, age)
    figure.draw(DESIGN, estimate, present=present)
    arcs, rows, body = drawn_arcs(figure), rows_of(words), figure._body.data

    assert 'nan' not in words
    assert 'inf ' not in words
    assert close(arcs['interval'], degrees_in(rows['bend angle']))
    assert close(arcs['band'], degrees_in(rows.get('can hold at', '')))
    assert (rows.get('can hold at') == 'nowhere') == (
        not arcs['band'] and estimate.regime != Regime.SLACK
    )
    assert (NOT_DETERMINED in words) <= bool(arcs['band'])
    assert rows['bend angle'].startswith('not determined') == (not body['angle'])
    if body['angle']:
        shown = float(rows['bend angle'].split('°')[0])
        assert math.degrees(-body['angle'][0]) == pytest.approx(shown, abs=0.0051)
        assert f'style="color:{body["colour"][0]}"' in words
    assert (LAST_KNOWN in words) == (not present) == ('ago' in words or bool(said))
    assert (f'<h2 style="color:{GREY}"' in words) >= (not present)

    sample = unit_sample(estimate)
    ends = sample['angle_low'], sample['angle_high']
    over_time = [] if math.isnan(ends[0]) else [ends]
    assert close(arcs['interval'], over_time)
    assert ('±' in rows['pressure']) == (not math.isnan(sample['pressure_low']))


def test_the_colour_of_a_drawing_follows_when_its_estimate_gets_old():
    estimate, figure = of_pair(*VERGE), UnitFigure()
    figure.draw(DESIGN, estimate)
    fresh = list(figure._body.data['colour'])
    figure.draw(DESIGN, estimate, present=False)
    assert fresh != figure._body.data['colour'] == [GREY]
    assert set(figure._arcs.data['colour']) == {GREY, INK}


def test_without_a_design_words_say_why_nothing_is_drawn():
    estimate = of_pair(*VERGE)
    assert NO_DESIGN in state_words(estimate, '', 0.0, is_drawn=False)
    assert NO_DESIGN not in state_words(estimate, '', 0.0)


def test_of_an_estimator_that_is_left_nothing_stays():
    figure = UnitFigure()
    figure.draw_design(DESIGN)
    figure.draw(DESIGN, of_pair(*VERGE))
    figure.clear()
    for source in (figure._base, figure._stops, figure._arcs, figure._body, figure._arrows):
        assert not any(source.data.values())
