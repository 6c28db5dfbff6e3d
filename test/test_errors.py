"""Every error of the package is one that a caller can catch as such."""

import inspect
import pkgutil
from importlib import import_module
from importlib.util import find_spec

import pytest

import tendon_statics
from tendon_statics import JointDesign, TendonStaticsError
from tendon_statics.recordings.errors import RecordingError


def all_errors():
    names = [
        module.name
        for module in pkgutil.walk_packages(tendon_statics.__path__, 'tendon_statics.')
        if not module.name.endswith('__main__')
    ]
    for name in names:
        if name.endswith('launching.actions') and find_spec('launch_ros') is None:
            continue  # ROS 2 from PyPI has no launch
        for _, found in inspect.getmembers(import_module(name), inspect.isclass):
            is_ours = found.__module__ == name and not found.__name__.startswith('_')
            if issubclass(found, Exception) and is_ours:
                yield found


def test_all_derive_from_one_class():
    errors = set(all_errors())
    assert RecordingError in errors
    strangers = [error for error in errors if not issubclass(error, TendonStaticsError)]
    assert strangers == []


def test_a_wrong_value_is_a_value_error_too():
    of_values = [error for error in all_errors() if issubclass(error, ValueError)]
    assert len(of_values) >= 12
    with pytest.raises(ValueError, match='ball_radius'):
        JointDesign.from_mapping({})
    with pytest.raises(TendonStaticsError, match='ball_radius'):
        JointDesign.from_mapping({})


def test_the_public_errors_are_at_the_top():
    public = {name for name in tendon_statics.__all__ if name.endswith('Error')}
    physics = {e.__name__ for e in all_errors() if e.__module__ == 'tendon_statics.physics.errors'}
    assert physics <= public
