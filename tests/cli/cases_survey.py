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
SMALL = "--set window=6 --set pose_frames=3 --set features=500"


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


def quaternion(row):
    """x y z w of the rotation in a line of poses.txt, by its largest component."""
    r = [row[0:3], row[4:7], row[8:11]]
    signs = ((1, -1, -1), (-1, 1, -1), (-1, -1, 1), (1, 1, 1))
    squares = [max(0.0, 1 + sum(s * r[i][i] for i, s in enumerate(sign))) / 4 for sign in signs]
    k = squares.index(max(squares))
    pairs = {(0, 1): r[0][1] + r[1][0], (0, 2): r[0][2] + r[2][0], (1, 2): r[1][2] + r[2][1],
             (0, 3): r[2][1] - r[1][2], (1, 3): r[0][2] - r[2][0], (2, 3): r[1][0] - r[0][1]}
    root = squares[k] ** 0.5
    return [root if i == k else pairs[min(i, k), max(i, k)] / (4 * root) for i in range(4)]


def as_tum(name, write):
    """The street's poses in TUM format; `write` makes a line of time, position and quaternion x y z w."""
    def make(root):
        lines = []
        for time_s, line in zip((root / "street/times.txt").read_text().split(), (root / "street/poses.txt").read_text().splitlines()):
            row = [float(x) for x in line.split()]
            lines.append(" ".join([time_s, *map(str, write(row[3::4], quaternion(row)))]))
        (root / name).write_text("\n".join(lines) + "\n")
    return make


def rotate(q, v):
    (x, y, z, w), (a, b, c) = q, v
    tx, ty, tz = 2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)
    return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx]


def inverse(t, q):
    back = [-q[0], -q[1], -q[2], q[3]]
    return [*(-x for x in rotate(back, t)), *back]


def colmap_map(root):
    cairn(root, "map", "street", "-o", "map", "--quiet", "--export", "colmap", *SMALL.split())


FILES = tuple(f"map/{name}" for name in ("Descriptor.bin", "Place.bin", "Point.bin", "config.yaml", "frames", "landmarks.ply", "landmarks.png", "map.json", "poses.txt",
                                         "report.json", "held_out.txt", "uvlist.txt", ".cairn"))


COLMAP_FILES = tuple(f"map/colmap/{name}.{form}" for name in ("cameras", "images", "points3D") for form in ("bin", "txt"))


def blank_in_a_name(root):
    for image in list((root / "street").glob("image_*/*.png")):
        image.rename(image.with_name("street " + image.name))


def out_of_range(setting, says):
    return Case(f"out of range: {setting}", f"map seq -o map --set {setting}", (says,), (SEQ,))


CASES = [
    # the command line
    Case("help", "map --help", code=0, prints=("Mapping with known poses", "MAP.unfinished", "pose_frames", "clean.duplicate_sigmas")),
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
    out_of_range("pose_frames=-1", "pose_frames: expected a number of frames from 0 (none), found -1"),
    out_of_range("max_frames=2", "max_frames: expected at least 3 frames, found 2"),
    out_of_range("epipolar_px=0", "epipolar_px: expected pixels above 0, found 0"),
    out_of_range("max_ratio=1.5", "max_ratio: expected a ratio from 0 (off) to 1, found 1.5"),
    out_of_range("min_view_change=-1", "min_view_change: expected radians from 0, found -1"),
    out_of_range("adjust.min_frames=1", "adjust.min_frames: expected at least 2 frames, found 1"),
    out_of_range("adjust.sigma_px=nan", "adjust.sigma_px"),
    out_of_range("clean.max_std_m=0", "clean.max_std_m: expected metres above 0, found 0"),
    out_of_range("clean.depth.max=-5", "clean.depth.max: expected metres from 0, found -5"),
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
    # poses against images
    Case("quaternions with qw first", "map street --poses p.txt -o map", ("p.txt: expected poses that move the camera as the images do", "qw qx qy qz", "px",
                                                                          "Write them in the order qx qy qz qw."),
         (street(), as_tum("p.txt", lambda t, q: [*t, q[3], *q[:3]]))),
    Case("inverse poses", "map street --poses p.txt -o map", ("p.txt: expected poses that", "camera_from_world", "Write world_from_camera"),
         (street(), as_tum("p.txt", inverse))),
    Case("right poses in TUM format", f"map street --poses p.txt -o map --quiet {SMALL}", given=(street(), as_tum("p.txt", lambda t, q: [*t, *q])), code=0,
         leaves=("map",), prints=("poses        TUM",)),
    # what it makes
    Case("a wall without texture", "map seq -o map --quiet", ("cairn map: not one landmark", "The images show no features"), (SEQ,), code=1, leaves=("map",)),
    Case("limits that no landmark holds", f"map street -o map --quiet {SMALL} --set clean.max_std_m=1e-9",
         ("cairn map: not one landmark", "fell to clean.max_std_m (1e-09 m"), (street(),), code=1, leaves=("map",)),
    Case("given poses", f"map street --poses street/poses.txt -o map --quiet {SMALL}", given=(street(),), code=0, leaves=("map",),
         prints=("frames       10 of 10 mapped", "poses        KITTI", "landmarks    ", "picture      map/landmarks.png")),
    Case("figures as JSON", f"map street -o map --json --quiet {SMALL}", given=(street(),), code=0, leaves=("map",),
         prints=('"mapped": 10', '"stopped": false', '"resumed_at": 0', '"landmarks": ', '"peak_memory_mb": ')),
    Case("a map of the same name is replaced", f"map street -o map --quiet {SMALL}", given=(street(), earlier_map), code=0, leaves=FILES),
    # models for other programs
    Case("a model for COLMAP", f"map street -o map --quiet --export colmap {SMALL}", given=(street(),), code=0, leaves=("map", *FILES, *COLMAP_FILES),
         prints=("colmap       map/colmap, with --image_path /",)),
    Case("names that COLMAP cannot read", f"map street -o map --quiet --export colmap {SMALL}",
         ("street/image_0/street 000000.png: expected names of images without blanks", "found 'image_0/street 000000.png'", "Rename the images"),
         (street(), blank_in_a_name)),
    Case("a model for another program", "map street -o map --export meshroom", ("--export",), (street(),)),
    Case("the map with its pictures and models is whole", "info map", given=(street(), colmap_map), code=0, prints=("keyframes", "landmarks")),
    Case("a picture of a drive without poses", "slam street -o run --quiet", given=(street(),), code=0, leaves=("run", "run/landmarks.png"),
         prints=("picture      run/landmarks.png",)),
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
