"""Which names of parameters somebody takes, and what ROS itself takes of every node."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches

from .estimator_parameters import known_names
from .parameter_kinds import Parameter, SettingError, SwitchParameter, check_given

QOS = 'qos_overrides.'
"""What the names of parameters begin with that override the quality of service of a topic"""

OF_ROS: tuple[Parameter, ...] = (
    SwitchParameter('use_sim_time', False, 'whether `/clock` is the time'),
    SwitchParameter(
        'start_type_description_service', True, 'whether there is `~/get_type_description`'
    ),
)
"""What every node takes"""

_POLICIES = ('history', 'depth', 'reliability', 'durability')
_OVERRIDE = re.compile(
    rf'{QOS}(?P<topic>/.+)\.(?:subscription|publisher)\.(?P<policy>{"|".join(_POLICIES)})'
)
_VALUES = {
    'history': ('keep_last', 'keep_all', 'system_default'),
    'reliability': ('reliable', 'best_effort', 'system_default', 'best_available'),
    'durability': ('volatile', 'transient_local', 'system_default', 'best_available'),
}


def unknown_names(names: Iterable[str]) -> list[str]:
    """Return those names that no program of this package takes.

    One file may serve all programs, so what is of another is left alone; and so is the quality of
    service, of which only the node knows its topics.
    """
    known = known_names() | {of.name for of in OF_ROS}
    left = [name for name in names if not (name in known or name.startswith(QOS))]
    if not left:
        return []
    # Here, for an arm takes NumPy, whose import the file of a unit need not wait for.
    from .arm_parameters import ARM_PARAMETERS, CABLES
    from .driver_parameters import DRIVER_PARAMETERS
    from .view_parameters import VIEW_PARAMETERS

    of_others = {of.name for of in (*DRIVER_PARAMETERS, *VIEW_PARAMETERS, *ARM_PARAMETERS)}
    return [name for name in left if not (name in of_others or name.startswith(CABLES))]


def said_of_unknown(names: Iterable[str], known: Iterable[str]) -> list[str]:
    """Say of each name that nobody takes that it is ignored, or which is probably meant.

    Parameters
    ----------
    known : iterable of str
        Names that the estimator has which is meant.
    """
    may_be = sorted(known)
    found = []
    for name in unknown_names(names):
        close = get_close_matches(name, may_be, 1, cutoff=0.85)
        found.append(
            f'{name} is no parameter of the estimator'
            + (f'; is {close[0]} meant?' if close else ', which ignores it')
        )
    return found


def check_parameters_of_ros(values: Mapping[str, object]) -> None:
    """Check what is given of parameters that every node takes, as ROS does at the start.

    Raises
    ------
    SettingError
        If a value is not allowed; the text names the parameter, its value and what is allowed.
    """
    check_given(OF_ROS, values)
    for name, value in values.items():
        override = _OVERRIDE.fullmatch(name)
        if override is None:
            continue
        if override['policy'] == 'depth':
            if type(value) is not int or value < 0:
                raise SettingError(f'{name} is {value!r}, a whole number from 0 on is needed')
        elif value not in _VALUES[override['policy']]:
            allowed = ' or '.join(_VALUES[override['policy']])
            raise SettingError(f'{name} is {value!r}, allowed is {allowed}')
