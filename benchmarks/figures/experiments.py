# SPDX-License-Identifier: Apache-2.0
"""The list of experiments. Each is a function of a `Work` and one of its cases, mostly a seed, and returns numbers by name; its
figures are those of all cases: `slam.kitti` returns `ate_m`, and the figure is `slam.kitti.ate_m`."""

from dataclasses import dataclass
from typing import Callable


@dataclass(frozen=True)
class Experiment:
    name: str
    measure: Callable
    cases: tuple
    ci: bool  # its first case is run by the tests, too


EXPERIMENTS = {}


def experiment(name, cases=(1,), ci=False):
    """Registers the function below. `ci`: the tests run its first case, so that takes few seconds."""
    def register(measure):
        EXPERIMENTS[name] = Experiment(name, measure, tuple(cases), ci)
        return measure
    return register


def load_all():
    """All experiments by name, in the order in which they run: those that share something stand together."""
    import measure_slam  # noqa: F401  pylint: disable=import-outside-toplevel,unused-import
    import measure_calibration  # noqa: F401
    import measure_mapping  # noqa: F401
    import measure_localization  # noqa: F401
    import measure_beside_peers  # noqa: F401
    return EXPERIMENTS
