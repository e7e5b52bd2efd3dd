#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The figures of the documents: layouts, templates, what is found to be wrong with a text, and what differs."""

import argparse
import contextlib
import io
import json
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import measure_beside_peers as bench
import run
from experiments import Experiment, load_all
from results import Figure, Measured, Store, collect, summarize
from texts import Documents, TextError, show, step, unmarked
from work import Contradiction, Skipped, expect


def figure(value, spread=0.0, kind="result", commit="abcdef1"):
    return Figure(value, value - spread, value + spread, 3, kind, commit)


class Layout(unittest.TestCase):
    def test_significant_digits(self):
        for value, layout, shown in ((38512, "s3", "38,500"), (0.2468, "s2", "0.25"), (3.04, "s2", "3.0"), (9.96, "s2", "10"), (99.96, "s3", "100"),
                                     (0.000412, "s1", "0.0004"), (1234, "s1", "1,000"), (0, "s2", "0.0"), (-2.55, "s2", "-2.5"), (600, "s3", "600")):
            self.assertEqual(show(value, layout), shown, (value, layout))

    def test_layouts_of_python(self):
        self.assertEqual(show(7846.6, ",.0f"), "7,847")
        self.assertEqual(show(-0.001, ".1f"), "0.0")  # no minus before nothing
        self.assertEqual(show(5.0, "g"), "5")

    def test_step_is_one_unit_of_the_last_digit(self):
        for value, layout, unit in ((38512, "s3", 100), (0.2468, "s2", 0.01), (9.96, "s2", 1), (600, "s3", 1), (7846.6, ",.0f", 1), (1.2, ".3f", 0.001)):
            self.assertAlmostEqual(step(value, layout), unit, places=9, msg=(value, layout))


class Summary(unittest.TestCase):
    def test_median_least_and_greatest(self):
        found = summarize([Measured(3), Measured(1), Measured(2.0000004)], "abc")
        self.assertEqual((found.value, found.low, found.high, found.of, found.commit), (2, 1, 3, 3, "abc"))

    def test_a_time_of_a_busy_machine_is_none(self):
        self.assertIsNone(summarize([Measured(3, "time", True), Measured(1, "time", False)], "abc"))

    def test_cases_need_not_have_the_same_names(self):
        self.assertEqual(collect([{"a": 1}, {"a": 2, "b": Measured(3, "memory")}]), {"a": [Measured(1), Measured(2)], "b": [Measured(3, "memory")]})

    def test_what_differs(self):
        kept = figure(10, spread=1)
        for value, said in ((10, ""), (11.1, ""), (8.9, ""), (11.2, "DIFFERS"), (8.8, "DIFFERS")):
            self.assertEqual(run.verdict(kept, figure(value), 0.1), said, value)
        self.assertEqual(run.verdict(figure(10, kind="time"), figure(20, kind="time"), 0.1), "")
        self.assertEqual(run.verdict(None, figure(10)), "new")
        self.assertIn("busy", run.verdict(kept, None))


class Sample(unittest.TestCase):
    """A project with one document and a template in a temporary folder."""

    FIGURES = {"slam.kitti.ate_m": figure(0.2468, 0.01), "slam.kitti.time_s": figure(3.21, kind="time", commit="1234567")}
    TABLE = "| | ATE | time |\n|---|--:|--:|\n| drive, 200 pairs | {slam.kitti.ate_m:s2} m | {slam.kitti.time_s:s2} s |\n\n{at}.\n"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("docs", "texts"):
            (self.root / name).mkdir()
        self.write("by_hand.json", "{}")
        self.set_texts(self.TABLE, "Before.\n\n<!-- figures: slam -->\nx\n<!-- end -->\n\nAfter.\n")

    def write(self, name, text):
        (self.root / name).write_text(text)

    def set_texts(self, template, document):
        self.write("texts/README.md", f"<!-- figures: slam -->\n{template}<!-- end -->\n")
        self.write("README.md", document)

    def documents(self):
        store = Store(self.root / "results.json", self.root / "by_hand.json")
        store.figures = dict(self.FIGURES)
        return Documents(store, self.root, self.root / "texts", self.root / "not_measured.txt")

    def complaints(self, experiments=("slam.kitti",)):
        return self.documents().complaints(experiments)

    def expect(self, *parts):
        said = "\n".join(self.complaints())
        for part in parts:
            self.assertIn(part, said)


