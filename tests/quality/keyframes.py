# SPDX-License-Identifier: Apache-2.0
"""How honest the covariances of a run's keyframes are, against the exact truth of a simulated sequence."""

import csv
import math

LIMIT_95 = 12.592  # chi-square with 6 degrees of freedom


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def transposed(a):
    return [list(row) for row in zip(*a)]


def apply(rotation, point):
    return [sum(x * y for x, y in zip(row, point)) for row in rotation]


def inverse(pose):
    rotation = transposed(pose[0])
    return rotation, [-x for x in apply(rotation, pose[1])]


def compose(a, b):
    return product(a[0], b[0]), [x + y for x, y in zip(apply(a[0], b[1]), a[1])]


def from_tum(numbers):
    x, y, z, w = numbers[3:7]
    rotation = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return rotation, numbers[:3]


def rows_of(path):
    return [[float(word) for word in line.split()] for line in path.read_text().splitlines() if line and line[0] != "#"]


def read_truth(sequence):
    """world_from_camera by stamp in milliseconds."""
    if (sequence / "groundtruth.txt").exists():
        return {round(1e3 * row[0]): from_tum(row[1:]) for row in rows_of(sequence / "groundtruth.txt")}
    stamps = [row[0] for row in rows_of(sequence / "times.txt")]
    return {round(1e3 * stamp): ([row[0:3], row[4:7], row[8:11]], [row[3], row[7], row[11]])
            for stamp, row in zip(stamps, rows_of(sequence / "poses.txt"))}


def perturbation(estimate, truth):
    """The xi with perturb_left(xi, estimate) = truth, small."""
    turn = product(truth[0], transposed(estimate[0]))
    half = [(turn[2][1] - turn[1][2]) / 2, (turn[0][2] - turn[2][0]) / 2, (turn[1][0] - turn[0][1]) / 2]
    return half + [x - y for x, y in zip(truth[1], apply(turn, estimate[1]))]


def solve(matrix, right):
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i, pivot in enumerate(rows):
        for row in rows[i + 1:]:
            factor = row[i] / pivot[i]
            row[i:] = [x - factor * y for x, y in zip(row[i:], pivot[i:])]
    x = [0.0] * len(rows)
    for i in reversed(range(len(rows))):
        x[i] = (rows[i][-1] - sum(rows[i][k] * x[k] for k in range(i + 1, len(rows)))) / rows[i][i]
    return x


def covariance(row, name):
    axes = ("rx", "ry", "rz", "x", "y", "z")
    return [[float(row[f"{name}_cov_{axes[min(i, k)]}_{axes[max(i, k)]}"]) for k in range(6)] for i in range(6)]


class Honesty:
    """Of the motions from the keyframe before, or from the first one."""

    def __init__(self, run, sequence, name):
        truth = read_truth(sequence)
        poses = {round(1e3 * row[0]): from_tum(row[1:]) for row in rows_of(run / "keyframes.txt")}
        lines = [line for line in (run / "keyframe_covariances.csv").read_text().splitlines() if line[0] != "#"]
        rows = list(csv.DictReader(lines))
        assert [round(1e3 * float(row["stamp_s"])) for row in rows] == list(poses), "a row for each keyframe"
        stamps = list(poses)
        self.nees, ratios = [], []
        for i in range(1, len(stamps)):
            start, here = stamps[i - 1 if name == "previous" else 0], stamps[i]
            motions = [compose(inverse(each[here]), each[start]) for each in (poses, truth)]
            error, stated = perturbation(*motions), covariance(rows[i], name)
            self.nees.append(sum(x * y for x, y in zip(error, solve(stated, error))))
            ratios.append((math.hypot(*error[3:]), math.sqrt(stated[3][3] + stated[4][4] + stated[5][5])))
        self.per_degree = sum(self.nees) / (6 * len(self.nees))
        self.coverage = sum(nees < LIMIT_95 for nees in self.nees) / len(self.nees)
        errors, deviations = (sorted(values)[len(values) // 2] for values in zip(*ratios))
        self.inflation = deviations / errors  # of the medians of positions

    def __repr__(self):
        return f"NEES {self.per_degree:.2f} per degree of freedom, {100 * self.coverage:.1f} % inside 95 %, deviation / error {self.inflation:.2f}"


if __name__ == "__main__":
    import pathlib
    import sys
    for kind in ("previous", "first"):
        print(kind, Honesty(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), kind))
