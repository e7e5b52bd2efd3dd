#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Single steps of geometry: two views, pose from points."""

import random

from harness import Case, main
from inputs import file, png_bytes

CAMERA = "--camera 500,500,320,240"
ESSENTIAL = ("-0.0203618550523477,-0.4007110038118445,-0.03324074249824097,0.3939270778216369,-0.03506401846698079,"
             "0.5857110303721015,-0.006788487241438284,-0.5815434272915686,-0.01438258684486258")
A, B = file("a.png", png_bytes(kind="gray8")), file("b.png", png_bytes(kind="gray8"))
TINY = file("tiny.png", png_bytes(1, 1, kind="gray8"))
DEPTH = file("depth.png", png_bytes(kind="gray16", value=2000))
SMALL_DEPTH = file("small.png", png_bytes(8, 8, kind="gray16", value=2000))


def rows(name, numbers):
    return file(name, "".join(" ".join(f"{x:.9g}" for x in row) + "\n" for row in numbers))


def scene(count, wrong=0, place=lambda draw: (draw(-1, 1), draw(-1, 1), draw(2, 5))):
    """Points and their pixels, seen by a camera at the origin; the first `wrong` pixels anywhere."""
    draw = random.Random(count).uniform
    points = [place(draw) for _ in range(count)]
    pixels = [(draw(0, 639), draw(0, 479)) if i < wrong else (500 * x / z + 320, 500 * y / z + 240)
              for i, (x, y, z) in enumerate(points)]
    return rows("points.txt", points), rows("pixels.txt", pixels)


def on_a_line(draw):
    return draw(-1, 1), 0.1, 3


def in_a_plane(draw):
    return draw(-1, 1), draw(-1, 1), 3


GOOD, PNP = scene(20), f"pnp points.txt pixels.txt {CAMERA}"

