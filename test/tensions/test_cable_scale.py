"""Readings as tensions: one by one, as the node takes them, and in arrays, as a replay does."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics.recordings.scaling import worse_reasons
from tendon_statics.tensions.cable_scale import CableScale, scaled, scaled_arrays, worse

floats = st.floats(allow_nan=True, allow_infinity=True)
scales = st.builds(
    CableScale,
    gain=st.floats(-1e6, 1e6).filter(bool),
    bias=st.floats(-1e6, 1e6),
    max_tension=st.floats(0.001, 1e9),
    slack_threshold=st.floats(0.0, 1e3),
)


@given(st.lists(st.tuples(floats, floats), min_size=1, max_size=20), scales, scales)
def test_node_and_replay_make_the_same_tensions_and_reasons_of_readings(pairs, scale_l, scale_s):
    arrays = [np.array(values) for values in zip(*pairs, strict=True)]
    (tensions_l, reasons_l), (tensions_s, reasons_s) = (
        scaled_arrays(values, scale)
        for values, scale in zip(arrays, (scale_l, scale_s), strict=True)
    )
    words = worse_reasons(reasons_l, reasons_s)
    for place, (reading_l, reading_s) in enumerate(pairs):
        tension_l, fault_l = scaled('tension_l', reading_l, scale_l)
        tension_s, fault_s = scaled('tension_s', reading_s, scale_s)
        np.testing.assert_array_equal(tensions_l[place], tension_l)
        np.testing.assert_array_equal(tensions_s[place], tension_s)
        assert reasons_l[place] == (fault_l[0] if fault_l else None)
        fault = worse(fault_l, fault_s)
        assert words[place] == (fault[0].value if fault else '')


def test_a_slack_cable_that_rounding_puts_below_zero_is_slack():
    scale = CableScale(0.001, -0.3)
    assert scaled('tension_l', 300.0, scale) == (0.0, None)
    tensions, reasons = scaled_arrays(np.array([300.0]), scale)
    assert tensions.tolist() == [0.0]
    assert reasons.tolist() == [None]
