"""How Sphinx builds the site from these pages: `make site`, and rosdoc2 by rosdoc2.yaml."""

import importlib.metadata
import re
from contextlib import suppress
from pathlib import Path

project = 'tendon_statics'
author = 'tendon_statics maintainers'
project_copyright = author
with suppress(importlib.metadata.PackageNotFoundError):  # rosdoc2 takes it from package.xml
    release = importlib.metadata.version(project)

extensions = ['myst_parser', 'sphinx.ext.autodoc', 'sphinx.ext.napoleon']
source_suffix = {'.rst': 'restructuredtext', '.md': 'markdown'}
# rosdoc2 copies this folder elsewhere, and has pages of its own for what is in the root.
in_clone = Path(__file__).resolve().parents[1].joinpath('CONTRIBUTING.md').exists()
exclude_patterns = [] if in_clone else ['contributing.md', 'changelog.rst']

# Headings may be linked to, as on the pages of a repository.
# A name that several classes have is linked to one of them.
suppress_warnings = ['ref.python']

myst_heading_anchors = 4
myst_enable_extensions = ['colon_fence']

# Docstrings write `names` so; what is no name of the package stays as it is.
default_role = 'py:obj'
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
autodoc_member_order = 'bysource'
autodoc_preserve_defaults = True
autodoc_typehints = 'description'
autodoc_typehints_description_target = 'documented'

html_theme = 'furo'
html_static_path = ['_static']
html_css_files = ['site.css']
html_title = f'{project} {globals().get("release", "")}'.strip()
html_copy_source = False
html_show_sphinx = False


def setup(app):
    """Let pages and docstrings be written for those who read them without Sphinx."""
    app.connect('source-read', lead_to_pages)
    app.connect('autodoc-process-docstring', hide_colon, priority=1)
    app.connect('autodoc-process-docstring', show_colon, priority=900)


def lead_to_pages(_app, _page, source):
    """Lead links to files of the root that are pages here to those pages."""
    source[0] = source[0].replace('](../CONTRIBUTING.md)', '](contributing.md)')


COLON = '\ue000'


def hide_colon(_app, what, _name, _object, _options, lines):
    """Keep "x: y" of an attribute from napoleon, which would take x for its type."""
    if what in ('attribute', 'data', 'property') and lines:
        lines[0] = lines[0].replace(':', COLON)


def show_colon(_app, _what, _name, _object, _options, lines):
    """Show it again, and keep |M|, a magnitude, from docutils, which would substitute it."""
    lines[:] = [re.sub(r'\|(?=\S)', r'\\|', line.replace(COLON, ':')) for line in lines]
