#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds that objects compiled for one instruction set define no symbol that other objects may share.

Of an inline function with external linkage (a standard template, say) the linker keeps one copy for the whole
program; were it the one compiled for AVX-512, the program would not run on an older processor.
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

from sources import SKIPPED

KERNEL_OBJECT = re.compile(r"cairn_\w+_(sse42|avx2|avx512)\.dir/.*\.o$")
SHARED = set("WVuwv")  # what nm calls weak and unique symbols


def shared_symbols(path):
    """Names of the symbols that this object defines and others may define as well."""
    listed = subprocess.run(["nm", "--defined-only", "--demangle", str(path)], capture_output=True, text=True, check=True)
    fields = (line.split(maxsplit=2) for line in listed.stdout.splitlines())
    return [parts[2] for parts in fields if len(parts) == 3 and parts[1] in SHARED]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help="folder with the object files")
    arguments = parser.parse_args()
    if not shutil.which("nm"):
        print("nm is not installed: nothing was checked")
        return SKIPPED
    objects = [path for path in sorted(arguments.build.rglob("*.o")) if KERNEL_OBJECT.search(path.as_posix())]
    complaints = [f"{path.name} of {path.parts[-3]}: '{symbol}' may be shared with objects for other instruction sets"
                  for path in objects for symbol in shared_symbols(path)]
    print("\n".join(complaints))
    print(f"kernels: {len(objects)} objects, {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
