# SPDX-License-Identifier: Apache-2.0
"""`cairn calibrate` on planted errors and on recordings; rectification."""

import math
import re
import statistics

from experiments import experiment
from work import expect

PLANTED = {"baseline factor": 1.005, "time offset": 0.02, "boresight x": 0.2, "boresight y": -0.2, "boresight z": 0.2,
           "lever arm x": 0.1, "lever arm y": -0.1, "lever arm z": 0.1}
ERRORS = ("--baseline-error", "0.5", "--pose-time-offset", "0.02", "--lever-arm-error", "0.1", "-0.1", "0.1", "--boresight-error", "0.2", "-0.2", "0.2")
SHORT = {"baseline factor": "baseline", "time offset": "time_ms", "boresight": "boresight_deg", "lever arm": "lever_cm"}
SCALE = {"baseline": 1, "time_ms": 1e3, "boresight_deg": 1, "lever_cm": 100}


def short_name(name):
    return "up_cm" if name == "lever arm z" else next(short for long, short in SHORT.items() if name.startswith(long))


def quantities(run):
    return {quantity["name"]: quantity for quantity in run["quantities"]}


def by_poses(work, scale, planted, seed):
    """The quantities of a drive around a block, with or without errors; nothing is called off that is not."""
    options = ("--frames-count", "150", "--scale", scale, "--seed", seed, *(ERRORS if planted else ("--body-poses",)))
    sequence = work.draw("street", *options)
    found = quantities(work.cairn("calibrate", sequence, "--poses", f"{sequence}/body_poses.csv", "-o", "found.yaml", "--apply-baseline"))
    off = {name for name, quantity in found.items() if quantity["finding"] == "off"}
    expect(off <= (set(PLANTED) if planted else set()), f"cairn calibrate calls nothing off that is not: {off}")
    expect(found["lever arm z"]["finding"] == "undetermined", "a level drive does not determine the lever arm's height")
    (work.folder / "found.yaml").unlink()
    return found


@experiment("calibrate.street", [(seed, planted) for seed in (1, 2, 3) for planted in (True, False)])
def street(work, case):
    seed, planted = case
    found = {}
    for name, quantity in by_poses(work, 1, planted, seed).items():
        if name not in PLANTED:
            continue
        short = short_name(name)
        scale = SCALE.get(short, 100)
        true = PLANTED[name] if planted else float(name == "baseline factor")
        found[f"{short}_error"] = max(found.get(f"{short}_error", 0), scale * abs(quantity["value"] - true))
        found.setdefault(f"{short}_std", []).append(scale * quantity["sigma"])
    for name in [name for name in found if name.endswith("_std")]:
        numbers = found.pop(name)
        found |= {f"{name}_least": min(numbers), f"{name}_most": max(numbers)}
    return found


@experiment("calibrate.small_street", [(seed, planted) for seed in (4, 5) for planted in (True, False)])
def small_street(work, case):
    seed, planted = case
    found = by_poses(work, 0.5, planted, seed)
    return {"time_ms_error": 1e3 * abs(found["time offset"]["value"] - (PLANTED["time offset"] if planted else 0))}


@experiment("calibrate.recordings")
def recordings(work, _):
    found = {}
    for name, folder in (("euroc", "euroc_v101"), ("kitti", "kitti_0039"), ("highway", "odo01")):
        found[name] = quantities(work.cairn("calibrate", work.recording(f"stereo/{folder}"), "-o", f"{name}.yaml"))
    expect(found["highway"]["baseline factor"]["finding"] == "undetermined", "odometry 01 does not determine the baseline factor")
    figures = {f"{name}_{key}": found[name]["baseline factor"][row] for name in ("euroc", "kitti") for key, row in (("baseline", "value"), ("std", "sigma"))}
    euroc = work.recording("stereo/euroc_v101")
    work.slam(euroc)
    turn = math.hypot(*(found["euroc"][f"boresight {axis}"]["value"] for axis in "xyz"))
    return figures | {"euroc_scale": work.evaluate("run", euroc)["sim3"]["scale"], "euroc_turn_deg": turn}


@experiment("calibrate.depth", (1, 2))
def depth(work, seed):
    """A room whose depth images lie beside their colour images by 4 and -3 px, or are a thirtieth of a second late."""
    sequence = work.draw("room", "--frames-count", "200", "--seed", seed)
    camera, right = sequence / "camera.yaml", (sequence / "camera.yaml").read_text()
    moved = re.search("camera: ({.*})", right).group(1).replace("cx: 319.5", "cx: 323.5").replace("cy: 239.5", "cy: 236.5")
    camera.write_text(right.replace("depth:", f"depth:\n  camera: {moved}"))
    found = quantities(work.cairn("calibrate", sequence, "-o", "shift.yaml"))
    error = max(abs(found["depth shift u"]["value"] - 4), abs(found["depth shift v"]["value"] + 3))
    camera.write_text(right)
    (sequence / "associations.txt").unlink()
    lines = [line.split() for line in (sequence / "depth.txt").read_text().splitlines()[1:]]
    (sequence / "depth.txt").write_text("".join(f"{a[0]} {b[1]}\n" for a, b in zip(lines, lines[1:])))
    late = quantities(work.cairn("calibrate", sequence, "-o", "delay.yaml"))["depth delay"]
    return {"shift_error_px": error, "delay_ms": 1e3 * late["value"], "delay_std_ms": 1e3 * late["sigma"]}


@experiment("calibrate.redkitchen")
def redkitchen(work, _):
    found = quantities(work.cairn("calibrate", work.recording("rgbd/redkitchen"), "-o", "found.yaml"))
    return {"shift_px": math.hypot(*(found[f"depth shift {axis}"]["value"] for axis in "uv"))}


def row_difference(work, left, right):
    """Median absolute difference of the rows of matching SIFT features, of all images together."""
    differences = []
    for a, b in zip(left, right):
        work.measure(work.program, "match", a, b, "--method", "sift", "--output", "m.csv")
        rows = [line.replace(",", " ").split() for line in (work.folder / "m.csv").read_text().splitlines()]
        differences += [abs(float(row[1]) - float(row[3])) for row in rows if row and re.match(r"[-\d.]", row[0])]
    return statistics.median(differences)


@experiment("rectify.euroc")
def rectify(work, _):
    """Of every tenth pair."""
    sequence = work.recording("stereo/euroc_v101")
    work.cairn("rectify", sequence, "-o", "rectified")
    root = sequence / "mav0" if (sequence / "mav0").is_dir() else sequence
    raw = [sorted((root / camera / "data").iterdir())[::10] for camera in ("cam0", "cam1")]
    rectified = [sorted((work.folder / "rectified" / camera).iterdir())[::10] for camera in ("image_0", "image_1")]
    return {"raw_rows_px": row_difference(work, *raw), "rows_px": row_difference(work, *rectified)}
