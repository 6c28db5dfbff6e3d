"""The services of the estimator of a unit, beside those that every estimator has."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

from ..physics import LoadError, TensionError, solve
from .load_design import load_design
from .outputs import messages
from .services import offer, say_interfaces_are_missing

if TYPE_CHECKING:
    from .estimator import Estimator


def offer_unit_services(node: Estimator) -> None:
    """Offer them, as far as the interfaces are there."""
    if messages.INTERFACES_MISSING:
        say_interfaces_are_missing(
            node, '~/solve', '~/solve_inverse', '~/load_design', '~/estimate'
        )
        return
    offer(node, messages.Solve, 'solve', functools.partial(_solve, node), messages.refuse_solve)
    offer(
        node,
        messages.SolveInverse,
        'solve_inverse',
        functools.partial(_invert, node),
        messages.refuse_inverse,
    )
    offer(
        node,
        messages.LoadDesign,
        'load_design',
        functools.partial(load_design, node),
        messages.refuse,
        in_every_state=True,
    )


def _solve(
    node: Estimator, request: messages.Solve.Request, response: messages.Solve.Response
) -> messages.Solve.Response:
    settings = node.core.settings
    try:
        known = messages.asked_load(request, node.known_load())
        result = solve(settings.design, request.tension_l, request.tension_s, known.load)
    except (TensionError, LoadError) as error:
        return messages.refuse_solve(response, str(error))
    return messages.fill_solve_response(response, result, settings, load_assured=known.is_assured)


def _invert(
    node: Estimator,
    request: messages.SolveInverse.Request,
    response: messages.SolveInverse.Response,
) -> messages.SolveInverse.Response:
    return messages.fill_inverse_response(
        response, node.core.settings.design, request, node.known_load().load
    )
