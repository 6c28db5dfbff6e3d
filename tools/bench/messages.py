"""Messages of the estimator: one that is filled again beside a new one each time."""

from __future__ import annotations

from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Float64MultiArray, Header

from tendon_statics import default_design_path, load_design, solve
from tendon_statics.estimation.equilibrium import PairEstimate
from tendon_statics.estimation.estimate import KnownLoad
from tendon_statics.estimation.settings import Settings
from tendon_statics.node.outputs.messages import (
    Estimate,
    fill_estimate,
    fill_intervals,
    fill_unit_pose,
)
from tendon_statics.physics import paper

from .rows import Row
from .timing import best_times

INTERVALS = [(-0.5, -0.1), (0.1, 0.3)]
TENSION_STDDEV = 0.01


def rows() -> list[Row]:
    """Measure."""
    design = load_design(default_design_path())
    result = solve(design, paper.TENSION_L, paper.TENSION_S)
    header = Header(frame_id='joint')
    estimate = PairEstimate(result, KnownLoad(result.load), Settings(design))
    fills = {
        '`Estimate`': (
            Estimate,
            lambda message: fill_estimate(message, estimate, header),
        ),
        '`PoseWithCovarianceStamped`': (
            PoseWithCovarianceStamped,
            lambda message: fill_unit_pose(
                message, design, result.bend_angle, TENSION_STDDEV, header
            ),
        ),
        '`Float64MultiArray` of intervals': (
            Float64MultiArray,
            lambda message: fill_intervals(message, INTERVALS),
        ),
    }
    return [_row(name, *fill) for name, fill in fills.items()]


def _row(name, message_type, fill) -> Row:
    message = message_type()
    again, anew = best_times(
        [
            lambda: [fill(message) for _ in range(20)],
            lambda: [fill(message_type()) for _ in range(20)],
        ],
        rounds=200,
    )
    return Row(f'{name}, the same filled again', 'a new one each time', again / anew)
