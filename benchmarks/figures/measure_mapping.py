# SPDX-License-Identifier: Apache-2.0
"""`cairn map`: landmarks, their covariances, memory and time."""

import json

from experiments import experiment
from measure_slam import OFF, inside_95
from work import Skipped

KITTI, REDKITCHEN, EUROC, HIGHWAY = "stereo/kitti_0039", "rgbd/redkitchen", "stereo/euroc_v101", "stereo/odo01"


def figures_of(work, folder, run):
    info = work.cairn("info", folder)
    return {"landmarks": run["landmarks"], "frames_each": info["sightings_per_landmark"], "rms_px": info["indicators"]["rms_px"]["median"],
            "beyond_4px_percent": 100 * run["share_beyond_px"]["4"], "memory_mb": run.memory(),
            "frame_ms": run.time(1e3 * run["seconds"]["total"] / run["frames"]["mapped"])}


@experiment("map.kitti")
def kitti(work, _):
    folder, run = work.map(work.recording(KITTI))
    exact = work.map(work.recording(KITTI), "--exact-poses")
    taken = figures_of(work, *exact)
    return figures_of(work, folder, run) | {"exact_landmarks": taken["landmarks"], "exact_rms_px": taken["rms_px"]}


@experiment("map.redkitchen")
def redkitchen(work, _):
    return figures_of(work, *work.map(work.recording(REDKITCHEN), "--frames", "0:400"))


@experiment("map.euroc")
def euroc(work, _):
    return figures_of(work, *work.map(work.recording(EUROC)))


@experiment("map.highway", ci=True)
def highway(work, _):
    """With the disparities as they are, and with their field taken off."""
    found = {}
    for name, options in (("off", OFF), ("auto", ())):
        run = work.cairn("map", work.recording(HIGHWAY), "-o", name, *options)
        found |= {f"{name}_landmarks": run["landmarks"], f"{name}_moved_cm": 100 * run["smoothed_poses"]["moved_rms_m"]}
    return found


@experiment("map.street", (1, 2, 3), ci=True)
def street(work, seed):
    """The example of the README, "Whether stated covariances hold"."""
    sequence = work.simulate("street", "--frames-count", "60", "--depth-truth", "--seed", seed)
    work.cairn("map", sequence, "--poses", f"{sequence}/poses.txt", "-o", "map")
    found = work.evaluate("map", sequence, "--landmarks")
    classes = [100 * next(one["share"] for one in row["coverage"] if one["nominal"] == 0.95) for row in found["by_observations"]]
    return {"inside": inside_95(found["all"]), "edge_inside": inside_95(found["at_an_edge"]), "edge_percent": 100 * found["at_edges"] / found["judged"],
            "least_inside": min(classes), "most_inside": max(classes)}


@experiment("map.honesty")
def honesty(work, _):
    """The tests `SlowSurveyHonesty`, which know the true landmarks."""
    tests = work.program.parent / "src/cairn/survey/cairn_survey_tests"
    if not tests.exists():
        raise Skipped(f"the tests are not built: {tests}")
    done = work.measure(tests, "--gtest_filter=SlowSurveyHonesty.*", "--gtest_output=json:done.json")
    if "2 tests" not in done.output:
        raise RuntimeError(done.output)
    suite, = json.loads((work.folder / "done.json").read_text())["testsuites"]
    found = {}
    for test in suite["testsuite"]:
        name = "wrong_matches" if "wrong" in test["name"] else "noise"
        found |= {f"{name}_cm": 100 * float(test["distance_m"]), f"{name}_nees": float(test["nees_per_freedom"]), f"{name}_inside": 100 * float(test["covered_95"])}
    return found
