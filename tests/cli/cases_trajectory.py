#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bad trajectories, and such as do not determine what is asked, for evaluate and align."""

import functools
import shutil
import subprocess
import tempfile
from pathlib import Path

from harness import Case, CommandLine, main
from inputs import file, folder, replaced, trajectory, tum_sequence

POSES = (trajectory("a.txt"), trajectory("b.txt"))


def places(name, rows, begin=1.0):
    """A trajectory through these places, turned nowhere, a tenth of a second apart."""
    return file(name, "".join(f"{begin + 0.1 * i:.6f} {x} {y} {z} 0 0 0 1\n" for i, (x, y, z) in enumerate(rows)))


def pairs(name, rows, map_of=lambda place: place):
    """A file of pairs: each place, and where map_of takes it."""
    def pose(i, place):
        return f"{1 + 0.1 * i:.6f} " + " ".join(str(value) for value in place) + " 0 0 0 1"
    return file(name, "".join(f"{pose(i, place)} {pose(i, map_of(place))}\n" for i, place in enumerate(rows)))


BEND = [(0, 0, 0), (1, 0.1, 0), (2, 0.4, 0.1), (3, 0.9, 0.3)]
LINE = [(i, 2 * i, -i) for i in range(5)]
NEAR_LINE = [(i, 1e-3 * (i * 7 % 5), 1e-3 * (i * 3 % 4)) for i in range(20)]
NEAR_OTHER_LINE = [(i, 1e-3 * (i * 5 % 7), 1e-3 * (i * 2 % 3)) for i in range(20)]
AXES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
LATER = places("late.txt", BEND, begin=900)



def kitti(name, rows):
    """The places as KITTI's matrices, without time."""
    return file(name, "".join(f"1 0 0 {x} 0 1 0 {y} 0 0 1 {z}\n" for x, y, z in rows))


def euroc(name, rows, begin=1.0):
    return file(name, "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n" + "".join(
        f"{round(1e9 * (begin + 0.1 * i))},{x},{y},{z},1,0,0,0\n" for i, (x, y, z) in enumerate(rows)))


def geodetic(name, count):
    """A bend, of a body that looks north."""
    return file(name, "time,latitude,longitude,height,roll,pitch,heading\n" + "".join(
        f"{1 + 0.1 * i:.1f},{49 + 1e-5 * i:.6f},{8 + 1e-6 * i * i:.7f},{100 + 0.1 * i * i:.2f},0,0,0\n" for i in range(count)))


AXES_OF_COVARIANCE = ("rx", "ry", "rz", "x", "y", "z")
PLACES_OF_COVARIANCE = [(i, k) for i in range(6) for k in range(i, 6)]


def columns(prefix):
    """The names of the 21 columns of a covariance."""
    return ",".join(f"{prefix}{AXES_OF_COVARIANCE[i]}_{AXES_OF_COVARIANCE[k]}" for i, k in PLACES_OF_COVARIANCE)


def covariance(rotation, position, coupling=0.0):
    """The values of 21 columns: both standard deviations, and what x and y have in common."""
    diagonal = [rotation ** 2] * 3 + [position ** 2] * 3
    return ",".join(repr(diagonal[i] if i == k else coupling * position ** 2 if (i, k) == (3, 4) else 0.0) for i, k in PLACES_OF_COVARIANCE)


BOWL = [(0.1 * i, 0.02 * i * i, 0.01 * (i % 3)) for i in range(20)]
OFF = [0.01 * (i % 7 - 3) for i in range(20)]  # metres, along y: 2 cm RMS, 2 cm in the median
FOUND = [(x, y + off, z) for (x, y, z), off in zip(BOWL, OFF)]
EMPTY = "," * 20


def found(sets=("cov_",), values=covariance(0.001, 0.02), weak=(), name="run"):
    """A run of cairn localize that is off by OFF; every fifth image more is not found."""
    rows = [f"{i},{1 + 0.1 * i:.9f},{i}.png,{'weak' if i in weak else 'good'}," + ",".join([values] * len(sets)) for i in range(20)]
    rows += [f"{i},{1 + 0.1 * i:.9f},{i}.png,none," + ",".join([EMPTY] * len(sets)) for i in range(20, 24)]
    table = "# poses\nframe,stamp_s,file,verdict," + ",".join(columns(prefix) for prefix in sets) + "\n" + "\n".join(rows) + "\n"
    def make(root):
        places(f"{name}/trajectory.txt", FOUND)(root)
        file(f"{name}/localization.csv", table)(root)
    return make


