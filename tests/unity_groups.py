#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Says which sources of each target CMake compiles together. Called by cmake/unity.cmake.

Reads lines "target<TAB>source" and prints a CMake script that sets UNITY_GROUP of each source that shares a batch.
"""

import sys
from pathlib import Path

from batches import make_batches
from sources import ROOT

MAX_BATCH = 8  # sources: larger ones take the compiler past 1 GB, and a core waits for the last


def main():
    targets = {}
    for line in sys.stdin.read().splitlines():
        target, source = line.split("\t")
        targets.setdefault(Path(source).resolve(), []).append(target)
    for number, (target, paths) in enumerate(make_batches(targets, ROOT, MAX_BATCH)):
        if len(paths) > 1:
            names = " ".join(f'"{path}"' for path in paths)
            print(f"set_source_files_properties({names}\n  TARGET_DIRECTORY {target} PROPERTIES UNITY_GROUP {target}_{number})")


if __name__ == "__main__":
    main()
