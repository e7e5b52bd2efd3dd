#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows that each check of this folder finds what it is there to find: a good sample passes, a bad one fails."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from sources import ROOT

TESTS = Path(__file__).resolve().parent


# That of the build (tests/CMakeLists.txt); by hand whichever there is.
COMPILER = os.environ.get("CXX") or next(filter(None, map(shutil.which, ("clang++-16", "g++", "c++"))))


class Sample(unittest.TestCase):
    """A project of a few lines in a temporary folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def run_command(self, *command):
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def check(self, script):
        return self.run_command(sys.executable, TESTS / script, "--root", self.root)

    def need(self, tool):
        if not shutil.which(tool):
            self.skipTest(f"{tool} is not installed")


class Layers(Sample):
    def setUp(self):
        super().setUp()
        self.write("src/cairn/CMakeLists.txt", "add_subdirectory(core)\nadd_subdirectory(map)\nadd_subdirectory(optimize)\n")
        self.write("src/cairn/map/CMakeLists.txt", "cairn_room(map\n  HEADERS map.h\n  PRIVATE fmt::fmt)\n")
        self.link("PUBLIC cairn::map")
        self.write("src/cairn/optimize/window.h", '#include "cairn/map/map.h"\n')

    def link(self, links, after=""):
        self.write("src/cairn/optimize/CMakeLists.txt",
                   f"cairn_room(optimize\n  HEADERS window.h\n  SOURCES window.cpp\n  {links})  # cairn::core\n{after}")

    def refuse_links(self, links, message, after=""):
        self.link(links, after)
        self.expect("src/cairn/core/text.h", "\n", message)

    def expect(self, name, text, message):
        self.write(name, text)
        code, output = self.check("check_layers.py")
        self.assertEqual(code, 1 if message else 0, output)
        self.assertIn(message or "0 complaints", output)

    def test_accepts_rooms_that_are_linked_and_named_libraries(self):
        self.expect("src/cairn/optimize/window.cpp",
                    '#include <ceres/ceres.h>\n#include <fmt/format.h>\n#include <unistd.h>\n#include <vector>\n'
                    '#include "cairn/optimize/window.h"\n#include "cairn/map/map.h"\n', None)

    def test_refuses_a_room_above_that_is_not_linked(self):
        self.expect("src/cairn/optimize/window.cpp", '\n#include "cairn/core/text.h"\n',
                    "window.cpp:2: room 'optimize' may not include 'core'")

    def test_refuses_a_room_in_a_public_header_that_is_linked_privately(self):
        self.refuse_links("PRIVATE cairn::map", "window.h:1: room 'optimize' may not include 'map'")

    def test_accepts_in_a_test_what_a_linked_room_may_include(self):
        self.write("src/cairn/map/CMakeLists.txt", "cairn_room(map\n  HEADERS map.h\n  PUBLIC cairn::core)\n")
        self.write("src/cairn/map/map.h", '#include "cairn/core/text.h"\n')
        self.expect("src/cairn/optimize/window_test.cpp", '#include "cairn/core/text.h"\n', None)

    def test_accepts_in_a_test_what_its_executable_is_linked_with(self):
        self.link("PUBLIC cairn::map", "target_link_libraries(cairn_optimize_tests PRIVATE cairn::core)\n")
        self.expect("src/cairn/optimize/window_test.cpp", '#include "cairn/core/text.h"\n', None)

    def test_refuses_in_a_test_what_nothing_is_linked_with(self):
        self.expect("src/cairn/optimize/window_test.cpp", '#include "cairn/core/text.h"\n',
                    "room 'optimize' may not include 'core'")

    def test_refuses_a_room_further_down(self):
        self.write("src/cairn/map/CMakeLists.txt", "cairn_room(map\n  HEADERS map.h\n  PUBLIC cairn::optimize)\n")
        self.expect("src/cairn/map/map.h", '#include "cairn/optimize/window.h"\n',
                    "room 'map' may not use 'optimize', which is not above it")

    def test_refuses_a_link_of_which_nothing_is_included(self):
        self.refuse_links("PUBLIC cairn::map cairn::core", "names cairn::core, of which no source")

    def test_refuses_a_public_link_that_only_sources_need(self):
        self.write("src/cairn/optimize/window.cpp", '#include "cairn/core/text.h"\n')
        self.refuse_links("PUBLIC cairn::map cairn::core", "names cairn::core in PUBLIC, but no public header includes it")

    def test_refuses_a_link_to_an_unknown_room(self):
        self.refuse_links("PUBLIC cairn::map cairn::attic", "there is no room 'attic'")

    def test_refuses_an_unknown_room(self):
        self.expect("src/cairn/map/map.h", '#include "cairn/maps/map.h"\n', "there is no room 'maps'")

    def test_refuses_a_room_that_is_not_in_the_table(self):
        self.expect("src/cairn/attic/a.h", "\n", "'attic' is no room")

    def test_refuses_a_relative_include(self):
        self.expect("src/cairn/map/map.cpp", '#include "map.h"\n', "write the whole path")

    def test_refuses_a_library_that_the_room_has_not(self):
        self.expect("src/cairn/map/map.cpp", "#include <ceres/ceres.h>\n", "room 'map' may not use ceres")

    def test_refuses_a_library_that_nobody_has(self):
        self.expect("src/cairn/map/map.cpp", "#include <pcl/point_cloud.h>\n", "of no library that")

    def test_refuses_a_heavy_library_in_a_public_header(self):
        self.expect("src/cairn/optimize/window.h", "#include <ceres/ceres.h>\n", "a public header may not include ceres")

    def test_tests_and_the_kit_may_include_the_kit(self):
        self.write("src/cairn/map/CMakeLists.txt", "cairn_room(map\n  HEADERS map.h\n  KIT map\n  PRIVATE fmt::fmt)\n")
        self.link("KIT map\n  PUBLIC cairn::map")
        self.write("src/cairn/testing/core/folder.h", "#include <gtest/gtest.h>\n")
        self.write("src/cairn/testing/map/world.cpp", '#include "cairn/map/map.h"\n#include "cairn/testing/core/folder.h"\n')
        self.write("src/cairn/map/map_test.cpp", '#include <gtest/gtest.h>\n#include "cairn/testing/map/world.h"\n')
        self.expect("src/cairn/optimize/window_test.cpp", '#include "cairn/testing/map/world.h"\n', None)

    def test_refuses_the_kit_in_what_is_no_test(self):
        self.expect("src/cairn/map/map.cpp", '#include "cairn/testing/map/world.h"\n', "map.cpp:1: only tests may include")

    def test_refuses_the_kit_in_the_program(self):
        self.expect("apps/cairn/main.cpp", '#include "cairn/testing/map/world.h"\n', "main.cpp:1: only tests may include")

    def test_refuses_a_part_of_the_kit_that_is_not_named(self):
        self.write("src/cairn/map/CMakeLists.txt", "cairn_room(map\n  HEADERS map.h\n  KIT core\n  PRIVATE fmt::fmt)\n")
        self.expect("src/cairn/map/map_test.cpp", '#include "cairn/testing/map/world.h"\n',
                    "tests of 'map' may not include \"cairn/testing/map/world.h\"")

    def test_refuses_a_part_of_the_kit_that_reaches_further_down(self):
        self.expect("src/cairn/testing/map/world.cpp", '#include "cairn/optimize/window.h"\n',
                    "the kit of 'map' may not include")

    def test_refuses_a_heavy_library_in_a_header_of_the_kit(self):
        self.expect("src/cairn/testing/optimize/scene.h", "#include <ceres/ceres.h>\n", "a public header may not include ceres")

    def test_refuses_rooms_out_of_order(self):
        self.expect("src/cairn/CMakeLists.txt", "add_subdirectory(map)\nadd_subdirectory(core)\n", "expected the rooms")

    def test_prints_the_table(self):
        code, output = self.run_command(sys.executable, TESTS / "check_layers.py", "--root", self.root, "--table")
        self.assertEqual(code, 0, output)
        self.assertIn("optimize   map\n", output)


class Lengths(Sample):
    def setUp(self):
        super().setUp()
        self.need("ctags")

    def test_accepts_short_ones(self):
        self.write("src/a.cpp", "int one() {\n  return 1;\n}\n")
        self.assertEqual(self.check("report_lengths.py")[0], 0)

    def test_refuses_a_long_function(self):
        self.write("src/a.cpp", "int one() {\n" + "  // a line\n" * 60 + "  return 1;\n}\n")
        code, output = self.check("report_lengths.py")
        self.assertEqual(code, 1)
        self.assertIn("src/a.cpp:1 one: 63 lines, at most 60", output)

    def test_refuses_a_long_file(self):
        self.write("src/a.h", "// a line\n" * 401)
        code, output = self.check("report_lengths.py")
        self.assertEqual(code, 1)
        self.assertIn("src/a.h: 401 lines, at most 400", output)


class Format(Sample):
    def setUp(self):
        super().setUp()
        self.need("clang-format-14")
        shutil.copy(ROOT / ".clang-format", self.root)

    def test_tells_formatted_from_unformatted(self):
        self.write("src/a.cpp", "int one() {\n  return 1;\n}\n")
        self.assertEqual(self.check("check_format.py")[0], 0)
        self.write("src/a.cpp", "int  one()\n{ return 1; }\n")
        self.assertEqual(self.check("check_format.py")[0], 1)


class Includes(Sample):
    def setUp(self):
        super().setUp()
        self.write("cmake/precompiled.cmake", "set(CAIRN_PRECOMPILED_HEADERS\n  <Eigen/LU> <string> <vector>)\n")
        self.write("src/cairn/core/text.h", "#include <string>\n")

    def expect(self, text, message, own=True):
        self.write("src/cairn/core/text.cpp", '#include "cairn/core/text.h"\n' + text if own else text)
        code, output = self.check("check_includes.py")
        self.assertEqual(code, 1 if message else 0, output)
        self.assertIn(message or "0 complaints", output)

    def test_accepts_what_our_headers_include_and_what_a_header_of_eigen_brings(self):
        self.expect('#include <Eigen/LU>\nstd::string a;\nEigen::PartialPivLU<Eigen::Matrix3d> b;\n', None)

    def test_passes_over_comments_and_text(self):
        self.expect('// std::vector\nconst char* a = "std::vector";\n', None)

    def test_refuses_what_is_not_included(self):
        self.expect("\nstd::vector<int> a;\n",
                    "core/text.cpp:3: uses std::vector and does not include <vector>")

    def test_refuses_a_library_that_is_not_included(self):
        self.expect("#include <Eigen/Core>\nEigen::Quaterniond a;\n", "does not include <Eigen/Geometry>")

    def test_refuses_a_source_whose_own_header_is_not_the_first(self):
        self.expect('#include <vector>\n#include "cairn/core/text.h"\n',
                    'text.cpp: does not include "cairn/core/text.h" before all others', own=False)

    def test_refuses_a_precompiled_header_that_it_does_not_know(self):
        self.write("cmake/precompiled.cmake", "set(CAIRN_PRECOMPILED_HEADERS\n  <deque>)\n")
        self.expect("\n", "<deque> is precompiled, and check_includes.py does not know")


class Headers(Sample):
    def verify(self, header):
        self.write("src/room/b.h", "#pragma once\nstruct B {};\n")
        self.write("src/room/a.h", header)
        self.write("src/room/c.cpp", '#include "room/b.h"\n\n#include "room/a.h"\n')
        self.write("src/room/CMakeLists.txt", "cairn_room(room HEADERS a.h SOURCES c.cpp)\n")
        self.write("CMakeLists.txt",
                   "cmake_minimum_required(VERSION 3.25)\nproject(sample LANGUAGES CXX)\n"
                   "find_package(Eigen3 REQUIRED)\nfind_package(fmt REQUIRED)\nadd_library(cairn_compile_options INTERFACE)\n"
                   f"include({ROOT}/cmake/precompiled.cmake)\ninclude({ROOT}/cmake/rooms.cmake)\n"
                   "add_subdirectory(src/room)\n")
        build = self.root / "build"
        code, output = self.run_command("cmake", "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={COMPILER}", "-S", self.root, "-B", build)
        self.assertEqual(code, 0, output)
        return self.run_command("cmake", "--build", build, "--target", "cairn_headers")

    def test_refuses_a_header_that_needs_another_before_it(self):
        code, output = self.verify("#pragma once\nB make_b();\n")
        self.assertNotEqual(code, 0, output)
        self.assertIn("a.h", output)

    def test_accepts_a_header_that_stands_alone(self):
        code, output = self.verify('#pragma once\n#include "room/b.h"\nB make_b();\n')
        self.assertEqual(code, 0, output)


class Kernels(Sample):
    def objects(self, source):
        self.write("a.cpp", source + "\n")
        place = self.root / "build/cairn_room_avx2.dir/kernels"
        place.mkdir(parents=True)
        code, output = self.run_command(COMPILER, "-std=c++20", "-c", self.root / "a.cpp", "-o", place / "a.cpp.o")
        self.assertEqual(code, 0, output)
        return self.run_command(sys.executable, TESTS / "check_kernels.py", "--build", self.root / "build")

    def test_accepts_functions_of_the_object_alone(self):
        code, output = self.objects("namespace { inline int one() { return 1; } }\nint two() { return one() + 1; }")
        self.assertEqual(code, 0, output)

    def test_refuses_an_inline_function_that_others_may_define(self):
        code, output = self.objects("inline int one() { return 1; }\nint two() { return one() + 1; }")
        self.assertEqual(code, 1, output)
        self.assertIn("'one()' may be shared", output)


class Tidy(Sample):
    BAD = {
        "struct lower_type {};": "invalid case style for struct",
        "void PascalFunction() {}": "invalid case style for function",
        "int CamelVariable = 0;": "invalid case style for variable",
        "constexpr int limit = 3;": "invalid case style for constexpr variable",
        "class A { int member; };": "invalid case style for private member",
        "enum class E { kOne };": "invalid case style for enum constant",
        "void f() { int a = 1; if ((a = 2)) {} sizeof(sizeof(a)); }": "bugprone-sizeof-expression",
    }
    GOOD = ("enum class Kind { one, two };\nconstexpr int kLimit = 3;\n"
            "class Box {\n public:\n  [[nodiscard]] int width() const { return width_; }\n\n"
            " private:\n  int width_ = kLimit;\n};\n")

    def setUp(self):
        super().setUp()
        self.need("clang-tidy-14")
        shutil.copy(ROOT / ".clang-tidy", self.root)

    def tidy(self, text):
        self.write("src/a.cpp", text + "\n")
        return self.run_command("clang-tidy-14", "--quiet", self.root / "src" / "a.cpp", "--", "-std=c++20")

    def test_accepts_the_house_style(self):
        code, output = self.tidy(self.GOOD)
        self.assertEqual(code, 0, output)

    def test_refuses_each_bad_line(self):
        for line, message in self.BAD.items():
            with self.subTest(line):
                code, output = self.tidy(line)
                self.assertNotEqual(code, 0)
                self.assertIn(message, output)


class CommandLineTables(Sample):
    """The harness of tests/cli against programs that behave badly."""

    GOOD = "echo 'cairn: a.txt:3: expected 8 values, found 7.' >&2; exit 2"
    BAD = {
        "wrong exit code": "echo 'cairn: a.txt:3: expected 8 values, found 7.' >&2; exit 1",
        "another message": "echo 'cairn: something is wrong.' >&2; exit 2",
        "two messages": f"echo 'cairn: oh' >&2; {GOOD}",
        "noise on stdout": f"echo oh; {GOOD}",
        "a file left behind": f"echo half >out.txt; {GOOD}",
        "a file changed": f"echo more >>a.txt; {GOOD}",
        "a file removed": f"rm a.txt; {GOOD}",
        "a crash": "kill -SEGV $$",
    }

    def verdict(self, script):
        self.write("program", f"#!/bin/bash\n{script}\n")
        (self.root / "program").chmod(0o755)
        sys.path.insert(0, str(TESTS / "cli"))
        import harness
        import inputs
        harness.CommandLine.program = str(self.root / "program")
        case = harness.Case("row", "evaluate a.txt", ("a.txt:3:",), (inputs.file("a.txt", "1 2 3\n"),))
        result = unittest.TestResult()
        harness.CommandLine.row = lambda self: self.check(case)
        harness.CommandLine("row").run(result)
        return result.wasSuccessful()

    def test_accepts_one_message_that_names_the_place(self):
        self.assertTrue(self.verdict(self.GOOD))

    def test_refuses_each_bad_program(self):
        for name, script in self.BAD.items():
            with self.subTest(name):
                self.assertFalse(self.verdict(script))


if __name__ == "__main__":
    unittest.main()
