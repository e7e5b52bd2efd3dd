#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lengths of files and functions: median, 90th percentile, longest. Fails over the hard limits."""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

from sources import FOLDERS, ROOT, SKIPPED, cpp_files

MAX_FUNCTION = 60  # lines, from the line with the name to the closing brace
MAX_FILE = 400


def functions_of(files):
    """(lines, 'file:line name') of every function that universal-ctags finds."""
    command = ["ctags", "--languages=C++", "--language-force=C++", "--kinds-C++=f", "--fields=ne", "-f", "-", "-L", "-"]
    names = "\n".join(str(path) for path in files)
    tags = subprocess.run(command, input=names, capture_output=True, text=True, check=True).stdout
    functions = []
    for tag in tags.splitlines():
        begin, end = re.search(r"\tline:(\d+)", tag), re.search(r"\tend:(\d+)", tag)
        if begin and end:
            name, path = tag.split("\t")[:2]
            functions.append((int(end[1]) - int(begin[1]) + 1, f"{path}:{begin[1]} {name}"))
    return functions


def lines_of(files):
    return [(len(path.read_text().splitlines()), str(path)) for path in files]


def summary(name, lengths):
    """One row of the report; lengths are (lines, place)."""
    ordered = sorted(lengths)
    at = lambda share: ordered[min(len(ordered) - 1, int(share * len(ordered)))][0]
    longest = ordered[-1]
    return f"{name:<22} {len(ordered):>5} {at(0.5):>7} {at(0.9):>5} {longest[0]:>8}  {longest[1]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=Path, default=ROOT)
    root = parser.parse_args().root.resolve()
    if not shutil.which("ctags"):
        print("universal-ctags is not installed: nothing was measured")
        return SKIPPED
    complaints = []
    print(f"{'lines of':<22} {'count':>5} {'median':>7} {'p90':>5} {'longest':>8}")
    for folder in FOLDERS:
        files = cpp_files(root, folders=(folder,))
        kinds = [("functions", functions_of(files), MAX_FUNCTION), ("files", lines_of(files), MAX_FILE)] if files else []
        for kind, lengths, limit in kinds:
            if lengths:
                print(summary(f"{folder}: {kind}", lengths).replace(f"{root}/", ""))
            complaints += [f"{place}: {lines} lines, at most {limit}" for lines, place in lengths if lines > limit]
    print(*complaints, sep="\n", end="\n" if complaints else "")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
