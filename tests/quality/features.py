#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Features and matches: the same bytes on every instruction set and at any number of threads. Arguments: the program."""

import re
import subprocess
import sys
from pathlib import Path

import program


def instruction_sets(image):
    """Those that this processor has, from the message about one that none has."""
    done = subprocess.run([Path(sys.argv[1]).resolve(), "features", image], capture_output=True, text=True, check=False,
                          env={"CAIRN_SIMD": "none"})
    listed = re.search(r"one of ([^\n]*), found", done.stderr)
    return listed.group(1).split(", ") if listed else []


class SameBytes(program.Quality):
    def setUp(self):
        super().setUp()
        self.cairn("simulate", "room", "-o", "room", "--frames-count", "12", "--scale", "0.5", "--quiet")
        self.first, self.second = sorted((self.folder / "room/rgb").iterdir())[0:8:7]

    def lists(self, method, threads, instructions):
        """Keypoints of one view and matches with the other, as bytes."""
        environment = {"CAIRN_SIMD": instructions} if instructions else {}
        common = ("--method", method, "--threads", threads)
        self.cairn("features", self.first, "--output", "k.csv", *common, environment=environment)
        self.cairn("match", self.first, self.second, "--output", "m.csv", *common, environment=environment)
        return (self.folder / "k.csv").read_bytes(), (self.folder / "m.csv").read_bytes()

    def test_features_and_matches(self):
        self.assertIn("plain", instruction_sets(self.first))
        for method in ("orb", "sift"):
            expected = self.lists(method, 1, "plain")
            self.assertGreater(expected[1].count(b"\n"), 50)
            for threads in (2, 3):
                self.assertEqual(self.lists(method, threads, None), expected, f"{method} on {threads} threads")
            for name in instruction_sets(self.first):
                self.assertEqual(self.lists(method, 1, name), expected, f"{method} with {name}")

    def test_slam(self):
        self.cairn("slam", "room", "-o", "best", "--quiet")
        self.cairn("slam", "room", "-o", "plain", "--quiet", environment={"CAIRN_SIMD": "plain"})
        self.assert_same_files("best", "plain", but=("run.json",))


if __name__ == "__main__":
    program.main()
