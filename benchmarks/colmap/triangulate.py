#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Triangulates a stereo sequence (KITTI odometry layout, with poses.txt) by COLMAP 3.8, with known poses: its
features, its matches, its point_triangulator. `apt-get install colmap` brings the program; it needs no GPU.

    triangulate.py SEQ -o WORK [--frames 51] [--features 4000] [--window 20] [--threads 2]
        [--poses MODEL] [--matches WORK]

WORK/model has the result as text, WORK/times.json the seconds of each stage. Matched are the left and the right
image of each pair, and the left images of each two frames that are at most `window` frames apart. The poses are those of
poses.txt, or with --poses those of a model's left images: as `cairn map --export colmap` writes them, which leaves out
frames that show nothing new. --matches takes features and matches of an earlier run with the same frames."""

import argparse
import json
import os
import shutil
import sqlite3
import subprocess
import time
from pathlib import Path

from model import read_images


def read_calibration(sequence):
    """fx, fy, cx, cy and the baseline. COLMAP's pixels have their centres at .5."""
    rows = dict(line.split(":") for line in (sequence / "calib.txt").read_text().splitlines() if ":" in line)
    left, right = (list(map(float, rows[name].split())) for name in ("P0", "P1"))
    return (left[0], left[5], left[2] + 0.5, left[6] + 0.5), -right[3] / right[0]


def quaternion_of(rotation):
    """w x y z of a rotation matrix, by the largest of the four, so that nothing small is divided by."""
    r = rotation
    squares = [1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2],
               1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]]
    differences = (r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1])
    sums = {(1, 2): r[0][1] + r[1][0], (1, 3): r[0][2] + r[2][0], (2, 3): r[1][2] + r[2][1]}
    best = squares.index(max(squares))

    def product(i, k):  # 4 q_i q_k
        i, k = min(i, k), max(i, k)
        return squares[i] if i == k else differences[k - 1] if i == 0 else sums[i, k]

    quaternion = [product(best, i) for i in range(4)]
    length = sum(q * q for q in quaternion) ** 0.5
    return tuple(q / length for q in quaternion)


def camera_from_world(row):
    """Quaternion and translation of the inverse of a 3x4 matrix."""
    matrix = [row[0:4], row[4:8], row[8:12]]
    inverse = [[matrix[k][i] for k in range(3)] for i in range(3)]
    return quaternion_of(inverse), tuple(-sum(inverse[i][k] * matrix[k][3] for k in range(3)) for i in range(3))


def read_poses(sequence, count, model):
    """By number of the frame: quaternion and translation, camera_from_world."""
    if model:
        files = [file.name for file in sorted((sequence / "image_0").iterdir())]
        poses = {files.index(Path(image.name).name): (image.quaternion, image.translation)
                 for image in read_images(model).values() if image.name.startswith("image_0/")}
        return {frame: pose for frame, pose in sorted(poses.items()) if frame < count}
    rows = [list(map(float, line.split())) for line in (sequence / "poses.txt").read_text().splitlines()]
    return {frame: camera_from_world(row) for frame, row in enumerate(rows[:count])}


def link_images(sequence, frames, folder):
    """left/NNNNNN.png and right/NNNNNN.png by the frame's number in the sequence."""
    for side, source in (("left", "image_0"), ("right", "image_1")):
        (folder / side).mkdir(parents=True)
        files = sorted((sequence / source).iterdir())
        for frame in frames:
            (folder / side / f"{frame:06}.png").symlink_to(files[frame].resolve())


def write_pairs(path, frames, window):
    pairs = [f"left/{a:06}.png right/{a:06}.png" for a in frames]
    pairs += [f"left/{a:06}.png left/{b:06}.png" for a in frames for b in frames if a < b <= a + window]
    path.write_text("\n".join(pairs) + "\n")
    return len(pairs)


