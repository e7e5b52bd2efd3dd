# SPDX-License-Identifier: Apache-2.0
"""cairn calibrate on simulated streets with planted errors. Arguments: the program."""

import re

import program

PLANTED = {"baseline factor": 1.005, "time offset": 0.02, "boresight x": 0.2, "boresight y": -0.2, "boresight z": 0.2,
           "lever arm x": 0.1, "lever arm y": -0.1, "lever arm z": 0.1}
NEAR = {"baseline factor": 0.003, "time offset": 0.003, "boresight": 0.06, "lever arm": 0.03}  # at half the pixels
ERRORS = ("--baseline-error", "0.5", "--pose-time-offset", "0.02", "--lever-arm-error", "0.1", "-0.1", "0.1", "--boresight-error", "0.2", "-0.2", "0.2")


class Calibrate(program.Quality):
    def street(self, *options, scale="0.5"):
        self.simulate("street", "street", "--frames-count", "150", "--scale", scale, *options)

    def calibrate(self, output, *options):
        figures = self.figures("calibrate", "street", "-o", output, *options)
        return {quantity["name"]: quantity for quantity in figures["quantities"]}

    def by_poses(self, output, *options):
        return self.calibrate(output, "--poses", "street/body_poses.csv", *options)

    def assert_near(self, found, true):
        """Within what is claimed, and within 3.5 of its standard deviations."""
        claimed = next(limit for name, limit in NEAR.items() if found["name"].startswith(name))
        error = abs(found["value"] - true)
        self.assertLess(error, claimed, found)
        self.assertLess(error, 3.5 * found["sigma"], found)


class Bends(Calibrate):
    def test_planted_errors_are_found_and_written(self):
        self.street(*ERRORS)
        found = self.by_poses("found.yaml", "--apply-baseline")
        for name, quantity in found.items():
            if quantity["finding"] != "undetermined" and name in PLANTED:
                self.assert_near(quantity, PLANTED[name])
        for name in ("time offset", "boresight x", "boresight y", "lever arm x", "lever arm y"):
            self.assertEqual(found[name]["finding"], "off", found[name])
        self.assertEqual(found["lever arm z"]["finding"], "undetermined")  # the drive is level
        self.assertIn("0.7]", (self.folder / "found.yaml").read_text())  # so its stated height stays
        self.assertFalse(any(quantity["finding"] == "off" for quantity in found.values() if quantity["unit"] == "px"))
        again = self.by_poses("again.yaml", "--camera", "found.yaml", "--pose-offset", found["time offset"]["value"])
        self.assertEqual([name for name, quantity in again.items() if quantity["finding"] == "off"], [])

    def test_nothing_is_off_where_nothing_was_planted(self):
        self.street("--body-poses", "--seed", "3")
        found = self.by_poses("found.yaml")
        self.assertEqual([name for name, quantity in found.items() if quantity["finding"] == "off"], [])
        self.assertEqual(found["time offset"]["finding"], "as stated")
        for name, quantity in found.items():
            if name in PLANTED and name != "lever arm z":
                self.assert_near(quantity, 1 if name == "baseline factor" else 0)


class Straight(Calibrate):
    def test_what_a_straight_drive_does_not_show_is_undetermined(self):
        self.street("--route", "straight", *ERRORS)
        found = self.by_poses("found.yaml")
        for name in ("time offset", "boresight x", "lever arm x", "lever arm y", "lever arm z"):
            self.assertEqual(found[name]["finding"], "undetermined", found[name])
            self.assertIn("only", found[name]["why"])
        for name in ("boresight y", "boresight z", "baseline factor"):
            self.assert_near(found[name], PLANTED[name])
        self.assertIn("translation: [1.4, 0.3, 0.7]", (self.folder / "found.yaml").read_text())


