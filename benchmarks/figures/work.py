# SPDX-License-Identifier: Apache-2.0
"""Where experiments run: the program, the recordings, and a folder in which simulated sequences and maps are made once for all."""

import json
import os
import shutil
import subprocess
import time
from pathlib import Path

from results import Measured

CORES = 2  # "two cores of a server"
TIME_LIMIT_S = 1800
BUSY_SHARE = 0.05  # of the cores' time, taken by others: above it a time is not accepted


class Skipped(Exception):
    """What the experiment needs is not here."""


class Contradiction(Exception):
    """A sentence of the documents does not hold."""


def expect(holds, sentence):
    if not holds:
        raise Contradiction(f"does not hold any more: {sentence}")


def all_busy_seconds():
    """Of all cores since the machine started."""
    fields = list(map(int, Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:]))
    return (sum(fields[:3]) + sum(fields[5:8])) / os.sysconf("SC_CLK_TCK")


class Run:
    """A command that ended well: what it printed, and whether the machine had nothing else to do."""

    def __init__(self, output, errors, idle):
        self.output, self.errors, self.idle = output, errors, idle

    @property
    def report(self):
        return json.loads(self.output)

    def __getitem__(self, key):
        return self.report[key]

    def time(self, value):
        return Measured(value, "time", self.idle)

    def memory(self):
        return Measured(self["peak_memory_mb"], "memory")


class Work:
    def __init__(self, program, data, root):
        self.program, self.data, self.root = Path(program).resolve(), Path(data).resolve() if data else None, Path(root)
        self.folder = self.root / "shared"
        self.folder.mkdir(parents=True)
        self.made, self.commands = {}, []
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:CORES])

    def begin(self, name):
        """A new case of an experiment: an empty folder."""
        self.folder = self.root / name
        self.commands = []
        self.folder.mkdir()

    def end(self):
        shutil.rmtree(self.folder)

    def recording(self, name):
        folder = self.data / name if self.data else None
        if not folder or not folder.is_dir():
            raise Skipped(f"there is no recording {name} in {self.data} (--data)")
        return folder

    def measure(self, *command, folder=None):
        """Any command, in the folder of the case."""
        command = list(map(str, command))
        busy, begin = all_busy_seconds(), time.monotonic()
        with subprocess.Popen(command, cwd=folder or self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
            before = os.times()
            try:
                output, errors = child.communicate(timeout=TIME_LIMIT_S)
            except subprocess.TimeoutExpired as error:
                child.kill()
                raise RuntimeError(f"took more than {TIME_LIMIT_S} s: {' '.join(command)}") from error
        after, wall = os.times(), time.monotonic() - begin
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        if child.returncode not in (0, 1):
            raise RuntimeError(f"{' '.join(command)}\n{output[-2000:]}{errors[-2000:]}")
        others = all_busy_seconds() - busy - cpu
        return Run(output, errors, others < BUSY_SHARE * CORES * wall + 0.05)

    def cairn(self, *arguments, folder=None):
        words = [str(word) for word in arguments]
        said = " ".join(words)
        for place, name in ((self.data, "DATA"), (self.root, "WORK")):
            said = said.replace(str(place), name) if place else said
        self.commands.append(f"cairn {said}")
        return self.measure(self.program, *words, "--json", folder=folder)

    def once(self, name, make):
        """A folder that several experiments want: `make(path)` fills it if it is not there."""
        if name not in self.made:
            path = self.root / "shared" / str(len(self.made))
            self.made[name] = (path, make(path))
        return self.made[name]

    def simulate(self, kind, *options):
        """A simulated sequence, made once however many experiments want it."""
        return self.once(("simulate", kind, *map(str, options)), lambda path: self.cairn("simulate", kind, "-o", path, *options))[0]

    def draw(self, kind, *options):
        """A large one, which goes with the case."""
        self.cairn("simulate", kind, "-o", "drawn", *options)
        return self.folder / "drawn"

    def map(self, recording, *options):
        """A map of `cairn map`, made once, and the run that made it."""
        return self.once(("map", str(recording), *map(str, options)), lambda path: self.cairn("map", recording, *options, "-o", path))

    def slam(self, sequence, *options, output="run"):
        """Trajectory and landmark map alone."""
        return self.cairn("slam", sequence, "-o", output, "--no-cloud", "--no-octree", *options)

    def evaluate(self, estimate, sequence, *options):
        return self.cairn("evaluate", estimate, sequence, *options).report
