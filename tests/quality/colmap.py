# SPDX-License-Identifier: Apache-2.0
"""COLMAP reads what `cairn map --export colmap` writes. Arguments: the program. Skipped where COLMAP is not installed."""

import os
import re
import shutil
import subprocess
import sys

import program


class Export(program.Quality):
    def colmap(self, command, **options):
        """What it says; the test fails where it does."""
        arguments = [word for name, value in options.items() for word in (f"--{name}", str(value))]
        done = subprocess.run(["colmap", command, *arguments], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=program.TIME_LIMIT_S, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
        self.assertEqual(done.returncode, 0, f"colmap {command}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def analyse(self, path):
        """By name: the number that model_analyzer prints."""
        found = re.findall(r"^.*?([A-Z][\w ]+): ([\d.]+)(?:px)?$", self.colmap("model_analyzer", path=path), re.M)
        return {name: float(number) for name, number in found}

    def test_a_model_is_read_and_converted(self):
        self.cairn("simulate", "street", "-o", "street", "--frames-count", "30", "--scale", "0.5", "--quiet")
        self.cairn("map", "street", "-o", "map", "--export", "colmap", "--quiet")
        info = self.figures("info", "map")
        model = self.analyse("map/colmap")
        self.assertGreater(info["landmarks"], 500)
        self.assertEqual((model["Cameras"], model["Registered images"], model["Points"]), (2, 2 * info["keyframes"], info["landmarks"]))
        self.assertGreater(model["Observations"], 1.9 * info["sightings"])  # nearly all have a disparity, and so a place in the right image
        self.assertLessEqual(model["Observations"], 2 * info["sightings"])
        self.assertLess(model["Mean reprojection error"], 0.5)  # 0.28: poses are exact, and half a pixel too much would be seen
        for kind in ("BIN", "PLY"):
            (self.folder / kind).mkdir()
            self.colmap("model_converter", input_path="map/colmap", output_path="BIN" if kind == "BIN" else "PLY/model.ply", output_type=kind)
        self.assertEqual(self.analyse("BIN"), model)
        self.assertIn(b"element vertex %d\n" % info["landmarks"], (self.folder / "PLY/model.ply").read_bytes()[:200])
        for file in (self.folder / "map/colmap").glob("*.bin"):
            file.unlink()
        self.assertEqual(self.analyse("map/colmap"), model)  # the text holds the same

    def colors(self, path):
        """By number of the point, from a model's text."""
        lines = (self.folder / path / "points3D.txt").read_text().splitlines()
        return {int(words[0]): tuple(map(int, words[4:7])) for words in (line.split() for line in lines if not line.startswith("#"))}

    def test_the_images_are_opened_and_the_colours_theirs(self):
        self.cairn("simulate", "street", "-o", "street", "--frames-count", "10", "--scale", "0.5", "--quiet")
        self.cairn("map", "street", "-o", "map", "--export", "colmap", "--quiet")
        self.colmap("image_undistorter", image_path="street", input_path="map/colmap", output_path="dense")
        undistorted = sorted(str(path.relative_to(self.folder / "dense/images")) for path in (self.folder / "dense/images").rglob("*.png"))
        self.assertEqual(undistorted, [f"image_{side}/{frame:06}.png" for side in (0, 1) for frame in range(10)])
        (self.folder / "colored").mkdir()
        self.colmap("color_extractor", image_path="street", input_path="map/colmap", output_path="colored")
        self.colmap("model_converter", input_path="colored", output_path="colored", output_type="TXT")
        ours, theirs = self.colors("map/colmap"), self.colors("colored")  # theirs are the means of both cameras'
        differences = sorted(abs(ours[number][0] - theirs[number][0]) for number in theirs)
        self.assertEqual(ours.keys(), theirs.keys())
        self.assertLess(differences[len(differences) // 2], 3)
        self.assertLess(differences[len(differences) * 9 // 10], 12)
        self.assertGreater(len({color for color in ours.values()}), 50)


if __name__ == "__main__":
    if not shutil.which("colmap"):
        print("SKIPPED: COLMAP is not installed")
        sys.exit(program.SKIPPED)
    program.main()
