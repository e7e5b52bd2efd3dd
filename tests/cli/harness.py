# SPDX-License-Identifier: Apache-2.0
"""Runs rows of a table: the program with some arguments in a folder of its own, and what it then has to say and leave.

A row is a Case. Add rows to one of the cases_*.py files, or a file of that name, which ctest then needs to know
(tests/CMakeLists.txt). Inputs are made by the functions of inputs.py.
"""

import argparse
import dataclasses
import os
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TIME_LIMIT_S = 120


@dataclasses.dataclass
class Case:
    """One row. `given` are functions of a folder that make input in it; `run` is the command line without 'cairn',
    split at blanks; each text of `says` must be in what the program prints to stderr."""

    name: str
    run: str
    says: tuple = ()
    given: tuple = ()
    code: int = 2
    prints: tuple = ()  # to stdout
    leaves: tuple = ()  # paths that must be new afterwards; anything else new or changed is an error
    messages: int = 1  # how many, where the code is 2: more only where frames are reported and skipped before
    environment: dict = dataclasses.field(default_factory=dict)  # variables set for the program
    file_limit: int = 0  # bytes that a file can grow to, as on a full disk; 0: no limit


def contents_of(folder):
    """Path to bytes of everything below, folders as None."""
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
            for path in sorted(folder.rglob("*")) if not path.is_symlink() or path.exists()}


def limit_files(size):
    """What the child process does before the program begins: writes beyond `size` bytes fail instead of killing."""
    def prepare():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return prepare if size else None


def start(program, case, folder):
    environment = dict(os.environ, LC_ALL="C", **case.environment)
    return subprocess.run([program, *case.run.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=TIME_LIMIT_S, check=False, env=environment,
                          preexec_fn=limit_files(case.file_limit))


class CommandLine(unittest.TestCase):
    program = ""
    maxDiff = None

    def check(self, case):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for make in case.given:
                make(folder)
            before = contents_of(folder)
            done = start(self.program, case, folder)
            output = f"cairn {case.run}\nexit code {done.returncode}\n{done.stdout}{done.stderr}"
            self.assertEqual(done.returncode, case.code, output)
            self.check_text(case, done, output)
            self.check_files(case, before, contents_of(folder), output)

    def check_text(self, case, done, output):
        for text in case.says:
            self.assertIn(text, done.stderr, output)
        for text in case.prints:
            self.assertIn(text, done.stdout, output)
        if case.code == 2:
            self.assertEqual(done.stdout, "", output)
            messages = [line for line in done.stderr.splitlines() if line.startswith("cairn")]
            self.assertEqual(len(messages), case.messages, f"number of messages\n{output}")
            self.assertLessEqual(len(done.stderr.splitlines()), 3 * case.messages, f"expected short messages\n{output}")

    def check_files(self, case, before, after, output):
        changed = {path for path in before | after if before.get(path, "") != after.get(path, "")}
        wanted = set(case.leaves)
        allowed = {path for path in changed if any(Path(path).is_relative_to(place) for place in wanted)}
        self.assertEqual(changed - allowed, set(), f"left behind or changed\n{output}")
        self.assertEqual(wanted - changed, set(), f"not written\n{output}")


def main(cases, others=()):
    """Runs all rows and the tests of the TestCases `others`, or those whose names contain one of the words given after
    the program."""
    parser = argparse.ArgumentParser()
    parser.add_argument("program", help="path of the cairn to test")
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_args()
    CommandLine.program = str(Path(arguments.program).resolve())
    suite = unittest.TestSuite()
    def is_wanted(name):
        return not arguments.words or any(word in name for word in arguments.words)
    for other in others:
        suite.addTests(other(name) for name in unittest.defaultTestLoader.getTestCaseNames(other) if is_wanted(name))
    for case in cases:
        if is_wanted(case.name):
            setattr(CommandLine, case.name, lambda self, case=case: self.check(case))
            suite.addTest(CommandLine(case.name))
    if len({case.name for case in cases}) < len(cases):
        sys.exit("two cases have the same name")
    result = unittest.TextTestRunner(verbosity=1).run(suite)
    sys.exit(0 if result.wasSuccessful() and result.testsRun > 0 else 1)
