# SPDX-License-Identifier: Apache-2.0
"""Mapping with the poses of a receiver, on a real recording. Arguments: the program, the folder of recordings."""

import csv
import math
import os

import program
import receivers

CALIBRATION = (1242, 375, 721.5377, 609.5593, 172.854, 387.5744 / 721.5377)  # of drive 0039: its calib.txt
FRAMES = os.environ.get("CAIRN_DRIVE_FRAMES", "0:30")  # of 200; "0:200" for the whole drive
PLACE_STD, ANGLE_STD_DEG = (0.02, 0.03, 0.05), (0.03, 0.04, 0.1)
# Places differ by what 14 digits of a latitude leave, 1e-8 m, but a landmark that lies on the limit of a rule may fall in one map alone.
SAME_PLACE_M, SAME_SHARE = 1e-3, 0.995


class Receivers(program.Quality):
    def setUp(self):
        super().setUp()
        self.sequence = program.recordings() / "stereo/kitti_0039"
        self.drive = receivers.Drive(self.sequence)
        for axes in ("frd", "flu"):
            self.drive.write_camera(self.folder / f"{axes}.yaml", CALIBRATION, axes)

    def map(self, name, poses, *options, axes="frd"):
        figures = self.figures("map", self.sequence, "--camera", f"{axes}.yaml", "--poses", poses, "--frames", FRAMES, "-o", name, *options)
        self.assertGreater(figures["landmarks"], 3000)
        self.assertEqual(figures["pose_check"]["verdict"], "agreement")
        return receivers.read_landmarks(self.folder / name)

    def table(self, name, geodetic, *deviations):
        self.drive.write_table(self.folder / name, geodetic, *deviations)
        return name

    def assert_same_landmarks(self, a, b):
        shared = a.keys() & b.keys()
        self.assertGreaterEqual(len(shared), SAME_SHARE * max(len(a), len(b)), (len(a), len(b), len(shared)))
        for seen in shared:
            (place_a, covariance_a), (place_b, covariance_b) = a[seen], b[seen]
            self.assertLess(math.dist(place_a, place_b), SAME_PLACE_M)
            scale = max(covariance_a[0], covariance_a[4], covariance_a[8])
            self.assertLess(max(abs(x - y) for x, y in zip(covariance_a, covariance_b)), 1e-3 * scale)
        print(f"{len(shared)} of {len(a)} and {len(b)} landmarks, places within "
              f"{max(math.dist(a[seen][0], b[seen][0]) for seen in shared):.1e} m")

    def test_the_same_from_packets_and_tables(self):
        """Packets state one deviation, here given alike in the tables."""
        self.drive.write_oxts(self.folder / "oxts", 0.05)
        packets = self.map("packets", "oxts", axes="flu")
        geodetic = self.map("geodetic", self.table("geodetic.csv", True, (0.05,) * 3))
        local = self.map("local", self.table("local.csv", False, (0.05,) * 3))
        self.assert_same_landmarks(packets, geodetic)
        self.assert_same_landmarks(geodetic, local)
        for found, stated in zip(receivers.map_origin(self.folder / "packets"), receivers.ORIGIN):
            self.assertAlmostEqual(found, stated, places=8)
        for place, covariance in packets.values():
            self.assertGreater(min(covariance[0], covariance[4], covariance[8]), 0.05 ** 2)

    def test_the_same_from_tables_with_all_deviations(self):
        geodetic = self.map("geodetic", self.table("geodetic.csv", True, PLACE_STD, ANGLE_STD_DEG))
        local = self.map("local", self.table("local.csv", False, PLACE_STD, ANGLE_STD_DEG))
        self.assert_same_landmarks(geodetic, local)

    def test_deviations_of_angles_alone(self):
        geodetic = self.map("geodetic", self.table("geodetic.csv", True, None, ANGLE_STD_DEG))
        local = self.map("local", self.table("local.csv", False, None, ANGLE_STD_DEG))
        self.assert_same_landmarks(geodetic, local)

    def test_a_cheap_receiver(self):
        """Deviations of a metre are in the covariances, and take no landmark away. By the same poses and disparities: these are adjusted
        to what the given poses state."""
        alike = ("--exact-poses", "--set", "stereo.self_calibration=off")
        exact = self.map("exact", self.table("exact.csv", True), *alike)
        figures = self.figures("map", self.sequence, "--camera", "frd.yaml", "--frames", FRAMES, "-o", "cheap", "--poses",
                               self.table("cheap.csv", True, (1.0, 1.0, 2.0)), *alike)
        cheap = receivers.read_landmarks(self.folder / "cheap")
        self.assertEqual(exact.keys(), cheap.keys())
        self.assertEqual(figures["uncertainty"]["dominated_by_poses"], len(cheap))
        for seen, (place, covariance) in cheap.items():
            self.assertLess(math.dist(place, exact[seen][0]), 1e-9)
            for axis, variance in ((0, 1.0), (4, 1.0), (8, 4.0)):
                self.assertAlmostEqual(covariance[axis] - exact[seen][1][axis], variance, places=6)

    def test_images_are_found_in_a_georeferenced_map(self):
        self.map("map", self.table("geodetic.csv", True, PLACE_STD, ANGLE_STD_DEG), "--without", "4::5")
        found = self.figures("localize", "map", self.sequence, "--frames", f"4:{FRAMES.split(':')[1]}:5", "-o", "found")
        self.assertEqual(found["images"]["good"], found["images"]["total"])
        rows = [line.split() for line in (self.folder / "found/trajectory.txt").read_text().splitlines() if line[0] != "#"]
        self.assertGreaterEqual(len(rows), 0.9 * len(range(4, int(FRAMES.split(":")[1]), 5)))
        for time, *place in ([float(x) for x in row[:4]] for row in rows):
            frame = min(range(200), key=lambda i: abs(self.drive.times[i] - time))
            self.assertLess(math.dist(place, self.drive.cameras[frame][1]), 0.3)


