#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Maps, good and bad; written here as docs/map_format.md says."""

import json
import struct
import zlib

from harness import Case, main
from inputs import file, without


UVLIST_HEADER = "# id x y z frames std_x std_y std_z rms_px " + " ".join(
    f"{statistic}_{quantity}" for quantity in ("distance", "lateral", "depth", "angle_deg") for statistic in ("mean", "min", "max", "std")) + "\n"


def sealed(body):
    blocks = b"".join(struct.pack("<I", zlib.crc32(body[i:i + 4096])) for i in range(0, len(body), 4096))
    return body + blocks + struct.pack("<I", zlib.crc32(blocks))


def checksum(contents):
    return struct.unpack("<I", contents[-4:])[0]


def frame_file(number, size=32):
    """Two features; the second shows the landmark."""
    header = b"CAIRNFRM" + struct.pack("<IiiIII", 3, number, 5 * number, 2, size, 0)
    return sealed(header + b"".join(struct.pack(f"<Ii7f{size}s", i, i - 1, 30.0 + i, 20, 10, 1, 0.5, 31, 90, bytes([i] * size))
                                    for i in range(2)))


def map_files(size=32, descriptor="ORB", width=64, height=48):
    """By name: two keyframes of two parts that see one landmark."""
    frames = [frame_file(number, size) for number in range(2)]
    points = sealed(b"CAIRNPNT" + struct.pack("<IIQIIQ12d", 3, 1, 2, 0, 2, 0, *[0.5] * 3, *[0.0] * 9))
    rows = b"".join(struct.pack("<iiff32s", number, 1, 31, 1, bytes([1] * 32)) for number in range(2))
    descriptors = sealed(b"CAIRNDSC" + struct.pack("<IIIIQ", 3, 32, 0, 48, 2) + rows)
    places = sealed(b"CAIRNPLC" + struct.pack("<6I2Qd2Q32sI4x2i", 3, 32, 0, 16, 0, 1, 1, 2, 0.0, 0, 1, bytes([1] * 32), 0, 0, 1))
    poses = b"# t tx ty tz qx qy qz qw\n" + b"".join(b"%d 0 0 0 0 0 0 1\n" % (number + 1) for number in range(2))
    table = (UVLIST_HEADER + "0 0.5 0.5 0.5 2 0 0 0 0.25" + 4 * " 1.5 1 2 0.5" + "\n").encode()
    info = {"format": "cairn keyframe map", "version": 3, "frame": "camera of the first keyframe",
            "rig": {"fx": 50.0, "fy": 50.0, "cx": 31.5, "cy": 23.5, "baseline": 0.1},
            "image": {"width": width, "height": height}, "descriptor": {"name": descriptor, "norm": "hamming", "bytes": 32}, "settings": "",
            "counts": {"keyframes": 2, "features": 4, "landmarks": 1, "sightings": 2},
            "keyframes": [{"file": f"frames/{number:06}.{descriptor.lower()}", "frame": 5 * number, "stamp_ns": 10**9 * (number + 1),
                           "part": number, "crc32": checksum(frame)} for number, frame in enumerate(frames)],
            "files": {"Descriptor.bin": checksum(descriptors), "Place.bin": checksum(places), "Point.bin": checksum(points), "poses.txt": zlib.crc32(poses),
                      "uvlist.txt": zlib.crc32(table)}}
    body = (json.dumps(info, indent=2).rpartition("\n")[0] + ",\n").encode()
    return {"map.json": body + b'  "crc32": %d\n}\n' % zlib.crc32(body), "poses.txt": poses, "uvlist.txt": table,
            "Point.bin": points, "Descriptor.bin": descriptors, "Place.bin": places,
            **{f"frames/{number:06}.{descriptor.lower()}": frame for number, frame in enumerate(frames)}}


def map_folder(name="map", **options):
    def make(root):
        for path, contents in map_files(**options).items():
            file(f"{name}/{path}", contents)(root)
    return make


def flipped(name, offset):
    """One bit of a file of an earlier maker."""
    def make(root):
        contents = bytearray((root / name).read_bytes())
        contents[offset] ^= 4
        (root / name).write_bytes(contents)
    return make


def replaced(name, old, new):
    return lambda root: (root / name).write_text((root / name).read_text().replace(old, new))


def cut(name, count):
    return lambda root: (root / name).write_bytes((root / name).read_bytes()[:-count])


MAP = map_folder()
FIGURES = ("keyframes    2, 2 features each", "components   2, of 1, 1 keyframes", "landmarks    1\n", "observations 2, 2.00 per landmark",
           "descriptors  ORB (Hamming, 32 bytes)", "images       64 x 48 pixels", "rms_px                0.25      0.25",
           "mean_depth             1.5", "no covariance: 1 landmarks")
