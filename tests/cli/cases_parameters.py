#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Parameters by --config and --set: ranges, former names, retired ones, --help, and the tables in the documents.

With --mend after the program, writes the tables into the documents instead of comparing them.
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from harness import Case, CommandLine, main
from inputs import file, png_bytes, tum_sequence

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = {"slam": "README.md", "localize": "README.md", "map": "docs/mapping.md"}

# Former name, present name, a value.
RENAMED = (("max_norm", "max_motion", 2), ("max_norm_lp", "max_loop_motion", 3), ("min_good_match", "min_matches", 20),
           ("good_match_threshold", "max_distance_factor", 10), ("check_loop_closure", "close_loops", "yes"),
           ("weak_tracking", "weak_inliers", 80), ("number_of_features", "features", 700), ("max_num_lost", "lost_frames", 10))


def parameter_file(lines):
    return file("p.yaml", "".join(f"{name}: {value}\n" for name, value in lines))


def printed_table(program, command):
    done = subprocess.run([program, command, "--parameters", "markdown"], capture_output=True, text=True, check=True)
    return done.stdout


def marked(command):
    """What matches the lines between the marks of a command's table, the marks as groups."""
    begin, end = re.escape(f"<!-- parameters of cairn {command} -->\n"), re.escape("<!-- end -->")
    return re.compile(f"({begin})(.*?)({end})", re.DOTALL)


def mend(program):
    for command, name in DOCUMENTS.items():
        table = printed_table(program, command)
        text = (ROOT / name).read_text()
        (ROOT / name).write_text(marked(command).sub(lambda found: found[1] + table + found[3], text))


class Documents(unittest.TestCase):
    maxDiff = None

    def check(self, command):
        name = DOCUMENTS[command]
        found = marked(command).search((ROOT / name).read_text())
        self.assertIsNotNone(found, f"{name} has no marks for the parameters of cairn {command}")
        self.assertEqual(found[2], printed_table(CommandLine.program, command),
                         f"{name} differs from what cairn {command} prints. This mends it:\n"
                         f"  python3 tests/cli/cases_parameters.py {CommandLine.program} --mend")

    def test_parameters_of_slam(self):
        self.check("slam")

    def test_parameters_of_map(self):
        self.check("map")

    def test_parameters_of_localize(self):
        self.check("localize")


