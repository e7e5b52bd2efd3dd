# SPDX-License-Identifier: Apache-2.0
"""Which sources compile as one translation unit, so that the headers of libraries are read once for all of them.

Sources and headers that give one name two meanings never share a batch. Shared by run_tidy.py and unity_groups.py.
"""

import re
import subprocess
from pathlib import Path

from sources import headers_below

TYPES = {"class", "struct", "enum", "union", "typedef"}


def names_inside_functions(paths):
    """{path: names of parameters and local variables}, by ctags, for which `Type name(...)` is a prototype.

    A local name that hides a type, variable or macro of another source earns a warning or is a fault.
    """
    command = ["ctags", "-x", "--languages=C++", "--kinds-C++=lpz", "--_xformat=%F\t%N", "-L", "-"]
    listed = subprocess.run(command, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True).stdout
    names = {path: set() for path in paths}
    for line in listed.splitlines():
        path, name = line.split("\t")
        names[Path(path)].add(name)
    for path in paths:  # ctags loses constants behind a braced initializer
        for declared in re.findall(r"^ +(?:static )?constexpr\b([^;]*)", path.read_text(), re.MULTILINE):
            names[path].update(re.findall(r"\b(k[A-Z]\w*) *[={\[]", declared))
    return names


def names_outside_classes(paths):
    """{path: {name: kind}} of what each file defines in a namespace or as a macro, by ctags."""
    command = ["ctags", "-x", "--languages=C++", "--kinds-C++=cdefgstuvx", "--_xformat=%F\t%K\t%{scopeKind}\t%N", "-L", "-"]
    listed = subprocess.run(command, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True).stdout
    names = {path: {} for path in paths}
    for line in listed.splitlines():
        path, kind, scope, name = line.split("\t")
        if scope in ("", "-", "namespace") and not name.startswith(("__anon", "TEST")):  # members have the class as scope
            names[Path(path)][name] = names[Path(path)].get(name, "function") if kind == "function" else kind
    for path in paths:  # GoogleTest's macros define a class of this name
        names[path].update(dict.fromkeys(re.findall(r"^TEST(?:_[FP])?\((\w+, *\w+)\)", path.read_text(), re.MULTILINE), "class"))
    return names


class Batch:
    """Sources with the same flags that compile as one translation unit: no name has two meanings."""

    def __init__(self, flags, names, locals_of):
        self.flags, self.names, self.locals_of = flags, names, locals_of
        self.headers = {}  # of each source: our headers that it includes, directly or not

    def takes(self, source, headers):
        together = set().union(*self.headers.values())
        return (all(self.agree(source, headers, other, others) for other, others in self.headers.items()) and
                not self.types_of(headers - together) & self.types_of(together - headers))

    def agree(self, a, headers_a, b, headers_b):
        """A name of one source is none of the other's, nor of a header that only the other includes."""
        names_a, names_b = self.names[a].keys(), self.names[b].keys()
        return (names_a.isdisjoint(names_b) and
                self.hideable(a).isdisjoint(self.locals_in({b} | headers_b - headers_a)) and
                self.hideable(b).isdisjoint(self.locals_in({a} | headers_a - headers_b)) and
                names_a.isdisjoint(self.names_of(headers_b - headers_a)) and
                names_b.isdisjoint(self.names_of(headers_a - headers_b)))

    def hideable(self, path):
        """What no local name may hide: a local name beside a function of the same name is usual, and found first."""
        return {name for name, kind in self.names[path].items() if kind != "function"}

    def names_of(self, headers):
        return set().union(*(self.names[header].keys() for header in headers))

    def locals_in(self, files):
        return set().union(*(self.locals_of[file] for file in files))

    def types_of(self, headers):
        return {name for header in headers for name, kind in self.names[header].items() if kind in TYPES}


def make_batches(units, root, most):
    """[(flags, paths)] from {path: flags of each of its compile commands}, with at most `most` paths; large ones first.

    Each source is in the first batch that takes it, once for each of its compile commands.
    """
    files = {*units, *(header for path in units for header in headers_below(path, root))}
    names, locals_of = names_outside_classes(files), names_inside_functions(files)
    batches = []
    for path, all_flags in units.items():
        for flags in all_flags:
            batch = next((one for one in batches if one.flags == flags and len(one.headers) < most and
                          one.takes(path, headers_below(path, root))), None)
            if not batch:
                batch = Batch(flags, names, locals_of)
                batches.append(batch)
            batch.headers[path] = headers_below(path, root)
    return sorted(((batch.flags, list(batch.headers)) for batch in batches), key=lambda batch: -len(batch[1]))
