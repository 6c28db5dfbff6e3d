"""From what was recorded of a unit to its tensions in N, as the estimator takes them."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..physics.calibration.load_cells import AS_MEASURED, LoadCells
from ..tensions.cable_scale import scaled_arrays
from ..tensions.reason import Reason
from .recording import Recording

if TYPE_CHECKING:
    from ..files.unit_file import Unit


def of_unit(recording: Recording, unit: Unit) -> Recording:
    """Return the recording with tensions in N and the faults that the estimator would find.

    Gain and bias of each cable apply to what was recorded, unless that is in N for certain; the
    largest plausible tension always does. What was recorded stays in `Recording.readings`.
    """
    scales = [unit.cable_l, unit.cable_s]
    applies = not (recording.in_newtons or all(scale.is_identity for scale in scales))
    if not applies:
        scales = [scale._replace(gain=1.0, bias=0.0) for scale in scales]
    (tension_l, reasons_l), (tension_s, reasons_s) = (
        scaled_arrays(readings, scale)
        for readings, scale in zip((recording.tension_l, recording.tension_s), scales, strict=True)
    )
    found = worse_reasons(reasons_l, reasons_s)
    faults = [
        before or now for before, now in zip(recording.known_faults, found.tolist(), strict=True)
    ]
    return dataclasses.replace(
        recording,
        tension_l=tension_l,
        tension_s=tension_s,
        readings=(recording.tension_l, recording.tension_s) if applies else None,
        in_newtons=True,
        faults=faults,
        notes=(*recording.notes, *_said(unit, recording, applies)),
    )


def worse_reasons(
    reasons_l: NDArray[np.object_], reasons_s: NDArray[np.object_]
) -> NDArray[np.str_]:
    """Return for each pair the reason that counts, empty if there is none: `worse` over arrays."""
    words_l, words_s = (
        np.array([reason.value if reason else '' for reason in reasons.tolist()], dtype='<U24')
        for reasons in (reasons_l, reasons_s)
    )
    implausible = Reason.IMPLAUSIBLE.value
    first: NDArray[np.str_] = np.where(words_l == '', words_s, words_l)
    return np.where((words_l == implausible) | (words_s == implausible), implausible, first)


def corrected(recording: Recording, cells: LoadCells) -> Recording:
    """Return the recording with the tensions that fitted load cells make of it."""
    if cells == AS_MEASURED:
        return recording
    tension_l, tension_s = cells.tensions(recording.tension_l, recording.tension_s)
    return dataclasses.replace(recording, tension_l=tension_l, tension_s=tension_s)


def _said(unit: Unit, recording: Recording, applies: bool) -> list[str]:
    """Say what of the unit's file was applied, and what was not."""
    scales = {'cable_l': unit.cable_l, 'cable_s': unit.cable_s}
    given = [name for name in scales if not scales[name].is_identity]
    found = list(unit.misspelt)
    if applies:
        found += [
            f'{cable}: tension = {scale.gain:g} · reading {scale.bias:+g} N, of the design file'
            for cable, scale in scales.items()
        ]
    elif given:
        found.append(
            f'gain and bias of {" and ".join(given)} in the design file are not applied: the '
            'tensions were recorded in N'
        )
    largest = {name: scale.max_tension for name, scale in scales.items()}
    if any(f'{name}.max_tension' in unit.parameters for name in scales):
        found.append(
            'tensions above '
            + ', '.join(f'{limit:g} N ({name})' for name, limit in largest.items())
            + ' are implausible, by the design file'
        )
    believed = unit.settings.plausibility
    if believed.max_rate > 0.0 and recording.time is None:
        found.append(
            'max_tension_rate of the design file is not checked: there are no times '
            '(--rate HZ makes them)'
        )
    elif believed.is_checked:
        checks = {
            'too fast': believed.max_rate,
            'saturated': believed.saturation_count,
            'frozen': believed.frozen_count,
        }
        named = ' or '.join(name for name, limit in checks.items() if limit)
        found.append(f'what is {named} is not believed, by the design file')
    return found
