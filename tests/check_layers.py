#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the order of the rooms: what may include what.

1. A file of a room includes only rooms at or above its own in ROOMS, and only the libraries that ROOMS names for it.
2. A public header (one in the HEADERS list of its room) includes no heavy library.
3. src/cairn/CMakeLists.txt adds the rooms in the order of ROOMS, then the test kit.
4. Only tests and the kit itself include the test kit, src/cairn/testing. Its folders have the names of rooms; what lies
   in one uses that room and those above it, and so do the tests that include it.
"""

import argparse
import collections
import re
import sys
from pathlib import Path

from sources import ROOT, cpp_files

# Bottom to top, each with the libraries that it may use beside EVERYWHERE.
ROOMS = {
    "core": {"tbb", "zlib"},
    "geometry": set(),
    "image": {"opencv", "png", "turbojpeg"},
    "sequence": {"yaml-cpp", "GeographicLib"},
    "features": {"opencv"},
    "map": {"nlohmann"},
    "optimize": {"ceres"},
    "frontend": set(),
    "slam": set(),
    "survey": set(),
    "localize": set(),
    "dense": {"octomap"},
    "evaluate": set(),
    "report": {"nlohmann"},
}
KIT = "testing"
EVERYWHERE = {"fmt"}
EIGEN_FROM = "geometry"  # this room and those after it
HEAVY = {"opencv", "ceres", "octomap", "yaml-cpp", "nlohmann", "CLI"}

# A file: its room (of a file of the kit, the room whose name its folder has) and what it is.
File = collections.namedtuple("File", "room is_test is_kit is_public")

# What an include begins with, and the library that it comes from.
LIBRARIES = {
    "tbb/": "tbb", "oneapi/tbb": "tbb", "fmt/": "fmt", "Eigen/": "Eigen", "unsupported/Eigen/": "Eigen",
    "opencv2/": "opencv", "png.h": "png", "zlib.h": "zlib", "turbojpeg.h": "turbojpeg", "yaml-cpp/": "yaml-cpp",
    "ceres/": "ceres", "glog/": "ceres", "octomap/": "octomap", "nlohmann/": "nlohmann", "CLI/": "CLI",
    "GeographicLib/": "GeographicLib", "gtest/": "gtest", "gmock/": "gtest",
}
SYSTEM = {"unistd.h", "fcntl.h", "dirent.h", "immintrin.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")')


def library_of(header):
    """The library of a <header>: '' for the language's and the system's own, None where it is not known."""
    for beginning, library in LIBRARIES.items():
        if header.startswith(beginning):
            return library
    if re.fullmatch(r"[a-z_0-9]+", header) or header in SYSTEM or header.startswith("sys/"):
        return ""
    return None


def libraries_allowed(room, is_test):
    names = list(ROOMS)
    allowed = ROOMS[room] | EVERYWHERE
    if names.index(room) >= names.index(EIGEN_FROM):
        allowed = allowed | {"Eigen"}
    return allowed | {"gtest"} if is_test else allowed


def complaint_about_library(header, file):
    library = library_of(header)
    if library is None:
        return f"<{header}> is of no library that tests/check_layers.py knows; add it to LIBRARIES and to one room"
    if not library:
        return None
    if library not in libraries_allowed(file.room, file.is_test or file.is_kit):
        return f"room '{file.room}' may not use {library} (<{header}>)"
    if file.is_public and library in HEAVY:
        return f"a public header may not include {library} (<{header}>); include it in the .cpp"
    return None


def complaint_about_room(header, file):
    parts = header.split("/")
    if parts[0] != "cairn" or len(parts) not in (3, 4):
        return f'"{header}": write the whole path, "cairn/<room>/[<folder>/]<file>.h"'
    if parts[1] == KIT:
        if not (file.is_test or file.is_kit):
            return f'only tests may include the test kit ("{header}")'
        parts = parts[1:]
    names = list(ROOMS)
    if parts[1] not in ROOMS:
        return f'"{header}": there is no room \'{parts[1]}\''
    if names.index(parts[1]) > names.index(file.room):
        return f"room '{file.room}' may not include '{parts[1]}', which is further down (\"{header}\")"
    return None


def public_headers(room_folder):
    """The names in the HEADERS list of the room's CMakeLists.txt."""
    description = room_folder / "CMakeLists.txt"
    text = re.sub(r"#.*", "", description.read_text()) if description.exists() else ""
    match = re.search(r"\bHEADERS\s+(.*?)(?:\b[A-Z]{4,}\b|\))", text, re.S)
    return set(match.group(1).split()) if match else set()


def check_file(path, file):
    complaints = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        library, own = match.groups()
        complaint = complaint_about_room(own, file) if own else complaint_about_library(library, file)
        if complaint:
            complaints.append(f"{path}:{number}: {complaint}")
    return complaints


def describe(path, source):
    """The File at `path`, or None if it is in no room."""
    room, *below = path.relative_to(source).parts
    is_kit = room == KIT
    if is_kit:
        room = below[0]
    if room not in ROOMS:
        return None
    is_public = path.suffix == ".h" if is_kit else path.name in public_headers(source / room)
    return File(room, path.name.endswith("_test.cpp"), is_kit, is_public)


def check_rooms(source):
    complaints = []
    for path in cpp_files(source.parent.parent, folders=("src/cairn",)):
        file = describe(path, source)
        if file:
            complaints += check_file(path, file)
        else:
            complaints.append(f"{path}: '{path.parent.name}' is no room of tests/check_layers.py")
    return complaints


def check_program(root):
    """The program is above all rooms, but the test kit is not for it."""
    return [f'{path}:{number}: only tests may include the test kit'
            for path in cpp_files(root, folders=("apps",))
            for number, line in enumerate(path.read_text().splitlines(), 1)
            if (match := INCLUDE.match(line)) and (match.group(2) or "").startswith(f"cairn/{KIT}/")]


def check_order(description):
    text = re.sub(r"#.*", "", description.read_text()) if description.exists() else ""
    added = re.findall(r"add_subdirectory\((\w+)\)", text)
    ordered = [room for room in (*ROOMS, KIT) if room in added]
    if added == ordered:
        return []
    return [f"{description}: expected the rooms {ordered}, found {added}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=ROOT)
    root = parser.parse_args().root
    source = root / "src" / "cairn"
    complaints = check_order(source / "CMakeLists.txt") + check_rooms(source) + check_program(root)
    print(*complaints, sep="\n", end="\n" if complaints else "")
    print(f"layers: {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