class Limits(program.Quality):
    """Every landmark of a map holds against every limit, merged ones too."""

    # To merge what hardly belongs together, of tracks that end soon and begin again.
    EAGER = ("--set", "clean.duplicate_sigmas=8", "--set", "window=2")
    LIMITS = {"clean.max_rms_px": 0.7, "clean.min_frames": 4, "clean.depth.max": 40, "clean.depth.max_std": 6, "clean.distance.max_mean": 35,
              "clean.lateral.max": 20, "clean.angle_deg.max": 35, "clean.angle_deg.max_std": 6}

    def test_each_row_of_the_table(self):
        sequence = program.recordings() / "stereo/kitti_0039"
        settings = [word for name, value in self.LIMITS.items() for word in ("--set", f"{name}={value}")]
        figures = self.figures("map", sequence, "--frames", FRAMES, "-o", "map", *settings, *self.EAGER)
        self.assertGreater(figures["merged"], 10)
        with open(self.folder / "map/uvlist.txt", encoding="ascii") as table:
            names = table.readline().split()[1:]
            rows = [dict(zip(names, map(float, row))) for row in csv.reader(table, delimiter=" ")]
        self.assertEqual(len(rows), figures["landmarks"])
        columns = {"clean.max_rms_px": "rms_px", "clean.min_frames": "frames", "clean.depth.max": "max_depth", "clean.depth.max_std": "std_depth",
                   "clean.distance.max_mean": "mean_distance", "clean.lateral.max": "max_lateral", "clean.angle_deg.max": "max_angle_deg",
                   "clean.angle_deg.max_std": "std_angle_deg"}
        for name, limit in self.LIMITS.items():
            values = [row[columns[name]] for row in rows]
            rounding = 1 + 1e-5  # the table has six digits
            broken = [x for x in values if (x < limit if name == "clean.min_frames" else x > limit * rounding)]
            self.assertEqual(broken, [], name)
        self.assertEqual([row for row in rows if row["min_depth"] < 0.3 / 1.00001 or row["max_distance"] > 120], [])
        self.assertGreater(figures["cleaned"]["position_std"], 0)  # by independent noise, which the table does not state


if __name__ == "__main__":
    program.recordings()  # skips all at once
    program.main()
