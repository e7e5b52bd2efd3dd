#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mapping with known poses (cairn map): bad input, and going on after a crash."""

import json
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from harness import Case, CommandLine, main
from inputs import file, kitti_sequence, trajectory_text, tum_sequence, without

SEQ = tum_sequence()
KITTI = kitti_sequence()
SMALL = "--set window=6 --set smooth_frames=3 --set features=500"


def cairn(place, *arguments):
    return subprocess.run([CommandLine.program, *arguments], cwd=place, check=True, capture_output=True, text=True)


def street(name="street", frames=10):
    """A simulated drive of a small stereo camera, with its truth."""
    def make(root):
        cairn(root, "simulate", "street", "-o", name, "--frames-count", str(frames), "--scale", "0.25", "--quiet")
    return make


def one_camera(root):
    KITTI(root)
    shutil.rmtree(root / "seq/image_1")


def earlier_map(root):
    file("map/.cairn", "map: written by an earlier cairn\n")(root)
    file("map/uvlist.txt", "of an earlier run")(root)


FILES = tuple(f"map/{name}" for name in ("Descriptor.bin", "Place.bin", "Point.bin", "config.yaml", "frames", "landmarks.ply", "map.json", "poses.txt", "report.json",
                                         "uvlist.txt", ".cairn"))


def out_of_range(setting, says):
    return Case(f"out of range: {setting}", f"map seq -o map --set {setting}", (says,), (SEQ,))


CASES = [
    # the command line
    Case("help", "map --help", code=0, prints=("Mapping with known poses", "MAP.unfinished", "smooth_frames", "clean.duplicate_sigmas")),
    Case("no arguments", "map", ("cairn map", "SEQ is required")),
    Case("no output", "map seq", ("--output is required",), (SEQ,)),
    Case("unknown option", "map seq -o map --sped 3", ("--sped",), (SEQ,)),
    Case("negative threads", "map seq -o map --threads -1", ("--threads",), (SEQ,)),
    Case("negative gap", "map seq -o map --pose-gap -1", ("--pose-gap",), (SEQ,)),
    Case("unknown parameter", "map seq -o map --set windw=3", ("windw",), (SEQ,)),
    Case("parameter without value", "map seq -o map --set window", ("--set",), (SEQ,)),
    Case("parameter that is no number", "map seq -o map --set window=many", ("window", "found 'many'"), (SEQ,)),
    Case("no such parameter file", "map seq -o map --config c.yaml", ("c.yaml: expected a readable file",), (SEQ,)),
    out_of_range("window=1", "window: expected at least 2 frames, found 1"),
    out_of_range("smooth_frames=20", "smooth_frames: expected a number of frames from 0, less than the window, found 20"),
    out_of_range("max_frames=2", "max_frames: expected at least 3 frames, found 2"),
    out_of_range("epipolar_px=0", "epipolar_px: expected pixels above 0, found 0"),
    out_of_range("max_ratio=1.5", "max_ratio: expected a ratio from 0 (off) to 1, found 1.5"),
    out_of_range("min_view_change=-1", "min_view_change: expected radians from 0, found -1"),
    out_of_range("adjust.min_frames=1", "adjust.min_frames: expected at least 2 frames, found 1"),
    out_of_range("adjust.sigma_px=nan", "adjust.sigma_px"),
    out_of_range("clean.max_std_m=0", "clean.max_std_m: expected metres above 0, found 0"),
    out_of_range("clean.depth.max=-5", "clean.depth.max: expected a number from 0, found -5"),
    out_of_range("clean.duplicate_sigmas=-1", "clean.duplicate_sigmas: expected standard deviations from 0, found -1"),
    # the sequence
    Case("no such sequence", "map seq -o map", ("seq: expected",)),
    Case("one camera", "map seq --poses p.txt -o map", ("seq/image_1: expected a folder with the images of one camera, found none",),
         (one_camera, file("p.txt", trajectory_text(["0", "1"])))),
    Case("not one readable image", "map seq -o map", ("rgb/0.png: expected a PNG", "none of 3 frames can be read"),
         (SEQ, *(file(f"seq/rgb/{i}.png", "no image") for i in range(3)))),
    Case("one image that cannot be read", "map seq -o map", ("rgb/1.png",), (SEQ, file("seq/rgb/1.png", "no image")), code=1, leaves=("map",)),
    # the poses
    Case("sequence without poses", "map seq -o map", ("seq: expected poses, found a sequence that carries none", "--poses FILE"),
         (SEQ, without("seq/groundtruth.txt"))),
    Case("stereo without poses", "map seq -o map", ("Give --poses FILE",), (KITTI,)),
    Case("no such poses", "map seq --poses p.txt -o map", ("p.txt: expected a readable file",), (SEQ,)),
    Case("poses of another recording", "map seq --poses p.txt -o map", ("p.txt: expected poses within", "share its clock"),
         (SEQ, file("p.txt", trajectory_text(["900.0", "900.1"])))),
    Case("poses with 7 numbers", "map seq --poses p.txt -o map", ("p.txt:1: expected 8 values", "found 7"), (SEQ, file("p.txt", "1 0 0 0 0 0 1\n"))),
    # the output
    Case("output that is not ours", "map seq -o thesis", ("thesis: expected a new or empty folder, or a map that cairn wrote", "nothing in it was touched"),
         (SEQ, file("thesis/thesis.tex", "years of work"))),
    Case("output that is a file", "map seq -o thesis.tex", ("thesis.tex: expected a folder to write to, found a file",), (SEQ, file("thesis.tex", "years"))),
    Case("output that is the sequence", "map seq -o seq", ("seq: expected a new or empty folder",), (SEQ,)),
    Case("unfinished folder that is not ours", "map seq -o map", ("map.unfinished: expected a new or empty folder", "nothing in it was touched"),
         (SEQ, file("map.unfinished/thesis.tex", "years of work"))),
    Case("disk full", "map seq -o map", ("map.unfinished",), (SEQ,), file_limit=100),
    # what it makes
    Case("a wall without texture", "map seq -o map --quiet", ("cairn map: not one landmark", "--pose-offset"), (SEQ,), code=1, leaves=("map",)),
    Case("given poses", f"map street --poses street/poses.txt -o map --quiet {SMALL}", given=(street(),), code=0, leaves=("map",),
         prints=("frames       10 of 10 mapped", "poses        KITTI", "landmarks    ")),
    Case("figures as JSON", f"map street -o map --json --quiet {SMALL}", given=(street(),), code=0, leaves=("map",),
         prints=('"mapped": 10', '"stopped": false', '"resumed_at": 0', '"landmarks": ', '"peak_memory_mb": ')),
    Case("a map of the same name is replaced", f"map street -o map --quiet {SMALL}", given=(street(), earlier_map), code=0, leaves=FILES),
]


