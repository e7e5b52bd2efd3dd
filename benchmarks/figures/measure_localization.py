# SPDX-License-Identifier: Apache-2.0
"""`cairn localize`: images in maps of recordings, how far they are from the truth, and whether what is stated holds."""

import math
import os
import re
import shutil
import zlib
from pathlib import Path

from experiments import experiment
from measure_mapping import EUROC, HIGHWAY, KITTI, REDKITCHEN
from measure_slam import inside_95, stated
from work import Skipped, expect

FIRST = ("--frames", "0:400")


def percentile(evaluation, percent, unit):
    return next(row[unit] for row in evaluation["ate_percentiles"] if row["percent"] == percent)


def located(work, map_folder, images, queries, within, *options, truth=None):
    """Poses of images against the truth, absolute. `within`: metres and degrees."""
    run = work.cairn("localize", map_folder, images, *options, "-o", "found")
    evaluation = work.evaluate("found", truth or images, "--align", "none", "--within", within, "--queries", queries)
    return run, evaluation, {
        "within_percent": 100 * evaluation["within"][0]["share_of_queries"], "median_cm": 100 * evaluation["ate_median_m"],
        "median_deg": evaluation["ate_median_deg"], "cm_90": 100 * percentile(evaluation, 90, "m"), "deg_90": percentile(evaluation, 90, "deg"),
        "good": run["images"]["good"], "features_ms": run.time(run["median_ms"]["features"]), "localize_ms": run.time(run["median_ms"]["localize"])}


def honesty(evaluation, scope="absolute"):
    found = stated(evaluation, scope)
    return {"inside": inside_95(found["pose"]), "nees": found["pose"]["mean_nees_per_dof"],
            "position_ratio": found["position"]["std_per_error"], "rotation_ratio": found["rotation"]["std_per_error"]}


@experiment("localize.redkitchen", (1, 2, 3, 4, 5))
def redkitchen(work, seed):
    sequence = work.recording(REDKITCHEN)
    folder, _ = work.map(sequence, *FIRST)
    _, evaluation, found = located(work, folder, sequence, 200, "0.05,5", "--frames", "400:600", "--seed", seed)
    found["within"] = evaluation["within"][0]["count"]
    found["aligned_cm"] = 100 * work.evaluate("found", sequence, "--align", "se3")["ate_median_m"]
    found["aligned_share"] = found["aligned_cm"] / found["median_cm"]
    return found | honesty(evaluation)


RESIZE = Path(__file__).with_name("resize.py")
PHOTOS = {"640": 1, "1600": 2.5, "1280": 2, "320": 0.5}


def scaled_camera(text, factor):
    """Pixel (0, 0) is the centre of the first pixel."""
    def replace(found):
        name, value = found[1], float(found[2])
        if name in ("width", "height"):
            return f"{name}: {round(value * factor)}"
        return f"{name}: {value * factor if name in ('fx', 'fy') else (value + 0.5) * factor - 0.5}"
    return re.sub(r"\b(width|height|fx|fy|cx|cy): *([\d.]+)", replace, text)


def quaternion(r):
    """x y z w, of the rows of a rotation by less than a half turn."""
    w = math.sqrt(1 + r[0][0] + r[1][1] + r[2][2]) / 2
    return (r[2][1] - r[1][2]) / (4 * w), (r[0][2] - r[2][0]) / (4 * w), (r[1][0] - r[0][1]) / (4 * w), w


def true_poses(sequence, frames):
    """7-Scenes' files as a TUM file, whose stamps are the positions of the frames in the list."""
    lines = []
    for i, frame in enumerate(frames):
        rows = [list(map(float, line.split())) for line in (sequence / f"frame-{frame:06}.pose.txt").read_text().splitlines()[:3]]
        lines.append(" ".join(map(str, (i, *(row[3] for row in rows), *quaternion(rows)))))
    return "\n".join(lines) + "\n"