class Rendering(Sample):
    def test_writes_the_block_and_its_commits(self):
        self.assertEqual(self.documents().mend(), ["README.md"])
        self.assertEqual((self.root / "README.md").read_text(), "Before.\n\n<!-- figures: slam (measured at commit abcdef1; times and memory at commit 1234567) -->\n"
                         "| | ATE | time |\n|---|--:|--:|\n| drive, 200 pairs | 0.25 m | 3.2 s |\n\n"
                         "Measured at commit abcdef1; times and memory at commit 1234567.\n<!-- end -->\n\nAfter.\n")
        self.assertEqual(self.complaints(), [])
        self.assertEqual(self.documents().mend(), [])

    def test_least_greatest_given_and_by_hand(self):
        self.write("by_hand.json", json.dumps({"peer.ate_m": {"value": 0.3, "how": "by hand"}}))
        self.set_texts("{slam.kitti.ate_m.low:.3f} to {slam.kitti.ate_m.high:.3f} m in {=20 m}, {peer.ate_m:.2f} m.\n", "<!-- figures: slam -->\n<!-- end -->\n")
        self.documents().mend()
        self.assertIn("\n0.237 to 0.257 m in 20 m, 0.30 m.\n", (self.root / "README.md").read_text())
        self.assertEqual(self.complaints(), [])


    def test_a_range_whose_ends_look_the_same_is_one_number(self):
        self.set_texts("{slam.kitti.ate_m.low:.0f} to {slam.kitti.ate_m.high:.0f} m, {slam.kitti.ate_m.low:.2f} to {slam.kitti.ate_m.high:.2f} m.\n",
                       "<!-- figures: slam -->\n<!-- end -->\n")
        self.documents().mend()
        self.assertIn("\n0 m, 0.24 to 0.26 m.\n", (self.root / "README.md").read_text())
        self.assertEqual(self.complaints(), [])


class Complaints(Sample):
    def test_a_figure_that_was_changed_by_hand(self):
        self.documents().mend()
        text = (self.root / "README.md").read_text()
        self.write("README.md", text.replace("0.25 m", "0.24 m"))
        self.expect("README.md:6: differs from its template", "0.24 m", "0.25 m")

    def test_a_name_that_nothing_has(self):
        self.set_texts("{slam.kitty.ate_m:s2} m.\n", "<!-- figures: slam -->\n<!-- end -->\n")
        self.expect("no figure is called 'slam.kitty.ate_m'")

    def test_a_place_that_is_no_name(self):
        self.set_texts("{Slam kitti} m.\n", "<!-- figures: slam -->\n<!-- end -->\n")
        with self.assertRaises(TextError):
            self.documents().mend()

    def test_marks_without_end_twice_or_without_template(self):
        self.write("README.md", "<!-- figures: slam -->\nx\n")
        self.expect("has no `<!-- end -->`")
        self.write("README.md", "<!-- figures: slam -->\n<!-- end -->\n" * 2)
        self.expect("two blocks are called 'slam'")
        self.write("README.md", "<!-- figures: other -->\n<!-- end -->\n")
        self.expect("README.md:")

    def test_a_number_beside_the_figures(self):
        self.documents().mend()
        text = (self.root / "README.md").read_text()
        for line, named in (("It has 3.4 cm.", "3.4 cm"), ("| a | 17 |", "17"), ("It is 12 % faster.", "12 %")):
            self.write("README.md", f"{text}\n{line}\n")
            self.expect(f"'{named}' is no figure of a template")
        for line in ("`--gap 3 cm` in [5 m](x), seed 3, V1_01", "| 17 | a |"):
            self.write("README.md", f"{text}\n{line}\n")
            self.assertEqual(self.complaints(), [], line)

    def test_numbers_that_are_said_to_be_no_measurement(self):
        self.documents().mend()
        text = (self.root / "README.md").read_text()
        self.write("not_measured.txt", "# why\nREADME.md: at most 3.4 cm\n")
        self.write("README.md", f"{text}\nIt may have at most 3.4 cm.\n")
        self.assertEqual(self.complaints(), [])
        self.write("README.md", text)
        self.expect("does not say 'at most 3.4 cm' outside of figures any more")

    def test_a_number_of_a_template_that_is_no_figure(self):
        self.set_texts(self.TABLE.replace("{slam.kitti.ate_m:s2} m", "0.25 m"), "<!-- figures: slam -->\n<!-- end -->\n")
        self.documents().mend()
        self.expect("'0.25 m' in 'slam' is neither a figure nor given")

    def test_a_table_that_says_no_commit(self):
        self.set_texts(self.TABLE.replace("{at}", "So"), "<!-- figures: slam -->\n<!-- end -->\n")
        self.expect("the table 'slam' lacks {at}")

    def test_what_nothing_shows(self):
        self.write("by_hand.json", json.dumps({"peer.ate_m": {"value": 0.3}}))
        self.documents().mend()
        said = "\n".join(self.complaints(("slam.kitti", "slam.other")))
        for part in ("no template shows 'peer.ate_m'", "'peer.ate_m' does not say how", "no template shows a figure of the experiment 'slam.other'"):
            self.assertIn(part, said)
        self.assertIn("'slam.kitti.ate_m' is of no experiment", "\n".join(self.complaints(("slam.other",))))

    def test_a_document_without_template_is_read_too(self):
        self.documents().mend()
        self.write("docs/more.md", "| a | 5 ms |\n")
        self.expect("docs/more.md:1: '5 ms'")


