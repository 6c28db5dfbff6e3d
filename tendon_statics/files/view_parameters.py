"""The live page's parameters: one table, as the estimator has one."""

from __future__ import annotations

from .parameter_kinds import NumberParameter, Parameter, TextParameter

OWN_MACHINE = '127.0.0.1'

HIGHEST_RATE = 20.0
"""Drawings per second; more cost the processor and show a person nothing"""

VIEW_PARAMETERS: tuple[Parameter, ...] = (
    NumberParameter(
        'port',
        8780,
        'port of the page; 0: any that is free, which the node then says',
        minimum=0,
        maximum=65535,
        is_fixed=True,
    ),
    TextParameter(
        'address',
        OWN_MACHINE,
        'address of this machine under which the page is served; any but `127.0.0.1` shows it to '
        'others, without a password; `0.0.0.0`: all addresses',
    ),
    TextParameter(
        'host',
        '',
        'a name by which browsers on other machines call this one, where it is not the address or '
        "the machine's own name",
    ),
    NumberParameter(
        'rate',
        HIGHEST_RATE,
        'drawings per second, at the most',
        minimum=1.0,
        maximum=HIGHEST_RATE,
        unit='Hz',
        is_fixed=True,
    ),
    TextParameter(
        'estimator',
        '',
        'full name of the node that a new page shows, say `/left/estimator`; empty: the first '
        'that is found',
    ),
)