@experiment("localize.photos")
def photos(work, _):
    """Every fifth of the queries as a photo of another size."""
    sequence = work.recording(REDKITCHEN)
    folder, _ = work.map(sequence, *FIRST)
    frames = range(400, 600, 5)
    truth = work.folder / "truth.txt"
    truth.write_text(true_poses(sequence, frames))
    found = {}
    for name, factor in PHOTOS.items():
        images = work.folder / name
        images.mkdir()
        resized = work.measure(RESIZE, factor, images, *(sequence / f"frame-{i:06}.color.jpg" for i in frames))
        if not any(images.iterdir()):
            raise Skipped(resized.errors.strip())
        (work.folder / f"{name}.yaml").write_text(scaled_camera((sequence / "camera.yaml").read_text(), factor))
        _, _, row = located(work, folder, images, 40, "0.05,5", "--camera", f"{name}.yaml", truth=truth)
        found |= {f"{key}_{name}": row[key] for key in ("within_percent", "median_cm", "cm_90", "good")}
        shutil.rmtree(images)
    return found


@experiment("localize.euroc", (4, 0))
def euroc(work, first):
    """Every fifth pair in the map of the others."""
    sequence = work.recording(EUROC)
    folder, _ = work.map(sequence, "--without", f"{first}::5")
    _, evaluation, found = located(work, folder, sequence, 20, "0.1,2", "--frames", f"{first}::5")
    _, _, mono = located(work, folder, sequence, 20, "0.1,2", "--frames", f"{first}::5", "--mono")
    return found | honesty(evaluation) | {f"mono_{name}": value for name, value in mono.items()}


@experiment("localize.kitti", (4, 0))
def kitti(work, first):
    sequence = work.recording(KITTI)
    folder, _ = work.map(sequence, "--without", f"{first}::5")
    _, evaluation, found = located(work, folder, sequence, 40, "0.3,5", "--frames", f"{first}::5")
    found |= honesty(evaluation) | {"most_cm": 100 * evaluation["ate_max_m"]}
    _, evaluation, _ = located(work, without_held_out(work, folder), sequence, 40, "0.3,5", "--frames", f"{first}::5")
    return found | {f"noise_{name}": value for name, value in honesty(evaluation, "in_map").items()}


def without_held_out(work, folder):
    """The same map without the frames by which localisation knows more than the noise of pixels."""
    copy = work.folder / "by_noise_alone"
    shutil.copytree(folder, copy, copy_function=os.link)
    sealed = (copy / "map.json").read_text().rpartition('  "crc32": ')[0]  # docs/map_format.md: the checksum of what stands before it
    text = re.sub(r'"held_out.txt": \d+, ', "", sealed)
    for name in ("map.json", "held_out.txt"):
        (copy / name).unlink()
    (copy / "map.json").write_text(f'{text}  "crc32": {zlib.crc32(text.encode())}\n}}\n')
    return copy


@experiment("localize.prior")
def prior(work, _):
    """Times with the pose of the image before, in a map of `cairn map` and in one of `cairn slam`."""
    sequence = work.recording(REDKITCHEN)
    folder, _ = work.map(sequence, *FIRST)
    work.slam(sequence, *FIRST, output="slam")
    found = {}
    for name, place in (("map", folder), ("slam", "slam")):
        run = work.cairn("localize", place, sequence, "--frames", "400:600", "--prior", "last", "-o", "found")
        found |= {f"{name}_{stage}_ms": run.time(run["median_ms"][stage]) for stage in ("features", "localize")}
    return found


@experiment("localize.others")
def others(work, _):
    """Images of other recordings in maps where they have no place."""
    asked = {REDKITCHEN: ((KITTI, "::1"), (EUROC, "::1"), (HIGHWAY, "::1")), EUROC: ((REDKITCHEN, "::1"), (KITTI, "::1")), KITTI: ((REDKITCHEN, "::3"), (HIGHWAY, "::1"))}
    images = 0
    for mapped, queries in asked.items():
        folder, _ = work.map(work.recording(mapped), *(FIRST if mapped == REDKITCHEN else ()))
        for name, frames in queries:
            run = work.cairn("localize", folder, work.recording(name), "--frames", frames, "-o", "found")
            expect(run["images"]["good"] == 0, f"no image of {name} is good in a map of {mapped}")
            images += run["images"]["total"]
    return {"images": images}
