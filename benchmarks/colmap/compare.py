#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`cairn map` beside COLMAP's point_triangulator on a stereo sequence with known poses (KITTI odometry layout).

    compare.py SEQ --cairn build/release/cairn -o WORK [--frames 51] [--features 4000] [--window 20] [--threads 2]
        [--matches WORK]

Both get the same images, calibration, number of features and poses; COLMAP once the given ones, and once those to which
`cairn map` adjusted them. The figures of all come from models in COLMAP's text form, by the same code (model.py): landmarks in
three frames or more, a left and a right image of one time being one frame; frames that show one; and the median over
the landmarks of the mean distance of pixel and projection in the left images. triangulate.py says how COLMAP is run."""

import argparse
import json
import os
import shutil
import subprocess
import time
from pathlib import Path

import triangulate
from model import figures_of

COLUMNS = {"cairn": "cairn map", "exact": "cairn map, --exact-poses", "given": "COLMAP, given poses", "smoothed": "COLMAP, cairn's poses"}
ROWS = {"landmarks": ("landmarks in three frames or more", "{:,}"), "frames_per_landmark": ("frames that show one, mean", "{:.2f}"),
        "median_error_px": ("distance of pixel and projection, median of the means (px)", "{:.2f}"),
        "features_s": ("features, processor seconds", "{:.0f}"), "rest_s": ("matching and landmarks, processor seconds", "{:.0f}"),
        "cpu_s": ("both", "{:.0f}"), "wall_s": ("both, on the wall", "{:.0f}")}


def run_cairn(arguments, folder, *options):
    """Its figures. Stages run beside one another, so that only the sum of their processor time is known."""
    if folder.exists():
        shutil.rmtree(folder)
    command = [arguments.cairn, "map", arguments.sequence, "--frames", f"0:{arguments.frames}", "-o", folder, "--export", "colmap",
               "--set", f"features={arguments.features}", "--set", f"window={arguments.window}", "--threads", arguments.threads, "--json", *options]
    begin = time.monotonic()
    with subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL) as child:
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit("cairn map failed")
    return {**figures_of(folder / "colmap", lambda name: name.startswith("image_0/")), "wall_s": time.monotonic() - begin, "cpu_s": usage.ru_utime + usage.ru_stime}


def run_colmap(arguments, name, poses, matches):
    options = argparse.Namespace(**{**vars(arguments), "output": arguments.output / name, "poses": poses, "matches": matches})
    times = triangulate.triangulate(options)["times"]
    stages = [times[stage] for stage in ("features", "matching", "triangulation")]
    return {**figures_of(options.output / "model", lambda image: image.startswith("left/")),
            "features_s": stages[0]["cpu_s"], "rest_s": stages[1]["cpu_s"] + stages[2]["cpu_s"],
            "wall_s": sum(stage["wall_s"] for stage in stages), "cpu_s": sum(stage["cpu_s"] for stage in stages)}


def format_table(results):
    lines = ["| | " + " | ".join(COLUMNS[name] for name in results) + " |", "|---|" + "--:|" * len(results)]
    for key, (title, layout) in ROWS.items():
        cells = [layout.format(result[key]) if key in result else "" for result in results.values()]
        lines.append(f"| {title} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", type=Path, metavar="SEQ")
    parser.add_argument("--cairn", type=Path, required=True, metavar="PROGRAM")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="WORK")
    parser.add_argument("--frames", type=int, default=51, help="the first so many")
    parser.add_argument("--features", type=int, default=4000, help="of an image, at most")
    parser.add_argument("--window", type=int, default=20, help="frames")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--matches", type=Path, metavar="WORK", help="of an earlier run of triangulate.py with the same frames")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    results = {"cairn": run_cairn(arguments, arguments.output / "map")}
    results["exact"] = run_cairn(arguments, arguments.output / "exact", "--exact-poses")
    results["given"] = run_colmap(arguments, "given", None, arguments.matches)
    results["smoothed"] = run_colmap(arguments, "smoothed", arguments.output / "map" / "colmap", arguments.output / "given")
    (arguments.output / "results.json").write_text(json.dumps(results, indent=2) + "\n")
    print(format_table(results))


if __name__ == "__main__":
    main()
