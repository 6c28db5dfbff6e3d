"""The columns of a table that are those of a recording."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from ..errors import RecordingError
from .table_options import TableOptions
from .time_column import TimeColumn, find_time
from .time_titles import (
    parse_time_title,
    place_of_date,
    place_of_nanoseconds,
    time_unit,
)
from .units import Quantities, split_title

_ONLY_NUMBERS = re.compile(r'[-+.,;|\s\deE]*\d[-+.,;|\s\deE]*')
"""One, or several in a line whose separator the titles do not tell"""

_LOOSE_UNIT = re.compile(
    r'(?P<name>.*?[^\W_].*?)\s*(?:\(\s*(?P<inside>[^()]*?)\s*\)'
    r'|(?:\s*/\s*|,\s*|\s+in\s+)(?P<after>[^\W\d_]+|°)|[\W_]+(?P<last>[^\W\d_]+|°))'
)
"""A title with a unit in round brackets or after a stroke, a comma or ``in``, or a last word"""


MOST_NAMED = 8
"""Columns that are not used and are named"""


class Column(NamedTuple):
    """Where a quantity stands in a table."""

    place: int
    factor: float
    """What one of its unit is in SI"""
    unit: str = ''
    """The unit that is said; empty: none is, and SI is taken"""

    @property
    def has_unit(self) -> bool:
        """Whether the unit is said, and not taken to be SI."""
        return bool(self.unit)


class Columns(NamedTuple):
    """Where all of a recording stands in a table."""

    numbers: dict[str, Column]
    """By quantity; without the time"""
    time: TimeColumn | None = None
    state: int | None = None
    others: tuple[int, ...] = ()
    """Places of what is left alone"""
    in_newtons: bool = False
    """Whether the tensions are in N for certain, since their units are said"""
    converted: tuple[str, ...] = ()
    """What was in another unit than that of SI, for people"""
    unused: tuple[str, ...] = ()
    """Titles of what is left alone"""

    @property
    def notes(self) -> list[str]:
        """How they were read, for people."""
        return [*self.converted, *_said_unused([of for of in self.unused if of.strip()])]


def find_columns(titles: Sequence[str], options: TableOptions | None = None) -> Columns:
    """Find the columns of a recording by their titles; others are left alone.

    Raises
    ------
    RecordingError
        If a tension has no column, a quantity has two, or a unit is not known.
    """
    options = options or TableOptions()
    quantities = options.quantities
    found: dict[str, Column] = {}
    named: dict[int, str] = {}
    for quantity, title in options.columns.items():
        found[quantity] = _named(quantity, title, titles, options)
        other = named.setdefault(found[quantity].place, quantity)
        if other != quantity:
            raise RecordingError(f'--columns says {title!r} is both {other} and {quantity}')
    by_itself: set[str] = set()
    for place, title in enumerate(titles):
        if place in named or split_title(title)[0] in options.columns:
            continue
        name, unit = split_title(title)
        quantities.check_title(title)
        if name not in quantities.kinds or name in options.columns:
            continue
        if name in by_itself:
            raise RecordingError(f'there are two columns of {name}')
        by_itself.add(name)
        found[name] = _column(place, name, unit, options)
    needed = quantities.required
    for name in needed:
        if name not in found:
            raise RecordingError(
                f'there is no column {name}; {", ".join(needed)} are needed, '
                + _there(titles, needed)
            )
    for quantity, unit in options.units.items():
        if quantity in found and quantity != 'time':
            factor = quantities.factor(quantity, unit)
            found[quantity] = _with_unit(unit, factor, found[quantity], titles)
    time = _time(found.pop('time', None), titles, options)
    state = found.pop('state', None)
    in_newtons = all(found[name].has_unit for name in needed)
    in_newtons = in_newtons or set(quantities.readings) <= set(titles)
    used = {column.place for column in found.values()} | {*(time.places if time else ())}
    used |= set() if state is None else {state.place}
    others = tuple(place for place in range(len(titles)) if place not in used)
    state_place = None if state is None else state.place
    converted = tuple(_converted(found, quantities))
    unused = tuple(titles[place] for place in others)
    return Columns(found, time, state_place, others, in_newtons, converted, unused)


def _converted(found: Mapping[str, Column], quantities: Quantities) -> Iterator[str]:
    """Say which columns were in another unit than that of SI."""
    of_unit: dict[tuple[str, str], list[str]] = {}
    for name, column in found.items():
        if column.factor != 1.0:
            si = next(iter(quantities.kinds[name].units))
            of_unit.setdefault((column.unit, si), []).append(name)
    for (unit, si), names in of_unit.items():
        yield f'{" and ".join(names)}: in {unit}, converted to {si}'


def _said_unused(titles: Sequence[str]) -> Iterator[str]:
    if titles:
        more = f' and {len(titles) - MOST_NAMED} more' if len(titles) > MOST_NAMED else ''
        yield f'not used: {", ".join(titles[:MOST_NAMED])}{more}'


def _there(titles: Sequence[str], needed: Sequence[str]) -> str:
    """Say which columns there are instead, and what to do."""
    there = [title for title in titles if title]
    numbers = sum(bool(_ONLY_NUMBERS.fullmatch(title)) for title in there)
    if there and 2 * numbers >= len(there):
        return (
            'but the first line has numbers in place of titles; put titles above it, such as '
            + ','.join(needed)
        )
    if len(there) == 1 and all(name in there[0] for name in needed):
        return f'there is: {there[0]} (--separator CHARACTER says what separates them)'
    missing = ','.join(f'{name}=TITLE' for name in needed if name not in there)
    return f'there are: {", ".join(there) or "none"} (--columns {missing} names them)'


def _named(quantity: str, title: str, titles: Sequence[str], options: TableOptions) -> Column:
    """Return the column that an option names.

    Raises
    ------
    RecordingError
        If there is none, or more than one, or it is in a unit that is not read.
    """
    quantities = options.quantities
    places = [place for place, name in enumerate(titles) if title == name]
    places = places or [
        place
        for place, name in enumerate(titles)
        if title == _split(name, quantity, quantities)[0]
    ]
    if len(places) != 1:
        raise RecordingError(
            f'there is no column {title!r} to be {quantity}; there are: {", ".join(titles)}'
            if not places
            else f'there are {len(places)} columns {title!r}'
        )
    unit = _split(titles[places[0]], quantity, quantities)[1]
    return _column(places[0], quantity, unit, options)


def _column(place: int, quantity: str, unit: str | None, options: TableOptions) -> Column:
    """Return a column in the unit of its title, or without one if an option has to say it.

    Raises
    ------
    RecordingError
        If it is in a unit that is not read, and no option says which it is in.
    """
    quantities = options.quantities
    if unit is None or not quantities.has_units(quantity):
        return Column(place, 1.0)
    if quantity in options.units and quantities.common(quantity, unit) is None:
        return Column(place, 1.0)  # What the option says counts.
    factor = quantities.factor(quantity, unit)
    return Column(place, factor, quantities.common(quantity, unit) or unit)


def _split(title: str, quantity: str, quantities: Quantities) -> tuple[str, str | None]:
    """Split a title into name and unit, which of a named column may stand in other ways too.

    What is another program's name of a unit is one as well, though it may not be read.
    """
    name, unit = split_title(title)
    loose = _LOOSE_UNIT.fullmatch(title.strip())
    if unit is not None or loose is None or not quantities.has_units(quantity):
        return name, unit
    unit = next(text for text in loose.group('inside', 'after', 'last') if text is not None)
    known = quantities.common(quantity, unit)
    if known is None and not quantities.is_foreign(quantity, unit):
        return title.strip(), None
    if unit in ('N', 'G') and loose['last']:
        return title.strip(), None  # F_N is a normal force.
    return loose['name'], known or unit


def _with_unit(unit: str, factor: float, column: Column, titles: Sequence[str]) -> Column:
    """Give a column the unit that an option says.

    Raises
    ------
    RecordingError
        If its title has another.
    """
    if column.has_unit and column.factor != factor:
        raise RecordingError(
            f'the unit of {titles[column.place]!r} stands in its title, and --units says {unit}'
        )
    return Column(column.place, factor, unit)


def _time(
    column: Column | None, titles: Sequence[str], options: TableOptions
) -> TimeColumn | None:
    """Return where the time stands, by an option, by its name, or by what exporters call it.

    Raises
    ------
    RecordingError
        If its title has another unit than the option, or one that is none.
    """
    if column is None:
        found = find_time(titles)
    else:
        title = titles[column.place].strip()
        parsed = parse_time_title(title)
        found = TimeColumn(
            column.place,
            title,
            time_unit(_split(title, 'time', options.quantities)[1] or '')
            or (parsed.unit if parsed else None),
            place_of_nanoseconds(titles, column.place),
            place_of_date(titles),
        )
    said = options.units.get('time')
    if found is None or said is None:
        return found
    unit = time_unit(said)
    if found.unit not in (None, unit):
        raise RecordingError(
            f'the unit of {found.title!r} stands in its title, and --units says {said}'
        )
    return found._replace(unit=unit)
