#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Single images: features and matches."""

from harness import Case, main
from inputs import file, png_bytes

A, B = file("a.png", png_bytes(kind="gray8")), file("b.png", png_bytes())
TINY = file("tiny.png", png_bytes(1, 1, kind="gray8"))
THIN = file("thin.png", png_bytes(1, 200, kind="gray8"))
DEEP = file("deep.png", png_bytes(kind="gray16", value=2000))
METHODS = ("orb", "sift", "rootsift", "opencv_orb", "opencv_sift", "akaze", "brisk")

CASES = [
    Case("features", "features a.png b.png", given=(A, B), code=0, prints=("a.png  64x48", "b.png  64x48", "keypoints", "ms")),
    Case("features as JSON", "features a.png --json", given=(A,), code=0, prints=('"keypoints"', '"time_ms"', '"image": "a.png"')),
    Case("features drawn and listed", "features a.png --draw k.png --output k.csv", given=(A,), code=0, leaves=("k.png", "k.csv")),
    *(Case(f"one pixel, {m}", f"features tiny.png thin.png --method {m}", given=(TINY, THIN), code=0,
           prints=("1x1  0 keypoints", "1x200  0 keypoints")) for m in METHODS),
    Case("more features than there are", "features a.png --count 10000000", given=(A,), code=0, prints=("keypoints",)),
    Case("no features asked for", "features a.png --count 0", ("--count",), (A,)),
    Case("unknown method", "features a.png --method surf", ("--method", "surf", "ORB"), (A,)),
    Case("no image", "features", ("IMG",)),
    *(Case(f"{which} image is missing", f"features {images}", ("no.png: expected a readable file", "The image is skipped."), (A, B), code=0,
           prints=("a.png  64x48", "b.png  64x48", "1 images cannot be read"))
      for which, images in (("first", "no.png a.png b.png"), ("last", "a.png b.png no.png"))),
    Case("missing image counted as JSON", "features no.png a.png --json", ("no.png: expected",), (A,), code=0, prints=('"unreadable": 1',)),
    Case("two missing images", "features no.png nor.png", ("no.png: expected a readable file", "none of 2 images can be read")),
    Case("16-bit image", "features deep.png", ("deep.png: expected",), (DEEP,)),
    Case("text for an image", "features a.txt", ("a.txt: expected",), (file("a.txt", "hello"),)),
    Case("broken image", "features a.png", ("a.png: expected",), (file("a.png", png_bytes()[:200]),)),
    Case("two images in one picture", "features a.png b.png --draw k.png", ("--draw: expected one image, found 2",), (A, B)),
    Case("picture into a missing folder", "features a.png --draw no/k.png", ("no/k.png: expected",), (A,)),
    Case("list into a missing folder", "features a.png --output no/k.csv", ("no/k.csv: expected",), (A,)),
    Case("unknown instruction set", "features a.png", ("CAIRN_SIMD: expected one of plain", "found 'mmx'"), (A,),
         environment={"CAIRN_SIMD": "mmx"}),
    Case("plain instructions", "features a.png", given=(A,), code=0, prints=("keypoints",), environment={"CAIRN_SIMD": "plain"}),
    Case("match", "match a.png b.png --output m.csv --draw m.png", given=(A, B), code=0, prints=("matches",), leaves=("m.csv", "m.png")),
    Case("match as JSON", "match a.png b.png --json", given=(A, B), code=0, prints=('"matches"', '"matching_time_ms"')),
    Case("match nothing", "match a.png tiny.png", given=(A, TINY), code=0, prints=("0 matches",)),
    Case("match with itself only", "match a.png", ("B",), (A,)),
    Case("ratio above 1", "match a.png b.png --ratio 1.5", ("--ratio",), (A, B)),
    Case("negative distance", "match a.png b.png --max-distance -1", ("--max-distance",), (A, B)),
    Case("distance that is no number", "match a.png b.png --max-distance nan", ("--max-distance",), (A, B)),
    Case("match with a missing image", "match a.png no.png --output m.csv", ("no.png: expected a readable file",), (A,)),
]

if __name__ == "__main__":
    main(CASES)
