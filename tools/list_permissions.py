"""Print who may do what under security/policy.xml, for docs/security.md."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from tendon_statics.command_line.tables import markdown_table

POLICY = Path(__file__).resolve().parents[1] / 'security' / 'policy.xml'

RIGHTS = {'topics': ('publish', 'subscribe'), 'services': ('reply', 'request')}
"""What may be allowed of each kind of name"""


def main() -> None:
    """Print the table; what each other node has of its own is gathered in rows with ``~``."""
    roles = {role.rpartition('/')[2]: rights for role, rights in permissions(POLICY).items()}
    cells: dict[tuple[str, str], dict[str, list[str]]] = {}
    for role, rights in roles.items():
        for right, names in rights.items():
            kind = 'topic' if right in RIGHTS['topics'] else 'service'
            for name in names:
                shown = (
                    name
                    if role in ('estimator', 'arm_estimator')
                    else name.replace(f'/{role}/', '~/')
                )
                cells.setdefault((kind, shown), {}).setdefault(role, []).append(right)
    rows = [
        (kind, f'`{name}`', *(', '.join(cell.get(role, ())) for role in roles))
        for (kind, name), cell in sorted(
            cells.items(), key=lambda item: (item[0][0] != 'topic', item)
        )
    ]
    print(markdown_table(('', 'name', *(f'`{role}`' for role in roles)), rows))


def permissions(policy: Path) -> dict[str, dict[str, set[str]]]:
    """Return what a policy allows: path of the enclave → right → full names.

    Names are made full as the template ``permissions.xsl`` of sros2 does it.
    """
    root = ElementTree.parse(policy).getroot()
    return {enclave.attrib['path']: _rights(enclave) for enclave in root.iterfind('enclaves/*')}


def _rights(enclave: ElementTree.Element) -> dict[str, set[str]]:
    rights: dict[str, set[str]] = {right: set() for pair in RIGHTS.values() for right in pair}
    for profile in enclave.iterfind('profiles/profile'):
        for right, name in _rules(profile):
            rights[right].add(full_name(name, profile.attrib['ns'], profile.attrib['node']))
    return rights


def _rules(profile: ElementTree.Element) -> Iterator[tuple[str, str]]:
    for group in profile:
        for right, qualifier in group.attrib.items():
            if right not in RIGHTS[group.tag] or qualifier != 'ALLOW':
                raise ValueError(f'{group.tag} {right}="{qualifier}" is not read here')
            yield from ((right, name.text or '') for name in group)


def full_name(name: str, namespace: str, node: str) -> str:
    """Return a name of a profile with its namespace, and its node in place of ``~``."""
    if name.startswith('/'):
        return name
    if not namespace.endswith('/'):
        namespace += '/'
    return namespace + (node + name[1:] if name.startswith('~') else name)


if __name__ == '__main__':
    main()
