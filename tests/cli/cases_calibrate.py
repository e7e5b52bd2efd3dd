#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cairn calibrate: what it refuses before any work, what it says of recordings that show nothing, and what it writes."""

import functools
import subprocess
import tempfile
from pathlib import Path

from harness import Case, CommandLine, main
from inputs import CAMERA, file, folder, kitti_sequence, replaced, trajectory, tum_sequence

CORRECTION = "\n  correction: {rows: [0.1, 0, 0, -7, 0, 0.5], disparity: [-0.5, 0, -1]}"
RIGHT = CAMERA.splitlines()[0] + "\nright:\n  baseline: 0.1"


@functools.lru_cache(maxsize=None)
def simulated(*options):
    """The files of a small street, made once."""
    with tempfile.TemporaryDirectory() as name:
        subprocess.run([CommandLine.program, "simulate", "street", "-o", "street", "--scale", "0.25", "--quiet", *options], cwd=name, check=True,
                       capture_output=True)
        return {str(path.relative_to(name)): path.read_bytes() for path in Path(name).rglob("*") if path.is_file()}


def street(*options):
    def make(root):
        for name, contents in simulated(*options).items():
            file(name, contents)(root)
    return make


SHORT = street("--frames-count", "12")
BODY = street("--frames-count", "40", "--body-poses")

CASES = [
    # before any work
    Case("no output", "calibrate seq", ("--output is required",), (tum_sequence(),)),
    Case("no sequence", "calibrate -o new.yaml", ("SEQ is required",)),
    Case("the output exists", "calibrate seq -o old.yaml", ("old.yaml: expected the name of a new file, found one that exists", "never replaced"),
         (tum_sequence(), file("old.yaml", "mine"))),
    Case("the output is a folder", "calibrate seq -o old", ("old: expected the name of a new file",), (tum_sequence(), folder("old"))),
    Case("the output is the sequence's calibration", "calibrate seq -o seq/camera.yaml", ("seq/camera.yaml: expected the name of a new file",),
         (tum_sequence(),)),
    Case("no folder for the output", "calibrate seq -o no/new.yaml", ("no/new.yaml: expected a file in a folder that exists",), (tum_sequence(),)),
    Case("no such sequence", "calibrate nowhere -o new.yaml", ("nowhere: expected a folder with a sequence",)),
    Case("poses of other times", "calibrate seq --poses p.txt -o new.yaml", ("p.txt: expected poses within the time of the frames", "--pose-offset"),
         (tum_sequence(), file("p.txt", "100 0 0 0 0 0 0 1\n100.1 1 0 0 0 0 0 1\n"))),
    Case("poses that are none", "calibrate seq --poses p.txt -o new.yaml", ("p.txt",), (tum_sequence(), file("p.txt", "no poses\n"))),
    Case("a parameter of no name", "calibrate seq -o new.yaml --set speed=1", ("speed",), (tum_sequence(),)),
    # a correction that is stated
    Case("a correction is read", "info seq", given=(kitti_sequence(), file("seq/camera.yaml", RIGHT + CORRECTION)), code=0,
         prints=("baseline 0.1 m, right images corrected",)),
    Case("five terms of rows", "info seq", ("seq/camera.yaml:4: expected six numbers, pixels for 'rows', found a list of 5",),
         (kitti_sequence(), file("seq/camera.yaml", RIGHT + CORRECTION), replaced("seq/camera.yaml", "0, 0.5]", "0.5]"))),
    Case("a correction of columns", "info seq", ("expected a known key in 'correction', found 'columns'",),
         (kitti_sequence(), file("seq/camera.yaml", RIGHT + CORRECTION), replaced("seq/camera.yaml", "disparity", "columns"))),
    # nothing is shown
    Case("a recording without texture", "calibrate seq -o new.yaml --quiet", ("cairn calibrate: the recording determines nothing; nothing was written",),
         (tum_sequence(),), code=1, prints=("depth factor", "undetermined")),
    Case("given poses of such a recording", "calibrate seq --poses poses.txt -o new.yaml --json", ("determines nothing",),
         (tum_sequence(), trajectory()), code=1, prints=('"output": null', '"finding": "undetermined"')),
    Case("a single pair", "calibrate street --frames 0:1 -o new.yaml --quiet", ("determines nothing",), (SHORT,), code=1,
         prints=("frames       1, 1 tracked", "matches in 1 pairs are too few")),
    # answers
    Case("a short street", "calibrate street -o new.yaml --quiet", given=(SHORT,), code=0, leaves=("new.yaml",),
         prints=("frames       12, 12 tracked", "rows xy", "disparity x2", "baseline factor", "stretches of the recording only", "written to   new.yaml")),
    Case("without poses", "calibrate street -o new.yaml --quiet", given=(SHORT, lambda root: (root / "street/poses.txt").unlink()), code=0,
         leaves=("new.yaml",), prints=("poses        none", "need --poses")),
    Case("poses of a body", "calibrate street --poses street/body_poses.csv -o new.yaml --quiet", given=(BODY,), code=0, leaves=("new.yaml",),
         prints=("street/body_poses.csv (EuRoC)", "time offset", "boresight x", "lever arm z")),
    Case("help", "calibrate --help", code=0, prints=("Example: cairn calibrate SEQ -o camera.yaml", "--apply-baseline", "--poses", "--pose-offset")),
]


if __name__ == "__main__":
    main(CASES)