def keyframes(first=covariance(0.001, 0.02), previous=covariance(0.001, 0.02)):
    """A run of cairn slam whose keyframes are every second pose; a second component begins at 2 s."""
    def row(i):
        return f"{1 + 0.1 * i:.9f},{first},{EMPTY if i in (0, 10) else previous}\n"
    def make(root):
        places("run/trajectory.txt", FOUND)(root)
        places("run/keyframes.txt", FOUND)(root)
        file("run/keyframe_covariances.csv", f"# keyframes\nstamp_s,{columns('first_cov_')},{columns('previous_cov_')}\n" + "".join(map(row, range(0, 20, 2))))(root)
    return make


TRUTH = places("ref.txt", BOWL)


@functools.lru_cache(maxsize=None)
def mapped_street():
    """The files of a small street with its true depth, and of a map of it, made once."""
    with tempfile.TemporaryDirectory() as name:
        for command in ("simulate street -o street --scale 0.25 --frames-count 8 --depth-truth", "map street --poses street/poses.txt -o map"):
            subprocess.run([CommandLine.program, *command.split(), "--quiet"], cwd=name, check=True, capture_output=True)
        return {str(path.relative_to(name)): path.read_bytes() for path in Path(name).rglob("*") if path.is_file()}


def street_and_map(root):
    for name, contents in mapped_street().items():
        file(name, contents)(root)


def moved(metres):
    """Moves the street's truth to the side."""
    def make(root):
        rows = [line.split() for line in (root / "street/poses.txt").read_text().splitlines()]
        for row in rows:
            row[3] = repr(float(row[3]) + metres)
        (root / "street/poses.txt").write_text("".join(" ".join(row) + "\n" for row in rows))
    return make


