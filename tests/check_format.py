#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the C++ files with what clang-format-14 makes of them; --fix rewrites them."""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

from sources import ROOT, SKIPPED, cpp_files

FORMATTER = "clang-format-14"  # pinned: another version formats otherwise


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=Path, default=ROOT)
    parser.add_argument("--fix", action="store_true")
    arguments = parser.parse_args()
    if not shutil.which(FORMATTER):
        print(f"{FORMATTER} is not installed: nothing was checked")
        return SKIPPED
    files = cpp_files(arguments.root)
    if not files:
        print("no files")
        return 1
    mode = ["-i"] if arguments.fix else ["--dry-run", "--Werror"]
    done = subprocess.run([FORMATTER, "--style=file", *mode, *map(str, files)], check=False)
    print(f"format: {len(files)} files", "mended" if arguments.fix else "checked")
    if done.returncode != 0:
        print("run ./do format")
    return min(done.returncode, 1)


if __name__ == "__main__":
    sys.exit(main())
