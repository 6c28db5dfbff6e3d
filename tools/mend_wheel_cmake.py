"""Point the CMake targets of the ROS wheels at this environment.

The wheels' exported targets name the Python and NumPy headers of the machine that built them
(``/opt/python/cp312-cp312/...``), so that no interfaces package can be compiled against them.
Run with the environment's own Python; a second run finds nothing to do.
"""

import re
import sys
import sysconfig
from pathlib import Path

import numpy

BUILDER = r'/opt/python/cp3\d+-cp3\d+'
REPLACEMENTS = (
    (rf'{BUILDER}/lib/python3\.\d+/site-packages/numpy/_core/include', numpy.get_include()),
    (rf'{BUILDER}/include/python3\.\d+', sysconfig.get_path('include')),
)


def main() -> None:
    """Rewrite every ``.cmake`` file under the environment's ``share`` that needs it."""
    mended = 0
    for path in sorted(Path(sys.prefix, 'share').rglob('*.cmake')):
        before = text = path.read_text(encoding='utf-8')
        for pattern, replacement in REPLACEMENTS:
            text = re.sub(pattern, lambda _, new=replacement: new, text)
        if text != before:
            path.write_text(text, encoding='utf-8')
            mended += 1
    print(f'== {mended} CMake files of the wheels pointed at {sys.prefix}')


if __name__ == '__main__':
    main()
