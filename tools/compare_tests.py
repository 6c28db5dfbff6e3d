"""Compare what the tests assert with an earlier commit: those gone, and those that assert less.

A test that was renamed or replaced shows up as gone; who reads the list judges.
"""

from __future__ import annotations

import argparse
import ast
import subprocess
from collections import Counter

from make_docs import ROOT


def assertions(commit: str) -> Counter[str]:
    """Test → assertions in it, `pytest.raises` and calls of helpers that assert among them."""
    count: Counter[str] = Counter()
    for path in _git('ls-tree', '-r', '--name-only', commit, 'test').splitlines():
        if not path.endswith('.py'):
            continue
        for node in ast.walk(ast.parse(_git('show', f'{commit}:{path}'))):
            if isinstance(node, ast.FunctionDef) and node.name.startswith('test_'):
                count[node.name] += sum(map(_asserts, ast.walk(node)))
    return count


def _asserts(node: ast.AST) -> bool:
    if isinstance(node, ast.Call):
        called = ast.unparse(node.func)
        return 'assert' in called or called == 'pytest.raises'
    return isinstance(node, ast.Assert)


def _git(*arguments: str) -> str:
    command = ('git', '-C', ROOT, *arguments)
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main() -> None:
    """Print both lists and the sums."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('before', help='a commit')
    parser.add_argument('after', nargs='?', default='HEAD', help='a commit (HEAD)')
    arguments = parser.parse_args()
    before, after = assertions(arguments.before), assertions(arguments.after)
    for name, count in before.items():
        if name not in after:
            print(f'gone: {name} ({count})')
        elif after[name] < count:
            print(f'fewer: {name} ({count} -> {after[name]})')
    print(f'{len(before)} -> {len(after)} tests, {before.total()} -> {after.total()} assertions')


if __name__ == '__main__':
    main()
