"""What RViz shows of the joints that a launch file starts."""

from __future__ import annotations

import copy
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from ament_index_python.packages import (
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
)

from ..physics.errors import TendonStaticsError
from .apt_package import apt_package

ROBOT_MODEL, MARKERS = 'rviz_default_plugins/RobotModel', 'rviz_default_plugins/MarkerArray'


class RvizError(TendonStaticsError, RuntimeError):
    """RViz cannot be started; the text is for the user."""


class Shown(NamedTuple):
    """A joint as RViz finds it."""

    namespace: str
    """Without slashes at its ends; empty for none"""
    frame_id: str
    has_base: bool = False
    """Whether its description has a link with Z up, for a base that is tilted"""


def rviz_config(joints: Sequence[Shown]) -> dict[str, Any]:
    """Return the installed ``tendon_statics.rviz`` with these joints in place of its one.

    The fixed frame is that of the first joint. Others are seen where transforms join them to it.
    """
    installed = Path(get_package_share_directory('tendon_statics'), 'rviz', 'tendon_statics.rviz')
    config: Any = yaml.safe_load(installed.read_text(encoding='utf-8'))
    manager = config['Visualization Manager']
    displays = []
    for display in manager['Displays']:
        if display['Class'] not in (ROBOT_MODEL, MARKERS):
            displays.append(display)
            continue
        key = 'Topic' if display['Class'] == MARKERS else 'Description Topic'
        for joint in joints:
            own = copy.deepcopy(display)
            if joint.namespace:
                own['Name'] += f' of {joint.namespace}'
                own[key]['Value'] = f'/{joint.namespace}{own[key]["Value"]}'
            displays.append(own)
    manager['Displays'] = displays
    first = joints[0]
    manager['Global Options']['Fixed Frame'] = first.frame_id + '_base' * first.has_base
    return config  # type: ignore[no-any-return]


def rviz_arguments(joints: Sequence[Shown]) -> list[str]:
    """Return the arguments of ``rviz2`` with which it shows the joints.

    Raises
    ------
    RvizError
        If RViz is not installed.
    """
    try:
        get_package_prefix('rviz2')
    except PackageNotFoundError:
        raise RvizError(
            f'rviz:=true needs RViz, which is not installed: apt install {apt_package("rviz2")}'
        ) from None
    # RViz may write to it when it ends, so it is not removed.
    path = Path(tempfile.mkdtemp(prefix='tendon_statics_'), 'tendon_statics.rviz')
    path.write_text(yaml.safe_dump(rviz_config(joints), sort_keys=False), encoding='utf-8')
    return ['-d', str(path)]
