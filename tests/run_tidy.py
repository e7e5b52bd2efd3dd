#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy-14 over our sources, as many at once as there are cores.

A source that passed is passed over until it, one of our headers, .clang-tidy or the compile command changes.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from sources import FOLDERS, ROOT, SKIPPED, cpp_files

TIDY = "clang-tidy-14"  # pinned: other versions have other checks


def common_hash(root):
    """Of everything that reaches every source: our headers and the rules."""
    state = hashlib.sha256()
    for path in [root / ".clang-tidy", *cpp_files(root, suffixes=(".h",))]:
        state.update(str(path).encode() + b"\0" + path.read_bytes())
    return state


def sources_to_check(build, chosen):
    """(path, hash) of our sources in the compilation database."""
    common = common_hash(ROOT)
    wanted = {Path(name).resolve() for name in chosen}
    states = {}  # kernels are compiled several times: one path, several commands
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"]).resolve()
        if path.is_relative_to(build) or not path.is_relative_to(ROOT) or path.relative_to(ROOT).parts[0] not in FOLDERS:
            continue
        if wanted and path not in wanted:
            continue
        state = states.setdefault(path, common.copy())
        state.update(entry["command"].encode() + path.read_bytes())
    return sorted((path, state.hexdigest()) for path, state in states.items())


def tidy(path, build):
    """What clang-tidy says of one source; nothing where it is content."""
    shim = f"--extra-arg-before=-include{ROOT / 'tests' / 'tidy_shim.h'}"
    command = [TIDY, "-p", str(build), "--quiet", shim, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help="folder with compile_commands.json")
    parser.add_argument("files", nargs="*", help="only these")
    arguments = parser.parse_args()
    if not shutil.which(TIDY):
        print(f"{TIDY} is not installed: nothing was checked")
        return SKIPPED
    build = arguments.build.resolve()
    record = build / "tidy_passed.txt"
    passed = set(record.read_text().split()) if record.exists() else set()
    sources = sources_to_check(build, arguments.files)
    todo = [(path, key) for path, key in sources if key not in passed]
    complaints = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (path, key), output in zip(todo, pool.map(lambda item: tidy(item[0], build), todo)):
            print(f"tidy: {path.relative_to(ROOT)}{'' if not output else ' FAILED'}", flush=True)
            if output:
                print(output, flush=True)
                complaints += 1
            else:
                passed.add(key)
                record.write_text("\n".join(sorted(passed)))
    print(f"tidy: {len(sources)} sources, {len(sources) - len(todo)} as before, {complaints} with findings")
    return 1 if complaints or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
