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
        self.assertEqual((model["Registered images"], model["Points"], model["Observations"]),
                         (info["keyframes"], info["landmarks"], info["sightings"]))
        self.assertLess(model["Mean reprojection error"], 0.5)  # 0.28: poses are exact, and half a pixel too much would be seen
        for kind in ("BIN", "PLY"):
            (self.folder / kind).mkdir()
            self.colmap("model_converter", input_path="map/colmap", output_path="BIN" if kind == "BIN" else "PLY/model.ply", output_type=kind)
        self.assertEqual(self.analyse("BIN"), model)
        self.assertIn(b"element vertex %d\n" % info["landmarks"], (self.folder / "PLY/model.ply").read_bytes()[:200])


if __name__ == "__main__":
    if not shutil.which("colmap"):
        print("SKIPPED: COLMAP is not installed")
        sys.exit(program.SKIPPED)
    program.main()
