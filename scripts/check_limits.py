#!/usr/bin/env python3
"""Refuses a limit that two tables of fields write in figures: fields of the same name with the same range, in two files,
name one constant (or one function for the permitted values).

usage: scripts/check_limits.py [ROOT]
"""
import collections
import pathlib
import re
import subprocess
import sys

ROW = re.compile(
    r'\badd(?:_read|_sampled_number)?\(\s*(?:table,\s*)?"([\w/]+)",[^;]{0,120}?\b(?:numbers|integers|numbers_above|texts)\(([^()]*)\)'
)
NAMED = re.compile(r"\bk[A-Z]")
# Shares and the like: their range is what the word says.
PLAIN = re.compile(r"^\s*0\s*,\s*1\s*$")


def limits(path):
    """Pairs of a field's name and its range in figures."""
    for name, values in ROW.findall(path.read_text(encoding="utf-8")):
        if not NAMED.search(values) and not PLAIN.match(values):
            yield name.rsplit("/", 1)[-1], " ".join(values.replace("'", "").split())


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    names = subprocess.check_output(["git", "-C", root, "ls-files", "*.cpp"], encoding="utf-8").split()
    files = collections.defaultdict(set)
    for name in names:
        if name.startswith(("tests/", "bench/")) or not (root / name).exists():
            continue
        for limit in limits(root / name):
            files[limit].add(name)
    twice = [(limit, where) for limit, where in sorted(files.items()) if len(where) > 1]
    for (field, values), where in twice:
        print(
            f"check_limits: the range ({values}) of \"{field}\" is in {' and '.join(sorted(where))}: name it once",
            file=sys.stderr,
        )
    return 1 if twice else 0


if __name__ == "__main__":
    sys.exit(main())
