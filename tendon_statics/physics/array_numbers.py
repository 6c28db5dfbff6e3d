"""`contact.numbers` for NumPy arrays."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .contact.numbers import Numbers


def _cosine(angle: Any) -> Any:
    """Of one angle for all as `math` has it, since a last bit may decide a regime."""
    return math.cos(angle) if isinstance(angle, float) else np.cos(angle)


def _sine(angle: Any) -> Any:
    return math.sin(angle) if isinstance(angle, float) else np.sin(angle)


ARRAYS = Numbers(np.sqrt, _cosine, _sine, np.where, np.minimum, np.maximum, np.any)
