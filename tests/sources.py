# SPDX-License-Identifier: Apache-2.0
"""Which files are ours. Shared by the checks beside this file."""

import functools
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("src", "apps", "tests", "examples", "benchmarks")
SKIPPED = 77  # the exit code that ctest reads as "skipped"


def cpp_files(root, suffixes=(".h", ".cpp"), folders=FOLDERS):
    """All C++ files of the project below `root`, sorted."""
    root = Path(root)
    found = (path for folder in folders for path in (root / folder).rglob("*"))
    return sorted(path for path in found if path.suffix in suffixes and path.is_file())


INCLUDE = re.compile(r'^\s*#\s*include\s+(?:<([^>]+)>|"([^"]+)")', re.MULTILINE)


def includes_of(path, root):
    """(library headers, our headers) that a file includes itself: names, and paths."""
    libraries, ours = [], []
    for library, own in INCLUDE.findall(path.read_text()):
        found = next((folder / own for folder in (root / "src", path.parent) if own and (folder / own).is_file()), None)
        if found:
            ours.append(found.resolve())
        elif library:
            libraries.append(library)
    return libraries, ours


@functools.cache
def headers_below(path, root):
    """Our headers that a file includes, directly or not."""
    ours = includes_of(path, root)[1]
    return frozenset(ours).union(*(headers_below(header, root) for header in ours))