VERSION_REMEDY = "Make the map again, or read it with the version of cairn that made it."
REMEDY = "Copy the map again from where it was made, or make it again."

CASES = [
    Case("a good map", "info map", given=(MAP,), code=0, prints=(*FIGURES, "know the noise of observations")),
    Case("map of a run", "info run", given=(map_folder("run/map"),), code=0, prints=FIGURES),
    Case("a good map as JSON", "info map --json", given=(MAP,), code=0, prints=('"landmarks": 1', '"parts": [\n    1,\n    1\n  ]')),
    Case("indicators as JSON", "info map --json", given=(MAP,), code=0,
         prints=('"origin": null', '"without_covariance": 1', '"std_x": {\n      "count": 0\n    }', '"min_lateral": {\n      "count": 1,\n      "min": 1.0')),
    Case("damaged table", "info map", ("map/uvlist.txt:2: expected a number for 'rms_px', found '0.25|1.5'", REMEDY), (MAP, replaced("map/uvlist.txt", "0.25 ", "0.25|"))),
    Case("table of another map", "info map", ("map/uvlist.txt: expected contents that fit their CRC-32", REMEDY), (MAP, replaced("map/uvlist.txt", "0.25", "0.75"))),
    Case("frames of a map", "info map --frames 0:2", ("--frames: expected a sequence to apply it to, found a map",), (MAP,)),
    Case("map without map.json", "info map", ("map/map.json: expected a readable file", "found"), (MAP, without("map/map.json"))),
    Case("map without poses", "info map", ("map/poses.txt: expected a readable file",), (MAP, without("map/poses.txt"))),
    Case("map without table", "info map", ("map/uvlist.txt: expected a readable file",), (MAP, without("map/uvlist.txt"))),
    Case("map without points", "info map", ("map/Point.bin: expected a readable file",), (MAP, without("map/Point.bin"))),
    Case("map without descriptors", "info map", ("map/Descriptor.bin: expected a readable file",), (MAP, without("map/Descriptor.bin"))),
    Case("map without places", "info map", ("map/Place.bin: expected a readable file",), (MAP, without("map/Place.bin"))),
    Case("damaged places", "info map", ("map/Place.bin: expected contents that fit their CRC-32",), (MAP, flipped("map/Place.bin", 100))),
    Case("map without a frame", "info map", ("map/frames/000001.orb: expected a readable file",), (MAP, without("map/frames/000001.orb"))),
    Case("empty map.json", "info map", ("map/map.json:1: expected JSON, found something else", REMEDY), (MAP, file("map/map.json", ""))),
    Case("map.json of an older version", "info map", ("map/map.json: expected version 3 of the format, found version 2", VERSION_REMEDY),
         (MAP, file("map/map.json", '{"format": "cairn keyframe map", "version": 2}'))),
    Case("frame of another version", "info map", ("map/frames/000000.orb: expected version 3 of the format, found version 7",),
         (MAP, flipped("map/frames/000000.orb", 8))),
    Case("frame that is none", "info map", ("map/frames/000000.orb: expected a file that begins with CAIRNFRM",), (MAP, flipped("map/frames/000000.orb", 0))),
    Case("damaged frame", "info map", ("map/frames/000000.orb: expected contents that fit their CRC-32", REMEDY), (MAP, flipped("map/frames/000000.orb", 50))),
    Case("damaged points", "info map", ("map/Point.bin: expected contents that fit their CRC-32",), (MAP, flipped("map/Point.bin", 40))),
    Case("points cut short", "info map", ("map/Point.bin: expected contents that fit their CRC-32", "cut short"), (MAP, cut("map/Point.bin", 9))),
    Case("descriptors cut short", "info map", ("map/Descriptor.bin: expected at least 16 bytes, found 4",), (MAP, cut("map/Descriptor.bin", 132))),
    Case("damaged poses", "info map", ("map/poses.txt: expected contents that fit their CRC-32",), (MAP, flipped("map/poses.txt", -3))),
    Case("descriptors of another kind", "info map", ("map/frames/000000.orb: expected descriptors of 32 bytes", "found 61 bytes"), (map_folder(size=61),)),
    Case("descriptor that cairn does not have", "info map", ("map/map.json: expected one of the descriptors ORB", "found 'BRIEF'"),
         (map_folder(descriptor="BRIEF"),)),
    Case("frames of two maps", "info map", ("map/Point.bin: expected the file that map.json names, by its CRC-32",),
         (MAP, file("map/Point.bin", sealed(b"CAIRNPNT" + struct.pack("<IIQ", 3, 0, 0))))),
]

if __name__ == "__main__":
    main(CASES)