CASES = [
    Case("evaluate images without times", "evaluate run ref.txt", ("run: its stamps are positions of the images. They pair with REF only if",),
         (trajectory("run/trajectory.txt"), file("run/run.json", '{"stamps": "positions of the images"}'), trajectory("ref.txt")), code=0),
    Case("evaluate", "evaluate a.txt b.txt", given=POSES, code=0, prints=("ATE se3", "ATE sim3", "RPE 1 frame")),
    Case("identical trajectories", "evaluate a.txt a.txt --json", given=POSES, code=0, prints=('"status": "ok"', '"drift": null')),
    Case("several estimates", "evaluate a.txt b.txt c.txt b.txt", given=(*POSES, trajectory("c.txt", 9)), code=0,
         prints=("reference  b.txt, 3 poses", "a.txt", "c.txt", "drift")),
    Case("several estimates drawn", "evaluate a.txt c.txt b.txt --plot all.svg", given=(*POSES, trajectory("c.txt", 9)), code=0,
         leaves=("all.svg",)),
    Case("several lengths of RPE", "evaluate a.txt b.txt --rpe-unit metres --rpe-delta 0.01,0.005", given=POSES, code=0,
         prints=("RPE 1 frame", "RPE 0.01 m", "RPE 0.005 m", "no RPE over 1 s")),
    Case("share within a tolerance", "evaluate a.txt b.txt --align none --within 0.05,5 --queries 10", given=(*POSES, trajectory("b.txt", 5)), code=0,
         prints=("percentiles, none", "50 %", "99 %", "within 0.05 m and 5 deg", "of the pairs", "of EST", "of REF", "of the queries",
                 "100.0 % of 3", "60.0 % of 5", "30.0 % of 10")),
    Case("shares as JSON", "evaluate a.txt b.txt --align none --within 0.05,5 --within 1,1 --json", given=(*POSES, trajectory("b.txt", 5)), code=0,
         prints=('"share_of_reference": 0.6', '"share_of_queries": null', '"position_m": 1.0', '"percent": 99.0')),
    Case("shares of several", "evaluate a.txt c.txt b.txt --within 0.05,5", given=(*POSES, trajectory("c.txt", 9)), code=0,
         prints=("percentiles, se3", "within 0.05 m and 5 deg", "33.3 % of 9")),
    Case("shares where one has no pairs", "evaluate a.txt late.txt b.txt --within 0.05,5", ("late.txt: no pose of EST",), (*POSES, LATER), code=1,
         prints=("within 0.05 m and 5 deg",)),
    Case("tolerance of one number", "evaluate a.txt b.txt --within 0.05", ("--within: expected 2 numbers, metres and degrees, found '0.05'",), POSES),
    Case("tolerance of zero", "evaluate a.txt b.txt --within 0,5", ("--within: expected metres and degrees above 0, found '0,5'",), POSES),
    Case("tolerance that is no number", "evaluate a.txt b.txt --within nan,5", ("--within: expected 2 numbers",), POSES),
    Case("fewer queries than poses", "evaluate a.txt b.txt --queries 2", ("--queries: expected at least 3, the poses of a.txt, found 2",), POSES),
    Case("reference is missing", "evaluate a.txt", ("REF is required",), POSES),
    Case("half a frame", "evaluate a.txt b.txt --rpe-delta 1,2.5", ("--rpe-delta: expected a whole number of frames, found 2.5",), POSES),
    Case("no length of RPE", "evaluate a.txt b.txt --rpe-delta 0", ("--rpe-delta",), POSES),
    Case("no such estimate", "evaluate a.txt b.txt", ("a.txt: expected a readable file",), (trajectory("b.txt"),)),
    Case("no such estimate among several", "evaluate b.txt a.txt b.txt", ("a.txt: expected a readable file",), (trajectory("b.txt"),)),
    Case("line with 7 numbers", "evaluate a.txt b.txt", ("a.txt:2: expected 8 values (t tx ty tz qx qy qz qw), found 7",),
         (*POSES, file("a.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n"))),
    Case("word among numbers", "evaluate a.txt b.txt", ("a.txt:1: expected a number for ty, found 'x'",),
         (*POSES, file("a.txt", "1 0 x 0 0 0 0 1\n"))),
    Case("not a number", "evaluate a.txt b.txt", ("a.txt:1: expected a number for tz, found 'nan'",),
         (*POSES, file("a.txt", "1 0 0 nan 0 0 0 1\n"))),
    Case("infinite number", "evaluate a.txt b.txt", ("a.txt:1: expected a number for qz, found 'inf'",),
         (*POSES, file("a.txt", "1 0 0 0 0 0 inf 1\n"))),
    Case("beyond the planets", "evaluate a.txt b.txt", ("a.txt:1: expected tx of at most 1e12 metres, found 1e+200",),
         (*POSES, file("a.txt", "1 1e200 0 0 0 0 0 1\n"))),
    Case("time goes backwards", "evaluate a.txt b.txt", ("a.txt:2: expected a time stamp after 2.000000000, found 1.000000000",),
         (*POSES, file("a.txt", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"))),
    Case("empty trajectory", "evaluate a.txt b.txt", ("a.txt: expected poses, one a line",), (*POSES, file("a.txt", ""))),
    Case("folder that is no run", "evaluate run b.txt", ("run: expected a trajectory file, or a run's folder",),
         (*POSES, folder("run"))),
    Case("picture of another format", "evaluate a.txt b.txt --plot a.png", ("--plot", "'a.png' does not end in .svg"), POSES),
    Case("picture of coverage of another format", "evaluate a.txt b.txt --plot-coverage a", ("--plot-coverage", "'a' does not end in .svg"), POSES),
    Case("picture into a missing folder", "evaluate a.txt b.txt --plot no/a.svg", ("no/a.svg: expected to create the file",), POSES),
    # stated covariances
    Case("covariances of localised poses", "evaluate run ref.txt --align none", given=(found(), TRUTH), code=0,
         prints=("covariances, none", "in 50 %", "in the map: pose", "\n  position ", "\n  rotation ", "3.46 cm", "if honest")),
    Case("covariances under an alignment", "evaluate run ref.txt", given=(found(), TRUTH), code=0,
         prints=("covariances, se3", "The alignment hides the part of the error that all poses have in common; --align none shows it.")),
    Case("absolute covariances before those in the map", "evaluate run ref.txt --align none --json", given=(found(("cov_", "abs_cov_")), TRUTH), code=0,
         prints=('"covariances": [\n    {\n      "scope": "absolute"', '"scope": "in_map"', '"median_std_m": 0.0346', '"nominal": 0.99')),
    Case("covariances of weak poses apart", "evaluate run ref.txt --align none", given=(found(weak=(3, 4)), TRUTH), code=0,
         prints=("in the map: pose                 18", "in the map, weak poses: pose      2")),
    Case("covariances of keyframes", "evaluate run ref.txt --json", given=(keyframes(), TRUTH), code=0,
         prints=('"scope": "from_first"', '"scope": "from_previous"', '"errors": 8')),
    Case("covariances drawn", "evaluate run ref.txt --align none --plot-coverage c.svg", given=(found(), TRUTH), code=0, leaves=("c.svg",)),
    Case("covariances of one of several", "evaluate run run/trajectory.txt ref.txt --plot-coverage c.svg", given=(found(), TRUTH), code=0, leaves=("c.svg",),
         prints=("covariances, se3", "\nrun in the map: pose")),
    Case("covariances of a shifted run", "evaluate run ref.txt --offset 100 --align none --json", given=(found(), places("ref.txt", BOWL, 101.0)), code=0,
         prints=('"scope": "in_map"', '"without_truth": 0', '"errors": 20')),
    Case("a run without covariances", "evaluate run ref.txt", given=(found(), file("run/localization.csv", "frame,stamp_s,std_x_m\n1,1.0,0.1\n"), TRUTH),
         code=0, prints=("ATE se3",)),
    Case("no covariances to draw", "evaluate run ref.txt --plot a.svg --plot-coverage c.svg",
         ("run/localization.csv: expected covariances of poses that pair with REF, in columns cov_rx_rx to cov_z_z, found none",),
         (found(), file("run/localization.csv", "frame,stamp_s,std_x_m\n1,1.0,0.1\n"), TRUTH)),
    Case("a trajectory without covariances to draw", "evaluate a.txt b.txt --plot-coverage c.svg",
         ("a.txt: expected the folder of a run that states covariances of its poses, found none", "localization.csv"), POSES),
    Case("a covariance that is none", "evaluate run ref.txt",
         ("run/localization.csv:3: expected a positive definite covariance in cov_rx_rx to cov_z_z, found one that is not",),
         (found(values=covariance(0.001, 0.02, 2.0)), TRUTH)),
    Case("a column of a covariance is missing", "evaluate run ref.txt", ("localization.csv:2: expected 21 columns cov_rx_rx to cov_z_z, found none of the name cov_x_y",),
         (found(), replaced("run/localization.csv", ",cov_x_y", ",cov_y_x"), TRUTH)),
    Case("a word among covariances", "evaluate run ref.txt", ("localization.csv:3: expected a number for cov_rx_rx, found '?'",),
         (found(values="?" + covariance(0.001, 0.02)[5:]), TRUTH)),
    Case("covariances of another run", "evaluate run ref.txt", ("localization.csv:3: expected time stamps of the run's trajectory.txt, found none",),
         (found(), file("run/trajectory.txt", "".join(f"{1.05 + 0.1 * i:.3f} {x} {y} {z} 0 0 0 1\n" for i, (x, y, z) in enumerate(FOUND))),
          places("ref.txt", BOWL, 1.05))),
    # landmarks
    Case("landmarks of a simulated street", "evaluate map street --landmarks --plot-coverage c.svg", given=(street_and_map,), code=0, leaves=("c.svg",),
         prints=("keyframes   8 in street, 0.00", "deg from the truth (medians), alignment none", "distance from the true surface",
                 "along the surface's normal", "\non one surface ", "\nat an edge ", "\n10 to 20 m ", "\n3 to 4 observations ", "\nif honest ")),
    Case("landmarks as JSON", "evaluate map street --landmarks --json", given=(street_and_map,), code=0,
         prints=('"keyframes": 8', '"without_covariance": 0', '"distance_from_surface_m"', '"mean_nees_per_dof"', '"by_distance"')),
    Case("landmarks of a world of its own", "evaluate map street --landmarks",
         ("map: expected a map in the world of the truth, its keyframes within 5.0 m and 10 deg, found 30.0 m and 0.0 deg (medians)", "--align se3"),
         (street_and_map, moved(30))),
    Case("landmarks, aligned", "evaluate map street --landmarks --align se3 --json", given=(street_and_map, moved(30)), code=0, prints=('"alignment": "se3"', '"all"')),
    Case("landmarks of another camera", "evaluate map street --landmarks", ("map: expected a map of the camera of street: fx 190.375 ", "found fx 180.375 "),
         (street_and_map, replaced("street/calib.txt", "P0: 1.80", "P0: 1.90"), replaced("street/calib.txt", "P1: 1.80", "P1: 1.90"))),
    Case("landmarks without true depth", "evaluate map street --landmarks",
         ("street: expected a simulated sequence with the true depth in depth_truth/, found none", "simulate street --depth-truth"),
         (street_and_map, lambda root: shutil.rmtree(root / "street/depth_truth"))),
    Case("a true depth is missing", "evaluate map street --landmarks", ("depth_truth/000007.png: expected a readable",),
         (street_and_map, lambda root: (root / "street/depth_truth/000007.png").unlink())),
    Case("landmarks of no map", "evaluate street street --landmarks", ("street: expected the folder of a map",), (street_and_map,)),
    Case("landmarks against a trajectory", "evaluate map street/poses.txt --landmarks", ("street/poses.txt: expected a folder with a sequence",), (street_and_map,)),
    Case("landmarks of two maps", "evaluate map map street --landmarks", ("--landmarks: expected one map and its sequence, found 2 maps",), (folder("map"), folder("street"))),
    Case("landmarks within a tolerance", "evaluate map street --landmarks --within 1,1",
         ("--within: expected an option that has a meaning with --landmarks",), (folder("map"), folder("street"))),
    # what does not determine an answer
    # formats
    Case("files of KITTI", "evaluate a.txt b.txt", given=(kitti("a.txt", BEND), kitti("b.txt", BEND)), code=0,
         prints=("pairs      4 (100.0 % of EST, 100.0 % of REF), by their order, as no file has time stamps", "ATE se3")),
    Case("file of KITTI and one with stamps", "evaluate a.txt b.txt --json", given=(kitti("a.txt", BEND), places("b.txt", BEND)), code=0,
         prints=('"pairs": 4', '"unit": "seconds"')),
    Case("file with stamps and one of KITTI", "evaluate a.txt b.txt --json", given=(places("a.txt", BEND), kitti("b.txt", BEND)), code=0,
         prints=('"pairs": 4', '"unit": "seconds"')),
    Case("files of KITTI of other lengths", "evaluate a.txt b.txt",
         ("a.txt: expected poses that pair with those of b.txt: 4 poses without time stamps, found 3 poses without time stamps",),
         (kitti("a.txt", BEND[:3]), kitti("b.txt", BEND))),
    Case("file of KITTI shorter than one with stamps", "evaluate a.txt b.txt", ("a.txt: expected poses that pair with those of b.txt: 4 poses with time",),
         (kitti("a.txt", BEND[:3]), places("b.txt", BEND))),
    Case("files of KITTI have no seconds", "evaluate a.txt b.txt --rpe-unit seconds", ("--rpe-unit: expected frames or metres, as no file has time stamps",),
         (kitti("a.txt", BEND), kitti("b.txt", BEND))),
    Case("file of KITTI and a sequence", "evaluate a.txt seq --json", given=(tum_sequence(), kitti("a.txt", BEND[:3])), code=0, prints=('"pairs": 3',)),
    Case("file of KITTI that does not fit a sequence", "evaluate a.txt seq", ("a.txt: expected poses that pair with those of seq",),
         (tum_sequence(), kitti("a.txt", BEND[:2]))),
    Case("file of EuRoC", "evaluate a.csv b.txt --json", given=(euroc("a.csv", BEND), places("b.txt", BEND)), code=0, prints=('"pairs": 4',)),
    Case("file of EuRoC as the truth", "evaluate b.txt a.csv --json", given=(euroc("a.csv", BEND), places("b.txt", BEND)), code=0, prints=('"pairs": 4',)),
    Case("stamps in nanoseconds", "evaluate a.txt b.csv --json",
         given=(file("a.txt", "".join(f"{1403636579763555584 + 10**8 * i}.000000 {x} {y} {z} 0 0 0 1\n" for i, (x, y, z) in enumerate(BEND))),
                file("b.csv", "timestamp,x,y,z,qx,qy,qz,qw\n" + "".join(
                    f"{1403636579763555584 + 10**8 * i},{x},{y},{z},0,0,0,1\n" for i, (x, y, z) in enumerate(BEND)))),
         code=0, prints=('"pairs": 4',)),
    Case("geodetic tables", "evaluate a.csv b.csv --align none --json", given=(geodetic("a.csv", 5), geodetic("b.csv", 6)), code=0,
         prints=('"pairs": 5', '"ate_rmse_m": 0.0')),
    Case("repeated stamps", "evaluate a.txt b.txt --json",
         ("cairn: a.txt:2: a second pose, 1 m away, at 1.000000000; 1 such line left out, the first pose counts.",),
         (file("a.txt", "1.0 0 0 0 0 0 0 1\n1.0 1 0 0 0 0 0 1\n1.1 1 0.1 0 0 0 0 1\n1.2 2 0.4 0.1 0 0 0 1\n"), places("b.txt", BEND)), code=0,
         prints=('"pairs": 3',)),
    Case("another clock", "evaluate late.txt b.txt", ("add --offset -899.0, or --offset start",), (*POSES, LATER), code=1),
    Case("another clock, aligned", "evaluate late.txt b.txt --offset start --json",
         ("cairn: late.txt: the first stamps are aligned by an offset of -899.0 s.",), (places("b.txt", BEND), LATER), code=0, prints=('"pairs": 4',)),
    Case("another clock, shifted", "evaluate late.txt b.txt --offset -899 --json", given=(places("b.txt", BEND), LATER), code=0, prints=('"pairs": 4',)),
    Case("align files of KITTI", "align a.txt b.txt", given=(kitti("a.txt", BEND), kitti("b.txt", [(x + 5, y, z) for x, y, z in BEND])), code=0,
         prints=("\nt            5.000000000   0.000000000   0.000000000  m",)),
    Case("align a file of EuRoC", "align a.csv b.txt --offset start", ("aligned by an offset of -99.0 s",),
         (euroc("a.csv", BEND, 100.0), places("b.txt", BEND)), code=0, prints=("0.000000000 m after",)),
    Case("nothing to compare", "evaluate late.txt b.txt", ("no pose of EST is within 0.02 s of a pose of REF", "REF 1.0", "raise --max-gap"),
         (*POSES, LATER), code=1),
    Case("nothing to compare for one of several", "evaluate a.txt late.txt b.txt", ("late.txt: no pose of EST is within",),
         (*POSES, LATER), code=1, prints=("a.txt", "late.txt")),
    Case("one pose", "evaluate a.txt b.txt", ("no alignment by se3 from 1 pairs: fewer than 3", "--align none"),
         (trajectory("a.txt", 1), trajectory("b.txt")), code=1),
    Case("one pose as JSON", "evaluate a.txt b.txt --json", ("fewer than 3",), (trajectory("a.txt", 1), trajectory("b.txt")), code=1,
         prints=('"status": "not_alignable"', '"alignment_status": "too_few_points"')),
    Case("nothing to compare as JSON", "evaluate late.txt b.txt --json", ("no pose of EST is within",), (*POSES, LATER), code=1,
         prints=('"status": "no_pairs"',)),
    Case("one pose as it is", "evaluate a.txt b.txt --align none", given=(trajectory("a.txt", 1), trajectory("b.txt")), code=0,
         prints=("ATE none",)),
    Case("poses on a line", "evaluate a.txt b.txt", ("lie on one line, so the turn about it is free",),
         (places("a.txt", LINE), places("b.txt", LINE)), code=1),
    Case("camera that stands still", "evaluate a.txt b.txt", ("are at one place",),
         (places("a.txt", [(1, 2, 3)] * 4), places("b.txt", BEND)), code=1),
    Case("poses nearly on a line", "evaluate a.txt b.txt", ("a.txt: for residuals of this size the poses lie too near to one line",),
         (places("a.txt", NEAR_LINE), places("b.txt", NEAR_OTHER_LINE)), code=0, prints=("ATE se3",)),
    Case("gap that is no number", "evaluate a.txt b.txt --max-gap nan", ("--max-gap", "'nan'"), POSES),
    Case("interval that is no number", "evaluate a.txt b.txt --rpe-delta nan", ("--rpe-delta", "'nan'"), POSES),
    # align
    Case("align", "align a.txt b.txt", given=(places("a.txt", BEND), places("b.txt", [(x + 5, y, z) for x, y, z in BEND])), code=0,
         prints=("reference = R * estimate + t", "\nt            5.000000000   0.000000000   0.000000000  m", "5.000000000 m RMS before, 0.000000000 m after")),
    Case("align pairs", "align p.txt", given=(pairs("p.txt", BEND, lambda p: (-p[1], p[0], p[2] - 7)),), code=0,
         prints=("pairs      4\n", "\nR            0.000000000  -1.000000000   0.000000000\n", "angle      90.000000 deg")),
    Case("align with scale", "align p.txt --scale", given=(pairs("p.txt", BEND, lambda p: tuple(4 * v for v in p)),), code=0,
         prints=("reference = s * R * estimate + t", "\ns            4.000000000\n", "0.000000000 m after")),
    Case("align as JSON", "align p.txt --json", given=(pairs("p.txt", BEND),), code=0,
         prints=('"direction": "reference_from_estimate"', '"scale": 1.0', '"rms_after_m"')),
    Case("align in a plane", "align p.txt", given=(pairs("p.txt", [(x, y, 0) for x, y, _ in BEND]),), code=0, prints=("after",)),
    Case("align drawn", "align p.txt --plot a.svg", given=(pairs("p.txt", BEND),), code=0, leaves=("a.svg",)),
    Case("align one trajectory", "align a.txt",
         ("a.txt:1: expected 16 values (estimate, then reference, each t tx ty tz qx qy qz qw), found 8", "give two trajectories"), POSES),
    Case("align a folder alone", "align run", ("run: expected",), (folder("run"),)),
    Case("align nothing", "align p.txt", ("p.txt: expected pairs of poses, one pair a line",), (file("p.txt", "# none\n"),)),
    Case("align what is not a number", "align p.txt", ("p.txt:1: expected a number for ty, found 'nan'",),
         (file("p.txt", "1 0 0 0 0 0 0 1 1 0 nan 0 0 0 0 1\n"),)),
    Case("align without common stamps", "align late.txt b.txt", ("no pose of EST is within",), (*POSES, LATER), code=1),
    Case("align one pair", "align p.txt", ("no alignment from 1 pairs: fewer than 3",), (pairs("p.txt", BEND[:1]),), code=1),
    Case("align a line", "align p.txt", ("one line",), (pairs("p.txt", LINE),), code=1),
    Case("align one place", "align p.txt", ("one place",), (pairs("p.txt", [(1, 2, 3)] * 5),), code=1),
    Case("align one place as JSON", "align p.txt --json", ("one place",), (pairs("p.txt", [(1, 2, 3)] * 5),), code=1,
         prints=('"status": "one_place"',)),
    Case("align without common stamps as JSON", "align late.txt b.txt --json", ("no pose of EST is within",), (*POSES, LATER), code=1,
         prints=('"status": "no_pairs"',)),
    Case("align mirror images", "align p.txt", ("mirror images",), (pairs("p.txt", AXES, lambda p: (p[0], p[1], -p[2])),), code=1),
    Case("align nearly a line", "align a.txt b.txt", ("too near to one line",),
         (places("a.txt", NEAR_LINE), places("b.txt", NEAR_OTHER_LINE)), code=0, prints=("transform",)),
    Case("alignment into a missing folder", "align p.txt --plot no/a.svg", ("no/a.svg: expected to create the file",), (pairs("p.txt", BEND),)),
]

if __name__ == "__main__":
    main(CASES)
