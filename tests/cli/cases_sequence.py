#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bad sequences and calibrations: each ends in one message that names the place and the way out."""

from harness import Case, main
from inputs import CAMERA, file, folder, png_bytes, replaced, tum_sequence, without

SEQ = tum_sequence()


def rgb(old, new):
    return replaced("seq/rgb.txt", old, new)


def camera(old, new):
    return replaced("seq/camera.yaml", old, new)


BODY = "body: {body_from_camera: {translation: [0, 0, 0], quaternion_xyzw: [0.5, 0.5, 0.5, 0.5]}}\n"
TABLE = "time_s,latitude,longitude,height,roll,pitch,heading\n" + "".join(f"{t},49,8,100,0,0,45\n" for t in (1.0, 1.1, 1.2))


def body_sequence(root):
    SEQ(root)
    file("seq/camera.yaml", CAMERA + BODY)(root)


def repeated(third):
    """The truth with its second row again, x as given."""
    return replaced("seq/groundtruth.txt", "1.100000 0.0100 0.0010 0 0 0 0 1\n",
                    f"1.100000 0.0100 0.0010 0 0 0 0 1\n1.100000 {third} 0.0010 0 0 0 0 1\n")


NO_FIX = TABLE.replace("1.0,49,8,100", "1.0,0,0,0")
JUMP = TABLE.replace("1.2,49,8", "1.2,49.01,8")
NAMED = "# frame_id, translation_x, translation_y, translation_z, quat_x, quat_y, quat_z, quat_w, scale, fusion_quality, v3\n" + "".join(
    f"{t}000000,0,0,0,0,0,0,1,1,1,1\n" for t in (1000, 1100, 1200))
LATER_CLOCK = "".join(f"{1317042145.594 + t:.3f} 0 0 0 0 0 0 1\n" for t in (0, 0.1, 0.2))
# What becomes of an image: a function of its path that gives a maker.
SPOILED = (("empty", lambda path: file(path, b"")), ("cut", lambda path: file(path, png_bytes()[:300])), ("missing", without),
           ("smaller", lambda path: file(path, png_bytes(32, 24, "gray16" if "depth" in path else "rgb8"))))
PARAMETERS = "--set camera.fx=50 --set camera.fy=50 --set camera.cx=31.5 --set camera.cy=23.5 --set camera.scale=1000"