class Sessions(Sample):
    """An experiment without a program."""

    def run_one(self, measure, cases=(1, 2), **flags):
        """The code with which the program would end, and what it printed."""
        arguments = argparse.Namespace(**{"ci": False, "update": False, **flags})
        documents = self.documents()
        with mock.patch.object(run, "commit_of_sources", lambda: "7654321"), contextlib.redirect_stdout(io.StringIO()) as printed:
            session = run.Session(arguments, mock.Mock(commands=["cairn slam"]), documents)
            session.run_all([Experiment("slam.kitti", measure, cases, True)])
            code = session.conclude()
        self.store = documents.renderer.store
        return code, printed.getvalue()

    def test_agrees_or_differs(self):
        for value, code in ((0.2468, 0), (0.266, 0), (0.268, 1), (0.22, 1)):
            found, printed = self.run_one(lambda work, seed, value=value: {"ate_m": value, "time_s": Measured(9, "time", False), "unknown": 1})
            self.assertEqual(found, code, printed)
            self.assertEqual("differ from what the documents say: slam.kitti.ate_m" in printed, code == 1, printed)
            self.assertNotIn("unknown", printed)

    def test_the_tests_run_the_first_case_alone(self):
        _, printed = self.run_one(lambda work, seed: {"ate_m": 0.25 + seed - 1}, ci=True)
        self.assertIn("1 of 2 cases", printed)
        self.assertNotIn("DIFFERS", printed)

    def test_an_update_is_written(self):
        code, printed = self.run_one(lambda work, seed: {"ate_m": 0.3 + seed, "time_s": Measured(9, "time", False)}, update=True)
        self.assertEqual(code, 0, printed)
        self.assertEqual(self.store.figures["slam.kitti.ate_m"], Figure(1.8, 1.3, 2.3, 2, "result", "7654321"))
        self.assertEqual(self.store.figures["slam.kitti.time_s"], self.FIGURES["slam.kitti.time_s"])
        self.assertIn("| 1.8 m | 3.2 s |", (self.root / "README.md").read_text())
        self.assertEqual(json.loads((self.root / "results.json").read_text())["experiments"]["slam.kitti"]["commands"], ["cairn slam"])

    def test_a_sentence_that_does_not_hold(self):
        code, printed = self.run_one(lambda work, seed: expect(False, "all is well"))
        self.assertEqual(code, 1)
        self.assertIn("FAILED: does not hold any more: all is well", printed)

    def test_a_defect_of_an_experiment_leaves_the_others(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code, printed = self.run_one(lambda work, seed: {}["no"])
        self.assertEqual(code, 1)
        self.assertIn("KeyError", said.getvalue())
        self.assertIn("failed: slam.kitti", printed)

    def test_what_is_not_here_is_skipped_unless_it_is_required(self):
        def skip(_, __):
            raise Skipped("no recording")
        for required, code in (("", run.SKIPPED), ("1", 1)):
            with mock.patch.dict(os.environ, {"CAIRN_REQUIRE_DATA": required}):
                found, printed = self.run_one(skip, ci=True)
            self.assertEqual(found, code)
            self.assertIn("SKIPPED: no recording", printed)


class Bench(unittest.TestCase):
    """What cairn_bench prints, of which the tests have the rows alone."""

    HEAD = "| work | threads | cairn, ms | peer, ms | share | at most | held |\n|---|--:|--:|--:|--:|--:|---|\n"
    QUALITY_HEAD = "\n| quality | cairn | peer | limit | held |\n|---|--:|--:|---|---|\n"

    @staticmethod
    def a_row_of(pattern):
        return pattern.replace(r"\d+", "638").replace(".*", "some")

    def printed(self, identical="1000"):
        timed = [f"| {self.a_row_of(pattern)} | {threads} | {0.5 * threads} | 2 | 1/4.0 | 1/3 | yes |\n" for pattern in bench.TIMED.values() for threads in (1, 2)]
        quality = [f"| {self.a_row_of(pattern)} | 205 | 203 | at least 100 % of the peer's | yes |\n" for pattern in bench.QUALITY.values()]
        return self.HEAD + "".join(timed) + self.QUALITY_HEAD + "".join(quality) + f"| Hamming, identical matches | 1000 | {identical} | | |\n"

    def test_rows_are_found_by_their_work_on_one_thread(self):
        found = bench.figures_of(self.printed(), lambda value: value)
        self.assertEqual((found["orb_ms"], found["orb_peer_ms"], found["orb_times"]), (0.5, 2, 4))
        self.assertEqual((found["sift_kitti"], found["sift_kitti_peer"], found["epnp_right"], found["keypoints"]), (205, 203, 205, 638))

    def test_a_row_that_is_missing_or_a_claim_that_fails(self):
        with self.assertRaisesRegex(RuntimeError, "prints 0 rows 'ORB 1000, 640x480'"):
            bench.figures_of(self.printed().replace("| ORB 1000, 640x480 |", "| ORB |"), float)
        with self.assertRaisesRegex(Contradiction, "identical"):
            bench.figures_of(self.printed(identical="999"), float)


class Registry(unittest.TestCase):
    def test_experiments_have_names_that_no_other_begins_inside(self):
        names = load_all().keys()
        self.assertGreater(len(names), 20)
        for name in names:
            self.assertRegex(name, r"^[a-z][a-z_0-9]*(\.[a-z][a-z_0-9]*)?$")


class Numbers(unittest.TestCase):
    def found(self, text):
        return [what for _, what in unmarked(text)]

    def test_are_found_with_their_units(self):
        self.assertEqual(self.found("a 3.4 cm b 25 mm, 1,000 px; 31 ± 2 ms and 0.02° or 5 %"), ["3.4 cm", "25 mm", "1,000 px", "31 ± 2 ms", "0.02°", "5 %"])
        self.assertEqual(self.found("V1_01, drive 0039, 640x480, 2000 frames, 3 models"), [])

    def test_are_found_in_cells_but_the_first(self):
        self.assertEqual(self.found("| 20 frames | 38,500 | | 600 of 601 | x 3 |"), ["38,500", "600 of 601"])

    def test_are_not_looked_for_in_heads_and_code(self):
        self.assertEqual(unmarked("| | 90 % |\n|---|--:|\n| a | 80 % |\n`70 %`\n"), [(3, "80 %")])


class Kept(Sample):
    def test_results_are_replaced_and_written(self):
        path = self.root / "results.json"
        store = Store(path, self.root / "by_hand.json")
        store.replace("slam.kitti", {"ate_m": figure(0.25), "time_s": figure(3, kind="time"), "gone": figure(1)}, seconds=12)
        store.replace("slam.kitti", {"ate_m": figure(0.26), "time_s": None}, seconds=11)
        store.write()
        again = Store(path, self.root / "by_hand.json")
        self.assertEqual(sorted(again.figures), ["slam.kitti.ate_m", "slam.kitti.time_s"])  # the time stays as it was
        self.assertEqual((again.figures["slam.kitti.ate_m"].value, again.figures["slam.kitti.time_s"].value), (0.26, 3))
        self.assertEqual(again.experiments, {"slam.kitti": {"seconds": 11}})


if __name__ == "__main__":
    unittest.main()
