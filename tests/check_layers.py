#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what a room may include. Which rooms those are is said once, where the room is linked: the PUBLIC and PRIVATE
lists of its CMakeLists.txt.

1. A file of a room includes only its own room and those that its CMakeLists.txt names; a public header (one in HEADERS)
   only those in PUBLIC. Tests may also include what these rooms may, and what their executable is linked with.
2. A room that is named is included by a source; one in PUBLIC by a public header.
3. A room names only rooms above its own in ROOMS; src/cairn/CMakeLists.txt adds them in that order, then the test kit.
4. Only tests and the kit itself include the test kit, src/cairn/testing. Its folders have the names of rooms; what lies
   in one uses that room and those above it. A test includes the kits that its CMakeLists.txt names in KIT, and those above.
5. A file includes only the libraries that ROOMS names for its room, and a public header no heavy one.

With --table it prints which rooms each room may include.
"""

import argparse
import re
import sys
from pathlib import Path

from sources import ROOT, cpp_files

# Bottom to top, each with the libraries that it may use beside EVERYWHERE.
ROOMS = {
    "core": {"tbb", "zlib"},
    "simd": set(),
    "geometry": set(),
    "image": {"opencv", "png", "turbojpeg"},
    "sequence": {"yaml-cpp", "GeographicLib"},
    "simulate": set(),
    "features": {"opencv"},
    "matching": {"opencv"},
    "places": set(),
    "map": set(),
    "map_files": {"nlohmann"},
    "optimize": {"ceres"},
    "observe": set(),
    "slam": set(),
    "calibrate": set(),
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

# What an include begins with, and the library that it comes from.
LIBRARIES = {
    "tbb/": "tbb", "oneapi/tbb": "tbb", "fmt/": "fmt", "Eigen/": "Eigen", "unsupported/Eigen/": "Eigen",
    "opencv2/": "opencv", "png.h": "png", "zlib.h": "zlib", "turbojpeg.h": "turbojpeg", "yaml-cpp/": "yaml-cpp",
    "ceres/": "ceres", "glog/": "ceres", "octomap/": "octomap", "nlohmann/": "nlohmann", "CLI/": "CLI",
    "GeographicLib/": "GeographicLib", "gtest/": "gtest", "gmock/": "gtest",
}
SYSTEM = {"unistd.h", "fcntl.h", "glob.h", "dirent.h", "immintrin.h"}
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


def complaint_about_library(header, room, is_test, is_public):
    library = library_of(header)
    if library is None:
        return f"<{header}> is of no library that tests/check_layers.py knows; add it to LIBRARIES and to one room"
    if not library:
        return None
    if library not in libraries_allowed(room, is_test):
        return f"room '{room}' may not use {library} (<{header}>)"
    if is_public and library in HEAVY:
        return f"a public header may not include {library} (<{header}>); include it in the .cpp"
    return None


class Links:
    """Which rooms the CMakeLists.txt of a room names."""

    KEYWORDS = ("HEADERS", "SOURCES", "TESTS", "KIT", "LONG", "PUBLIC", "PRIVATE")

    def __init__(self, source, room):
        self.path = source / room / "CMakeLists.txt"
        text = re.sub(r"#.*", "", self.path.read_text()) if self.path.exists() else ""
        lists = dict.fromkeys(self.KEYWORDS, "")
        described = re.search(rf"\bcairn_room\(\s*{room}\b(.*?)\)", text, re.S)
        parts = re.split(rf"\b({'|'.join(self.KEYWORDS)})\b", described.group(1)) if described else [""]
        for keyword, content in zip(parts[1::2], parts[2::2]):
            lists[keyword] += content
        self.headers = set(lists["HEADERS"].split())
        self.public, self.private = rooms_in(lists["PUBLIC"]), rooms_in(lists["PRIVATE"])
        self.kits = set(lists["KIT"].split())
        tests = re.findall(rf"\btarget_link_libraries\(\s*cairn_{room}_tests\b(.*?)\)", text, re.S)
        self.tests = rooms_in(" ".join(tests)) | self.kits

    @property
    def all(self):
        return self.public | self.private


def rooms_in(links):
    return set(re.findall(r"\bcairn::(\w+)", links))


def reached(rooms, table):
    """The rooms themselves and all that they may include, directly or not."""
    found, ahead = set(), list(rooms)
    while ahead:
        room = ahead.pop()
        if room not in found:
            found.add(room)
            ahead += table[room].all if room in table else ()
    return found


def is_above(room, other):
    """Whether `room` is the other or above it."""
    names = list(ROOMS)
    return room in ROOMS and names.index(room) <= names.index(other)


def complaint_about_kit(header, room, table, is_test):
    kit = header.split("/")[2]
    if not is_test:
        return f'only tests may include the test kit ("{header}")'
    if not any(is_above(kit, named) for named in table[room].kits):
        return f"tests of '{room}' may not include \"{header}\": its CMakeLists.txt names no such KIT"
    return None


def complaint_about_room(header, room, table, is_test, is_public):
    parts = header.split("/")
    if parts[0] != "cairn" or len(parts) not in (3, 4):
        return f'"{header}": write the whole path, "cairn/<room>/[<folder>/]<file>.h"'
    if parts[1] == KIT:
        return complaint_about_kit(header, room, table, is_test)
    other, links = parts[1], table[room]
    if other not in ROOMS:
        return f'"{header}": there is no room \'{other}\''
    if other == room:
        return None
    if is_test:
        allowed, place = reached(links.all | links.tests, table), "PUBLIC or PRIVATE, nor is it linked to the tests"
    elif is_public:
        allowed, place = links.public, "PUBLIC, and this is a public header"
    else:
        allowed, place = links.all, "PUBLIC or PRIVATE"
    if other not in allowed:
        return f"room '{room}' may not include '{other}' (\"{header}\"): its CMakeLists.txt does not name cairn::{other} in {place}"
    return None


def is_test_file(path):
    return path.name.endswith("_test.cpp")


def included(path):
    """(number of the line, library or None, own header or None) of each include."""
    matches = ((number, INCLUDE.match(line)) for number, line in enumerate(path.read_text().splitlines(), 1))
    return [(number, *match.groups()) for number, match in matches if match]


def complaints_in(path, about_library, about_own):
    """What the two say of each include, with its line."""
    found = ((number, about_own(own) if own else about_library(library)) for number, library, own in included(path))
    return [f"{path}:{number}: {complaint}" for number, complaint in found if complaint]


def check_file(path, room, table, is_public):
    is_test = is_test_file(path)
    return complaints_in(path, lambda library: complaint_about_library(library, room, is_test, is_public),
                         lambda own: complaint_about_room(own, room, table, is_test, is_public))


def check_kit(path, room):
    """A file of the kit: it may use the room whose name its folder has, and those above."""
    def about_own(own):
        other = next((part for part in own.split("/")[1:] if part != KIT), None)
        return None if is_above(other, room) else f"the kit of '{room}' may not include \"{own}\""
    return complaints_in(path, lambda library: complaint_about_library(library, room, True, path.suffix == ".h"), about_own)


def check_program(root):
    """The program is above all rooms, but the test kit is not for it."""
    def about_own(own):
        return "only tests may include the test kit" if own.startswith(f"cairn/{KIT}/") else None
    return [complaint for path in cpp_files(root, folders=("apps",)) for complaint in complaints_in(path, lambda _: None, about_own)]


def check_names(room, links, by_sources, by_headers):
    """Rooms that are named for nothing, that are no rooms, or that are further down."""
    names = list(ROOMS)
    for other in sorted(links.all | links.tests):
        if other not in ROOMS:
            yield f"{links.path}: there is no room '{other}'"
        elif other in links.all and names.index(other) >= names.index(room):
            yield f"{links.path}: room '{room}' may not use '{other}', which is not above it"
    for other in sorted(links.all - by_sources):
        yield f"{links.path}: names cairn::{other}, of which no source of the room includes anything"
    for other in sorted((links.public & by_sources) - by_headers):
        yield f"{links.path}: names cairn::{other} in PUBLIC, but no public header includes it; name it in PRIVATE"
    for other in sorted(links.public & links.private):
        yield f"{links.path}: names cairn::{other} in PUBLIC and in PRIVATE"


def rooms_included(paths):
    owns = (own.split("/") for path in paths for _, _, own in included(path) if own)
    return {parts[1] for parts in owns if parts[0] == "cairn" and len(parts) > 2} - {KIT}


def check_rooms(source):
    table = {room: Links(source, room) for room in ROOMS}
    files = {room: [] for room in ROOMS}
    complaints = []
    for path in cpp_files(source.parent.parent, folders=("src/cairn",)):
        room, *below = path.relative_to(source).parts
        if room == KIT and below[0] in ROOMS:
            complaints += check_kit(path, below[0])
            continue
        if room not in ROOMS:
            complaints.append(f"{path}: '{room}' is no room of tests/check_layers.py")
            continue
        is_public = path.relative_to(source / room).as_posix() in table[room].headers
        complaints += check_file(path, room, table, is_public)
        if not is_test_file(path):
            files[room].append((path, is_public))
    for room, links in table.items():
        by_sources = rooms_included(path for path, _ in files[room])
        by_headers = rooms_included(path for path, is_public in files[room] if is_public)
        complaints += check_names(room, links, by_sources, by_headers)
    return complaints


def print_table(source):
    for room in ROOMS:
        links = Links(source, room)
        print(f"{room:<10} {' '.join(other for other in ROOMS if other in links.all)}")


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
    parser.add_argument("--table", action="store_true", help="print which rooms each room may include")
    arguments = parser.parse_args()
    source = arguments.root / "src" / "cairn"
    if arguments.table:
        print_table(source)
        return 0
    complaints = check_order(source / "CMakeLists.txt") + check_rooms(source) + check_program(arguments.root)
    print(*complaints, sep="\n", end="\n" if complaints else "")
    print(f"layers: {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
