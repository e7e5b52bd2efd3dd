#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bad pose graphs."""

from harness import Case, main
from inputs import file

GRAPH = """\
VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1
VERTEX_SE3:QUAT 1 1 0 0 0 0 0 1
EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1
"""

PLANAR = """\
VERTEX_SE2 0 0 0 0
VERTEX_SE2 1 1 0 0
EDGE_SE2 0 1 1 0 0.1 1 0 0 1 0 1
"""


def graph(old="", new=""):
    assert old in GRAPH
    return file("in.g2o", GRAPH.replace(old, new, 1))


CASES = [
    Case("graph", "graph in.g2o -o out.g2o", given=(graph(),), code=0, prints=("chi2 after",), leaves=("out.g2o",)),
    Case("no such graph", "graph in.g2o -o out.g2o", ("in.g2o: expected a readable file",)),
    Case("graph into a missing folder", "graph in.g2o -o no/out.g2o", ("no/out.g2o: expected to create the file",), (graph(),)),
    Case("graph over a device", "graph in.g2o -o /dev/null", ("/dev/null: expected the name of a file to write",), (graph(),)),
    Case("vertex with 6 numbers", "graph in.g2o -o out.g2o", ("in.g2o:2: expected", "found"), (graph("1 1 0 0 0 0 0 1", "1 1 0 0 0 0 1"),)),
    Case("edge to nowhere", "graph in.g2o -o out.g2o", ("in.g2o:3: expected",), (graph("QUAT 0 1 1", "QUAT 0 7 1"),)),
    Case("edge with half a matrix", "graph in.g2o -o out.g2o", ("in.g2o:3: expected",), (graph(" 1 0 1\n", "\n"),)),
    Case("planar graph", "graph in.g2o -o out.g2o", given=(file("in.g2o", PLANAR),), code=0, prints=("chi2 after",), leaves=("out.g2o",)),
    Case("lines that no edge uses", "graph in.g2o -o out.g2o", ("in.g2o: 1 line that no edge between poses uses passed over, and not written: PARAMS_SE3OFFSET (1).",),
         given=(file("in.g2o", "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n" + GRAPH),), code=0, prints=("chi2 after",), leaves=("out.g2o",)),
    Case("an edge to a landmark", "graph in.g2o -o out.g2o", ("in.g2o:4: expected EDGE_SE3:QUAT or EDGE_SE2, found 'EDGE_SE2_XY'", "Delete all other edges"),
         (file("in.g2o", PLANAR + "EDGE_SE2_XY 0 2 1 1 1 0 1\n"),)),
    Case("empty graph", "graph in.g2o -o out.g2o", ("in.g2o: expected",), (file("in.g2o", ""),)),
    Case("unknown kernel", "graph in.g2o -o out.g2o --robust strong", ("--robust", "strong"), (graph(),)),
    Case("kernel's scale that is no number", "graph in.g2o -o out.g2o --robust huber --robust-scale nan", ("--robust-scale", "'nan'"), (graph(),)),
    Case("full disk", "graph in.g2o -o out.g2o", ("out.g2o: expected to write the file", "File too large"), (graph(),), file_limit=64),
]

if __name__ == "__main__":
    main(CASES)
