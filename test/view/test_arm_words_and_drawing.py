"""What the page says of an arm and what it draws of it are one, whatever comes."""

import math

import pytest
from std_msgs.msg import Header
from tendon_statics_interfaces.msg import AdmissibleAngles, ArmEstimate

from tendon_statics import ArmFilter, ArmTracker, Load, Regime, load_arm
from tendon_statics.estimation.arm_estimate import ArmEstimate as Found
from tendon_statics.estimation.arm_settings import ArmSettings
from tendon_statics.estimation.estimate import KnownLoad
from tendon_statics.estimation.filtered_arm_estimate import FilteredArmEstimate
from tendon_statics.estimation.regimes import INVALID, REGIME_COLOURS, STALE
from tendon_statics.files.installed_files import installed_config
from tendon_statics.node.outputs.arm_messages import fill_admissible_angles, fill_arm_estimate
from tendon_statics.view.arm_figure import ArmFigure
from tendon_statics.view.arm_values import arm_names, arm_sample, is_of, joints_said
from tendon_statics.view.arm_words import NO_ARM, arm_state_words, joints_table
from tendon_statics.view.drawing import FORCE
from tendon_statics.view.estimate_values import GREY, OLD
from tendon_statics.view.words import LAST_KNOWN

ARM = load_arm(installed_config('arm.yaml'))
NAMES = tuple(f'arm_joint_{number}' for number in range(1, 6))
EVEN = {'l_mid': 1.0, 's_mid': 1.0, 'l_tip': 1.0, 's_tip': 1.0}
BENT = {**EVEN, 's_tip': 1.6}
DRIVEN = {**EVEN, 's_tip': 4.0}
SLACK = {**EVEN, 'l_tip': 0.0}
SETTINGS = ArmSettings(ARM, NAMES)


def found_by_tracking(*rows):
    tracker = ArmTracker(ARM)
    state = [tracker.update(row) for row in rows][-1]
    return Found(state, KnownLoad(Load()), SETTINGS)


def found_by_filtering(*rows):
    arm = ArmFilter(ARM, tension_stddev=0.02)
    state = [arm.update(row, time=0.01 * number) for number, row in enumerate(rows)][-1]
    return FilteredArmEstimate(state, KnownLoad(Load()), SETTINGS, 0.01 * len(rows))


def tracked(*rows):
    return fill_arm_estimate(ArmEstimate(), found_by_tracking(*rows), Header())


def filtered(*rows):
    return fill_arm_estimate(ArmEstimate(), found_by_filtering(*rows), Header())


STATES = {
    'straight': lambda: tracked(EVEN),
    'bent': lambda: tracked(EVEN, BENT),
    'on its stops': lambda: tracked(DRIVEN),
    'slack': lambda: tracked(BENT, SLACK),
    'held after slack': lambda: tracked(BENT, SLACK, BENT),
    'filtered': lambda: filtered(*[BENT] * 10),
    # From whoever publishes the type.
    'less than all': lambda: ArmEstimate(joint_names=list(NAMES), bend_angles=[0.1]),
    'nothing': ArmEstimate,
    'regimes of another kind': lambda: ArmEstimate(
        joint_names=list(NAMES), regimes=['floating'] * 5, bend_angles=[math.inf] * 5
    ),
}


@pytest.mark.parametrize('state', STATES)
def test_words_and_drawing_are_one(state):
    estimate = STATES[state]()
    figure = ArmFigure()
    figure.draw(ARM, estimate)
    drawn = {name: source.data for name, source in figure._sources.items()}
    words, table = arm_state_words(estimate, '', 0.0), joints_table(estimate, present=True)
    joints = joints_said(estimate)

    for text in (words, table):
        assert 'nan' not in text
        assert 'inf ' not in text
    assert table.count('<tr>') == 1 + len(joints)
    is_known = bool(joints) and all(math.isfinite(joint.angle) for joint in joints)
    assert bool(drawn['units']['colour']) == is_known
    for joint in joints:
        angle = f'{math.degrees(joint.angle):.2f}°'
        assert (angle in table) == math.isfinite(joint.angle)
    if is_known:
        assert drawn['units']['colour'] == [REGIME_COLOURS[Regime(of.regime)] for of in joints]
        assert len(drawn['fans']['start']) == sum(joint.interval is not None for joint in joints)
        tilt = 0.0
        for start, end, of in zip(
            drawn['fans']['start'], drawn['fans']['end'], joints, strict=False
        ):
            middle = 0.5 * math.pi - 0.5 * (start + end) - tilt
            low, high = of.interval
            assert middle == pytest.approx(0.5 * (low + high))
            tilt += of.angle
    assert set(arm_sample(estimate)) <= set(arm_names(estimate))


@pytest.mark.parametrize(('said', 'age'), [(INVALID, 0.0), (STALE, 1.0), ('', OLD + 1.0)])
def test_what_was_is_grey_and_said_to_have_been(said, age):
    estimate, figure = tracked(BENT), ArmFigure()
    words = arm_state_words(estimate, said, age)
    assert LAST_KNOWN in words
    assert f'color:{GREY}' in words
    figure.draw(ARM, estimate, present=False)
    assert set(figure._sources['units'].data['colour']) == {GREY}


