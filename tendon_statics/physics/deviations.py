"""Standard deviations of what is measured, where nobody says others."""

from __future__ import annotations

import math

TENSION_STDDEV = 0.01
"""Of each tension in N"""

BEND_ANGLE_STDDEV = math.radians(0.5)
"""Of a measured bend angle in rad"""
