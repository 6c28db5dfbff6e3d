"""What ``tendon-statics archive`` finds out about each recording, as replay and calibrate do."""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import Any

from ..archive.row import DAMAGED, REFUSED, UNREADABLE, WHOLE
from ..archive.work import Studied
from ..files.unit_file import Unit
from ..physics import CalibrationError, DesignError, LoadError
from ..physics.errors import BendAngleError
from ..recordings.errors import RecordingError
from ..recordings.hints import hints
from ..recordings.plausible_fit import objections
from ..recordings.progress import unseen
from ..recordings.recording import Recording
from ..recordings.replay.result import Replay
from ..recordings.replay.summary import summary_of
from .calibration_options import add_calibration_options, calibration_from
from .options import UsageError
from .recording_options import recording_from
from .replay_options import replay_from
from .replay_text import invalid_text

NOT_OF_RESULTS = (
    *('command', 'verb', 'run', 'folders', 'output', 'exclude', 'workers', 'scheduler', 'format'),
    *('design', 'node'),
)
"""Options that no result hangs on; the design counts by what stands in its file"""


@dataclasses.dataclass(frozen=True)
class Study:
    """Replays a recording of a unit, and calibrates with it if that is asked."""

    unit: Unit
    options: argparse.Namespace

    def __call__(self, path: Path) -> Studied:
        """Return what there is to tell of a recording, and its samples."""
        try:
            recording = recording_from(self.options, self.unit, path, unseen)
        except RecordingError as error:
            return Studied({'status': UNREADABLE, 'error': _without(path, error)})
        facts = {**self._facts(recording), 'status': DAMAGED if recording.damage else WHOLE}
        try:
            replayed = replay_from(self.options, self.unit, self.unit.design, recording, unseen)
        except (BendAngleError, LoadError, RecordingError, UsageError) as error:
            return Studied({**facts, 'status': REFUSED, 'error': _without(path, error)})
        facts |= _replay_facts(replayed)
        if self.options.calibrate:
            found = self._calibration_facts(recording)
            facts |= {**found, 'warnings': (*facts['warnings'], *found.get('warnings', ()))}
        return Studied(facts, replayed.columns())

    def _facts(self, recording: Recording) -> dict[str, Any]:
        return {
            'samples': len(recording),
            'damage': recording.damage,
            'notes': recording.notes,
            'warnings': tuple(hints(recording, self.unit.design, self.unit.settings.plausibility)),
            'clock': recording.clock,
            'time_origin': recording.time_origin or None,
        }

    def _calibration_facts(self, recording: Recording) -> dict[str, Any]:
        try:
            calibration, comparison = calibration_from(self.options, self.unit, recording)
        except (CalibrationError, DesignError, RecordingError) as error:
            return {'calibration_error': str(error)}
        told = () if comparison is None else (comparison.statement,)
        return {
            'warnings': (*calibration.warnings, *told),
            'calibration_objections': tuple(objections(calibration)),
            'calibration_residual': calibration.residuals.root_mean_square,
            'contact_law': (calibration.design or calibration.start).contact_law,
            'fitted': {
                parameter.name: (parameter.value, parameter.standard_error)
                for parameter in calibration.parameters
            },
        }


def _replay_facts(replayed: Replay) -> dict[str, Any]:
    summary = summary_of(replayed)
    pace = {} if summary.pace is None else summary.pace._asdict()
    error = {} if summary.error is None else summary.error._asdict()
    return {
        **pace,
        'estimation': replayed.estimation,
        'regimes': summary.regimes,
        'invalid_reasons': invalid_text(summary),
        'determined': summary.determined,
        'not_assured': summary.unsure,
        **{f'error_{name}': value for name, value in error.items()},
    }


def _without(path: Path, error: Exception) -> str:
    """Return the text of an error without the path before it, which stands beside it."""
    return str(error).removeprefix(f'{path}: ')


def what_counts(options: argparse.Namespace, unit: Unit) -> dict[str, Any]:
    """Return all that the results hang on beside the recording, ready for JSON."""
    left_out = {*NOT_OF_RESULTS}
    if not options.calibrate:
        of_calibration = argparse.ArgumentParser(add_help=False)
        add_calibration_options(of_calibration)
        left_out |= vars(of_calibration.parse_args([])).keys() - {'tension_stddev'}
    chosen = {name: value for name, value in vars(options).items() if name not in left_out}
    return {**chosen, 'parameters': dict(unit.parameters)}