class Resume(unittest.TestCase):
    """A run that is killed goes on where it was, and its map has the bytes of one that was not."""

    FRAMES = 60

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        street(frames=self.FRAMES)(self.folder)

    def command(self, output):
        return ["map", "street", "-o", output, "--quiet", "--json", *SMALL.split()]

    def frames_done(self):
        return sum(1 for _ in (self.folder / "map.unfinished" / "frames").glob("*.sift"))

    def end_with(self, signal_number):
        """Runs the command and sends it a signal when it has written a frame; the finished process and its stderr."""
        before = self.frames_done()
        run = subprocess.Popen([CommandLine.program, *self.command("map")], cwd=self.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        while run.poll() is None and self.frames_done() <= before:
            time.sleep(0.005)
        run.send_signal(signal_number)
        return run, run.communicate()[1]

    def test_after_an_interrupt_and_a_kill(self):
        cairn(self.folder, *self.command("whole"))
        run, said = self.end_with(signal.SIGINT)
        self.assertEqual(run.returncode, 1, said)
        self.assertIn("The same command goes on from there.", said)
        run, said = self.end_with(signal.SIGKILL)
        self.assertEqual(run.returncode, -signal.SIGKILL, said)
        self.assertFalse((self.folder / "map").exists())
        resumed = json.loads(cairn(self.folder, *self.command("map")).stdout)
        self.assertGreater(resumed["resumed_at"], 0)
        self.assertLess(resumed["resumed_at"], self.FRAMES)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["map", "street", "whole"])
        self.assert_same_files("whole", "map")

    def test_after_a_kill_before_anything_was_kept(self):
        cairn(self.folder, *self.command("whole"))
        run, said = self.end_with(signal.SIGKILL)
        self.assertEqual(run.returncode, -signal.SIGKILL, said)
        cairn(self.folder, *self.command("map"))
        self.assert_same_files("whole", "map")

    def assert_same_files(self, a, b):
        contents = [{str(path.relative_to(root)): path.read_bytes() for path in root.rglob("*") if path.is_file()}
                    for root in (self.folder / a, self.folder / b)]
        self.assertEqual(contents[0].keys(), contents[1].keys())
        self.assertEqual([name for name in contents[0] if contents[0][name] != contents[1][name]], [])


if __name__ == "__main__":
    main(CASES, (Resume,))
