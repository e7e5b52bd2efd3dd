# SPDX-License-Identifier: Apache-2.0
"""COLMAP's sparse models in their text form (colmap.github.io/format.html), read one line after the other, and what
is counted of them. Nothing but Python's own library is needed."""

import math
import statistics
from pathlib import Path


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        yield from (line for line in file if not line.startswith("#"))


def read_cameras(folder):
    """By id: fx, fy, cx, cy. All cameras are of the model PINHOLE."""
    cameras = {}
    for line in lines_of(Path(folder) / "cameras.txt"):
        words = line.split()
        if words[1] != "PINHOLE":
            raise ValueError(f"{folder}: a camera of the model PINHOLE expected, found {words[1]}")
        cameras[int(words[0])] = tuple(map(float, words[4:8]))
    return cameras


class Image:
    """name, camera, camera_from_world as (rows of the rotation, translation), quaternion as w x y z, and pixels by their number."""

    def __init__(self, line, points_line):
        words = line.split()
        self.quaternion = tuple(map(float, words[1:5]))
        self.translation = tuple(map(float, words[5:8]))
        self.camera, self.name = int(words[8]), words[9]
        self.rotation = rotation_of(self.quaternion)
        self.pixels = list(map(float, points_line.split()))

    def pixel(self, number):
        return self.pixels[3 * number], self.pixels[3 * number + 1]

    def from_world(self, point):
        return [sum(r * x for r, x in zip(row, point)) + t for row, t in zip(self.rotation, self.translation)]


def rotation_of(quaternion):
    w, x, y, z = quaternion
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def read_images(folder):
    """By id."""
    images, lines = {}, lines_of(Path(folder) / "images.txt")
    for line in lines:
        images[int(line.split(maxsplit=1)[0])] = Image(line, next(lines))
    return images


def read_points(folder):
    """One after the other: the place, and its track as (image, number of the pixel in it)."""
    for line in lines_of(Path(folder) / "points3D.txt"):
        words = line.split()
        track = list(map(int, words[8:]))
        yield tuple(map(float, words[1:4])), list(zip(track[::2], track[1::2]))


def frame_of(image):
    """The frame that an image is of: the left and the right one of a pair have the same file name."""
    return Path(image.name).name


def distance_px(image, camera, point, pixel):
    """Between a pixel and the projection; infinite behind the camera."""
    x, y, z = image.from_world(point)
    fx, fy, cx, cy = camera
    return math.hypot(fx * x / z + cx - pixel[0], fy * y / z + cy - pixel[1]) if z > 0 else math.inf


def figures_of(folder, is_left, min_frames=3):
    """Of the landmarks that `min_frames` frames or more show: how many, the mean number of frames that show one, and the
    median of their errors, each the mean distance of pixel and projection in the left images that show it."""
    cameras, images = read_cameras(folder), read_images(folder)
    lengths, errors = [], []
    for point, track in read_points(folder):
        frames = {frame_of(images[image]) for image, _ in track}
        if len(frames) < min_frames:
            continue
        left = [(images[image], number) for image, number in track if is_left(images[image].name)]
        lengths.append(len(frames))
        if left:
            errors.append(statistics.fmean(distance_px(image, cameras[image.camera], point, image.pixel(number)) for image, number in left))
    return {"landmarks": len(lengths), "frames_per_landmark": statistics.fmean(lengths) if lengths else 0,
            "median_error_px": statistics.median(errors) if errors else math.nan}
