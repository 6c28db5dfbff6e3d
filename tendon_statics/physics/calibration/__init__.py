"""From a recorded session to a design that fits it: what each sample says, the fit, its limits.

`samples` sorts what is measured by what it is used for, `boundary_distance` says how far a sample
lies from the boundary of slip, `fit` finds the values, `identifiability` and `fit_warnings` say
what the data do not tell, `comparison` which contact law they speak for, and `result` is what is
given back.
"""

from .comparison import compare_laws
from .fit import DEFAULT_FIT, calibrate
from .law_comparison import LawComparison
from .result import HELD, SLIPPING, Calibration, FittedParameter

__all__ = [
    'DEFAULT_FIT',
    'HELD',
    'SLIPPING',
    'Calibration',
    'FittedParameter',
    'LawComparison',
    'calibrate',
    'compare_laws',
]
