# SPDX-License-Identifier: Apache-2.0
"""The program on real recordings. Arguments: the program, the folder of recordings (README, "Tests")."""

import shutil
import subprocess

import program

# What ORB-SLAM2 reaches on the same frames is 4.9 cm; the truth itself is good to some centimetres.
REDKITCHEN_ATE_M = 0.06


class Redkitchen(program.Quality):
    def test_follows_the_camera_the_same_at_any_number_of_threads(self):
        sequence = program.recordings() / "rgbd/redkitchen"
        run = self.figures("slam", sequence, "-o", "run1", "--threads", "1")
        self.assertGreaterEqual(run["frames"]["tracked"], 0.98 * 600)
        self.assertLessEqual(run["peak_memory_mb"], 1000)
        evaluation = self.figures("evaluate", "run1", sequence)
        self.assertLessEqual(evaluation["ate_rmse_m"], REDKITCHEN_ATE_M)
        self.cairn("slam", sequence, "-o", "run2", "--threads", "2", "--quiet")
        self.assert_same_files("run1", "run2", but=("run.json",))


class FiveViews(program.Quality):
    """Numbered files with poses by frame number."""

    def setUp(self):
        super().setUp()
        self.sequence = program.recordings() / "rgbd/five_views"

    def test_info(self):
        info = self.figures("info", self.sequence)
        self.assertEqual((info["format"], info["frames"], info["truth_poses"]), ("numbered", 5, 5))

    def test_cloud(self):
        for name in ("five.ply", "five.pcd"):
            cloud = self.figures("cloud", self.sequence, "--poses", self.sequence / "trajectory.txt", "-o", name)
            self.assertEqual(cloud["frames"]["fused"], 5)
            self.assertGreater(cloud["points"], 100_000)

    def test_octree_that_octomap_reads(self):
        for name in ("five.bt", "five.ot"):
            self.figures("octree", self.sequence, "-o", name)
            self.assertTrue(shutil.which("convert_octree"), "OctoMap's own tools are missing (package octomap-tools)")
            done = subprocess.run(["convert_octree", name, f"{name}.converted.bt"], cwd=self.folder, capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater((self.folder / f"{name}.converted.bt").stat().st_size, 1000)


class Graphs(program.Quality):
    def test_reach_the_known_minima(self):
        for name, chi2 in (("sphere2500", 727.16), ("parking-garage", 1.2388)):
            source = program.recordings() / f"graphs/{name}.g2o"
            report = self.figures("graph", source, "-o", "out.g2o")
            self.assertLessEqual(report["chi2_after"], chi2)
            self.assertEqual(self.ids(source), self.ids(self.folder / "out.g2o"))

    @staticmethod
    def ids(path):
        """Tag and ids of each line, in order."""
        lines = [line.split() for line in path.read_text().splitlines() if line.strip()]
        return [line[:3] if line[0].startswith("EDGE") else line[:2] for line in lines]


if __name__ == "__main__":
    program.recordings()  # skips all at once
    program.main()