class ConfigOfARun(unittest.TestCase):
    def test_has_present_names_and_is_read_again(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            tum_sequence("seq")(folder)
            old = [(former, value) for former, _, value in RENAMED] + [("mapping.triangulate", "no")]
            parameter_file(old)(folder)
            self.slam(folder, "first", "p.yaml", warnings=len(old))
            config = (folder / "first/config.yaml").read_text()
            for former, present, value in RENAMED:
                self.assertIn(f"\n{present}: {value}\n", config)
                self.assertNotIn(f"\n{former}:", config)
            self.assertNotIn("triangulate", config)
            self.slam(folder, "again", "first/config.yaml", warnings=0)
            self.assertEqual((folder / "again/config.yaml").read_text(), config)

    def slam(self, folder, output, config, warnings):
        done = subprocess.run([CommandLine.program, "slam", "seq", "-o", output, "--config", config, "--quiet"], cwd=folder,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)  # its images are grey: a map of one frame
        self.assertEqual(done.stderr.count("cairn: "), warnings, done.stderr)


def no_sequence(name, parameters, says, given=(), messages=1):
    """A row that ends when the parameters are right: there is no sequence."""
    return Case(name, f"slam no -o run {parameters}", says, given, messages=messages)


# The lines of the RGB-D tutorial's file that are no names of today, as they are written.
TUTORIAL = """\
# \u53c2\u6570
detector=ORB
descriptor=ORB
good_match_threshold=10
camera.cx=31.5;
camera.cy=23.5;
camera.fx=50.0;
camera.fy=50.0;
camera.scale=1000.0;
start_index=1
end_index=3
rgb_dir=/home/another/rgb_png/
rgb_extension=.png
depth_dir=../data/depth_png/
depth_extension=.png
voxel_grid=0.01
visualize_pointcloud=yes
min_good_match=10 \u6700\u5c11
min_inliers=5
max_norm=0.2
keyframe_threshold=0.1
max_norm_lp=2.0
check_loop_closure=yes
nearby_loops=5
random_loops=5
"""
BOOK = """\
%YAML:1.0
dataset_dir: /home/another/fr1_desk
camera.fx: 50
camera.fy: 50
camera.cx: 31.5
camera.cy: 23.5
camera.depth_scale: 1000
number_of_features: 500
scale_factor: 1.2
level_pyramid: 4
match_ratio: 2.0
max_num_lost: 10
min_inliers: 30
keyframe_rotation: 0.1
keyframe_translation: 0.1
map_point_erase_ratio: 0.1
"""


def numbered_sequence(root):
    """Files 1 to 3 in the folders of the tutorial, without a calibration."""
    for number in (1, 2, 3):
        file(f"seq/rgb_png/{number}.png", png_bytes())(root)
        file(f"seq/depth_png/{number}.png", png_bytes(kind="gray16", value=2000))(root)


CASES = [
    # files of others
    Case("the tutorial's file is found and runs unchanged", "slam seq -o run --no-cloud --no-octree",
         ("seq/parameters.txt is taken for --config", "'visualize_pointcloud' changes nothing", "rgb_dir '/home/another/rgb_png/' is no folder here"),
         (numbered_sequence, file("seq/parameters.txt", TUTORIAL)), code=0, prints=("2 of 2 tracked",), leaves=("run",)),
    Case("slambook's file", "slam seq -o run --config default.yaml --no-cloud --no-octree",
         ("default.yaml:2: 'dataset_dir' changes nothing", "'camera.depth_scale' is now called 'camera.scale'", "between any two of 3 frames"),
         (tum_sequence(), file("default.yaml", BOOK)), code=1, leaves=("run",)),
    Case("two images become a cloud", "cloud seq/rgb/0.png seq/depth/0.png --camera 50,50,31.5,23.5,1000 -o pair.ply", given=(tum_sequence(),), code=0,
         prints=("1 of 1 fused",), leaves=("pair.ply",)),
    Case("two images without scale", "cloud seq/rgb/0.png seq/depth/0.png --camera 50,50,31.5,23.5 -o pair.ply",
         ("--camera: expected the scale of the depth image",), (tum_sequence(),)),
    Case("two images without camera", "cloud seq/rgb/0.png seq/depth/0.png -o pair.ply", ("--camera: expected the camera of the two images",),
         (tum_sequence(),)),
    Case("two images with poses", "cloud seq/rgb/0.png seq/depth/0.png --camera tum-fr1 --poses p.txt -o pair.ply",
         ("--poses: expected a sequence, found two images",), (tum_sequence(),)),
    Case("parameters.txt of another program", "slam no -o run", ("parameters.txt is not taken: 'epochs' in line 1 is no parameter", "no: expected a folder"),
         (file("parameters.txt", "epochs=100\n"),), messages=2),
    # former names
    no_sequence("former name", "--set max_norm=2", ("cairn: --set: 'max_norm' is now called 'max_motion'; both are accepted.\n",), messages=2),
    no_sequence("former names in a file", "--quiet --config p.yaml",
                tuple(f"cairn: p.yaml:{line}: '{former}' is now called '{present}'; both are accepted.\n"
                      for line, (former, present, _) in enumerate(RENAMED, 1)),
                (parameter_file([(former, value) for former, _, value in RENAMED]),), messages=1 + len(RENAMED)),
    no_sequence("present names in a file", "--config p.yaml", ("no: expected a folder with a sequence",),
                (parameter_file([(present, value) for _, present, value in RENAMED]),)),
    no_sequence("former name out of range", "--set max_norm=-1",
                ("max_motion: expected rad + m above 0, found -1.\n  Leave it out for the default.",), messages=2),
    no_sequence("former name after the present one", "--set max_motion=1 --set max_norm=-1", ("max_motion: expected rad + m above 0, found -1",), messages=2),
    no_sequence("former name before the present one", "--set max_norm=-1 --set max_motion=1", ("no: expected a folder with a sequence",), messages=2),
    no_sequence("former name misspelt", "--set max_nrm=1", ("found 'max_nrm'", "Did you mean 'max_motion'?")),
    # retired ones
    no_sequence("retired parameter as earlier runs have it", "--config p.yaml",
                ("cairn: p.yaml:2: 'mapping.triangulate' was removed, as it improved", "'no' is accepted and changes nothing.\n"),
                (parameter_file([("features", 500), ("mapping.triangulate", "no")]),), messages=2),
    no_sequence("retired parameter that would change something", "--config p.yaml",
                ("p.yaml:2: expected 'no' for 'mapping.triangulate', which was removed, found 'yes'.\n  Leave it out",),
                (parameter_file([("features", 500), ("mapping.triangulate", "yes")]),)),
    # ranges
    no_sequence("range of the octree", "--set octree.resolution=0", ("octree.resolution: expected metres above 0, up to 1000, found 0",)),
    no_sequence("range of the cloud", "--set voxel_grid=0", ("voxel_grid: expected metres above 0, found 0.\n  0.01 suits a room",)),
    no_sequence("part of a noise that is estimated", "--set depth.sigma_m=0.01",
                ("depth.sigma_m: expected 0 unless depth.sigma_disparity_px is above 0, found 0.01",)),
    no_sequence("noise below 0", "--set depth.sigma_disparity_px=-1", ("depth.sigma_disparity_px: expected pixels from 0, found -1",)),
    no_sequence("range over two parameters", "--set depth.min=3 --set depth.max=2", ("depth.max: expected metres above depth.min, found 2",)),
    no_sequence("documented switch", "--set stereo.search_images=maybe", ("expected yes or no for 'stereo.search_images', found 'maybe'",)),
    no_sequence("one of three words", "--set stereo.self_calibration=maybe", ("stereo.self_calibration: expected auto, report or off, found maybe.",)),
    # help
    *(Case(f"help of {command} explains parameters", f"{command} --help", code=0, prints=(f"Example: cairn {command}", "--parameters FORMAT", *prints))
      for command, prints in (("slam", ("  max_motion  ", "  rad + m above 0. Motion between neighbouring")),
                              ("map", ("  clean.max_std_m  ", "  metres above 0. Largest standard deviation")),
                              ("localize", ("  trust.min_inliers  ", "  at least 4 inliers. Fewest inliers")))),
    *(Case(f"parameters of {command} need no input", f"{command} --parameters text", code=0, prints=(prints,))
      for command, prints in (("slam", "  max_motion  "), ("map", "  clean.max_std_m  "), ("localize", "  trust.min_inliers  "))),
    Case("parameters in an unknown format", "map --parameters html", ("--parameters", "markdown")),
    Case("parameters without a format", "map --parameters", ("--parameters",)),
]

if __name__ == "__main__":
    if "--mend" in sys.argv[2:]:
        mend(str(Path(sys.argv[1]).resolve()))
    else:
        main(CASES, (Documents, ConfigOfARun))
