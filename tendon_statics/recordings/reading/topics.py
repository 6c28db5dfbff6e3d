"""Which topics of a bag hold what was measured."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

from ...estimation.settings import Settings
from ...files.cable_parameters import TENSION_SOURCES
from ..errors import RecordingError
from .clock import CLOCKS

DEFAULT_TENSIONS = '/tensions'
DEFAULT_PAIR = ('/tension_l', '/tension_s')
"""Where the estimator listens"""

FORCE_COMPONENTS = ('x', 'y', 'z', 'norm')


@dataclasses.dataclass(frozen=True)
class BagTopics:
    """Topics of a bag, and where in their messages the numbers are.

    The defaults are the estimator's own topics and parameters.
    """

    tensions: tuple[str, ...] | None = None
    """One topic of a type in `ONE_TOPIC`, or two of a type in `TWO_TOPICS`, cable l first; None:
    `DEFAULT_TENSIONS`, or `DEFAULT_PAIR` if the bag has that instead"""
    cable_names: tuple[str, str] = ('cable_l', 'cable_s')
    """Names of the cables in messages with names"""
    force_component: str = 'z'
    """Of a wrench: one of `FORCE_COMPONENTS`"""
    bend_angle: str | None = None
    """Topic of a number or of joint states with the angle as position, rad; None:
    ``/measured_bend_angle`` if the bag has it"""
    joint_name: str | None = None
    """Name of the joint in that ``JointState``; None if it has just one"""
    pressure: str | None = None
    """Topic of a number, Pa; None: ``/measured_pressure`` if the bag has it"""
    base: str | None = None
    """Topic of an IMU or a pose of the base, or of its tilt in rad; None: ``/imu`` or
    ``/base_pose`` as `gravity_source` says, else ``/measured_base_tilt`` if the bag has it"""
    gravity_source: str = 'fixed'
    """Which topic the estimator takes: ``imu``, ``pose`` or none"""
    imu_mounting: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Roll, pitch and yaw in rad of the IMU in the joint frame"""
    tip_wrench: str | None = None
    """Topic of wrenches with the force at the tip, in the joint frame; None: there is none, or
    that which a replay has written"""
    state: str | None = None
    """Topic of ``std_msgs/String``: ``slipping`` or ``held``"""
    max_skew: float = 0.02
    """s by which a message may be apart from the tensions that it is taken to belong to"""
    tension_skew: float | None = None
    """s by which the two tensions of a pair may be apart; None: as the estimator has it"""
    clock: str = 'auto'
    """One of `CLOCKS`"""
    tension_source: str | None = None
    """One of `TENSION_SOURCES`: which type the tensions have; None: any that can be read"""
    interface: str = 'effort'
    """Of the cables in a ``DynamicJointState``"""

    @property
    def pair_skew(self) -> float:
        """How far apart in s the two tensions of a pair may be."""
        return Settings.max_skew if self.tension_skew is None else self.tension_skew

    def __post_init__(self) -> None:
        """Check what can be checked without a bag.

        Raises
        ------
        RecordingError
            If there are not one or two topics of tensions, or not two cables, if a name is empty
            or given twice, or if the force component or the skew is none.
        """
        if self.tensions is not None:
            _check_names('topic of tensions', self.tensions, (1, 2))
        _check_names('cable', self.cable_names, (2,))
        for name in (self.bend_angle, self.pressure, self.state, self.base, self.tip_wrench):
            if name is not None:
                _check_names('topic', (name,), (1,))
        if self.force_component not in FORCE_COMPONENTS:
            raise RecordingError(
                f'the force component is {self.force_component!r}; '
                f'there are {", ".join(FORCE_COMPONENTS)}'
            )
        if self.tension_source not in (None, *TENSION_SOURCES):
            raise RecordingError(
                f'the source of tensions is {self.tension_source!r}; '
                f'there are {", ".join(TENSION_SOURCES)}'
            )
        if self.clock not in CLOCKS:
            raise RecordingError(f'the clock is {self.clock!r}; there are {", ".join(CLOCKS)}')
        for skew in (self.max_skew, self.tension_skew or 0.0):
            if not 0.0 <= skew < math.inf:
                raise RecordingError(
                    f'the largest skew is {skew!r} s; '
                    'a finite number that is not negative is needed'
                )


def full_name(topic: str) -> str:
    """Return a topic's name as it stands in a bag."""
    return topic if topic.startswith('/') else f'/{topic}'


def _check_names(what: str, names: Sequence[str], counts: Sequence[int]) -> None:
    """Check that there are as many names as there may be, and that they are different."""
    if len(names) not in counts:
        raise RecordingError(
            f'{len(names)} names of a {what} are given, not {" or ".join(map(str, counts))}'
        )
    if not all(names):
        raise RecordingError(f'the name of a {what} is empty')
    if len({full_name(name) for name in names}) < len(names):
        raise RecordingError(f'the name of a {what} is given twice: {names[0]}')
