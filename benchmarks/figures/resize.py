#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes images of other sizes as PNG: resize.py FACTOR FOLDER IMAGE... Enlarged by bicubic interpolation, or shrunk by means of areas.

A program of its own, as Debian's Pillow (python3-pil) belongs to /usr/bin/python3, which need not be the python3 of the PATH."""

import sys
from pathlib import Path

try:
    from PIL import Image
except ImportError:
    sys.exit("images of other sizes are made with Pillow: apt-get install python3-pil")

factor, folder = float(sys.argv[1]), Path(sys.argv[2])
for path in map(Path, sys.argv[3:]):
    with Image.open(path) as image:
        size = tuple(round(factor * side) for side in image.size)
        image.resize(size, Image.BICUBIC if factor > 1 else Image.BOX).save(folder / f"{path.name.partition('.')[0]}.png")
