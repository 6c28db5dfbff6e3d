"""What the parameter ``estimation`` chooses from."""

from __future__ import annotations

from .equilibrium import EachPair
from .filtering import Filtering
from .method import Method
from .tracking import Tracking

METHODS: dict[str, type[Method]] = {
    'equilibrium': EachPair,
    'tracking': Tracking,
    'filtering': Filtering,
}
"""Name → the way from tensions to an estimate; the first is the default"""
