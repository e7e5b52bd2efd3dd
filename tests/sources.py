# SPDX-License-Identifier: Apache-2.0
"""Which files are ours. Shared by the checks beside this file."""

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("src", "apps", "tests", "examples", "benchmarks")
SKIPPED = 77  # the exit code that ctest reads as "skipped"


def cpp_files(root, suffixes=(".h", ".cpp"), folders=FOLDERS):
    """All C++ files of the project below `root`, sorted."""
    root = Path(root)
    found = (path for folder in folders for path in (root / folder).rglob("*"))
    return sorted(path for path in found if path.suffix in suffixes and path.is_file())
