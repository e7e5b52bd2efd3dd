# SPDX-License-Identifier: Apache-2.0
"""What was measured: figures by name, each with its spread and the commit at which it was taken (results.json), and those that are
kept by hand, as they need programs of others (by_hand.json)."""

import json
import statistics
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
RESULTS, BY_HAND = HERE / "results.json", HERE / "by_hand.json"
DIGITS = 5  # significant ones that are kept; texts show fewer


@dataclass(frozen=True)
class Measured:
    """One number. `kind`: result, which has to be the same everywhere, or time or memory, which are of one machine. `idle`: whether
    the machine had nothing else to do; a time that was taken otherwise says nothing."""
    value: float
    kind: str = "result"
    idle: bool = True


@dataclass(frozen=True)
class Figure:
    """Median, least and greatest of `of` numbers; `commit`: of the program that was measured."""
    value: float
    low: float
    high: float
    of: int
    kind: str
    commit: str


def rounded(value):
    return float(f"{value:.{DIGITS}g}")


def summarize(numbers, commit):
    """The figure of one or more `Measured`; none if they are times of a busy machine."""
    if not all(number.idle for number in numbers):
        return None
    values = [number.value for number in numbers]
    return Figure(*map(rounded, (statistics.median(values), min(values), max(values))), len(values), numbers[0].kind, commit)


def as_measured(number):
    return number if isinstance(number, Measured) else Measured(float(number))


def collect(cases):
    """By name, the numbers of all cases, each of which is a dict of numbers."""
    names = {name: None for case in cases for name in case}
    return {name: [as_measured(case[name]) for case in cases if name in case] for name in names}


class Store:
    """The figures of results.json and by_hand.json; of each experiment its cases, how long they took, and the commands of the
    first."""

    def __init__(self, results=RESULTS, by_hand=BY_HAND):
        self.path = results
        kept = json.loads(results.read_text()) if results.exists() else {"experiments": {}, "figures": {}}
        self.experiments = kept["experiments"]
        self.figures = {name: Figure(**figure) for name, figure in kept["figures"].items()}
        self.by_hand = json.loads(by_hand.read_text()) if by_hand.exists() else {}

    def replace(self, experiment, found, **how):
        """`found`: figures by their names within the experiment, None for one whose former number stays. `how` it was done."""
        stays = {name for name, figure in found.items() if figure is None}
        own = f"{experiment}."
        self.figures = {name: figure for name, figure in self.figures.items()
                        if not name.startswith(own) or name[len(own):] in stays}
        self.figures |= {own + name: figure for name, figure in found.items() if figure}
        self.experiments[experiment] = how

    def write(self):
        def lines(rows):
            return ",\n".join(f"    {json.dumps(name)}: {json.dumps(row, ensure_ascii=False)}" for name, row in sorted(rows.items()))
        figures = {name: vars(figure) for name, figure in self.figures.items()}
        self.path.write_text(f'{{\n  "experiments": {{\n{lines(self.experiments)}\n  }},\n  "figures": {{\n{lines(figures)}\n  }}\n}}\n')
