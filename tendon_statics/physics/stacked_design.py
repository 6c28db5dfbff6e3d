"""Several designs as one, so that a formula serves all of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .contact.law import ContactLaw
from .design import JointDesign


class StackedDesign:
    """Designs of one contact law, each number an array of shape ``(designs,)``.

    A number that is the same in all of them stays a float. It has what slip functions and dead
    loads take from a `JointDesign`, and is taken in the place of one there.

    Parameters
    ----------
    designs : sequence of JointDesign
        At least one.
    """

    def __init__(self, designs: Sequence[JointDesign]) -> None:
        def of_all(name: str) -> Any:
            return stacked([getattr(design, name) for design in designs])

        self.ball_radius = of_all('ball_radius')
        self.friction_coefficient = of_all('friction_coefficient')
        self.stiffness = of_all('stiffness')
        self.relative_lever = of_all('relative_lever')
        self.weight = of_all('weight')
        self.com_distance = of_all('com_distance')
        self.max_bend_angle = of_all('max_bend_angle')
        self.contact_area = of_all('contact_area')
        self.law: ContactLaw = of_all('law')


def stacked(parts: Sequence[Any]) -> Any:
    """Return what several designs have in one place, each number an array.

    A number that is the same in all of them stays a float.
    """
    first = parts[0]
    if isinstance(first, ContactLaw):
        law = object.__new__(type(first))
        law.__dict__ = {
            name: stacked([part.__dict__[name] for part in parts]) for name in first.__dict__
        }
        law.is_stacked = True
        return law
    if isinstance(first, tuple):
        return type(first)(*(stacked(of_one) for of_one in zip(*parts, strict=True)))
    return first if all(part == first for part in parts) else np.array(parts)
