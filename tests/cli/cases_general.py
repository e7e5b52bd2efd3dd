#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What holds for the program as a whole: help, usage, and where results may go."""

from harness import Case, main
from inputs import file, folder

FOREIGN = (file("out/thesis.tex", "years of work"),)

CASES = [
    Case("help", "--help", code=0, prints=("usage: cairn COMMAND", "exit codes: 0 done")),
    Case("help of a command", "pnp --help", code=0, prints=("Usage: cairn pnp [OPTIONS] POINTS PIXELS", "Example: cairn pnp")),
    Case("help of a command's command", "simulate room --help", code=0, prints=("Usage: cairn simulate room [OPTIONS]",)),
    Case("version", "--version", code=0, prints=("cairn 0.",)),
    Case("unknown command", "simulat", ("'simulat' is no command", "Did you mean 'simulate'?")),
    Case("unknown option", "info --frobnicate seq", ("cairn info:", "--frobnicate", "cairn info --help")),
    Case("missing argument", "info", ("SEQ is required", "cairn info --help")),
    Case("missing output", "simulate room", ("--output is required",)),
    Case("threads that are no number", "simulate room -o out --threads many", ("--threads", "many")),
    Case("no threads", "simulate room -o out --threads 0", ("--threads",)),
    Case("unknown scene", "simulate castle -o out", ("expected one of room", "found 'castle'")),
    Case("a right camera turned too far", "simulate street -o out --right-rotation 0 5.5 0",
         ("--right-rotation", "'5.5' is no number from -5 to 5")),
    Case("a rotation of no number", "simulate street -o out --right-rotation 0 nan 0", ("--right-rotation", "'nan' is no number")),
    Case("a rotation about two axes", "simulate street -o out --right-rotation 0 1", ("--right-rotation", "3 required")),
    Case("depth noise below 0", "simulate room -o out --depth-noise -1", ("--depth-noise", "-1")),
    Case("depth noise of no number", "simulate room -o out --depth-noise nan", ("--depth-noise", "nan")),
    Case("a rotation in a room", "simulate room -o out --right-rotation 0 1 0", ("--right-rotation",)),
    Case("a baseline far from the stated one", "simulate street -o out --baseline-error -21",
         ("--baseline-error", "'-21' is no number from -20 to 20")),
    Case("a lever arm of kilometres", "simulate street -o out --lever-arm-error 0 1000 0", ("--lever-arm-error", "'1000' is no number from -10 to 10")),
    Case("a boresight about two axes", "simulate street -o out --boresight-error 0 1", ("--boresight-error", "3 required")),
    Case("a route of no name", "simulate street -o out --route zigzag", ("--route", "zigzag", "straight")),
    Case("rounds on a straight street", "simulate street -o out --route straight --loops 2 --quiet", ("--loops", "0 on a straight street")),
    Case("poses of the body", "simulate street -o out --frames-count 1 --scale 0.05 --pose-time-offset -0.02 --quiet", code=0,
         prints=("frames       1",), leaves=("out", "out/body_poses.csv", "out/camera.yaml")),
    Case("errors of poses of a street", "simulate street -o out --frames-count 2 --scale 0.05 --pose-error 0.05 0.1 --pose-error-time 2 --quiet", code=0,
         prints=("frames       2", "next         cairn map out --poses out/given_poses.txt -o map"), leaves=("out", "out/given_poses.txt", "out/poses.txt")),
    Case("errors of poses of a body", "simulate street -o out --frames-count 2 --scale 0.05 --pose-jitter 0.02 0 --body-poses --quiet", code=0,
         prints=("frames       2", "next         cairn map out --poses out/given_body_poses.csv -o map"), leaves=("out", "out/given_body_poses.csv", "out/body_poses.csv")),
    Case("errors of poses of a room", "simulate room -o out --frames-count 2 --scale 0.05 --pose-error 0 0.1 --quiet", code=0,
         prints=("frames       2",), leaves=("out", "out/given_poses.txt", "out/groundtruth.txt")),
    Case("a pose error below 0", "simulate room -o out --pose-error -0.1 0", ("--pose-error: expected metres from 0 to 100, found -0.1.\n",)),
    Case("a pose error without degrees", "simulate room -o out --pose-error 0.1", ("--pose-error", "2 required")),
    Case("jitter beyond all angles", "simulate street -o out --pose-jitter 0.1 20", ("--pose-jitter: expected degrees from 0 to 10, found 20.\n",)),
    Case("a pose error that knows no time", "simulate street -o out --pose-error-time 0", ("--pose-error-time", "'0' is no number from 0.001 to 100000")),
    Case("errors of the right camera", "simulate street -o out --frames-count 1 --scale 0.05 --right-rotation -0.2 0.1 -.3 "
         "--baseline-error=-2 --quiet", code=0, prints=("frames       1",), leaves=("out",)),
    Case("output is a file", "simulate room -o out",
         ("out: expected a folder to write to, found a file of that name.", "Choose another -o"), (file("out", "x"),)),
    Case("output is a foreign folder", "simulate room -o out",
         ("out: expected a new or empty folder, or a", "found a folder with other contents", "nothing in it was touched"),
         FOREIGN),
    Case("output below a file", "simulate room -o out/deep/room", ("out/deep/room: expected to create the folder",),
         (file("out", "x"),)),
    Case("output where nobody may write", "simulate room -o /proc/cairn/room",
         ("/proc/cairn/room: expected to create the folder",)),
    Case("full disk", "simulate room -o out --frames-count 3 --threads 1", ("File too large", "Check the path and the disk."),
         file_limit=4096),
    Case("full disk keeps the earlier result", "simulate room -o out --frames-count 3 --threads 2", ("File too large",),
         (folder("out"), file("out/.cairn", "sequence: written by cairn\n"), file("out/rgb.txt", "old\n")),
         file_limit=4096),
    *(Case(f"--set of {command} takes one value", f"{command} --set {setting} no {rest}", ("no: expected ", "found nothing of that name"))
      for command, setting, rest in (("slam", "features=1000", "-o run"), ("map", "features=1000", "-o map"),
                                     ("localize", "features=1000", "seq -o found"))),
    Case("two --set before the sequence", "slam --set features=1000 --set max_motion=2 no -o run", ("no: expected a folder with a sequence",)),
    Case("--set without a value", "slam no -o run --set", ("--set",)),
    Case("option with a letter missing", "slam seq -o run --thread 2", ("there is no option --thread. Did you mean --threads?",)),
    Case("option that is like none", "simulate room -o room --fps 3", ("there is no option --fps.\n",)),
    Case("option of a subcommand misspelt", "simulate room -o room --sead=3", ("there is no option --sead. Did you mean --seed?",)),
]

if __name__ == "__main__":
    main(CASES)
