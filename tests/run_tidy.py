#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy-14 over our sources, as many at once as there are cores.

Most of clang-tidy's time goes into the headers of the libraries, so sources are checked in batches: one translation unit
includes several of them and reads the headers once (467 sources in batches: a sixth of the time). Sources and headers
that give one name two meanings never share a batch; a batch with findings is checked again in halves, down to the source
that has them. A source that passed is passed over until it, one of our headers, .clang-tidy or the compile command
changes.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from sources import FOLDERS, ROOT, SKIPPED, cpp_files, includes_of

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
    states, flags = {}, {}  # kernels are compiled several times: one path, several commands
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"]).resolve()
        if path.is_relative_to(build) or not path.is_relative_to(root) or path.relative_to(root).parts[0] not in FOLDERS:
            continue
        if wanted and path not in wanted:
            continue
        state = states.setdefault(path, common.copy())
        state.update(entry["command"].encode() + path.read_bytes())
        flags.setdefault(path, []).append(flags_of(entry))
    return {path: (states[path].hexdigest(), flags[path]) for path in sorted(states)}


TYPES = {"class", "struct", "enum", "union", "typedef"}


def names_outside_classes(paths):
    """{path: {name: whether it is a type}} of what each file defines in a namespace or as a macro, by ctags."""
    command = ["ctags", "-x", "--languages=C++", "--kinds-C++=cdefgstuvx", "--_xformat=%F\t%K\t%{scopeKind}\t%N", "-L", "-"]
    listed = subprocess.run(command, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True).stdout
    names = {path: {} for path in paths}
    for line in listed.splitlines():
        path, kind, scope, name = line.split("\t")
        if scope in ("", "-", "namespace") and not name.startswith(("__anon", "TEST")):  # members have the class as scope
            names[Path(path)][name] = kind in TYPES
    for path in paths:  # GoogleTest's macros define a class of this name
        names[path].update(dict.fromkeys(re.findall(r"^TEST(?:_[FP])?\((\w+, *\w+)\)", path.read_text(), re.MULTILINE), True))
    return names


class Batch:
    """Sources with the same flags that compile as one translation unit: no name has two meanings."""

    def __init__(self, flags, names):
        self.flags, self.names = flags, names
        self.headers = {}  # of each source: our headers that it includes, directly or not

    def takes(self, source, headers):
        if len(self.headers) >= MAX_BATCH:
            return False
        together = set().union(*self.headers.values())
        return (all(self.agree(source, headers, other, others) for other, others in self.headers.items()) and
                not self.types_of(headers - together) & self.types_of(together - headers))

    def agree(self, a, headers_a, b, headers_b):
        """A name of one source is none of the other's, nor of a header that only the other includes."""
        names_a, names_b = self.names[a].keys(), self.names[b].keys()
        return (names_a.isdisjoint(names_b) and names_a.isdisjoint(self.names_of(headers_b - headers_a)) and
                names_b.isdisjoint(self.names_of(headers_a - headers_b)))

    def names_of(self, headers):
        return set().union(*(self.names[header].keys() for header in headers))

    def types_of(self, headers):
        return {name for header in headers for name, is_type in self.names[header].items() if is_type}


def make_batches(sources, root):
    """Batches with each source once for each of its compile commands, in the first one that takes it; large ones first."""
    @functools.cache
    def headers_of(path):
        ours = includes_of(path, root)[1]
        return frozenset(ours).union(*map(headers_of, ours))

    names = names_outside_classes({*sources, *(header for path in sources for header in headers_of(path))})
    batches = []
    for path, (_, all_flags) in sources.items():
        for flags in all_flags:
            batch = next((one for one in batches if one.flags == flags and one.takes(path, headers_of(path))), None)
            if not batch:
                batch = Batch(flags, names)
                batches.append(batch)
            batch.headers[path] = headers_of(path)
    return sorted(((batch.flags, list(batch.headers)) for batch in batches), key=lambda batch: -len(batch[1]))


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
    pending = {path: len(flags) for path, (_, flags) in sources.items()}  # one result for each compile command
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = [pool.submit(tidy_batch, folder / str(number), *batch, root)
                for number, batch in enumerate(make_batches(sources, root))]
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
