# SPDX-License-Identifier: Apache-2.0
"""From simulation to evaluation, as a user would go, against the exact truth. Arguments: the program."""

import json
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import program

DOCS = Path(__file__).resolve().parents[2] / "docs"


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


class Loops(program.Quality):
    def test_closes_the_loops_of_a_long_walk(self):
        self.cairn("simulate", "room", "-o", "room", "--frames-count", "1000", "--loops", "2", "--quiet")
        run = self.figures("slam", "room", "-o", "run", "--no-cloud", "--no-octree")
        self.assertEqual(run["frames"]["tracked"], 1000)
        self.assertLessEqual(run["ate_rmse_m"], 0.007)
        self.assertLessEqual(run["peak_memory_mb"], 1500)


class Street(program.Quality):
    def test_keeps_the_scale_along_a_street(self):
        self.cairn("simulate", "street", "-o", "street", "--quiet")
        run = self.figures("slam", "street", "-o", "run")
        self.assertEqual(run["frames"]["tracked"], 200)
        evaluation = self.figures("evaluate", "run", "street")
        self.assertLessEqual(evaluation["ate_rmse_m"], 0.10)
        self.assertAlmostEqual(evaluation["sim3"]["scale"], 1, delta=0.003)


class Small(program.Quality):
    """On a quarter of the pixels, where accuracy is not the question."""

    def setUp(self):
        super().setUp()
        self.cairn("simulate", "room", "-o", "room", "--frames-count", "60", "--scale", "0.5", "--quiet")

    def test_writes_the_same_bytes_at_any_number_of_threads(self):
        for threads in (1, 2, 3):
            self.cairn("slam", "room", "-o", f"run{threads}", "--threads", threads, "--quiet")
        self.assert_same_files("run1", "run2", but=("run.json",))  # run.json holds times
        self.assert_same_files("run1", "run3", but=("run.json",))

    def test_a_run_can_be_repeated_from_its_configuration(self):
        self.cairn("slam", "room", "-o", "run", "--set", "features=700", "--set", "nearby_loops=3", "--quiet")
        self.cairn("slam", "room", "-o", "again", "--config", "run/config.yaml", "--quiet")
        self.assert_same_files("run", "again", but=("run.json",))

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
        process = subprocess.Popen([sys.argv[1], "slam", "long", "-o", "run", "--threads", "1", "--json"], cwd=self.folder,
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
        self.assertRegex(said, r"position +\S+ cm by noise alone \(standard deviation\), protection level \S+ cm")


if __name__ == "__main__":
    program.main()