CASES = [
    Case("essential matrix taken apart", f"two-view --essential={ESSENTIAL}", code=0, prints=(
        "singular values      0.707107     0.707107            0",
        "-0.365887   -0.0584576     0.928822", "-0.00287462     0.998092    0.0616848", "0.930655   -0.0198996     0.365356",
        "-0.998596    0.0516992   -0.0115267", "-0.0513961     -0.99836   -0.0252005", "0.0128107    0.0245727    -0.999616",
        "0.581301    0.0231206    -0.401938", "t^R1               -0.0203619    -0.400711   -0.0332407")),
    Case("essential matrix as JSON", f"two-view --json --essential={ESSENTIAL}", code=0, prints=('"singular_values"', '"R1"', '"t"')),
    Case("no essential matrix", "two-view --essential=1,0,0,0,1,0,0,0,1", code=1, says=("no essential matrix",)),
    Case("zeros", "two-view --essential=0,0,0,0,0,0,0,0,0", says=("--essential", "not zero")),
    Case("eight numbers", "two-view --essential=1,2,3,4,5,6,7,8", says=("--essential", "9 numbers")),
    Case("NaN in the matrix", "two-view --essential=1,2,3,4,nan,6,7,8,9", says=("--essential", "9 numbers")),
    Case("no images and no matrix", "two-view", says=("two images", "--essential")),
    Case("images without a camera", "two-view a.png b.png", given=(A, B), says=("--camera",)),
    Case("three numbers for a camera", "two-view a.png b.png --camera 1,2,3", given=(A, B), says=("--camera", "fx,fy,cx,cy")),
    Case("focal length 0", "two-view a.png b.png --camera 0,1,2,3", given=(A, B), says=("focal lengths above 0",)),
    Case("unknown camera", "two-view a.png b.png --camera tum-fr9", given=(A, B), says=("--camera", "tum-fr9")),
    Case("image missing", f"two-view a.png c.png {CAMERA}", given=(A,), says=("c.png",)),
    Case("images without features", f"two-view a.png tiny.png {CAMERA}", given=(A, TINY), code=1, says=("fewer than five matches",)),
    Case("images with too little in them", f"two-view a.png b.png {CAMERA}", given=(A, B), code=1, says=("by chance",)),
    Case("the same as JSON", f"two-view a.png b.png {CAMERA} --json", given=(A, B), code=1, prints=('"status"',)),
    Case("depth without a scale", f"two-view a.png b.png {CAMERA} --depth depth.png", given=(A, B, DEPTH), says=("--depth-scale",)),
    Case("depth of another size", f"two-view a.png b.png {CAMERA} --depth small.png --depth-scale 1000",
         given=(A, B, SMALL_DEPTH), says=("small.png", "64x48", "8x8")),
    Case("sigma that is no number", f"two-view a.png b.png {CAMERA} --sigma nan", given=(A, B), says=("nan",)),

    Case("pose", PNP, given=GOOD, code=0, prints=("20 of 20 points agree", "world to", "std rotation", "by the noise of pixels alone", "the points count as exact")),
    Case("pose with a trace", f"{PNP} --trace --kernel cauchy", given=GOOD, code=0, prints=("iteration", "lambda")),
    Case("pose as JSON", f"{PNP} --json", given=GOOD, code=0, prints=('"camera_from_world"', '"covariance"', '"trace"')),
    Case("pose from the identity", f"{PNP} --start identity --method gauss-newton", given=GOOD, code=0, prints=("20 used of 20",)),
    Case("pose of a plane", PNP, given=scene(20, place=in_a_plane), code=0, prints=("20 of 20",)),
    Case("pose among outliers", PNP, given=scene(60, wrong=30), code=0, prints=("of 60 points agree",)),
    Case("no points", PNP, given=scene(0), code=1, says=("0 points", "too few")),
    Case("two points", PNP, given=scene(2), code=1, says=("2 points", "too few")),
    Case("three points", PNP, given=scene(3), code=1, says=("3 points", "chance")),
    Case("three points from the identity", f"{PNP} --start identity", given=scene(3), code=1, says=("fewer than four",)),
    Case("points on a line", PNP, given=scene(20, place=on_a_line), code=1, says=("do not determine",)),
    Case("points on a line from the identity", f"{PNP} --start identity", given=scene(20, place=on_a_line), code=1,
         says=("do not determine",)),
    Case("points in one place", PNP, given=scene(20, place=lambda draw: (0.1, 0.2, 3)), code=1, says=("do not determine",)),
    Case("all outliers", PNP, given=scene(40, wrong=40), code=1, says=("by chance",)),
    Case("all outliers from the identity", f"{PNP} --start identity", given=scene(40, wrong=40), code=1, says=("by chance",)),
    Case("too few steps", f"{PNP} --start identity --iterations 1", given=scene(20, wrong=2), code=1, says=("not converged",),
         prints=("world to",)),
    Case("points behind the camera", f"{PNP} --start identity", code=1, says=("behind the camera",),
         given=scene(20, place=lambda draw: (draw(-1, 1), draw(-1, 1), draw(-5, -2)))),
    Case("fewer pixels than points", PNP, given=(*scene(5), scene(4)[1]), says=("pixels.txt", "5 pixels", "4")),
    Case("NaN in the points", PNP, given=(file("points.txt", "1 2 nan\n"), file("pixels.txt", "1 2\n")), says=("points.txt", ":1", "nan")),
    Case("words in the pixels", PNP, given=(file("points.txt", "1 2 3\n"), file("pixels.txt", "u v\n")), says=("pixels.txt", ":1")),
    Case("two columns of points", PNP, given=(file("points.txt", "1 2\n"), file("pixels.txt", "1 2\n")), says=("points.txt", "x y z")),
    Case("points missing", PNP, given=(file("pixels.txt", "1 2\n"),), says=("points.txt",)),
    Case("huge numbers", PNP, given=(file("points.txt", "1e300 1e300 1e300\n" * 5), file("pixels.txt", "1e300 1\n" * 5)), code=1,
         says=("no pose",)),
    Case("unknown kernel", f"{PNP} --kernel tukey", given=GOOD, says=("--kernel",)),
    Case("no camera", "pnp points.txt pixels.txt", given=GOOD, says=("--camera",)),
]

if __name__ == "__main__":
    main(CASES)
