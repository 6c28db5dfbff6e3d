"""From two cable tensions to bend angle and joint pressure."""

from __future__ import annotations

from .design import JointDesign
from .load import UPRIGHT, Load
from .regime import AT_ROOT, AT_STOP, Regime
from .roots import refine
from .state import Equilibrium
from .tensions import check_tensions, taut_slip


def solve(
    design: JointDesign, tension_l: float, tension_s: float, load: Load = UPRIGHT
) -> Equilibrium:
    """Solve the quasi-static equilibrium of one unit for a pair of cable tensions.

    The slip function (Eq. (4), corrected, under the paper's law) is searched from 0 to the stop on
    the side of the stronger cable; equal tensions count as pulling towards s. A root is found
    within a bracket of 1e-10 rad over which the function changes sign. Of several roots the one
    nearest to 0 is returned, and all are counted.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions T_l and T_s in N.
    load : Load
        What acts beside them; without it the unit is upright with nothing at its tip.

    Raises
    ------
    TensionError
        If a tension is not a number, not finite, negative or above `MAX_TENSION`, or if the two
        do not add up to what seats the joint: more than the unit's weight, say.
    """
    tensions = check_tensions(tension_l, tension_s)
    tension_l, tension_s = tensions
    if tension_l == 0.0 or tension_s == 0.0:
        return Equilibrium(design, load, Regime.SLACK, tension_l, tension_s, None, 0, 0)

    slip = taut_slip(design, tensions, load, -1.0 if tension_l > tension_s else 1.0)
    first, last = slip.ends(design.max_bend_angle)
    found = slip.brackets(first, last)
    if found:
        probe, iterations = refine(slip, found[0])
        regime = AT_ROOT
    elif first[1] > 0.0:
        probe, iterations = last, 0
        regime = AT_STOP
    else:
        return Equilibrium(design, load, Regime.HELD, tension_l, tension_s, None, 0, 0)
    angle = slip.side * probe[0]
    return Equilibrium.of(
        slip,
        probe,
        (design, load, regime, tension_l, tension_s, angle, len(found), iterations, True, None),
    )


def residual(
    design: JointDesign,
    tension_l: float,
    tension_s: float,
    bend_angle: float,
    load: Load = UPRIGHT,
) -> float:
    """g(θ) = (M − K) / (μ r) in N, for a unit that slips towards cable s.

    With the paper's law N_m − N_f: the corrected Eq. (4), multiplied by the contact area C w. For
    the other side swap the tensions, negate the angle and mirror the load.

    Parameters
    ----------
    tension_l, tension_s : float
        Cable tensions in N, both above 0.
    bend_angle : float
        θ in rad.

    Raises
    ------
    TensionError
        As `solve` does, and for a slack cable.
    """
    slip = taut_slip(design, check_tensions(tension_l, tension_s), load)
    return slip.residual_at(slip.probe(bend_angle))
