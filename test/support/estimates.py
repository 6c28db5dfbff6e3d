"""Estimates of the exact kinds, from answers of the physics."""

from tendon_statics.estimation.equilibrium import PairEstimate
from tendon_statics.estimation.estimate import KnownLoad
from tendon_statics.estimation.exact_estimate import ExactEstimate
from tendon_statics.estimation.settings import Settings
from tendon_statics.estimation.tracking import TrackedEstimate
from tendon_statics.physics import Equilibrium


def estimate_of(result: Equilibrium) -> ExactEstimate:
    """Return what an estimator makes of an answer of `solve` or of a tracker."""
    given = result, KnownLoad(result.load), Settings(result.design)
    return TrackedEstimate(*given, None) if result.is_tracked else PairEstimate(*given)
