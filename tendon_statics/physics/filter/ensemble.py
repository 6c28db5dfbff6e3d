"""The members of a filter: possible units, each with errors of its own that stay the same."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..design import JointDesign
from ..design_uncertainty import DesignUncertainty
from ..draws import draw_designs, draw_normals
from ..load import DeadLoad, Load
from ..loaded_joint import LoadedJoint, loaded_joint
from ..slip import Slip
from ..stacked_design import StackedDesign
from .members import follow, slips_of
from .resting import hold_all
from .smoothing import Estimate

Floats = NDArray[np.float64]

MEMBERS = 39
"""Possible units that are followed. The truth is as likely to be beyond the extremes as one more
member, so that these enclose 38 of 40: 95 %"""

CAUTION = 1.25
"""By how much the standard errors are taken for larger, since windows also are a little wrong"""

SIDES = np.array([-1.0, 1.0])
"""Of T_l and T_s, so that a member of a higher score is driven more towards s"""


class TensionErrors:
    """By how much the members' tensions differ from smoothed ones: constants of each.

    Parameters
    ----------
    scores : ndarray
        Standard errors of noise by which each differs, shape ``(tensions, members)``.
    sum_scores : ndarray
        Those of a sum of tensions, shape ``(members,)``.
    biases : ndarray
        Constant errors in N, shape ``(tensions, members)``.
    """

    def __init__(self, scores: Floats, sum_scores: Floats, biases: Floats) -> None:
        self._scores, self._biases = scores[:, None], biases[:, None]
        self.sum_scores = sum_scores

    def tensions(self, estimate: Estimate) -> Floats:
        """Return what smoothed tensions are for each member, in N.

        Parameters
        ----------
        estimate : Estimate
            Of each tension in N, shape ``(tensions, samples)``.

        Returns
        -------
        ndarray
            Shape ``(tensions, samples, members)``.
        """
        tensions: Floats = estimate.value[:, :, None] + estimate.error[:, :, None] * self._scores
        tensions -= self._biases
        return tensions

    def driving_and_pressing(self, tensions: Floats, error: Floats) -> Floats:
        """Return the two tensions that drive members, and those with which they press a joint.

        The errors by which members differ in their drive leave the sum of the tensions alone. Its
        own error hardly moves a unit, but is most of that of the pressure.

        Parameters
        ----------
        tensions : ndarray
            Of members at one sample in N, shape ``(2, members)``.
        error : ndarray
            Standard errors in N of all tensions that press the joint.

        Returns
        -------
        ndarray
            In N, shape ``(2, 2, members)``, of which the second index tells the two apart.
        """
        found = np.empty((2, 2, tensions.shape[1]))
        found[:, 0] = tensions
        found[:, 1] = tensions + 0.5 * np.hypot.reduce(error) * self.sum_scores
        return found


class Ensemble(TensionErrors):
    """What tells the members of a filter apart: constants of each.

    A member's errors of the smoothed tensions, its load cells' biases and its design differ from
    the nominal ones by so many deviations, the same all the time; each of these is spread over the
    quantiles of a normal distribution, in an order of its own.

    Parameters
    ----------
    design : JointDesign
    bias_stddev : float
        Standard deviation of the constant error of each tension in N.
    uncertainty : DesignUncertainty, optional
        Of the design.
    seed : int
        Of the orders.
    """

    def __init__(
        self,
        design: JointDesign,
        bias_stddev: float,
        uncertainty: DesignUncertainty | None,
        seed: int,
    ) -> None:
        parameters = () if uncertainty is None else uncertainty.parameters
        normals = draw_normals(MEMBERS, 4 + len(parameters), seed)
        super().__init__(
            SIDES[:, None] * (CAUTION * np.sort(normals[0])),
            CAUTION * normals[3],
            bias_stddev * normals[1:3],
        )
        self._spread = normals[0]
        self.units: JointDesign | StackedDesign = design
        """The design of all members, or one of each"""
        if uncertainty is not None and parameters:
            self.units = StackedDesign(list(draw_designs(design, uncertainty, normals[4:])))

    @property
    def stop(self) -> Any:
        """θ_max in rad, of all members or of each."""
        return self.units.max_bend_angle

    def angles(self, bend_angle: float, stddev: float) -> Floats:
        """Return an angle of each member, spread about one in rad and within its stops."""
        stop = self.stop
        angles: Floats = np.minimum(np.maximum(bend_angle + stddev * self._spread, -stop), stop)
        return angles

    def joint(self, loads: list[Load]) -> LoadedJoint:
        """Return the members' joints under loads: one for all, or of one load a row."""
        if all(load is loads[0] for load in loads):
            return loaded_joint(self.units, loads[0])
        parts = zip(*(load.on(self.units) for load in loads), strict=True)
        dead = (np.array(np.broadcast_arrays(*part)).reshape(len(loads), -1) for part in parts)
        return LoadedJoint.of(self.units, DeadLoad(*dead))

    def follow(self, tensions: Floats, loads: list[Load], start: Floats) -> Sequence[Floats]:
        """Follow the members through pairs of tensions, under a load each.

        Parameters
        ----------
        tensions : ndarray
            In N, of shape ``(2, pairs, members)``.
        start : ndarray
            Where the members are at first, in rad.

        Returns
        -------
        sequence of ndarray
            Where they are at first and after each pair.
        """
        joint, place, stop = self.joint(loads), float(start[0]), self.stop
        if (
            isinstance(self.units, JointDesign)
            and isinstance(joint.size, float)
            and np.count_nonzero(start == place) == len(start)
            and hold_all(joint, tensions, place, stop)
        ):
            return [start] * (len(loads) + 1)
        return follow(slips_of(joint, tensions), start, stop)


class MemberSlips(NamedTuple):
    """The slip functions of the members at one pair of smoothed tensions."""

    ensemble: Ensemble
    load: Load
    tensions: Floats
    """Of the members in N, shape ``(2, members)``"""
    error: Floats
    """Standard errors of T_l and T_s in N"""

    @property
    def units(self) -> JointDesign | StackedDesign:
        """The design of all members, or one of each."""
        return self.ensemble.units

    def driving(self) -> Slip:
        """Return them at the tensions that drive the members."""
        return self._at(self.tensions[:, None]).part(0)

    def driving_and_pressing(self) -> Slip:
        """Return them at those, and at the tensions that press the joints, in a row each."""
        return self._at(self.ensemble.driving_and_pressing(self.tensions, self.error))

    def _at(self, tensions: Floats) -> Slip:
        return slips_of(self.ensemble.joint([self.load]), tensions)
