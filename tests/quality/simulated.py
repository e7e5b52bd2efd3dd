# SPDX-License-Identifier: Apache-2.0
"""From simulation to evaluation, as a user would go, against the exact truth. Arguments: the program."""

import json
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import keyframes
import program
import receivers

DOCS = Path(__file__).resolve().parents[2] / "docs"


def check_keyframes(test, run, sequence):
    """The covariances of keyframes are honest. Errors against the first keyframe move together along a run, so that one run says less of them."""
    before, first = (keyframes.Honesty(test.folder / run, test.folder / sequence, name) for name in ("previous", "first"))
    test.assertGreater(before.per_degree, 0.8, before)
    test.assertLess(before.per_degree, 1.25, before)
    test.assertGreater(before.coverage, 0.9, before)
    test.assertLess(before.inflation, 1.5, before)
    test.assertGreater(first.per_degree, 0.4, first)
    test.assertLess(first.per_degree, 1.5, first)
    test.assertGreater(first.coverage, 0.85, first)


class Room(program.Quality):
    def test_maps_a_simulated_room(self):
        self.cairn("simulate", "room", "-o", "room", "--quiet")
        run = self.figures("slam", "room", "-o", "run")
        self.assertEqual(run["frames"]["tracked"], 300)
        self.assertLessEqual(run["peak_memory_mb"], 1000)
        evaluation = self.figures("evaluate", "run", "room")
        self.assertEqual(evaluation["pairs"], 300)
        self.assertLessEqual(evaluation["ate_rmse_m"], 0.015)
        self.assertAlmostEqual(evaluation["ate_rmse_m"], run["ate_rmse_m"], places=9)
        check_keyframes(self, "run", "room")
        self.check_map_reader()

    def check_map_reader(self):
        """The reader that docs/map_format.md prints reads the map."""
        code = re.search(r"```python\n(.*?)```", (DOCS / "map_format.md").read_text(), re.S).group(1)
        self.assertLess(code.count("\n"), 40)
        (self.folder / "reader.py").write_text(code)
        done = subprocess.run([sys.executable, "reader.py", "run/map"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        run = json.loads((self.folder / "run/run.json").read_text())
        self.assertIn(f"{run['keyframes']} keyframes, {run['landmarks']} landmarks", done.stdout)
        info = self.figures("info", "run")
        self.assertEqual((info["keyframes"], info["landmarks"]), (run["keyframes"], run["landmarks"]))


class DepthNoise(program.Quality):
    """A small room whose depth is noisier or better than a Kinect's, at half the resolution."""

    def test_is_estimated_as_well_as_if_it_were_known(self):
        for factor in (0.5, 2, 10):
            with self.subTest(factor=factor):
                self.cairn("simulate", "room", "-o", "room", "--frames-count", "60", "--scale", "0.5", "--depth-noise", factor, "--quiet")
                run = self.figures("slam", "room", "-o", "run", "--no-cloud", "--no-octree")
                known = self.figures("slam", "room", "-o", "known", "--no-cloud", "--no-octree", "--set", f"depth.sigma_disparity_px={0.03 * factor}",
                                     "--set", f"depth.sigma_m={0.0015 * factor}")
                self.assertEqual(run["frames"]["tracked"], 60)
                self.assertLessEqual(run["ate_rmse_m"], 1.5 * known["ate_rmse_m"])
                # Nguyen, Izadi, Lovell 2012 at 3 m
                self.assertAlmostEqual(run["depth_noise"]["sigma_at_3_m"], factor * 0.0140, delta=0.3 * factor * 0.0140)
                shutil.rmtree(self.folder / "room")


class Loops(program.Quality):
    """At half the resolution, with the accuracy that is claimed for all of it."""

    def test_closes_the_loops_of_a_long_walk(self):
        self.cairn("simulate", "room", "-o", "room", "--frames-count", "1000", "--loops", "2", "--scale", "0.5", "--quiet")
        run = self.figures("slam", "room", "-o", "run", "--no-cloud", "--no-octree")
        self.assertEqual(run["frames"]["tracked"], 1000)
        self.assertLessEqual(run["ate_rmse_m"], 0.007)
        self.assertLessEqual(run["peak_memory_mb"], 200)


class Street(program.Quality):
    """A street whose pair is as calibrated."""

    def test_keeps_the_scale_and_does_nothing_to_the_pair(self):
        self.cairn("simulate", "street", "-o", "street", "--quiet")
        run = self.figures("slam", "street", "-o", "run", "--threads", "2")
        self.assertEqual(run["frames"]["tracked"], 200)
        evaluation = self.figures("evaluate", "run", "street")
        self.assertLessEqual(evaluation["ate_rmse_m"], 0.10)
        self.assertAlmostEqual(evaluation["sim3"]["scale"], 1, delta=0.003)
        found = run["stereo_calibration"]
        self.assertFalse(found["rows"]["applied"] or found["disparities"]["applied"], found)
        self.cairn("slam", "street", "-o", "off", "--threads", "1", "--set", "stereo.self_calibration=off", "--quiet")
        self.assert_same_files("run", "off", but=("run.json", "config.yaml"))


class TurnedCamera(program.Quality):
    """A street whose right camera is turned by 0.02 degrees about each axis."""

    PLANTED_PX = 721.5 * 0.02 * 3.14159265 / 180  # c0 and c2 of its disparities

    def scale(self, run, street):
        return self.figures("evaluate", run, street)["sim3"]["scale"]

    def test_is_found_and_taken_off(self):
        self.cairn("simulate", "street", "-o", "street", "--frames-count", "150", "--seed", "3", "--right-rotation", "0.02", "0.02", "0.02", "--quiet")
        found = self.figures("slam", "street", "-o", "run")["stereo_calibration"]
        self.assertTrue(found["rows"]["applied"] and found["disparities"]["applied"], found)
        for term, planted in zip(found["disparities"]["terms_px"], (self.PLANTED_PX, 0, self.PLANTED_PX)):
            self.assertAlmostEqual(term, planted, delta=0.05)
        self.assertAlmostEqual(self.scale("run", "street"), 1, delta=0.002)
        check_keyframes(self, "run", "street")
        self.figures("slam", "street", "-o", "as_calibrated", "--set", "stereo.self_calibration=off")
        self.assertGreater(self.scale("as_calibrated", "street"), 1.01)  # what there was to find


class Receiver(program.Quality):
    """Maps from the poses of a receiver, with every kind of deviation."""

    SMALL = ("--set", "window=6", "--set", "pose_frames=3", "--set", "features=500", "--quiet")
    PLACE, ANGLES = (0.02, 0.03, 0.05), (0.03, 0.04, 0.1)

    def setUp(self):
        super().setUp()
        self.simulate("street", "street", "--frames-count", "12", "--scale", "0.25")
        self.drive = receivers.Drive(self.folder / "street")
        info = self.figures("info", "street")
        calibration = [info["camera"][name] for name in ("width", "height", "fx", "cx", "cy")] + [info["baseline_m"]]
        for axes in ("frd", "flu"):
            self.drive.write_camera(self.folder / f"{axes}.yaml", calibration, axes)

    def map(self, name, poses, *options, axes="frd", code=0):
        said = self.cairn("map", "street", "--camera", f"{axes}.yaml", "--poses", poses, "-o", name, *self.SMALL, *options, "--json", code=code)
        return json.loads(said) if code == 0 else None

    def test_each_kind_of_deviation_makes_a_map(self):
        self.drive.write_oxts(self.folder / "oxts", 0.05)
        self.assertGreater(self.map("packets", "oxts", axes="flu")["landmarks"], 200)
        for geodetic in (True, False):
            for place in (None, self.PLACE):
                for angles in (None, self.ANGLES):
                    self.drive.write_table(self.folder / "poses.csv", geodetic, place, angles)
                    figures = self.map("map", "poses.csv")
                    self.assertGreater(figures["landmarks"], 200)
                    stated = figures["uncertainty"]
                    self.assertAlmostEqual(stated["stated_rotation_std_deg"], 0.1 if angles else 0, places=2)
                    self.assertEqual(stated["by_poses_rms_m"] > 0.005, bool(place or angles))
                    self.assertEqual(self.figures("info", "map")["landmarks"], figures["landmarks"])

    def test_deviations_of_a_metre_take_no_landmark_away(self):
        self.drive.write_table(self.folder / "exact.csv", True)
        self.drive.write_table(self.folder / "cheap.csv", True, (1.0, 1.0, 2.0))
        exact, cheap = self.map("exact", "exact.csv"), self.map("cheap", "cheap.csv")
        self.assertEqual(cheap["landmarks"], exact["landmarks"])
        self.assertEqual(cheap["uncertainty"]["dominated_by_poses"], cheap["landmarks"])
        self.assertAlmostEqual(cheap["uncertainty"]["by_poses_rms_m"], 2, places=3)

    def test_a_heading_of_the_other_sign_is_named(self):
        self.drive.write_table(self.folder / "poses.csv", True, self.PLACE)
        lines = (self.folder / "poses.csv").read_text().splitlines()
        rows = [line.split(",") for line in lines[1:]]
        for row in rows:
            row[6] = str(-float(row[6]))
        (self.folder / "wrong.csv").write_text("\n".join([lines[0], *map(",".join, rows)]) + "\n")
        self.map("map", "wrong.csv", code=2)
        self.assertFalse((self.folder / "map").exists() or (self.folder / "map.unfinished").exists())
        self.assertGreater(self.map("map", "poses.csv")["landmarks"], 200)


class SmallStreet(program.Quality):
    """Mistakes in how a stereo recording is laid out or described."""

    def setUp(self):
        super().setUp()
        self.simulate("street", "street", "--frames-count", "14", "--scale", "0.25")
        self.images = [self.folder / "street" / camera for camera in ("image_0", "image_1")]

    def slam(self, *options):
        return self.figures("slam", "street", "-o", "run", *options)

    def test_names_without_leading_zeros_come_in_natural_order(self):
        before = self.slam()
        for image in (path for folder in self.images for path in sorted(folder.iterdir())):
            image.rename(image.with_name(f"{int(image.stem)}.png"))
        after = self.slam()
        self.assertLess(after["ate_rmse_m"], 0.2)
        self.assertEqual(after["ate_rmse_m"], before["ate_rmse_m"])
        self.cairn("map", "street", "-o", "map", "--quiet")
        plain = self.folder / "plain"
        shutil.copytree(self.images[0], plain)
        self.cairn("localize", "map", plain, "-o", "found", "--quiet")
        found = (self.folder / "found/localization.csv").read_text()
        self.assertEqual(re.findall(r"\d+\.png", found), [f"{i}.png" for i in range(14)])

    def test_exchanged_images_are_named_by_every_command_that_reads_pairs(self):
        self.cairn("map", "street", "-o", "map", "--quiet")
        left, right = self.images
        left.rename(self.folder / "other")
        right.rename(left)
        (self.folder / "other").rename(right)
        for command in (("info", "street"), ("slam", "street", "-o", "run"), ("map", "street", "-o", "map2"),
                        ("rectify", "street", "-o", "rectified"), ("localize", "map", "street", "-o", "found")):
            said = self.complaints(*command, code=2)
            self.assertIn("left and right images that look exchanged", said)
            self.assertIn("Exchange the images of image_0 and image_1", said)
        self.cairn("localize", "map", "street", "-o", "found", "--mono", "--quiet")  # the right camera's are as good

    def test_a_motion_beyond_max_motion_is_refused(self):
        self.assertEqual(self.slam("--set", "max_motion=2")["frames"]["tracked"], 14)  # 8 m/s at 10 Hz
        said = self.complaints("slam", "street", "-o", "run", "--set", "max_motion=0.3", "--quiet", code=1)
        self.assertIn("moved further than max_motion = 0.3", said)
        rows = (self.folder / "run/frames.csv").read_text()
        self.assertGreaterEqual(rows.count("too far"), 4, rows)

    def test_a_start_map_does_not_lift_max_motion(self):
        self.slam()
        said = self.complaints("slam", "street", "-o", "again", "--map", "run", "--set", "max_motion=0.3", "--quiet", code=1)
        self.assertIn("moved further than max_motion = 0.3", said)

    def test_the_first_pairs_may_be_unreadable(self):
        (self.images[0] / "000000.png").write_bytes(b"")
        (self.images[1] / "000001.png").unlink()
        run = self.slam()
        self.assertEqual((run["frames"]["tracked"], len(run["frames"]["unreadable"])), (12, 2))
        self.assertEqual(self.figures("map", "street", "-o", "map")["frames"]["unreadable"], 2)
        self.assertEqual(self.figures("localize", "map", "street", "-o", "found")["images"]["unreadable"], 2)
        self.assertEqual(self.figures("rectify", "street", "-o", "rectified")["unreadable"], 2)
        self.assertEqual(self.figures("info", "street")["unreadable"], 2)
        self.assertEqual(self.figures("info", "rectified")["frames"], 12)


class StatedCovariances(program.Quality):
    """What cairn evaluate says of covariances, where the truth is exact."""

    def setUp(self):
        super().setUp()
        self.cairn("simulate", "street", "-o", "street", "--frames-count", "14", "--scale", "0.25", "--depth-truth", "--quiet")

    def check_landmarks(self, name):
        found = self.figures("evaluate", name, "street", "--landmarks")
        self.assertEqual(found["landmarks"], self.figures("info", name)["landmarks"])
        self.assertEqual(found["judged"] + found["without_truth"] + found["without_covariance"] + found["undetermined"]
                         + found["in_other_components"], found["landmarks"])
        self.assertGreater(found["judged"], 0.9 * found["landmarks"])
        for classes in ("by_distance", "by_observations"):
            self.assertEqual(sum(one["errors"] for one in found[classes]), found["judged"])
        self.assertLess(found["distance_from_surface_m"]["median"], 0.1)
        shares = [one["share"] for one in found["all"]["coverage"]]
        self.assertEqual(shares, sorted(shares))
        return found

    def test_landmarks_of_a_map_lie_on_the_surfaces(self):
        self.cairn("map", "street", "--poses", "street/poses.txt", "-o", "map", "--quiet")
        found = self.check_landmarks("map")
        on_surface = found["on_one_surface"]
        self.assertGreater(on_surface["median_nees_ratio"], 0.5)
        self.assertLess(on_surface["median_nees_ratio"], 2)
        self.assertGreater(on_surface["coverage"][2]["share"], 0.8)
        self.cairn("localize", "map", "street", "-o", "found", "--quiet")
        run = self.figures("evaluate", "found", "street", "--align", "none", "--plot-coverage", "poses.svg")
        self.assertEqual(sum(one["pose"]["errors"] for one in run["covariances"] if one["scope"] == "in_map"), run["pairs"])
        self.assertIn("in the map", (self.folder / "poses.svg").read_text())

    def test_landmarks_of_a_room_lie_on_the_surfaces(self):
        self.cairn("simulate", "room", "-o", "room", "--frames-count", "10", "--scale", "0.5", "--depth-truth", "--quiet")
        self.cairn("map", "room", "--poses", "room/groundtruth.txt", "-o", "map", "--quiet")
        found = self.figures("evaluate", "map", "room", "--landmarks")
        self.assertGreater(found["judged"], 0.9 * found["landmarks"])
        self.assertLess(found["distance_from_surface_m"]["median"], 0.01)

    def test_landmarks_of_slam_lie_on_the_surfaces(self):
        self.cairn("slam", "street", "-o", "run", "--quiet")
        self.check_landmarks("run")


class Small(program.Quality):
    """On a quarter of the pixels, where accuracy is not the question."""

    def setUp(self):
        super().setUp()
        self.simulate("room", "room", "--frames-count", "60", "--scale", "0.5")

    def test_writes_the_same_bytes_at_any_number_of_threads(self):
        for threads in (1, 2, 3):
            self.cairn("slam", "room", "-o", f"run{threads}", "--threads", threads, "--quiet")
        self.assert_same_files("run1", "run2", but=("run.json",))  # run.json holds times
        self.assert_same_files("run1", "run3", but=("run.json",))

    def test_a_run_can_be_repeated_from_its_configuration(self):
        self.cairn("slam", "room", "-o", "run", "--set", "features=700", "--set", "nearby_loops=3", "--quiet")
        self.cairn("slam", "room", "-o", "again", "--config", "run/config.yaml", "--quiet")
        self.assert_same_files("run", "again", but=("run.json",))

    def test_a_wrong_scale_of_depth_is_doubted(self):
        camera = self.folder / "room/camera.yaml"
        right = camera.read_text()
        self.assertNotIn("median depth", self.complaints("slam", "room", "-o", "run", "--frames", "0:20", "--quiet"))
        for scale in ("1000", "25000"):
            camera.write_text(re.sub(r"scale: [0-9.]+", f"scale: {scale}", right))
            for command in (("slam", "room", "-o", "run"), ("map", "room", "-o", "map"), ("cloud", "room", "-o", "room.ply"),
                            ("octree", "room", "-o", "room.bt"), ("info", "room")):
                quiet = () if command[0] == "info" else ("--quiet",)
                done = subprocess.run([Path(sys.argv[1]).resolve(), *command, "--frames", "0:20", *quiet], cwd=self.folder,
                                      capture_output=True, text=True, check=False)
                self.assertIn(f"with depth.scale {scale}; with 5000 it would be", done.stderr)

    def test_cloud_and_octree_from_a_trajectory(self):
        self.cairn("slam", "room", "-o", "run", "--quiet")
        self.cairn("cloud", "room", "--poses", "run/trajectory.txt", "-o", "room.ply", "--voxel", "0.02", "--quiet")
        self.cairn("octree", "room.ply", "-o", "from_cloud.bt", "--quiet")
        self.cairn("octree", "room", "--poses", "run/trajectory.txt", "-o", "room.ot", "--quiet")
        self.assertTrue((self.folder / "room.ot").read_bytes().startswith(b"# Octomap OcTree file"))
        self.assertIn(b"id ColorOcTree\n", (self.folder / "room.ot").read_bytes()[:300])
        self.assertTrue((self.folder / "from_cloud.bt").read_bytes().startswith(b"# Octomap OcTree binary file"))

    def test_an_interrupted_run_writes_what_was_done(self):
        self.cairn("simulate", "room", "-o", "long", "--frames-count", "200", "--scale", "0.5", "--quiet")
        process = subprocess.Popen([Path(sys.argv[1]).resolve(), "slam", "long", "-o", "run", "--threads", "1", "--json"], cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and program.processor_seconds(process.pid) < 1.0:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=program.TIME_LIMIT_S)
        self.assertEqual(process.returncode, 0, errors)
        frames = json.loads(output)["frames"]
        self.assertGreater(frames["processed"], 0)
        self.assertLess(frames["processed"], 200, "the run was over before it was interrupted")
        written = (self.folder / "run/trajectory.txt").read_text().splitlines()
        self.assertEqual(len(written) - 1, frames["tracked"])
        for name in ("cloud.ply", "octree.ot", "graph_after.g2o", "map/map.json"):
            self.assertTrue((self.folder / "run" / name).is_file(), name)


class Photos(program.Quality):
    """Images of a room by cameras of other resolutions than the map's, which their calibrations say."""

    def test_are_found_at_other_resolutions(self):
        self.cairn("simulate", "room", "-o", "room", "--frames-count", "20", "--scale", "0.5", "--quiet")
        self.cairn("map", "room", "--poses", "room/groundtruth.txt", "-o", "map", "--quiet")
        for scale, size in (("1.25", "800x600 pixels, scaled to 320x240"), ("0.3", "192x144 pixels, scaled to 320x240")):
            self.cairn("simulate", "room", "-o", "other", "--frames-count", "20", "--scale", scale, "--quiet")
            for options in ((), ("--mono",)):
                run = self.figures("localize", "map", "other", *options, "--frames", "1::4", "-o", "found")
                self.assertIn(size, run["camera"])
                self.assertEqual(run["images"]["good"], 5, f"{scale} {options}")
                errors = self.figures("evaluate", "found", "other", "--align", "none")
                self.assertLessEqual(errors["ate_max_m"], 0.01)
                self.assertLessEqual(errors["ate_max_deg"], 0.3)
            run = self.figures("localize", "map", "other/rgb", "--camera", "other/camera.yaml", "--frames", "1::4", "-o", "found", "--draw")
            self.assertEqual((run["images"]["good"], run["stamps"][:9]), (5, "positions"))
        said = self.cairn("localize", "map", "other", "--frames", "1:2", "-o", "found", "--quiet")
        self.assertRegex(said, r"position +\S+ cm within the map \(standard deviation\), protection level \S+ cm")


if __name__ == "__main__":
    program.main()
