"""Which topics of a bag hold what was measured."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

from ..errors import RecordingError

FORCE_COMPONENTS = ('x', 'y', 'z', 'norm')


@dataclasses.dataclass(frozen=True)
class BagTopics:
    """Topics of a bag, and where in their messages the numbers are.

    The defaults are the estimator's own topics and parameters.
    """

    tensions: tuple[str, ...] = ('/tensions',)
    """One topic of ``std_msgs/Float64MultiArray`` [T_l, T_s], of ``sensor_msgs/JointState`` with
    tensions as effort or of ``tendon_statics_interfaces/Estimate``, or a pair of
    ``geometry_msgs/WrenchStamped``, cable l first; N"""
    cable_names: tuple[str, str] = ('cable_l', 'cable_s')
    """Names of the cables in a ``JointState``"""
    force_component: str = 'z'
    """Of a ``WrenchStamped``: one of `FORCE_COMPONENTS`"""
    bend_angle: str | None = None
    """Topic of ``std_msgs/Float64`` or of ``sensor_msgs/JointState`` with the angle as position,
    rad; None: ``/measured_bend_angle`` if the bag has it"""
    joint_name: str | None = None
    """Name of the joint in that ``JointState``; None if it has just one"""
    pressure: str | None = None
    """Topic of ``std_msgs/Float64``, Pa; None: ``/measured_pressure`` if the bag has it"""
    state: str | None = None
    """Topic of ``std_msgs/String``: ``slipping`` or ``held``"""
    max_skew: float = 0.02
    """s by which a message may be apart from the tensions that it is taken to belong to"""

    def __post_init__(self) -> None:
        """Check what can be checked without a bag.

        Raises
        ------
        RecordingError
            If there are not one or two topics of tensions, or not two cables, if a name is empty
            or given twice, or if the force component or the skew is none.
        """
        _check_names('topic of tensions', self.tensions, (1, 2))
        _check_names('cable', self.cable_names, (2,))
        for name in (self.bend_angle, self.pressure, self.state):
            if name is not None:
                _check_names('topic', (name,), (1,))
        if self.force_component not in FORCE_COMPONENTS:
            raise RecordingError(
                f'the force component is {self.force_component!r}; '
                f'there are {", ".join(FORCE_COMPONENTS)}'
            )
        if not 0.0 <= self.max_skew < math.inf:
            raise RecordingError(
                f'the largest skew is {self.max_skew!r} s; '
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