def test_the_worst_that_a_joint_does_is_said_first_with_its_name():
    words = arm_state_words(tracked(BENT), '', 0.0)
    assert 'slipping' in words
    assert 'arm_joint_5' in words
    assert 'arm_joint_1' not in words
    assert 'slack' in arm_state_words(tracked(SLACK), '', 0.0)


def test_a_joint_that_may_have_moved_unseen_is_named():
    words = arm_state_words(tracked(BENT, SLACK, BENT), '', 0.0)
    assert 'moved unseen' in words
    assert 'moved unseen' not in arm_state_words(tracked(BENT), '', 0.0)


def test_what_a_filter_may_take_back_is_said_to_be_provisional():
    assert 'Provisional' in arm_state_words(filtered(*[EVEN] * 10), '', 0.0)
    assert 'Provisional' not in arm_state_words(filtered(*[EVEN] * 10, SLACK), '', 0.0)
    assert 'Provisional' not in arm_state_words(tracked(EVEN), '', 0.0)


def test_the_probability_of_a_regime_is_that_of_the_message():
    estimate = filtered(*[EVEN] * 10)
    for place, joint in enumerate(joints_said(estimate)):
        assert joint.regime == 'held'
        assert joint.probability == estimate.probabilities_held[place]
    assert '100&nbsp;%' in joints_table(estimate, present=True)


def test_another_arm_is_not_drawn_for_the_one_that_speaks():
    estimate = tracked(BENT)
    assert is_of(estimate, ARM)
    estimate.cable_names = ['a', 'b', 'c', 'd']
    assert not is_of(estimate, ARM)
    assert NO_ARM in arm_state_words(estimate, '', 0.0, is_drawn=False)


def test_of_an_arm_that_is_left_nothing_stays():
    figure = ArmFigure()
    figure.draw(ARM, tracked(BENT))
    figure.clear()
    assert not any(any(source.data.values()) for source in figure._sources.values())


def test_gravity_is_an_arrow_in_the_corner_and_the_force_one_that_ends_at_the_tip():
    estimate, figure = tracked(BENT), ArmFigure()
    figure.draw(ARM, estimate)
    (gravity,) = figure._sources['loads'].data['colour']
    estimate.tip_force_x = -0.2
    figure.draw(ARM, estimate)
    arrows, units = figure._sources['loads'].data, figure._sources['units'].data
    assert arrows['colour'] == [gravity, FORCE]
    assert arrows['x0'][0] == arrows['x1'][0]
    assert arrows['z1'][0] < arrows['z0'][0]
    assert (arrows['x1'][1], arrows['z1'][1]) == (units['x1'][-1], units['z1'][-1])
    assert arrows['x0'][1] > arrows['x1'][1]
    assert arrows['z0'][1] == arrows['z1'][1]


@pytest.mark.parametrize('find', [found_by_tracking, found_by_filtering])
@pytest.mark.parametrize('rows', [[EVEN], [EVEN, BENT], [DRIVEN], [BENT, SLACK]])
def test_where_friction_can_hold_each_joint_is_drawn_and_said_as_the_model_has_it(find, rows):
    found, figure = find(*rows), ArmFigure()
    estimate = fill_arm_estimate(ArmEstimate(), found, Header())
    admissible = fill_admissible_angles(AdmissibleAngles(), found, Header())
    figure.draw(ARM, estimate, admissible)
    drawn = figure._sources['bands'].data
    table = joints_table(estimate, admissible, present=True)
    if found.state.is_slack:
        assert not drawn['start']
        assert 'nowhere' not in table
        return
    expected, colours, tilt = [], [], 0.0
    for bands, regime, angle in zip(found.bands, found.regimes, found.bend_angles, strict=True):
        expected += [(tilt + low, tilt + high) for low, high in bands]
        colours += [REGIME_COLOURS[regime]] * len(bands)
        tilt += angle
        for low, high in bands:
            assert f'{math.degrees(low):.1f}&nbsp;to {math.degrees(high):.1f}°' in table
    # The browser counts from X, and to the left.
    ends = zip(drawn['end'], drawn['start'], strict=True)
    assert [tuple(0.5 * math.pi - end for end in pair) for pair in ends] == [
        pytest.approx(pair) for pair in expected
    ]
    assert drawn['colour'] == colours
    assert table.count('nowhere') == sum(not bands for bands in found.bands)


def test_bands_that_nobody_tells_are_neither_drawn_nor_said_to_be_nowhere():
    estimate, figure = tracked(BENT), ArmFigure()
    for admissible in (
        *(None, AdmissibleAngles(), AdmissibleAngles(joint_names=['of', 'another'])),
        # From whoever publishes the type.
        AdmissibleAngles(joint_names=list(NAMES), joints=[0, 6], lows=[0.1], highs=[math.nan]),
    ):
        figure.draw(ARM, estimate, admissible)
        assert not figure._sources['bands'].data['start']
        said = list(admissible.joint_names) == list(NAMES) if admissible else False
        assert joints_table(estimate, admissible, present=True).count('nowhere') == 5 * said
