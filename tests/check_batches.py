#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows that clang-tidy's batches (run_tidy.py) are as many as needed, and that no finding is lost in them."""

import json
import shutil
import sys
import unittest

from check_selftest import TESTS, Sample
from sources import ROOT


class TidyBatches(Sample):
    """Sources that are checked together: each finding is named with its source, and none is lost."""

    GOOD = "namespace {\nint one() { return 1; }\n}  // namespace\nint %s() { return one(); }\n"

    def setUp(self):
        super().setUp()
        self.need("clang-tidy-14")
        self.need("ctags")
        shutil.copy(ROOT / ".clang-tidy", self.root)

    def tidy(self, **sources):
        for name, text in sources.items():
            self.write(f"src/{name}.cpp", text)
        return self.tidy_commands(*((name, "") for name in sources))

    def tidy_commands(self, *commands):
        """Checks sources by their names, each compiled with flags."""
        build = self.root / "build"
        build.mkdir(exist_ok=True)
        entries = [{"directory": str(build), "file": str(self.root / f"src/{name}.cpp"),
                    "command": f"/usr/bin/c++ -std=c++20 {flags} -o {name}.o -c {self.root}/src/{name}.cpp"} for name, flags in commands]
        (build / "compile_commands.json").write_text(json.dumps(entries))
        return self.run_command(sys.executable, TESTS / "run_tidy.py", "--root", self.root, "--build", build)

    def batches(self):
        """How many sources each batch had."""
        return sorted(path.read_text().count("#include") for path in (self.root / "build/tidy_batches").rglob("batch.cpp"))

    def test_accepts_sources_that_define_the_same_name(self):
        code, output = self.tidy(a=self.GOOD % "a", b=self.GOOD % "b", c="int c() { return 3; }\n")
        self.assertEqual(code, 0, output)
        self.assertIn("3 sources, 0 as before, 0 with findings", output)
        self.assertEqual(self.batches(), [1, 2])  # a with c, and b

    def test_a_local_name_may_be_that_of_a_function_but_of_no_type_or_variable_elsewhere(self):
        local = "int %s(int one) {\n  const int other = one + 1;\n  return other;\n}\n"
        code, output = self.tidy(a=self.GOOD % "a", b=local % "b")
        self.assertEqual((code, self.batches()), (0, [2]), output)
        code, output = self.tidy(c="namespace {\nint other = 1;\n}  // namespace\nint c() { return other; }\n", d=local % "d")
        self.assertEqual((code, self.batches()), (0, [1, 1]), output)

    def test_sources_of_targets_with_other_definitions_and_folders_share_a_batch(self):
        self.write("x/x.h", "#ifdef LIBRARY\ninline int x() { return 1; }\n#endif\n")
        for name in "bc":
            self.write(f"src/{name}.cpp", f"int {name}() {{ return 2; }}\n")
        self.write("src/a.cpp", "#include <x.h>\nint a() { return x(); }\n")
        code, output = self.tidy_commands(("a", f"-DLIBRARY -isystem {self.root}/x"), ("b", "-DOTHER"), ("c", ""))
        self.assertEqual((code, self.batches()), (0, [3]), output)
        self.assertIn("3 sources, 0 as before, 0 with findings", output)

    def test_a_source_is_never_checked_with_a_macro_of_another_target_that_it_names(self):
        self.write("src/h.h", "#ifndef GIVEN\nint BadName();\n#endif\n")
        for name, text in (("a", ""), ("b", '#include "h.h"\n'), ("c", "#ifdef GIVEN\nint OtherName();\n#endif\n")):
            self.write(f"src/{name}.cpp", f"{text}int {name}() {{ return 1; }}\n")
        code, output = self.tidy_commands(("a", "-DGIVEN"), ("b", ""), ("c", ""))
        self.assertEqual(code, 1, output)
        self.assertIn("'BadName'", output)
        self.assertNotIn("'OtherName'", output)
        self.assertIn("3 sources, 0 as before, 1 with findings", output)
        code, output = self.tidy_commands(("a", "-DGIVEN=1"), ("c", "-DGIVEN=2"))
        self.assertIn("'OtherName'", output)
        self.assertEqual(self.batches(), [1, 1])

    def test_a_source_with_two_commands_passes_only_if_both_are_clean(self):
        self.write("src/a.cpp", "#ifdef BAD\nint BadName() { return 1; }\n#endif\n")
        self.write("src/b.cpp", "int b() { return 2; }\n")
        for again in ("0", "1"):
            code, output = self.tidy_commands(("a", "-DGOOD"), ("a", "-DBAD"), ("b", "-DGOOD"), ("b", "-DBAD"))
            self.assertEqual(code, 1, output)
            self.assertIn("'BadName'", output)
            self.assertIn(f"2 sources, {again} as before, 1 with findings", output)

    def test_names_the_source_of_a_finding_and_passes_over_the_others_the_next_time(self):
        for again in ("0", "2"):
            code, output = self.tidy(a="int a() { return 1; }\n", b="int BigName() { return 2; }\n", c="int c() { return 3; }\n")
            self.assertEqual(code, 1, output)
            self.assertIn("tidy: src/b.cpp FAILED", output)
            self.assertIn("invalid case style for function 'BigName'", output)
            self.assertIn(f"3 sources, {again} as before, 1 with findings", output)


if __name__ == "__main__":
    unittest.main()
