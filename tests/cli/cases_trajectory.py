#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bad trajectories and pose graphs."""

from harness import Case, main
from inputs import file, folder, trajectory

GRAPH = """\
VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1
VERTEX_SE3:QUAT 1 1 0 0 0 0 0 1
EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1
"""


def graph(old="", new=""):
    assert old in GRAPH
    return file("in.g2o", GRAPH.replace(old, new, 1))


POSES = (trajectory("a.txt"), trajectory("b.txt"))

CASES = [
    Case("evaluate", "evaluate a.txt b.txt", given=POSES, code=0, prints=("ATE",)),
    Case("no such estimate", "evaluate a.txt b.txt", ("a.txt: expected a readable file",), (trajectory("b.txt"),)),
    Case("line with 7 numbers", "evaluate a.txt b.txt", ("a.txt:2: expected 8 values (t tx ty tz qx qy qz qw), found 7",),
         (*POSES, file("a.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n"))),
    Case("word among numbers", "evaluate a.txt b.txt", ("a.txt:1: expected a number for ty, found 'x'",),
         (*POSES, file("a.txt", "1 0 x 0 0 0 0 1\n"))),
    Case("not a number", "evaluate a.txt b.txt", ("a.txt:1: expected a number for tz, found 'nan'",),
         (*POSES, file("a.txt", "1 0 0 nan 0 0 0 1\n"))),
    Case("time goes backwards", "evaluate a.txt b.txt", ("a.txt:2: expected a time stamp after 2.000000000, found 1.000000000",),
         (*POSES, file("a.txt", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"))),
    Case("empty trajectory", "evaluate a.txt b.txt", ("a.txt: expected poses, one a line",), (*POSES, file("a.txt", ""))),
    Case("folder that is no run", "evaluate run b.txt", ("run: expected a trajectory file, or a run's folder",),
         (*POSES, folder("run"))),
    Case("picture into a missing folder", "evaluate a.txt b.txt --plot no/a.svg", ("no/a.svg: expected to create the file",), POSES),
    Case("nothing to compare", "evaluate a.txt b.txt", (), (*POSES, file("b.txt", "900 0 0 0 0 0 0 1\n901 0 0 0 0 0 0 1\n")), code=1),
    # pose graphs
    Case("graph", "graph in.g2o -o out.g2o", given=(graph(),), code=0, prints=("chi2 after",), leaves=("out.g2o",)),
    Case("no such graph", "graph in.g2o -o out.g2o", ("in.g2o: expected a readable file",)),
    Case("graph into a missing folder", "graph in.g2o -o no/out.g2o", ("no/out.g2o: expected to create the file",), (graph(),)),
    Case("graph over a device", "graph in.g2o -o /dev/null", ("/dev/null: expected the name of a file to write",), (graph(),)),
    Case("vertex with 6 numbers", "graph in.g2o -o out.g2o", ("in.g2o:2: expected", "found"), (graph("1 1 0 0 0 0 0 1", "1 1 0 0 0 0 1"),)),
    Case("edge to nowhere", "graph in.g2o -o out.g2o", ("in.g2o:3: expected",), (graph("QUAT 0 1 1", "QUAT 0 7 1"),)),
    Case("edge with half a matrix", "graph in.g2o -o out.g2o", ("in.g2o:3: expected",), (graph(" 1 0 1\n", "\n"),)),
    Case("planar graph", "graph in.g2o -o out.g2o", ("in.g2o:1: expected",), (file("in.g2o", "VERTEX_SE2 0 0 0 0\n"),)),
    Case("empty graph", "graph in.g2o -o out.g2o", ("in.g2o: expected",), (file("in.g2o", ""),)),
    Case("unknown kernel", "graph in.g2o -o out.g2o --robust strong", ("--robust", "strong"), (graph(),)),
    Case("kernel's scale that is no number", "graph in.g2o -o out.g2o --robust huber --robust-scale nan", ("--robust-scale", "'nan'"), (graph(),)),
    Case("full disk", "graph in.g2o -o out.g2o", ("out.g2o: expected to write the file", "File too large"), (graph(),), file_limit=64),
]

if __name__ == "__main__":
    main(CASES)
