# SPDX-License-Identifier: Apache-2.0
"""Which sources compile as one translation unit, so that the headers of libraries are read once for all of them.

Sources and headers that give one name two meanings never share a batch. Shared by run_tidy.py and unity_groups.py.
"""

import functools
import re
import subprocess
from pathlib import Path

from sources import includes_of

TYPES = {"class", "struct", "enum", "union", "typedef"}


def names_inside_functions(paths):
    """{path: names of parameters and local variables}, by ctags, for which `Type name(...)` is a prototype.

    A local name that hides one of another source earns a warning.
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
    """{path: {name: whether it is a type}} of what each file defines in a namespace or as a macro, by ctags."""
    command = ["ctags", "-x", "--languages=C++", "--kinds-C++=cdefgstuvx", "--_xformat=%F\t%K\t%{scopeKind}\t%N", "-L", "-"]
    listed = subprocess.run(command, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True).stdout
    names = {path: {} for path in paths}
    for line in listed.splitlines():
        path, kind, scope, name = line.split("\t")
        if scope in ("", "-", "namespace") and not name.startswith(("__anon", "TEST")):  # members have the class as scope
            names[Path(path)][name] = kind in TYPES
    for path in paths:  # GoogleTest's macros define a class of this name
        names[path].update(dict.fromkeys(re.findall(r"^TEST(?:_[FP])?\((\w+, *\w+)\)", path.read_text(), re.MULTILINE), True))
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
                names_a.isdisjoint(self.locals_in({b} | headers_b - headers_a)) and
                names_b.isdisjoint(self.locals_in({a} | headers_a - headers_b)) and
                names_a.isdisjoint(self.names_of(headers_b - headers_a)) and
                names_b.isdisjoint(self.names_of(headers_a - headers_b)))

    def names_of(self, headers):
        return set().union(*(self.names[header].keys() for header in headers))

    def locals_in(self, files):
        return set().union(*(self.locals_of[file] for file in files))

    def types_of(self, headers):
        return {name for header in headers for name, is_type in self.names[header].items() if is_type}


def make_batches(units, root, most):
    """[(flags, paths)] from {path: flags of each of its compile commands}, with at most `most` paths; large ones first.

    Each source is in the first batch that takes it, once for each of its compile commands.
    """
    @functools.cache
    def headers_of(path):
        ours = includes_of(path, root)[1]
        return frozenset(ours).union(*map(headers_of, ours))

    files = {*units, *(header for path in units for header in headers_of(path))}
    names, locals_of = names_outside_classes(files), names_inside_functions(files)
    batches = []
    for path, all_flags in units.items():
        for flags in all_flags:
            batch = next((one for one in batches if one.flags == flags and len(one.headers) < most and
                          one.takes(path, headers_of(path))), None)
            if not batch:
                batch = Batch(flags, names, locals_of)
                batches.append(batch)
            batch.headers[path] = headers_of(path)
    return sorted(((batch.flags, list(batch.headers)) for batch in batches), key=lambda batch: -len(batch[1]))
