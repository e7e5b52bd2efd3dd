#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what README.md and docs/ claim, and writes it there.

    run.py --check-text                     do the documents say what results.json says? Runs nothing
    run.py --mend                           write the figures of results.json into the documents
    run.py --program build/release/cairn    measure all, and compare with results.json
        [NAME ...]    only experiments whose names begin so
        [--ci]        only the first case of those that take seconds, as the tests do
        [--update]    keep what was measured in results.json, and write the documents
        [--data DIR]  the recordings

Ends with 1 where something differs by more than the spread of its runs and one unit of the last digit that is shown. Times and
memory are not compared, and times are kept only where the machine did nothing else."""

import argparse
import os
import subprocess
import sys
import tempfile
import time
import traceback
from pathlib import Path

from experiments import load_all
from results import Store, collect, summarize
from texts import Documents, TextError, show, step
from work import Contradiction, Skipped, Work

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ("src", "apps", "cmake", "CMakeLists.txt")
SKIPPED = 77  # ctest's SKIP_RETURN_CODE


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=True).stdout.strip()


def commit_of_sources():
    """The last one that changed the program. Whoever updates figures has committed what is measured."""
    if git("status", "--porcelain", "--", *SOURCES):
        raise SystemExit("figures: the sources differ from their commit; commit first, so that figures can say of which one they are")
    return git("log", "-1", "--format=%h", "--abbrev=7", "--", *SOURCES)


def finest_steps(documents):
    """By figure: what the last digit stands for where it is shown with most."""
    steps = {}
    for use in documents.all_uses():
        figure = documents.renderer.store.figures.get(use.name)
        if figure:
            unit = step(figure.value, use.layout)
            steps[use.name] = min(unit, steps.get(use.name, unit))
    return steps


def verdict(kept, found, unit=0):
    """What differs, in a word; nothing where figures agree."""
    if found is None:
        return "not kept: the machine was busy"
    if kept is None:
        return "new"
    if kept.kind != "result":
        return ""
    margin = unit * (1 + 1e-9)
    return "" if kept.low - margin <= found.low and found.high <= kept.high + margin else "DIFFERS"


class Session:
    def __init__(self, arguments, work, documents):
        self.arguments, self.work, self.documents = arguments, work, documents
        self.store = documents.renderer.store
        self.shown = {use.name for use in self.documents.all_uses()}
        self.steps = finest_steps(self.documents)
        self.commit = commit_of_sources() if arguments.update else "now"
        self.failed, self.differing, self.skipped = [], [], []

    def run(self, experiment):
        begin = time.monotonic()
        cases, commands = [], None
        for i, case in enumerate(experiment.cases[:1] if self.arguments.ci else experiment.cases):
            self.work.begin(f"{experiment.name}-{i}")
            cases.append(experiment.measure(self.work, case))
            commands = commands or self.work.commands
            self.work.end()
        found = {name: summarize(numbers, self.commit) for name, numbers in collect(cases).items() if f"{experiment.name}.{name}" in self.shown}
        seconds = time.monotonic() - begin
        print(f"{experiment.name}: {len(cases)} of {len(experiment.cases)} cases, {seconds:.0f} s", flush=True)
        self.compare(experiment.name, found)
        if self.arguments.update:
            self.store.replace(experiment.name, found, cases=experiment.cases, seconds=round(seconds), commands=commands)
            self.store.write()  # what is done is done, whatever comes

    def compare(self, experiment, found):
        for name, figure in found.items():
            name = f"{experiment}.{name}"
            kept = self.store.figures.get(name)
            said = verdict(kept, figure, self.steps.get(name, 0))
            if said == "DIFFERS":
                self.differing.append(name)
            numbers = " ".join(describe(one) for one in (kept, figure))
            print(f"  {name:44} {numbers} {said}".rstrip(), flush=True)

    def run_all(self, experiments):
        for experiment in experiments:
            try:
                self.run(experiment)
            except Skipped as reason:
                self.skipped.append(experiment.name)
                print(f"{experiment.name}: SKIPPED: {reason}", flush=True)
            except Exception as reason:  # the others are measured all the same  pylint: disable=broad-exception-caught
                self.failed.append(experiment.name)
                print(f"{experiment.name}: FAILED: {reason}", flush=True)
                if not isinstance(reason, Contradiction):
                    traceback.print_exc()

    def conclude(self):
        if self.arguments.update:
            for name in self.documents.mend():
                print(f"figures: wrote {name}")
        if self.differing and not self.arguments.update:
            print(f"figures: {len(self.differing)} differ from what the documents say: {', '.join(self.differing)}\n"
                  "  If that is meant: ./do figures --update")
        for names, what in ((self.failed, "failed"), (self.skipped, "skipped")):
            if names:
                print(f"figures: {what}: {', '.join(names)}")
        if self.failed or (self.differing and not self.arguments.update):
            return 1
        if self.skipped and self.arguments.ci:
            return 1 if os.environ.get("CAIRN_REQUIRE_DATA") else SKIPPED
        return 0


def describe(figure):
    if figure is None:
        return f"{'-':>24}"
    spread = f" [{show(figure.low, 's3')}, {show(figure.high, 's3')}]" if figure.of > 1 else ""
    return f"{show(figure.value, 's3') + spread:>24}"


def chosen(arguments):
    names = arguments.names or [""]
    experiments = [one for one in load_all().values() if any(one.name.startswith(name) for name in names)]
    return [one for one in experiments if one.ci] if arguments.ci else experiments


def check_text(documents):
    said = documents.complaints(load_all().keys())
    for one in said:
        print(one)
    print(f"figures: {len(said)} complaints" + ("; run.py --mend writes the figures of results.json into the documents" if said else ""))
    return 1 if said else 0


def measure(arguments):
    experiments = chosen(arguments)
    if not experiments:
        raise SystemExit(f"figures: no experiment is called so. There are: {', '.join(load_all())}")
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="cairn_figures_", dir=arguments.scratch) as root:
        session = Session(arguments, Work(arguments.program, arguments.data, root), Documents(Store()))
        session.run_all(experiments)
    cpu = sum(os.times()[2:4])
    print(f"figures: {len(experiments)} experiments in {time.monotonic() - begin:.0f} s, {cpu:.0f} s of processors")
    return session.conclude()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--program", type=Path)
    parser.add_argument("--data", type=Path, default=ROOT.parent / "shared/data")
    parser.add_argument("--scratch", type=Path, help="where a temporary folder of some gigabytes is made")
    for flag in ("--check-text", "--mend", "--ci", "--update", "--list"):
        parser.add_argument(flag, action="store_true")
    arguments = parser.parse_args()
    try:
        if arguments.list:
            print("\n".join(one.name for one in chosen(arguments)))
            return 0
        if arguments.check_text:
            return check_text(Documents(Store()))
        if arguments.mend:
            print("\n".join(Documents(Store()).mend()))
            return 0
        if not arguments.program:
            parser.error("--program, --check-text, --mend or --list is needed")
        return measure(arguments)
    except TextError as error:
        raise SystemExit(f"figures: {error}") from error


if __name__ == "__main__":
    sys.exit(main())
