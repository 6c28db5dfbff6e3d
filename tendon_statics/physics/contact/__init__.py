"""Contact laws: how much moment friction in the joint can take up. One file a law.

They are written in shares of the tensions and know nothing of designs, sides or units; see `law`.
"""

from __future__ import annotations

from .elastic_seat import ElasticSeatLaw
from .friction_circle import FrictionCircleLaw
from .law import ContactLaw
from .merged import MergedLaw

CONTACT_LAWS: dict[str, type[ContactLaw]] = {
    'merged': MergedLaw,
    'friction_circle': FrictionCircleLaw,
    'elastic_seat': ElasticSeatLaw,
}
"""Name → law; the first is the default"""

__all__ = ['CONTACT_LAWS', 'ContactLaw', 'ElasticSeatLaw', 'FrictionCircleLaw', 'MergedLaw']
