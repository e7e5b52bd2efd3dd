#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bad stereo recordings: each ends in one message that names the place and the way out."""

from harness import Case, main
from inputs import CAMERA, RIGHT_CAMERA, asl_sequence, file, kitti_sequence, png_bytes, replaced, tum_sequence, without

SEQ = asl_sequence()
KITTI = kitti_sequence()


def left(old, new):
    return replaced("seq/mav0/cam0/sensor.yaml", old, new)


def right(old, new):
    return replaced("seq/mav0/cam1/sensor.yaml", old, new)


def camera(old, new):
    return replaced("seq/camera.yaml", old, new)


CASES = [
    Case("a good pair", "info seq", given=(SEQ,), code=0,
         prints=("EuRoC", "frames       3", "3 of 3 left images have a right image", "raw left     radtan 64x48", "raw right    radtan 64x48",
                 "baseline 0.1", "truth        3 poses")),
    Case("a good pair as JSON", "info seq --json", given=(SEQ,), code=0, prints=('"raw_stereo": {', '"rectified_from_left_xyzw"')),
    # images
    Case("no list of left images", "info seq", ("seq/mav0/cam0/data.csv: expected a readable file",), (SEQ, without("seq/mav0/cam0/data.csv"))),
    Case("no list of right images", "info seq", ("seq/mav0/cam1/data.csv: expected a readable file",), (SEQ, without("seq/mav0/cam1/data.csv"))),
    Case("stamp is no number", "info seq", ("seq/mav0/cam0/data.csv:3: expected a time stamp in whole nanoseconds, found '1.05'",),
         (SEQ, replaced("seq/mav0/cam0/data.csv", "1050000000,", "1.05,"))),
    Case("time goes backwards", "info seq", ("seq/mav0/cam1/data.csv:3: expected a time stamp after 1000000000, found 50000000",),
         (SEQ, replaced("seq/mav0/cam1/data.csv", "1050000000,", "50000000,"))),
    Case("image without name", "info seq", ("seq/mav0/cam0/data.csv:2: expected 2 values (stamp in nanoseconds, file name), found 1",),
         (SEQ, replaced("seq/mav0/cam0/data.csv", ",1000000000.png", ""))),
    Case("left image without partner", "info seq", given=(SEQ, replaced("seq/mav0/cam1/data.csv", "1050000000,1050000000.png\n", "")),
         code=0, prints=("frames       2", "2 of 3 left images have a right image")),
    Case("no pair at all", "info seq", ("seq/mav0/cam1/data.csv: expected images within 0.02 s of those in cam0/data.csv, found none", "one clock"),
         (SEQ, file("seq/mav0/cam1/data.csv", "9000000000,1000000000.png\n"))),
    Case("no image", "info seq", ("seq: expected at least one frame, found 0 of 0",), (SEQ, file("seq/mav0/cam0/data.csv", "#t\n"))),
    Case("first right image is missing", "info seq", ("cam1/data/1000000000.png: expected a readable file",),
         (SEQ, without("seq/mav0/cam1/data/1000000000.png")), code=0, prints=("unreadable   1 frames",)),
    Case("no right image can be read", "info seq", ("cam1/data/1000000000.png: expected", "none of 3 frames can be read"),
         (SEQ, *[file(f"seq/mav0/cam1/data/{stamp}.png", b"") for stamp in (1000000000, 1050000000, 1100000000)])),
    Case("right image of another size", "rectify seq -o out --quiet",
         ("cam1/data/1050000000.png: expected an image of 64x48 pixels, as the calibration says, found 32x24",),
         (SEQ, file("seq/mav0/cam1/data/1050000000.png", png_bytes(32, 24))), code=0, leaves=("out",),
         prints=("frames       2", "unreadable   1 frames", "poses        of every frame")),
    Case("broken right image", "rectify seq -o out --quiet", ("cam1/data/1100000000.png: expected a whole PNG image",),
         (SEQ, file("seq/mav0/cam1/data/1100000000.png", png_bytes()[:300])), code=0, leaves=("out",), prints=("unreadable   1 frames",)),
    Case("first left image is empty", "rectify seq -o out --quiet --json", ("cam0/data/1000000000.png: expected",),
         (SEQ, file("seq/mav0/cam0/data/1000000000.png", b"")), code=0, leaves=("out",), prints=('"frames": 2', '"unreadable": 1')),
    Case("nothing to rectify", "rectify seq -o out --quiet", ("cam0/data/1000000000.png: expected", "none of 3 frames can be read"),
         (SEQ, *[file(f"seq/mav0/cam0/data/{stamp}.png", b"") for stamp in (1000000000, 1050000000, 1100000000)])),
    Case("an image of a pair is missing on disk", "info seq", ("seq/image_1/000000.png: expected a readable file",),
         (KITTI, without("seq/image_1/000000.png")), code=0, prints=("frames       2", "unreadable   1 frames")),
    Case("a pair is missing on disk", "info seq", ("seq/image_0/000000.png: expected a readable file",),
         (KITTI, without("seq/image_0/000000.png"), without("seq/image_1/000000.png")), code=0, prints=("frames       2", "unreadable   1 frames")),
    Case("an image that no time is for", "info seq", ("seq/image_1/000007.png: expected the partner of seq/image_0/000007.png",),
         (KITTI, file("seq/image_0/000007.png", png_bytes(kind="gray8")))),
    # cameras
    Case("no sensor.yaml", "info seq", ("seq/mav0/cam1/sensor.yaml: expected a readable file",), (SEQ, without("seq/mav0/cam1/sensor.yaml"))),
    Case("unknown camera model", "info seq", ("cam0/sensor.yaml:8: expected pinhole for 'camera_model', found 'omni'",),
         (SEQ, left("camera_model: pinhole", "camera_model: omni"))),
    Case("unknown distortion", "info seq", ("cam1/sensor.yaml:10: expected radial-tangential, equidistant or none for 'distortion_model', found 'fov'",),
         (SEQ, right("radial-tangential", "fov"))),
    Case("no distortion coefficients", "info seq", ("cam0/sensor.yaml", "'distortion_coefficients' in 'sensor'", "Add"),
         (SEQ, left("distortion_coefficients", "coefficients"))),
    Case("focal length 0", "info seq", ("cam0/sensor.yaml:9: expected focal lengths above 0 for 'intrinsics'",), (SEQ, left("[50.0,", "[0.0,"))),
    Case("sensor is no YAML", "info seq", ("cam0/sensor.yaml:2: expected YAML",), (SEQ, file("seq/mav0/cam0/sensor.yaml", "T_BS: [1, 2\n"))),
    Case("sensor is empty", "info seq", ("cam0/sensor.yaml: expected a calibration, found an empty file",),
         (SEQ, file("seq/mav0/cam0/sensor.yaml", ""))),
    Case("no transform", "info seq", ("cam1/sensor.yaml:2: expected 'T_BS' in 'sensor'",), (SEQ, right("T_BS", "T_SB"))),
    Case("transform that mirrors", "info seq", ("cam1/sensor.yaml:5: expected a rotation in the first three rows and columns for 'data'",),
         (SEQ, right("data: [1.0", "data: [-1.0"))),
    # the pair
    Case("cameras in one place", "info seq", ("cam1/sensor.yaml: expected two cameras that are apart, found the right one at (0, 0, 0) m",),
         (SEQ, right("0.1,", "0.0,"))),
    Case("left and right exchanged", "info seq", ("cam1/sensor.yaml: expected the right camera to the right of the left one", "Swap the cameras"),
         (SEQ, right("0.1,", "-0.1,"))),
    Case("cameras facing apart", "info seq", ("cam1/sensor.yaml: expected two cameras beside each other that look the same way",
                                              "no view in common", "turned by 180.0 degrees"),
         (SEQ, right("[1.0, 0.0, 0.0, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,", "[-1.0, 0.0, 0.0, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0,"))),
    Case("one camera behind the other", "info seq", ("look the same way", "no view in common: the right one at (0, 0, 0.5) m"),
         (SEQ, right("[1.0, 0.0, 0.0, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0", "[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.5"))),
    # truth
    Case("truth with 7 values", "info seq", ("state_groundtruth_estimate0/data.csv:2: expected 8 values",),
         (SEQ, file("seq/mav0/state_groundtruth_estimate0/data.csv", "#t\n1000000000,0,0,0,1,0,0\n"))),
    Case("truth in another order", "info seq", ("state_groundtruth_estimate0/data.csv:1: expected a quaternion of length 1", "order of the columns"),
         (SEQ, file("seq/mav0/state_groundtruth_estimate0/data.csv", "1000000000,0,0,0,5,0,0,0\n"))),
    # both cameras in camera.yaml
    Case("raw pair in KITTI layout", "info seq", given=(KITTI,), code=0, prints=("KITTI", "raw right    kb4 64x48")),
    Case("right camera without its place", "info seq", ("seq/camera.yaml:3: expected 'left_from_right' in 'right'", "Add"),
         (KITTI, camera("  left_from_right", "#  left_from_right"))),
    Case("right camera in one place with the left", "info seq", ("seq/camera.yaml:4: expected two cameras that are apart",),
         (KITTI, camera("[0.1, 0, 0]", "[0, 0, 0]"))),
    Case("right camera and baseline", "info seq", ("seq/camera.yaml:5: expected either 'baseline' or 'camera'",),
         (KITTI, lambda folder: file("seq/camera.yaml", (folder / "seq/camera.yaml").read_text() + "  baseline: 0.1\n")(folder))),
    Case("unknown key of the right camera", "info seq", ("seq/camera.yaml:4: expected a known key in 'right', found 'left_to_right'",
                                                         "Did you mean 'left_from_right'?"),
         (KITTI, camera("left_from_right", "left_to_right"))),
    Case("right camera for an RGB-D sequence", "info seq", ("seq/camera.yaml:4: expected 'baseline' instead, as there is 'depth'",),
         (tum_sequence(), lambda folder: file("seq/camera.yaml", (folder / "seq/camera.yaml").read_text() + RIGHT_CAMERA)(folder))),
    Case("right camera for a sequence of one camera", "info seq", ("seq/camera.yaml: expected one camera, as a sequence of format TUM has", "Delete"),
         (tum_sequence(), file("seq/camera.yaml", CAMERA.splitlines()[0] + "\n" + RIGHT_CAMERA))),
    Case("focal length of a raw pair", "slam seq -o run --set camera.fx=50", ("camera.fx", "raw stereo pair", "--camera"), (SEQ,)),
    # rectify
    Case("rectify", "rectify seq -o out --quiet", given=(SEQ,), code=0, leaves=("out",), prints=("frames       3", "poses        of every frame")),
    Case("rectify without truth", "rectify seq -o out --quiet", given=(KITTI,), code=0, leaves=("out",), prints=("poses        none",)),
    Case("rectify what is not stereo", "rectify seq -o out", ("seq: expected a stereo sequence", "format TUM"), (tum_sequence(),)),
    Case("rectify into its own sequence", "rectify seq -o seq", ("seq: expected a new or empty folder",), (SEQ,)),
]

if __name__ == "__main__":
    main(CASES)