class TurnedCamera(Calibrate):
    TURN = ("--right-rotation", "0.1", "0.1", "0.1")
    PLANTED_PX = 721.5 / 4 * 0.1 * 3.14159265 / 180  # c1 of the disparities, at a quarter of the pixels

    def test_what_was_written_is_not_found_again(self):
        self.street(*self.TURN, scale="0.25")
        found = self.calibrate("found.yaml")
        self.assertEqual(found["rows xy"]["finding"], "off")
        self.assertEqual(found["disparity 1"]["finding"], "off")
        self.assertAlmostEqual(found["disparity 1"]["value"], self.PLANTED_PX, delta=0.08)
        again = self.calibrate("again.yaml", "--camera", "found.yaml")
        self.assertEqual([name for name, quantity in again.items() if quantity["finding"] == "off"], [])
        self.assertEqual((self.folder / "again.yaml").read_bytes(), (self.folder / "found.yaml").read_bytes())
        run = self.figures("slam", "street", "-o", "run", "--camera", "found.yaml")
        self.assertEqual(run["stereo_calibration"]["rows"]["pairs"], 0)  # what is stated is not measured again
        scale = self.figures("evaluate", "run", "street")["sim3"]["scale"]
        self.assertAlmostEqual(scale, 1, delta=0.006)
        plain = self.figures("slam", "street", "-o", "plain", "--set", "stereo.self_calibration=off")
        self.assertGreater(plain["ate_rmse_m"], 3 * run["ate_rmse_m"])

    def test_rectified_images_state_what_they_still_have(self):
        self.street(*self.TURN, scale="0.25")
        self.calibrate("found.yaml")
        self.cairn("rectify", "street", "--camera", "found.yaml", "-o", "rectified", "--quiet")
        stated = self.figures("info", "rectified")["right_correction"]
        self.assertEqual(stated["rows_px"], [0] * 6)
        self.assertEqual(stated["disparity_px"], self.figures("info", "street", "--camera", "found.yaml")["right_correction"]["disparity_px"])

    def test_writes_the_same_bytes_at_any_number_of_threads(self):
        self.street(*self.TURN, "--body-poses", scale="0.25")
        runs = [self.cairn("calibrate", "street", "--poses", "street/body_poses.csv", "-o", "found.yaml", "--json", "--threads", threads)
                + (self.folder / "found.yaml").rename(self.folder / f"{threads}.yaml").read_text() for threads in (1, 2)]
        self.assertEqual(runs[0], runs[1])


class ShiftedDepth(program.Quality):
    """A room whose depth images lie beside their colour images, or are later."""

    def setUp(self):
        super().setUp()
        self.simulate("room", "seq", "--frames-count", "200")

    def calibrate(self, output, *options):
        return {quantity["name"]: quantity for quantity in self.figures("calibrate", "seq", "-o", output, *options)["quantities"]}

    def test_a_shift_is_found_and_written(self):
        camera = self.folder / "seq/camera.yaml"
        right = camera.read_text()
        moved = re.search("camera: ({.*})", right).group(1).replace("cx: 319.5", "cx: 323.5").replace("cy: 239.5", "cy: 236.5")
        camera.write_text(right.replace("depth:", f"depth:\n  camera: {moved}"))
        found = self.calibrate("found.yaml")
        for name, planted in (("depth shift u", 4), ("depth shift v", -3)):
            self.assertEqual((found[name]["finding"], found[name]["written"]), ("off", True), found[name])
            self.assertAlmostEqual(found[name]["value"], planted, delta=0.6)
        again = self.calibrate("again.yaml", "--camera", "found.yaml")
        self.assertEqual([name for name, quantity in again.items() if quantity["finding"] == "off"], [])

    def test_a_delay_is_found_where_there_is_one(self):
        without = self.calibrate("without.yaml")
        self.assertEqual([name for name, quantity in without.items() if quantity["finding"] == "off"], [])
        self.assertEqual(without["depth delay"]["finding"], "as stated")
        (self.folder / "seq/associations.txt").unlink()
        lines = [line.split() for line in (self.folder / "seq/depth.txt").read_text().splitlines()[1:]]
        (self.folder / "seq/depth.txt").write_text("".join(f"{a[0]} {b[1]}\n" for a, b in zip(lines, lines[1:])))
        found = self.calibrate("found.yaml")["depth delay"]  # by a thirtieth of a second
        self.assertEqual(found["finding"], "off", found)
        self.assertAlmostEqual(found["value"], 1 / 30, delta=0.006)


if __name__ == "__main__":
    program.main()
