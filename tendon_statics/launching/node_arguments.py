"""What both launch files take for their nodes, beside what is to be started."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from ..files.cable_parameters import TENSION_SOURCES
from ..files.parameter_file import node_parameter
from ..files.yaml_file import YamlFileError, read_yaml
from ..physics.errors import TendonStaticsError

TOPICS = {
    'array': ('tensions',),
    'joint_state': ('tensions',),
    'wrench_pair': ('tension_l', 'tension_s'),
}
"""``tension_source`` → the topics on which tensions come"""


class LaunchArgumentError(TendonStaticsError, ValueError):
    """An argument of a launch file cannot be met; the text is for the user."""


class Argument(NamedTuple):
    """An argument of a launch file."""

    name: str
    default: str
    description: str
    choices: tuple[str, ...] = ()


YES_OR_NO = ('true', 'false')

NODE_ARGUMENTS = (
    Argument(
        'use_sim_time',
        '',
        'whether the nodes take the time of /clock; default: as their parameters say',
        ('', *YES_OR_NO),
    ),
    Argument(
        'log_level',
        'info',
        'how much the nodes log',
        ('debug', 'info', 'warn', 'error', 'fatal'),
    ),
    Argument(
        'autostart',
        '',
        'whether estimators configure and activate themselves; default: as their parameters say, '
        'which is true where they do not',
        ('', *YES_OR_NO),
    ),
    Argument('respawn', 'false', 'whether a node that ended is started again', YES_OR_NO),
    Argument('respawn_delay', '1.0', 'after so many seconds'),
)
"""Those that both have"""


def given_parameters(arguments: Mapping[str, str], *names: str) -> dict[str, bool]:
    """Return those arguments of these names that are given, as parameters of a node."""
    return {name: arguments[name] == 'true' for name in names if arguments[name]}


def respawn_options(arguments: Mapping[str, str]) -> dict[str, Any]:
    """Return what launch is told of nodes that end.

    Raises
    ------
    LaunchArgumentError
        If the delay is no number from 0 on.
    """
    try:
        delay = float(arguments['respawn_delay'])
    except ValueError:
        delay = -1.0
    if not 0.0 <= delay < float('inf'):
        raise LaunchArgumentError(
            f'respawn_delay is {arguments["respawn_delay"]!r}, a number of seconds from 0 on is '
            'needed'
        )
    return {'respawn': arguments['respawn'] == 'true', 'respawn_delay': delay}


def tension_remappings(
    arguments: Mapping[str, str], params_file: str | Path, estimator: str
) -> list[tuple[str, str]]:
    """Return the remappings of topics of tensions: of those to which the estimator listens.

    Parameters
    ----------
    arguments : mapping
        With ``tensions``, ``tension_l`` and ``tension_s``, empty where they are not given.
    estimator : str
        Full name of the node.

    Raises
    ------
    LaunchArgumentError
        If one is given that the estimator would not listen to, or the file cannot be read.
    """
    try:
        source = node_parameter(read_yaml(Path(params_file)), estimator, 'tension_source')
    except YamlFileError as error:
        raise LaunchArgumentError(f'{params_file}: {error}') from None
    heard = TOPICS.get(str(source or TENSION_SOURCES[0]), ())
    given = {
        topic: arguments[topic]
        for topic in dict.fromkeys(topic for topics in TOPICS.values() for topic in topics)
        if arguments[topic]
    }
    for topic, other in given.items():
        if heard and topic not in heard:
            raise LaunchArgumentError(
                f'{topic} is {other!r}, but with tension_source {source or TENSION_SOURCES[0]} '
                f'tensions come on {" and ".join(heard)}: give {" and ".join(heard)} instead'
            )
    return list(given.items())
