#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Localisation in maps, good and bad."""

from cases_map import REMEDY, VERSION_REMEDY, cut, flipped, map_folder
from harness import Case, main
from inputs import CAMERA, file, folder, png_bytes, replaced, tum_sequence, trajectory, without

MAP, SEQ = map_folder(), tum_sequence()
RUN = "localize map seq -o run --quiet"
LEFT = ("run/landmarks.png", "run/trajectory.txt", "run/localization.csv", "run/run.json", "run/.cairn")
LARGE = "camera: {model: pinhole, width: 160, height: 120, fx: 125.0, fy: 125.0, cx: 79.5, cy: 59.5}\n"
NOT_FOUND = "cairn localize: none of 3 images was found in the map."


def damaged(what, name, says):
    return Case(what, RUN, (says,), (MAP, SEQ, flipped(f"map/{name}", 60)))


CASES = [
    Case("images of elsewhere", RUN, (NOT_FOUND,), (MAP, SEQ), code=1, leaves=("run", *LEFT)),
    Case("nothing is said of precision if nothing is found", RUN + " --json", (NOT_FOUND,), (MAP, SEQ), code=1, leaves=("run", *LEFT),
         prints=('"median_inliers": null', '"median_std_m": null', '"median_protection_m": null', '"stamps": "times"')),
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
    Case("another camera by its own calibration", RUN, (NOT_FOUND,), (MAP, SEQ, replaced("seq/camera.yaml", "fx: 50.0", "fx: 60.0")),
         code=1, leaves=("run", *LEFT)),
    Case("another camera by --camera", RUN + " --camera other.yaml", (NOT_FOUND,), (MAP, SEQ, file("other.yaml", CAMERA.replace("fx: 50.0", "fx: 60.0"))),
         code=1, leaves=("run", *LEFT)),
    Case("another camera as it was said before", RUN + " --any-camera", (NOT_FOUND,), (MAP, SEQ, replaced("seq/camera.yaml", "fx: 50.0", "fx: 60.0")),
         code=1, leaves=("run", *LEFT)),
    Case("help on another camera", "localize --help", code=0, prints=("--any-camera", "not needed: the calibration says which camera")),
    Case("image of another size", "localize map image.png -o run",
         ("image.png: expected an image of 64x48 pixels, as the map's camera has, or a calibration", "found 32x24 and no calibration", "--camera FILE"),
         (MAP, file("image.png", png_bytes(32, 24)))),
    Case("folder of images of another size", "localize map images -o run", ("images/a.png: expected an image of 64x48 pixels", "--camera FILE"),
         (MAP, file("images/a.png", png_bytes(160, 120)))),
    Case("map that does not say its size", "localize map image.png -o run", ("--camera: expected the calibration of the images",),
         (map_folder(width=0, height=0), file("image.png", png_bytes()))),
    Case("larger images by --camera", "localize map images -o run --camera large.yaml", ("none of 1 images",),
         (MAP, file("images/a.png", png_bytes(160, 120)), file("large.yaml", LARGE)), code=1, leaves=("run", *LEFT),
         prints=("camera       160x120 pixels, scaled to 64x48: to the map's pixels per radian",)),
    Case("larger images by camera.yaml beside them", "localize map images -o run", ("none of 1 images",),
         (MAP, file("images/a.png", png_bytes(160, 120)), file("images/camera.yaml", LARGE)), code=1, leaves=("run", *LEFT),
         prints=("scaled to 64x48",)),
    Case("a rate alone beside the images completes the map's camera", "localize map images -o run --json", ("none of 2 images",),
         (MAP, file("images/a.png", png_bytes()), file("images/b.png", png_bytes()), file("images/camera.yaml", "rate_hz: 10\n")), code=1,
         leaves=("run", *LEFT), prints=('"stamps": "times"',)),
    Case("--camera without a camera", "localize map image.png -o run --camera body.yaml",
         ("body.yaml:1: expected 'camera' in 'calibration'", "Add 'camera'."), (MAP, file("image.png", png_bytes()), file("body.yaml", "rate_hz: 10\n"))),
    Case("image that is not of its calibration's size", "localize map image.png -o run --camera large.yaml",
         ("image.png: expected an image of 160x120 pixels, as the calibration says", "by --camera FILE"),
         (MAP, file("image.png", png_bytes(32, 24)), file("large.yaml", LARGE))),
    Case("frames of 7-Scenes without depth are photos", "localize map images -o run", ("none of 2 images",),
         (MAP, file("images/frame-000002.color.png", png_bytes()), file("images/frame-000007.color.png", png_bytes())), code=1,
         leaves=("run", *LEFT), prints=("stamps       positions of the images in their folder",)),
    Case("photos one after the other", "localize map images -o run --prior last", ("--prior last is ignored: these images have no times", "none of 2"),
         (MAP, file("images/a.png", png_bytes()), file("images/b.png", png_bytes())), code=1, leaves=("run", *LEFT)),
    Case("a video of images", "localize map images -o run --prior last", ("none of 2",),
         (MAP, file("images/a.png", png_bytes()), file("images/b.png", png_bytes()), file("images/camera.yaml", CAMERA + "rate_hz: 10\n")), code=1,
         leaves=("run", *LEFT)),
    Case("prior poses of other frames", RUN + " --prior poses.txt", ("poses.txt",), (MAP, SEQ, file("poses.txt", "99 0 0 0 0 0 0 1\n"))),
    Case("prior poses of another clock", RUN + " --prior poses.txt", ("poses.txt: expected poses within", "--pose-offset start"),
         (MAP, SEQ, file("poses.txt", "1317042145.594 0 0 0 0 0 0 1\n"))),
    Case("prior poses of another clock, aligned", RUN + " --prior poses.txt --pose-offset start",
         ("cairn: poses.txt: the first stamps are aligned by an offset of", NOT_FOUND), (MAP, SEQ, file("poses.txt", "1317042145.594 0 0 0 0 0 0 1\n")),
         code=1, leaves=("run", *LEFT)),
    Case("prior poses", RUN + " --prior poses.txt", (NOT_FOUND,), (MAP, SEQ, trajectory()), code=1, leaves=("run", *LEFT)),
    Case("unknown parameter", RUN + " --set featurs=10", ("featurs", "features"), (MAP, SEQ)),
    Case("parameter out of range", RUN + " --set radius_px=0", ("radius_px: expected pixels above 0",), (MAP, SEQ)),
    Case("folder that cairn did not write", "localize map seq -o other", ("other",), (MAP, SEQ, file("other/notes.txt", "mine"))),
]

if __name__ == "__main__":
    main(CASES)
