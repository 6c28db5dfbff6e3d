"""From what was recorded to tensions in N, as the estimator of the unit or arm takes them."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..files.arm_parameters import ARM_PARAMETERS
from ..files.known_parameters import said_of_unknown
from ..physics.calibration.load_cells import AS_MEASURED, LoadCells
from ..tensions.cable_scale import DEFAULT_MAX_TENSION, SLACK_STDDEVS, CableScale, scaled_arrays
from ..tensions.reason import Reason
from ..tensions.watch import Plausibility
from .arm_recording import ArmRecording
from .recording import Recording
from .session import Floats, Session

if TYPE_CHECKING:
    from ..estimation.arm_settings import ArmSettings
    from ..files.unit_file import Unit


def of_unit(recording: Recording, unit: Unit) -> Recording:
    """Return the recording with tensions in N and the faults that the estimator would find.

    Gain and bias of each cable apply to what was recorded, unless that is in N for certain; the
    largest plausible tension always does. What was recorded stays in `Recording.readings`.
    """
    scales = {'cable_l': unit.cable_l, 'cable_s': unit.cable_s}
    applies, (tension_l, tension_s), faults = _in_newtons(recording, [*scales.values()])
    believed = unit.settings.plausibility
    limited = any(f'{name}.max_tension' in unit.parameters for name in scales)
    said = [
        *filter(None, [unit.addressed]),
        *unit.unknown,
        *_said(scales, believed, recording, applies, 'design', limited=limited),
        _slack_said(scales, unit.settings.tension_stddev, unit.parameters)
        + _limit_said(limited=limited),
    ]
    return dataclasses.replace(
        recording,
        tension_l=tension_l,
        tension_s=tension_s,
        readings=(recording.tension_l, recording.tension_s) if applies else None,
        in_newtons=True,
        faults=faults,
        notes=(*recording.notes, *said),
    )


def of_arm(
    recording: ArmRecording, settings: ArmSettings, given: Collection[str] = ()
) -> ArmRecording:
    """Return the same of an arm, as the estimator with these settings would find it.

    Parameters
    ----------
    given : collection of str
        Names of the parameters that a file gives.
    """
    names = settings.arm.cable_names
    scales = {f'cables.{name}': of for name, of in zip(names, settings.scales, strict=True)}
    applies, tensions, faults = _in_newtons(recording, [*scales.values()])
    limited = any(f'{name}.max_tension' in given for name in scales)
    said = [
        *said_of_unknown(given, (of.name for of in ARM_PARAMETERS)),
        *_said(scales, settings.plausibility, recording, applies, 'parameter', limited=limited),
        _slack_said(scales, settings.tension_stddev, given) + _limit_said(limited=limited),
    ]
    return dataclasses.replace(
        recording,
        cable_tensions=dict(zip(names, tensions, strict=True)),
        readings=recording.cable_tensions if applies else None,
        in_newtons=True,
        faults=faults,
        notes=(*recording.notes, *said),
    )


def _in_newtons(
    recording: Session, scales: Sequence[CableScale]
) -> tuple[bool, list[Floats], list[str]]:
    """Whether gain and bias apply, the tensions in N, and why each sample has none."""
    applies = not (recording.in_newtons or all(scale.is_identity for scale in scales))
    if not applies:
        scales = [scale._replace(gain=1.0, bias=0.0) for scale in scales]
    found = [
        scaled_arrays(readings, scale)
        for readings, scale in zip(recording.cables(), scales, strict=True)
    ]
    worst = worse_reasons(*(reasons for _, reasons in found)).tolist()
    faults = [before or now for before, now in zip(recording.known_faults, worst, strict=True)]
    return applies, [tensions for tensions, _ in found], faults


def worse_reasons(*reasons: NDArray[np.object_]) -> NDArray[np.str_]:
    """Return of the cables' reasons the one that counts, empty if none: `worse` over arrays."""
    words = [
        np.array([reason.value if reason else '' for reason in of_cable.tolist()], dtype='<U24')
        for of_cable in reasons
    ]
    worst = words[-1]
    for word in words[-2::-1]:
        worst = np.where(word == '', worst, word)
    implausible = Reason.IMPLAUSIBLE.value
    return np.where(np.any([word == implausible for word in words], axis=0), implausible, worst)


def corrected(recording: Recording, cells: LoadCells) -> Recording:
    """Return the recording with the tensions that fitted load cells make of it."""
    if cells == AS_MEASURED:
        return recording
    tension_l, tension_s = cells.tensions(recording.tension_l, recording.tension_s)
    return dataclasses.replace(recording, tension_l=tension_l, tension_s=tension_s)


def _said(
    scales: Mapping[str, CableScale],
    believed: Plausibility,
    recording: Session,
    applies: bool,
    file: str,
    *,
    limited: bool,
) -> list[str]:
    """Say what of the parameter file was applied, and what was not."""
    given = [name for name in scales if not scales[name].is_identity]
    found = []
    if applies:
        found += [
            f'{cable}: tension = {scale.gain:g} · reading {scale.bias:+g} N, of the {file} file'
            for cable, scale in scales.items()
        ]
    elif given:
        found.append(
            f'gain and bias of {" and ".join(given)} in the {file} file are not applied: the '
            'tensions were recorded in N'
        )
    if limited:
        found.append(
            'tensions above '
            + ', '.join(f'{scale.max_tension:g} N ({name})' for name, scale in scales.items())
            + f' are implausible, by the {file} file'
        )
    if believed.max_rate > 0.0 and recording.time is None:
        found.append(
            f'max_tension_rate of the {file} file is not checked: there are no times '
            '(--rate HZ makes them)'
        )
    elif believed.is_checked:
        checks = {
            'too fast': believed.max_rate,
            'saturated': believed.saturation_count,
            'frozen': believed.frozen_count,
        }
        named = ' or '.join(name for name, limit in checks.items() if limit)
        found.append(f'what is {named} is not believed, by the {file} file')
    return found


def _slack_said(
    scales: Mapping[str, CableScale], tension_stddev: float, given: Collection[str]
) -> str:
    """Say up to which tension a cable counts as slack, and why."""
    by_threshold: dict[tuple[float, bool], list[str]] = {}
    for name, scale in scales.items():
        key = scale.slack_threshold, f'{name}.slack_threshold' in given
        by_threshold.setdefault(key, []).append(name)
    return '; '.join(
        f'{" and ".join(names) if len(by_threshold) > 1 else "a cable"} counts as slack up to '
        f'{threshold:g} N, '
        + (
            'its slack_threshold'
            if is_given and threshold > 0.0
            else f'{SLACK_STDDEVS:g} times the tension_stddev of {tension_stddev:g} N'
        )
        for (threshold, is_given), names in by_threshold.items()
    )


def _limit_said(*, limited: bool) -> str:
    """Say up to which tension all is believed, where no file gives a limit."""
    return (
        ''
        if limited
        else f'; tensions up to {DEFAULT_MAX_TENSION:g} N are believed, as no max_tension is given'
    )
