"""What a page shows of an arm."""

from __future__ import annotations

from collections.abc import Sequence

from bokeh.models import Div, LayoutDOM

from ..physics import Arm
from .arm_figure import ArmFigure
from .arm_time_figures import ArmTimeFigures
from .arm_values import is_of
from .arm_words import arm_state_words, joints_table
from .estimate_values import is_present
from .panels import LastMinute
from .watch import Watch
from .words import STYLE


class ArmPanels:
    """The arm, its joints in a table, and the last minute of each and of the tip."""

    def __init__(self) -> None:
        self._minute = LastMinute('arm_history')
        self._arm = ArmFigure()
        self._times = ArmTimeFigures(self._minute.source)
        self._joints = Div(name='joints', sizing_mode='stretch_width', stylesheets=[STYLE])
        self.move_on = self._times.move_on

    @property
    def roots(self) -> Sequence[LayoutDOM]:
        """All figures, and the table."""
        of = self._times
        return (self._arm.root, self._joints, of.angle, of.margin, of.pressure, of.tip)

    def draw(self, watch: Watch, age: float) -> None:
        """Draw what is new; `age` is that of the newest estimate in s."""
        estimate = watch.estimate
        if estimate is None:
            return
        count = len(estimate.joint_names)
        if count != self._times.count:
            self._times.clear()  # before the columns go that it draws
        self._minute.draw(watch)
        self._times.draw_joints(count)
        arm = _known_arm(watch)
        if arm is None:
            self._arm.clear()
        else:
            self._arm.draw(arm, estimate, watch.admissible, present=is_present(watch.said, age))

    def say(self, watch: Watch, age: float) -> str:
        """Have the table say what the newest estimate is, and return what to say of the whole."""
        estimate, is_drawn = watch.estimate, _known_arm(watch) is not None
        joints = joints_table(estimate, watch.admissible, present=is_present(watch.said, age))
        if joints != self._joints.text:
            self._joints.text = joints
        return arm_state_words(estimate, watch.said, age, is_drawn=is_drawn)

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""
        self._times.clear()
        self._minute.clear()
        self._arm.clear()
        self._joints.text = ''


def _known_arm(watch: Watch) -> Arm | None:
    """Return the arm that the estimator named, if the newest estimate may be of it."""
    arm: Arm | None = watch.design
    return arm if arm is not None and is_of(watch.estimate, arm) else None
