# SPDX-License-Identifier: Apache-2.0
"""What the quality tests share: running the program, reading its figures, and finding the recordings."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TIME_LIMIT_S = 600
SKIPPED = 77  # ctest's SKIP_RETURN_CODE
DRAWN = {}  # what was simulated, by the arguments: temporary folders


def recordings():
    """The folder of recordings, or the end of this test: skipped, and a failure where they are required."""
    folder = Path(sys.argv[2])
    if folder.is_dir():
        return folder
    required = os.environ.get("CAIRN_REQUIRE_DATA")
    print(f"{'FAILED' if required else 'SKIPPED'}: there are no recordings in {folder} (CMake's CAIRN_DATA_DIR)")
    sys.exit(1 if required else SKIPPED)


def processor_seconds(pid):
    """How long a process that still runs has worked, however busy the machine is with others."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Quality(unittest.TestCase):
    """Each test has a folder of its own, `self.folder`."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_cairn(self, *arguments, code=0, environment=None):
        """Runs a command in the test's folder. `environment`: variables set for it."""
        done = subprocess.run([Path(sys.argv[1]).resolve(), *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False,
                              env={**os.environ, **(environment or {})})
        self.assertEqual(done.returncode, code, f"cairn {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done

    def cairn(self, *arguments, code=0, environment=None):
        """The same; what it printed to stdout."""
        return self.run_cairn(*arguments, code=code, environment=environment).stdout

    def simulate(self, kind, name, *options):
        """Makes a simulated sequence, drawn once however many tests of this process want it: each has a copy of its own."""
        key = (kind, *map(str, options))
        if key not in DRAWN:
            folder = tempfile.TemporaryDirectory()
            unittest.addModuleCleanup(folder.cleanup)
            self.cairn("simulate", kind, "-o", Path(folder.name) / "drawn", *options, "--quiet")
            DRAWN[key] = folder
        shutil.copytree(Path(DRAWN[key].name) / "drawn", self.folder / name)

    def complaints(self, *arguments, code=0):
        """The same; what it printed to stderr."""
        return self.run_cairn(*arguments, code=code).stderr

    def figures(self, *arguments):
        return json.loads(self.cairn(*arguments, "--json"))

    def assert_same_files(self, a, b, but=()):
        """Two result folders hold the same bytes, but for the files named."""
        contents = [{str(path.relative_to(root)): path.read_bytes() for path in sorted(root.rglob("*"))
                     if path.is_file() and path.name not in but} for root in (self.folder / a, self.folder / b)]
        self.assertEqual(contents[0].keys(), contents[1].keys())
        different = [name for name in contents[0] if contents[0][name] != contents[1][name]]
        self.assertEqual(different, [])


def main():
    unittest.main(argv=sys.argv[:1], verbosity=2)
