# SPDX-License-Identifier: Apache-2.0
"""Times and figures beside OpenCV and Ceres (`./do bench`), and beside COLMAP."""

import json
import re
import shutil
import sys
from pathlib import Path

from experiments import experiment
from work import Skipped, expect

COLMAP = Path(__file__).resolve().parents[1] / "colmap/compare.py"

# What the documents show of the tables that cairn_bench prints: name, the row's work.
TIMED = {"orb": "ORB 1000, 640x480", "orb_describe": r"angle and descriptor of \d+ keypoints", "sift_vga": "SIFT 2000, 640x480",
         "sift_wide": "SIFT 2000, 1242x375", "hamming": "Hamming nearest .*", "hamming_mutual": "Hamming mutual .*", "l2": "L2 two nearest .*",
         "left_right": "left-right SIFT .*", "landmarks_ceres": ".* beside one Ceres problem each", "landmarks_tiny": ".* beside ceres::TinySolver",
         "map_opened": "a map of a million landmarks opened", "map_queried": "an image found among a million landmarks, .*",
         "epnp": "25 problems: solvePnPRansac, EPnP, .* 50 % wrong", "p3p": "25 problems: solvePnPRansac, P3P, .* 50 % wrong",
         "essential": "25 problems: findEssentialMat, RANSAC, .* 50 % wrong", "usac": "25 problems: findEssentialMat, USAC_ACCURATE, .* 50 % wrong"}
QUALITY = {**{f"{method.lower()}_{name}": f"{method} {count}, correct matches, {group}" for method, count in (("ORB", 1000), ("SIFT", 2000))
              for name, group in (("desk", "two_view"), ("redkitchen_10", "redkitchen, 10 apart"), ("redkitchen_30", "redkitchen, 30 apart"),
                                  ("kitti", "kitti_0039, 1 apart"))},
           "disparity_px": "left-right SIFT .*, median error, px", "landmarks_apart_m": "landmarks: largest distance from those of one Ceres .*",
           **{f"{name}_right": f"right within 1 % of 500: {work.partition(': ')[2]}" for name, work in TIMED.items() if work.startswith("25 problems")}}
SHOWN = "ORB_1000|keypoints|SIFT_2000|Hamming|L2_two|left-right_SIFT|landmarks|million|50_%_wrong".replace("_", " ")


def rows_of(printed):
    """Cells of each row of the tables."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in printed.splitlines() if line.startswith("|") and "--:" not in line]


def row_of(rows, pattern):
    found = [row for row in rows if re.fullmatch(pattern, row[0])]
    if len(found) != 1:
        raise RuntimeError(f"cairn_bench prints {len(found)} rows '{pattern}', not one")
    return found[0]


def timed_rows(rows):
    """work, threads, cairn, peer, share, limit, held: those of one thread."""
    return [row for row in rows if len(row) == 7 and row[1] == "1"]


def quality_rows(rows):
    """work, cairn, peer, limit, held."""
    return [row for row in rows if len(row) == 5]


def figures_of(printed, time):
    """Milliseconds of both on one thread, their ratio, and figures of quality of both. `time` makes a number one of a machine."""
    rows, found = rows_of(printed), {}
    for name, pattern in TIMED.items():
        ours, peers = row_of(timed_rows(rows), pattern)[2:4]
        found[f"{name}_ms"] = time(float(ours))
        if peers:
            found |= {f"{name}_peer_ms": time(float(peers)), f"{name}_times": time(float(peers) / float(ours))}
    for name, pattern in QUALITY.items():
        ours, peers = row_of(quality_rows(rows), pattern)[1:3]
        found[name] = float(ours)
        if peers:
            found[f"{name}_peer"] = float(peers)
    same = [row for row in quality_rows(rows) if row[0].endswith("identical matches")]
    expect(same and all(row[1] == row[2] for row in same), "brute-force matches are identical to OpenCV's")
    return found | {"keypoints": float(re.search(r"of (\d+) keypoints", printed)[1])}


@experiment("bench")
def beside_opencv(work, _):
    """What `./do bench` prints."""
    program = work.program.parent / "cairn_bench"
    if not program.exists():
        raise Skipped(f"the benchmarks are not built: {program} (./do bench)")
    run = work.measure(program, f"--benchmark_filter=({SHOWN}).*1 thread/")
    found = figures_of(run.output, run.time)
    found["landmarks_per_second_millions"] = run.time(1 / found["landmarks_ceres_ms"].value)  # a thousand at a time
    found["landmarks_apart_um"] = 1e6 * found["landmarks_apart_m"]
    found["map_slower_times"] = run.time(1 / found["map_queried_times"].value)
    found["map_opened_s"] = run.time(found["map_opened_ms"].value / 1e3)
    return found


@experiment("colmap")
def beside_colmap(work, _):
    """As docs/colmap_comparison.md says."""
    if not shutil.which("colmap"):
        raise Skipped("COLMAP is not installed: apt-get install colmap")
    run = work.measure(sys.executable, COLMAP, work.recording("stereo/kitti_0039"), "--cairn", work.program, "-o", work.folder / "work", "--frames", 51)
    found = {}
    for side, row in json.loads((work.folder / "work/results.json").read_text()).items():
        found |= {f"{side}_{key}": run.time(value) if key.endswith("_s") else value for key, value in row.items() if key != "wall_s"}
    return found