def write_poses(database, poses, baseline, calibration, folder):
    """A model without points, with the numbers that the database gave images and cameras."""
    folder.mkdir()
    with sqlite3.connect(database) as connection:
        images = connection.execute("SELECT image_id, camera_id, name FROM images ORDER BY image_id").fetchall()
        camera, width, height = connection.execute("SELECT camera_id, width, height FROM cameras").fetchone()
    with open(folder / "images.txt", "w", encoding="utf-8") as file:
        for number, of_camera, name in images:
            side, _, image = name.partition("/")
            quaternion, (x, y, z) = poses[int(Path(image).stem)]
            x -= baseline if side == "right" else 0.0
            file.write(f"{number} {' '.join(map(repr, (*quaternion, x, y, z)))} {of_camera} {name}\n\n")
    (folder / "cameras.txt").write_text(f"{camera} PINHOLE {width} {height} {' '.join(map(repr, calibration))}\n")
    (folder / "points3D.txt").write_text("")


class Stages:
    """Runs COLMAP's commands and takes their times: seconds on the wall, and of processors."""

    def __init__(self, log):
        self.log, self.times = log, {}

    def run(self, stage, command, **options):
        arguments = ["colmap", command]
        for name, value in options.items():
            arguments += [f"--{name.replace('__', '.')}", str(value)]
        begin = time.monotonic()
        with open(self.log, "a", encoding="utf-8") as log:
            child = subprocess.Popen(arguments, stdout=log, stderr=log, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
            _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            raise SystemExit(f"colmap {command} failed; see {self.log}")
        self.times[stage] = {"wall_s": time.monotonic() - begin, "cpu_s": usage.ru_utime + usage.ru_stime}


def match(arguments, frames, calibration, stages):
    """Makes the database with features and matches; how many pairs of images were matched."""
    work = arguments.output
    database = work / "database.db"
    pairs = write_pairs(work / "pairs.txt", frames, arguments.window)
    if arguments.matches:
        shutil.copy(arguments.matches / "database.db", database)
        earlier = json.loads((arguments.matches / "times.json").read_text())["times"]
        stages.times.update({stage: earlier[stage] for stage in ("features", "matching")})
        return pairs
    stages.run("features", "feature_extractor", database_path=database, image_path=work / "images",
               ImageReader__camera_model="PINHOLE", ImageReader__single_camera=1,
               ImageReader__camera_params=",".join(map(repr, calibration)), SiftExtraction__use_gpu=0,
               SiftExtraction__max_num_features=arguments.features, SiftExtraction__num_threads=arguments.threads)
    stages.run("matching", "matches_importer", database_path=database, match_list_path=work / "pairs.txt",
               SiftMatching__use_gpu=0, SiftMatching__num_threads=arguments.threads)
    return pairs


def triangulate(arguments):
    work = arguments.output
    if work.exists():
        shutil.rmtree(work)
    work.mkdir(parents=True)
    calibration, baseline = read_calibration(arguments.sequence)
    poses = read_poses(arguments.sequence, arguments.frames, arguments.poses)
    link_images(arguments.sequence, poses, work / "images")
    stages = Stages(work / "log.txt")
    pairs = match(arguments, list(poses), calibration, stages)
    write_poses(work / "database.db", poses, baseline, calibration, work / "poses")
    (work / "model").mkdir()
    stages.run("triangulation", "point_triangulator", database_path=work / "database.db", image_path=work / "images",
               input_path=work / "poses", output_path=work / "model", Mapper__num_threads=arguments.threads)
    stages.run("conversion", "model_converter", input_path=work / "model", output_path=work / "model", output_type="TXT")
    stages.run("analysis", "model_analyzer", path=work / "model")
    figures = {"frames": len(poses), "image_pairs": pairs, "times": stages.times}
    (work / "times.json").write_text(json.dumps(figures, indent=2) + "\n")
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", type=Path, metavar="SEQ")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="WORK", help="is emptied first")
    parser.add_argument("--frames", type=int, default=51, help="the first so many")
    parser.add_argument("--features", type=int, default=4000, help="of an image, at most")
    parser.add_argument("--window", type=int, default=20, help="frames")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--poses", type=Path, metavar="MODEL", help="a model in COLMAP's text form")
    parser.add_argument("--matches", type=Path, metavar="WORK", help="of an earlier run with the same frames")
    print(json.dumps(triangulate(parser.parse_args()), indent=2))


if __name__ == "__main__":
    main()
