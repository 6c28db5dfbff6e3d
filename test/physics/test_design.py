"""`JointDesign`: its ranges, and what it says of values outside."""

import dataclasses
import math

import pytest
from designs import PRELIMINARY

from tendon_statics import DesignError, JointDesign
from tendon_statics.physics import design_fields, design_parameters

VALUES = dataclasses.asdict(PRELIMINARY)
NAMES = [parameter.name for parameter in design_parameters()]


def test_a_design_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        PRELIMINARY.mass = 1.0


@pytest.mark.parametrize('parameter', design_parameters(), ids=NAMES)
def test_values_outside_the_range_are_refused_with_value_and_range(parameter):
    outside = [
        math.nextafter(parameter.minimum, -math.inf),
        math.nextafter(parameter.maximum, math.inf),
        math.nan,
        math.inf,
        -math.inf,
        10**400,
    ]
    for value in outside:
        with pytest.raises(DesignError) as caught:
            JointDesign(**{**VALUES, parameter.name: value})
        assert caught.value.key == parameter.name
        assert parameter.name in str(caught.value)
        assert repr(float(value) if abs(value) < 1e308 else value)[:6] in str(caught.value) or (
            'inf' in str(caught.value)
        )
        assert parameter.allowed in str(caught.value)


@pytest.mark.parametrize('name', NAMES)
@pytest.mark.parametrize('value', ['0.5', None, True, [0.5], 1j])
def test_what_is_not_a_number_is_refused(name, value):
    with pytest.raises(DesignError, match=f'{name} is .*not a number'):
        JointDesign(**{**VALUES, name: value})


def test_whole_numbers_are_numbers():
    design = JointDesign(**{**VALUES, 'friction_coefficient': 1})
    assert isinstance(design.friction_coefficient, float)


@pytest.mark.parametrize('end', [VALUES['contact_start_angle'], 0.5])
def test_the_contact_zone_has_an_extent(end):
    with pytest.raises(DesignError, match='the end must exceed the start'):
        JointDesign(**{**VALUES, 'contact_end_angle': end})


def test_degrees_are_met_with_a_hint():
    with pytest.raises(DesignError, match='radians'):
        JointDesign(**{**VALUES, 'max_bend_angle': 30.0})


@pytest.mark.parametrize('name', [p.name for p in design_parameters() if p.default is None])
def test_a_mapping_lacks_nothing(name):
    with pytest.raises(DesignError, match=f'{name} is missing'):
        JointDesign.from_mapping({key: VALUES[key] for key in VALUES if key != name})


def test_a_mapping_holds_nothing_unknown():
    with pytest.raises(DesignError, match=r'masss is 1\.0, but there is no such design parameter'):
        JointDesign.from_mapping({**VALUES, 'masss': 1.0})


def test_what_has_a_default_is_the_papers():
    defaults = {
        field.name: field.default for field in design_fields() if field.default is not None
    }
    assert defaults == {'contact_width': 1.0, 'contact_law': 'merged', 'stiffness': 0.0}
    without = {key: VALUES[key] for key in VALUES if key not in defaults}
    assert JointDesign.from_mapping(without) == PRELIMINARY


@pytest.mark.parametrize('law', ['Merged', '', None, 3, ['merged']])
def test_a_law_that_is_none_is_refused_with_the_choices(law):
    with pytest.raises(DesignError, match='allowed is one of merged, friction_circle') as caught:
        JointDesign(**{**VALUES, 'contact_law': law})
    assert caught.value.key == 'contact_law'


def test_an_elastic_seat_ends_at_90_degrees():
    values = {**VALUES, 'contact_end_angle': 1.6}
    JointDesign(**{**values, 'contact_law': 'friction_circle'})
    with pytest.raises(DesignError, match='contact zone up to 90 deg') as caught:
        JointDesign(**{**values, 'contact_law': 'elastic_seat'})
    assert caught.value.key == 'contact_end_angle'


def test_every_parameter_says_what_it_is():
    for parameter in design_parameters():
        assert parameter.symbol
        assert parameter.description
        assert parameter.minimum < parameter.maximum
