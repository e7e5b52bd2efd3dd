#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Localisation in maps, good and bad."""

from cases_map import REMEDY, VERSION_REMEDY, cut, flipped, map_folder
from harness import Case, main
from inputs import file, folder, png_bytes, replaced, tum_sequence, trajectory, without

MAP, SEQ = map_folder(), tum_sequence()
RUN = "localize map seq -o run --quiet"
LEFT = ("run/landmarks.png", "run/trajectory.txt", "run/localization.csv", "run/run.json", "run/.cairn")
NOT_FOUND = "cairn localize: none of 3 images was found in the map."


def damaged(what, name, says):
    return Case(what, RUN, (says,), (MAP, SEQ, flipped(f"map/{name}", 60)))


CASES = [
    Case("images of elsewhere", RUN, (NOT_FOUND,), (MAP, SEQ), code=1, leaves=("run", *LEFT)),
    Case("one image", "localize map image.png -o run --quiet", ("none of 1 images",), (MAP, file("image.png", png_bytes())), code=1,
         leaves=("run", *LEFT)),
    Case("a folder of images", "localize map images -o run --quiet", ("none of 2 images",),
         (MAP, file("images/a.png", png_bytes()), file("images/b.png", png_bytes())), code=1, leaves=("run", *LEFT)),
    Case("pictures", "localize map image.png -o run --quiet --draw", ("none of 1 images",), (MAP, file("image.png", png_bytes())), code=1,
         leaves=("run", *LEFT, "run/pictures", "run/pictures/000000.png")),
    Case("no map", "localize nothing seq -o run", ("nothing: expected the folder of a map", "found nothing of that name"), (SEQ,)),
    Case("a folder that is no map", "localize seq seq -o run", ("seq: expected the folder of a map", "found none of its files"), (SEQ,)),
    Case("no images", "localize map nothing -o run", ("nothing: expected a folder with a sequence",), (MAP,)),
    Case("an empty folder of images", "localize map images -o run", ("images: expected",), (MAP, folder("images"))),
    Case("map of another version", RUN, ("map/map.json: expected version 3 of the format, found version 2", VERSION_REMEDY),
         (MAP, SEQ, file("map/map.json", '{"format": "cairn keyframe map", "version": 2}'))),
    Case("damaged map.json", RUN, ("map/map.json: expected contents that fit their CRC-32",), (MAP, SEQ, replaced("map/map.json", "50.0", "51.0"))),
    Case("damaged poses", RUN, ("map/poses.txt: expected contents that fit their CRC-32",), (MAP, SEQ, flipped("map/poses.txt", -3))),
    damaged("damaged points", "Point.bin", "map/Point.bin: expected contents that fit their CRC-32"),
    damaged("damaged descriptors", "Descriptor.bin", "map/Descriptor.bin: expected contents that fit their CRC-32"),
    damaged("damaged places", "Place.bin", "map/Place.bin: expected contents that fit their CRC-32"),
    damaged("damaged frame", "frames/000001.orb", "map/frames/000001.orb: expected contents that fit their CRC-32"),
    Case("damaged table", RUN, ("map/uvlist.txt: expected contents that fit their CRC-32",), (MAP, SEQ, flipped("map/uvlist.txt", 2))),
    Case("places cut short", RUN, ("map/Place.bin: expected contents that fit their CRC-32", REMEDY), (MAP, SEQ, cut("map/Place.bin", 9))),
    Case("map without places", RUN, ("map/Place.bin: expected a readable file",), (MAP, SEQ, without("map/Place.bin"))),
    Case("map without a frame", RUN, ("map/frames/000000.orb: expected a readable file",), (MAP, SEQ, without("map/frames/000000.orb"))),
    Case("another descriptor", RUN + " --set descriptor=SIFT", ("descriptor: expected ORB, as the map has, found SIFT",), (MAP, SEQ)),
    Case("another camera", RUN, ("expected the camera of the map: 64x48 fx 50", "found 64x48 fx 60", "--any-camera"),
         (MAP, SEQ, replaced("seq/camera.yaml", "fx: 50.0", "fx: 60.0"))),
    Case("another camera on purpose", RUN + " --any-camera", (NOT_FOUND,), (MAP, SEQ, replaced("seq/camera.yaml", "fx: 50.0", "fx: 60.0")),
         code=1, leaves=("run", *LEFT)),
    Case("images of another size", "localize map image.png -o run", ("image.png: expected an image of 64x48 pixels", "found 32x24"),
         (MAP, file("image.png", png_bytes(32, 24)))),
    Case("prior poses of other frames", RUN + " --prior poses.txt", ("poses.txt",), (MAP, SEQ, file("poses.txt", "99 0 0 0 0 0 0 1\n"))),
    Case("prior poses", RUN + " --prior poses.txt", (NOT_FOUND,), (MAP, SEQ, trajectory()), code=1, leaves=("run", *LEFT)),
    Case("unknown parameter", RUN + " --set featurs=10", ("featurs", "features"), (MAP, SEQ)),
    Case("parameter out of range", RUN + " --set radius_px=0", ("radius_px: expected above 0",), (MAP, SEQ)),
    Case("folder that cairn did not write", "localize map seq -o other", ("other",), (MAP, SEQ, file("other/notes.txt", "mine"))),
]

if __name__ == "__main__":
    main(CASES)
