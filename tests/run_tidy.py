#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy-14 over our sources, as many at once as there are cores.

Most of clang-tidy's time goes into the headers of the libraries, so sources are checked in batches: one translation unit
includes several of them and reads the headers once (467 sources in batches: a sixth of the time; batches.py). A batch
with findings is checked again in halves, down to the source that has them. A source that passed is passed over until it, one of our headers, .clang-tidy or the compile command
changes.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from batches import make_batches
from shared_flags import share_flags
from sources import FOLDERS, ROOT, SKIPPED, cpp_files

TIDY = "clang-tidy-14"  # pinned: other versions have other checks
MAX_BATCH = 32  # sources: more save little, and the last batch would keep one core waiting


def common_hash(root):
    """Of everything that reaches every source: our headers and the rules."""
    state = hashlib.sha256()
    for path in [root / ".clang-tidy", *cpp_files(root, suffixes=(".h",))]:
        state.update(str(path).encode() + b"\0" + path.read_bytes())
    return state


def flags_of(entry):
    """The words of a compile command that say how, not what: neither the source nor the object."""
    words = entry["command"].split()
    skipped = {words.index("-o"), words.index("-o") + 1, words.index("-c"), words.index("-c") + 1}
    return " ".join(word for number, word in enumerate(words) if number not in skipped)


def sources_to_check(root, build, chosen):
    """{path: (hash, flags of each compile command)} of our sources in the compilation database."""
    common = common_hash(root)
    wanted = {Path(name).resolve() for name in chosen}
    flags = {}  # kernels are compiled several times: one path, several commands
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"]).resolve()
        if path.is_relative_to(build) or not path.is_relative_to(root) or path.relative_to(root).parts[0] not in FOLDERS:
            continue
        if wanted and path not in wanted:
            continue
        flags.setdefault(path, []).append(flags_of(entry))
    shared = share_flags({path: flags[path] for path in sorted(flags)}, root)
    return {path: (hash_of(path, all_flags, common), all_flags) for path, all_flags in shared.items()}


def hash_of(path, all_flags, common):
    state = common.copy()
    state.update("\0".join(all_flags).encode() + path.read_bytes())
    return state.hexdigest()


def write_batch(folder, flags, paths):
    """A source that includes `paths`, and the compilation database for it alone. Returns the source."""
    folder.mkdir(parents=True)
    source = folder / "batch.cpp"
    source.write_text("".join(f'#include "{path}"  // NOLINT(bugprone-suspicious-include)\n' for path in paths))
    entry = {"directory": str(folder), "file": str(source), "command": f"{flags} -o batch.o -c {source}"}
    (folder / "compile_commands.json").write_text(json.dumps([entry]))
    return source


def tidy(source, database, root):
    """What clang-tidy says of one translation unit; nothing where it is content."""
    command = [TIDY, "-p", str(database), "--quiet", f"--config-file={root / '.clang-tidy'}",
               f"--header-filter=^{re.escape(str(root))}/({'|'.join(FOLDERS)})/",
               f"--extra-arg-before=-include{ROOT / 'tests' / 'tidy_shim.h'}", str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def tidy_batch(folder, flags, paths, root):
    """[(path, findings)] of a batch; one with findings is checked again in halves."""
    findings = tidy(write_batch(folder, flags, paths), folder, root)
    if not findings or len(paths) == 1:
        return [(path, findings) for path in paths]
    middle = len(paths) // 2
    return [*tidy_batch(folder / "a", flags, paths[:middle], root),
            *tidy_batch(folder / "b", flags, paths[middle:], root)]


def check(sources, build, root, passed_now):
    """Checks the sources, prints what is found and calls `passed_now` with each that is clean. Returns {path: findings}."""
    folder = build / "tidy_batches"
    shutil.rmtree(folder, ignore_errors=True)
    findings = {}
    batches = make_batches({path: flags for path, (_, flags) in sources.items()}, root, MAX_BATCH)
    pending = {path: len(flags) for path, (_, flags) in sources.items()}  # one result for each compile command
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = [pool.submit(tidy_batch, folder / str(number), *batch, root)
                for number, batch in enumerate(batches)]
        for run in concurrent.futures.as_completed(runs):
            for path, output in run.result():
                findings[path] = findings.get(path, "") + output
                pending[path] -= 1
                print(f"tidy: {path.relative_to(root)}{'' if not output else ' FAILED'}", flush=True)
                if output:
                    print(output, flush=True)
            passed_now([path for path, _ in run.result() if pending[path] == 0 and not findings[path]])
    return findings


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, required=True, help="folder with compile_commands.json")
    parser.add_argument("--root", type=Path, default=ROOT)
    parser.add_argument("files", nargs="*", help="only these")
    arguments = parser.parse_args()
    missing = [tool for tool in (TIDY, "ctags") if not shutil.which(tool)]
    if missing:
        print(f"not installed: {' '.join(missing)}; nothing was checked")
        return SKIPPED
    build, root = arguments.build.resolve(), arguments.root.resolve()
    record = build / "tidy_passed.txt"
    passed = set(record.read_text().split()) if record.exists() else set()
    sources = sources_to_check(root, build, arguments.files)
    todo = {path: source for path, source in sources.items() if source[0] not in passed}

    def passed_now(paths):
        passed.update(todo[path][0] for path in paths)
        record.write_text("\n".join(sorted(passed)))

    findings = check(todo, build, root, passed_now)
    bad = sum(1 for output in findings.values() if output)
    print(f"tidy: {len(sources)} sources, {len(sources) - len(todo)} as before, {bad} with findings")
    return 1 if bad or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