CASES = [
    Case("a good sequence", "info seq", given=(SEQ,), code=0, prints=("TUM", "frames       3")),
    Case("frames as slices", "info seq --frames 0:2", given=(SEQ,), code=0, prints=("frames       2",)),
    # what is named
    Case("no such sequence", "info seq", ("seq: expected a folder with a sequence, found nothing of that name", "Check")),
    Case("sequence is a file", "info seq", ("expected a folder with a sequence, found a file",), (file("seq", "x"),)),
    Case("empty folder", "info seq", ("seq: expected a sequence", "found an empty folder"), (folder("seq"),)),
    Case("folder of something else", "info seq", ("found none of these",), (file("seq/notes.txt", "x"),)),
    Case("empty sequence", "info seq", ("seq: expected at least one frame, found 0 of 0",), (SEQ, file("seq/rgb.txt", "# nothing\n"))),
    Case("frames that are no slice", "info seq --frames all", ("--frames: expected A:B", "found 'all'"), (SEQ,)),
    Case("no frame left", "info seq --frames 7:9", ("expected at least one frame", "Widen --frames"), (SEQ,)),
    # lists
    Case("time goes backwards", "info seq", ("seq/rgb.txt:3: expected a time stamp after 1.100000000, found 0.500000000",),
         (SEQ, rgb("1.200000", "0.5"))),
    Case("stamp is no number", "info seq", ("seq/rgb.txt:2: expected a time stamp in seconds, found '1,1'",),
         (SEQ, rgb("1.100000", "1,1"))),
    Case("line without file name", "info seq", ("seq/rgb.txt:2: expected 2 values", "found 1"), (SEQ, rgb(" rgb/1.png", ""))),
    Case("no depth near in time", "info seq", ("depth.txt: expected depth images within", "one clock"),
         (SEQ, file("seq/depth.txt", "900.0 depth/0.png\n"))),
    Case("trajectory line with 7 numbers", "info seq", ("seq/groundtruth.txt:2: expected 8 values (t tx ty tz qx qy qz qw), found 7",),
         (SEQ, replaced("seq/groundtruth.txt", "0.0100 0.0010 0 0 0 0 1", "0.0100 0.0010 0 0 0 1"))),
    Case("quaternion of length 0", "info seq", ("seq/groundtruth.txt:2: expected a quaternion of length 1", "order of the columns"),
         (SEQ, replaced("seq/groundtruth.txt", "0.0100 0.0010 0 0 0 0 1", "0.0100 0.0010 0 0 0 0 0"))),
    # calibration
    Case("no calibration", "info seq", ("expected a calibration, found none", "camera.yaml"), (SEQ, without("seq/camera.yaml"))),
    Case("unknown camera", "info seq --camera tum-fr9", ("tum-fr9",), (SEQ,)),
    Case("empty calibration", "info seq", ("camera.yaml: expected a calibration, found an empty file",),
         (SEQ, file("seq/camera.yaml", ""))),
    Case("calibration is no YAML", "info seq", ("seq/camera.yaml:2: expected YAML",), (SEQ, file("seq/camera.yaml", "camera: {\n"))),
    Case("fx is 0", "info seq", ("seq/camera.yaml:1: expected", "'fx'"), (SEQ, camera("fx: 50.0", "fx: 0"))),
    Case("fx is missing", "info seq", ("seq/camera.yaml:1: expected 'fx' in 'camera'", "Add 'fx'"), (SEQ, camera("fx: 50.0, ", ""))),
    Case("fx is a word", "info seq", ("seq/camera.yaml:1:", "'wide'"), (SEQ, camera("fx: 50.0", "fx: wide"))),
    Case("unknown key", "info seq", ("seq/camera.yaml:2: expected a known key in 'depth', found 'scael'", "Did you mean 'scale'?"),
         (SEQ, camera("scale", "scael"))),
    Case("unknown model", "info seq", ("seq/camera.yaml:1:", "pinhole, radtan or kb4"), (SEQ, camera("pinhole", "fisheye"))),
    Case("depth without scale", "info seq", ("seq/camera.yaml", "'depth: {scale: ...}'", "1000 where depth is in millimetres"),
         (SEQ, file("seq/camera.yaml", CAMERA.splitlines()[0] + "\n"))),
    Case("scale is 0", "info seq", ("seq/camera.yaml:2:", "'scale'"), (SEQ, camera("1000.0", "0"))),
    # images, as slam and cloud read them
    Case("image of the wrong size", "cloud seq -o a.ply",
         ("seq/rgb/0.png: expected an image of 64x48 pixels, as the calibration says, found 32x24",),
         (SEQ, *[file(f"seq/rgb/{i}.png", png_bytes(32, 24)) for i in range(3)])),
    Case("image of the wrong size for slam", "slam seq -o run",
         ("seq/rgb/0.png: expected an image of 64x48 pixels, as the calibration says, found 32x24",),
         (SEQ, *[file(f"seq/rgb/{i}.png", png_bytes(32, 24)) for i in range(3)])),
    Case("depth of the wrong type for slam", "slam seq -o run", ("seq/depth/0.png: expected", "16"),
         (SEQ, *[file(f"seq/depth/{i}.png", png_bytes(kind="gray8")) for i in range(3)])),
    Case("depth of the wrong type", "cloud seq -o a.ply", ("seq/depth/0.png: expected", "16"),
         (SEQ, *[file(f"seq/depth/{i}.png", png_bytes(kind="gray8")) for i in range(3)])),
    Case("broken image in the middle", "cloud seq -o a.ply", ("frame 1 left out: seq/rgb/1.png: expected",),
         (SEQ, file("seq/rgb/1.png", png_bytes()[:300])), code=0, leaves=("a.ply",)),
    Case("broken depth in the middle", "cloud seq -o a.ply", ("frame 1 left out: seq/depth/1.png: expected",),
         (SEQ, file("seq/depth/1.png", b"no image")), code=0, leaves=("a.ply",)),
    Case("missing image in the middle", "cloud seq -o a.ply", ("frame 1 left out: seq/rgb/1.png: expected a readable file",),
         (SEQ, without("seq/rgb/1.png")), code=0, leaves=("a.ply",)),
    # the first image is no other than the rest
    *(Case(f"{what} first {kind}, {command.split()[0]}", command, ("0.png: expected",), (SEQ, spoil(f"seq/{place}/0.png")), code=0,
           leaves=leaves, prints=prints)
      for what, spoil in SPOILED for kind, place in (("image", "rgb"), ("depth", "depth"))
      for command, leaves, prints in (("info seq --json", (), ('"unreadable": 1',)), ("cloud seq -o a.ply --json", ("a.ply",), ('"unreadable": 1',)),
                                      ("octree seq -o a.bt --json", ("a.bt",), ('"unreadable": 1',)))),
    Case("the first two are missing", "info seq", ("rgb/0.png: expected", "rgb/1.png: expected"), (SEQ, without("seq/rgb/0.png"), without("seq/rgb/1.png")),
         code=0, prints=("unreadable   2 frames",)),
    Case("image of another size in the middle", "info seq", ("rgb/1.png: expected an image of 64x48",), (SEQ, file("seq/rgb/1.png", png_bytes(32, 24))),
         code=0, prints=("unreadable   1 frames",)),
    Case("no image can be read", "info seq", ("rgb/0.png: expected a readable file", "none of 3 frames can be read"),
         (SEQ, *[without(f"seq/rgb/{i}.png") for i in range(3)])),
    Case("no image can be read by slam", "slam seq -o run --quiet", ("depth/0.png: expected", "none of 3 frames can be read"),
         (SEQ, *[file(f"seq/depth/{i}.png", b"") for i in range(3)])),
    Case("no image can be read by map", "map seq -o map --quiet", ("rgb/0.png: expected", "none of 3 frames can be read"),
         (SEQ, *[file(f"seq/rgb/{i}.png", b"") for i in range(3)])),
    Case("size from the parameters alone", "slam seq -o run --quiet " + PARAMETERS, ("rgb/0.png: expected a PNG", "of 2 frames"),
         (SEQ, without("seq/camera.yaml"), file("seq/rgb/0.png", b"")), code=1, leaves=("run",)),
    # depth
    *(Case(f"depth.scale {scale} for {command.split()[0]}", command,
           (f"median depth of {wrong} m", f"with depth.scale {scale}; with 1000 it would be 2.02 m"), (SEQ, camera("1000.0", scale)),
           code=0, leaves=leaves)
      for scale, wrong in (("5000", "0.40"), ("200", "10.11"))
      for command, leaves in (("info seq", ()), ("cloud seq -o a.ply --max-depth 20", ("a.ply",)), ("octree seq -o a.bt", ("a.bt",)))),
    # poses
    Case("no such poses", "cloud seq --poses p.txt -o a.ply", ("p.txt: expected a readable file, found No such file",), (SEQ,)),
    Case("poses with 7 numbers", "cloud seq --poses p.txt -o a.ply", ("p.txt:1: expected 8 values", "found 7"),
         (SEQ, file("p.txt", "1 0 0 0 0 0 1\n"))),
    Case("poses of another recording", "cloud seq --poses p.txt -o a.ply", ("p.txt: expected poses within", "share its clock"),
         (SEQ, file("p.txt", "900 0 0 0 0 0 0 1\n"))),
    Case("table of poses", "cloud seq --poses p.csv -o a.ply --json", given=(body_sequence, file("p.csv", TABLE)), code=0, leaves=("a.ply",),
         prints=('"fused": 3',)),
    Case("table of poses with an offset", "cloud seq --poses p.csv --pose-offset 0.1 -o a.ply --json",
         given=(body_sequence, file("p.csv", TABLE)), code=0, leaves=("a.ply",), prints=('"fused": 2', '"without_pose": 1')),
    Case("table of poses too far apart", "cloud seq --poses p.csv --pose-gap 0.05 --pose-offset 0.05 -o a.ply",
         ("p.csv: expected poses within", "at most 0.05 s apart"), (body_sequence, file("p.csv", TABLE))),
    Case("negative gap of poses", "cloud seq --pose-gap -1 -o a.ply", ("--pose-gap",), (SEQ,)),
    Case("table of poses without a body", "cloud seq --poses p.csv -o a.ply",
         ("camera.yaml: expected 'body: {body_from_camera: ...}'", "quaternion_xyzw: [0.5, 0.5, 0.5, 0.5]"), (SEQ, file("p.csv", TABLE))),
    Case("table of poses without heading", "cloud seq --poses p.csv -o a.ply", ("p.csv:1: expected 'heading' among the columns",),
         (body_sequence, file("p.csv", TABLE.replace("heading", "course")))),
    Case("folder without poses", "cloud seq --poses seq -o a.ply", ("seq: expected poses: OXTS packets",), (SEQ,)),
    Case("OXTS packets without times", "info seq", given=(SEQ, file("seq/oxts/data/0000000000.txt", "")), code=0, prints=("truth        3 poses",)),
    Case("info of OXTS packets", "info seq", given=(SEQ, file("seq/oxts/data/0000000000.txt", ""), file("seq/oxts/timestamps.txt", "")),
         code=0, prints=("poses        OXTS packets in seq/oxts",)),
    Case("truth with equal rows", "info seq", given=(SEQ, repeated("0.0100")), code=0, prints=("truth        3 poses",)),
    Case("truth with unequal rows at a stamp", "info seq",
         ("cairn: seq/groundtruth.txt:3: a second pose, 0.01 m away, at 1.100000000; 1 such line left out, the first pose counts.",),
         (SEQ, repeated("0.0200")), code=0, prints=("truth        3 poses",)),
    Case("poses with equal rows", "cloud seq --poses p.csv -o a.ply --json", given=(body_sequence, file("p.csv", TABLE + TABLE.splitlines()[-1] + "\n")),
         code=0, leaves=("a.ply",), prints=('"fused": 3',)),
    Case("poses with named columns", "cloud seq --poses p.csv -o a.ply --json",
         ("cairn: p.csv: its columns do not say whose poses they are: taken as the camera's",), (SEQ, file("p.csv", NAMED)), code=0,
         leaves=("a.ply",), prints=('"fused": 3',)),
    Case("poses whose quaternion is numbered", "cloud seq --poses p.csv -o a.ply",
         ("p.csv:1: expected the quaternion's columns by the names qx, qy, qz, qw, found q0, q1, q2, q3",),
         (SEQ, file("p.csv", "time,x,y,z,q0,q1,q2,q3\n1.0,0,0,0,1,0,0,0\n"))),
    Case("poses whose quaternion is incomplete", "cloud seq --poses p.csv -o a.ply", ("p.csv:1: expected 'qw' among the columns",),
         (SEQ, file("p.csv", "time,x,y,z,qx,qy,qz\n1.0,0,0,0,1,0,0\n"))),
    Case("poses before a fix", "cloud seq --poses p.csv -o a.ply --json",
         ("cairn: p.csv:2: 1 of 3 rows left out, from 1.000000000 on: no position (0 north and 0 east, empty or no number).",),
         (body_sequence, file("p.csv", NO_FIX)), code=0, leaves=("a.ply",), prints=('"fused": 2', '"without_pose": 1')),
    Case("poses without any fix", "cloud seq --poses p.csv -o a.ply", ("p.csv: expected rows with a position, found 3 with no position",),
         (body_sequence, file("p.csv", TABLE.replace("49,8,100", "0,0,0")))),
    Case("poses that jump", "cloud seq --poses p.csv -o a.ply",
         ("cairn: p.csv:4: the position jumps by 1112.", "within 0.1 s, at 1.200000000, faster than any vehicle; 1 such jump"),
         (body_sequence, file("p.csv", JUMP)), code=0, leaves=("a.ply",)),
    Case("poses of another clock", "cloud seq --poses p.txt -o a.ply",
         ("p.txt: expected poses within", "add --pose-offset -1317042144.594, or --pose-offset start"), (SEQ, file("p.txt", LATER_CLOCK))),
    Case("poses of another clock, aligned", "cloud seq --poses p.txt --pose-offset start -o a.ply --json",
         ("cairn: p.txt: the first stamps are aligned by an offset of -1317042144.594 s.",), (SEQ, file("p.txt", LATER_CLOCK)), code=0,
         leaves=("a.ply",), prints=('"fused": 3',)),
    Case("poses of another clock, shifted", "cloud seq --poses p.txt --pose-offset -1317042144.594 -o a.ply --json",
         given=(SEQ, file("p.txt", LATER_CLOCK)), code=0, leaves=("a.ply",), prints=('"fused": 3',)),
    Case("offset that is none", "cloud seq --pose-offset begin -o a.ply", ("--pose-offset", "'begin' is no number"), (SEQ,)),
    Case("empty poses", "cloud seq --poses p.txt -o a.ply", ("p.txt: expected poses, one a line",), (SEQ, file("p.txt", "# none\n"))),
    Case("sequence without poses", "cloud seq -o a.ply", ("Give --poses FILE",), (SEQ, without("seq/groundtruth.txt"))),
    # outputs
    Case("cloud of unknown kind", "cloud seq -o a.xyz", ("a.xyz", ".ply", ".pcd"), (SEQ,)),
    Case("cloud into a missing folder", "cloud seq -o no/a.ply", ("no/a.ply: expected to create the file", "Make the folder first."), (SEQ,)),
    Case("octree of unknown kind", "octree seq -o a.oct", ("a.oct", ".bt", ".ot"), (SEQ,)),
    Case("octree of nothing", "octree no.ply -o a.bt", ("no.ply",)),
    Case("full disk", "cloud seq --voxel 0.001 -o a.ply", ("a.ply: expected to", "File too large"), (SEQ,), file_limit=2048),
    Case("cloud", "cloud seq -o a.ply --quiet", given=(SEQ,), code=0, leaves=("a.ply",)),
    Case("octree", "octree seq -o a.bt --quiet", given=(SEQ,), code=0, leaves=("a.bt",)),
    # slam
    Case("slam into its own sequence", "slam seq -o seq", ("seq: expected a new or empty folder, or a run that cairn wrote",), (SEQ,)),
    Case("slam into a simulated sequence", "slam seq -o seq", ("or a run that cairn wrote, found a sequence that cairn wrote",),
         (SEQ, file("seq/.cairn", "sequence: written by cairn\n"))),
    Case("slam unknown parameter", "slam seq -o run --set featurs=9", ("--set: ", "'featurs'", "'features'"), (SEQ,)),
    Case("slam unknown parameter in a file", "slam seq -o run --config p.yaml", ("p.yaml:2: ", "'keyframe_treshold'", "'keyframe_threshold'"),
         (SEQ, file("p.yaml", "features: 100\nkeyframe_treshold: 1\n"))),
    Case("slam parameter out of range", "slam seq -o run --set features=-5", ("features", "-5"), (SEQ,)),
    Case("slam parameter of the wrong type", "slam seq -o run --set features=many", ("features", "'many'"), (SEQ,)),
    Case("slam with too few features", "slam seq -o run --quiet", ("no motion was found",), (SEQ,), code=1, leaves=("run",)),
    Case("slam without depth", "slam seq -o run --quiet --set depth.max=0.5", ("no frame could be tracked",), (SEQ,), code=1),
]

if __name__ == "__main__":
    main(CASES)
