# SPDX-License-Identifier: Apache-2.0
"""Compile commands under which sources of different targets can be checked as one translation unit. Used by run_tidy.py."""

import functools
import re
from pathlib import Path

from sources import headers_below


class SharedFlags:
    """One command for many sources: all their definitions and include folders. The other words are the same in each.

    A source sees a definition or folder that its own command lacks only where it makes no difference to our code: neither
    the source nor one of our headers below it names the macro.
    """

    def __init__(self, others):
        self.others = others
        self.defined, self.folders = {}, {}
        self.undefined = set()  # macros that a source names without being compiled with them

    def takes(self, others, defined, named):
        return (self.others == others and self.undefined.isdisjoint(defined) and
                all(self.defined.get(name, word) == word for name, word in defined.items()) and
                (named - defined.keys()).isdisjoint(self.defined))

    def add(self, defined, folders, named):
        self.defined.update(defined)
        self.folders.update(folders)
        self.undefined.update(named - defined.keys())

    def text(self):
        return " ".join([*self.others, *self.defined.values(), *self.folders])


def split_flags(flags):
    """(other words, {macro: its -D}, {include folder: None}) of the words of a compile command."""
    joined = re.sub(r"(^| )(-isystem|-I|-D) +", r"\1\2", flags).split()
    defined = {re.match(r"-D(\w+)", word)[1]: word for word in joined if word.startswith("-D")}
    folders = dict.fromkeys(word for word in joined if word.startswith(("-I", "-isystem")))
    return [word for word in joined if word not in folders and word not in defined.values()], defined, folders


def share_flags(units, root):
    """{path: flags of each compile command}, the flags joined as far as that is no different for our code."""
    pieces = {flags: split_flags(flags) for all_flags in units.values() for flags in all_flags}
    macros = set().union(*(defined for _, defined, _ in pieces.values()))

    @functools.cache
    def named_in(path):
        return macros & set(re.findall(r"\w+", path.read_text()))

    groups, chosen = [], {}
    for path, all_flags in units.items():
        named = named_in(path).union(*map(named_in, headers_below(Path(path), root)))
        for flags in all_flags:
            others, defined, folders = pieces[flags]
            group = next((one for one in groups if one.takes(others, defined, named)), None)
            if not group:
                group = SharedFlags(others)
                groups.append(group)
            group.add(defined, folders, named)
            chosen.setdefault(path, {})[id(group)] = group
    return {path: [group.text() for group in found.values()] for path, found in chosen.items()}
