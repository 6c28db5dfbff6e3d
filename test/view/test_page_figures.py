"""The figures of the page, without a browser."""

import math

import pytest
from bokeh.models import ColumnDataSource
from std_msgs.msg import Header
from tendon_statics_interfaces.msg import Estimate

from tendon_statics import default_design_path, load_design
from tendon_statics.view.map_figure import MapFigure
from tendon_statics.view.unit_figure import UnitFigure
from tendon_statics.view.unit_sample import unit_sample

DESIGN = load_design(default_design_path())


@pytest.mark.parametrize('value', [math.nan, math.inf, -math.inf, -1.0, 1e300])
def test_an_estimate_of_nonsense_is_drawn_as_far_as_it_makes_sense(value):
    """Whoever publishes it, the page goes on."""
    estimate = Estimate(
        header=Header(),
        tension_l=value,
        tension_s=value,
        bend_angle=value,
        bend_angle_stddev=value,
        pressure=value,
        slip_margin=value,
        admissible_angles=[value, 0.1, 0.2],
        gravity_direction_z=-1.0,
    )
    assert [name for name in unit_sample(estimate) if 'admissible_low' in name] == [
        'admissible_low_0'
    ]
    UnitFigure().draw(DESIGN, estimate)
    figure = MapFigure(ColumnDataSource({'tension_l': [], 'tension_s': []}))
    figure.draw(DESIGN, estimate)
    assert 0.0 < figure.root.x_range.end < 2e4
