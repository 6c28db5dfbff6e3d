"""Named tuples, made without a detour."""

from __future__ import annotations

named = tuple.__new__
"""``named(Type, fields)`` is ``Type(*fields)`` in half of the time, where microseconds count"""
