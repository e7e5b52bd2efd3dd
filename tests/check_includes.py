#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each source includes what it uses of the headers that are precompiled for all (cmake/precompiled.cmake),
and its own header before all others.

With a precompiled header a missing #include goes unnoticed; without one (another generator, a user of one of our
headers) the source would not compile. What counts is what a file includes itself or through our own headers, not what
happens to come with a header of a library.

A source that begins with its own header shows that this header compiles alone; those without a source are compiled by
the target cairn_headers (cmake/rooms.cmake).
"""

import argparse
import functools
import re
import sys
from pathlib import Path

from sources import ROOT, cpp_files, includes_of

PRECOMPILED = "cmake/precompiled.cmake"

# Header: what it is known by. Names of <cmath> and <cstdint> are those that we write with std::.
STD = {
    "algorithm": "all_of any_of none_of for_each find find_if find_if_not count count_if equal mismatch search copy copy_if copy_n "
                 "transform replace fill fill_n generate remove remove_if unique reverse rotate shuffle partition stable_partition "
                 "sort stable_sort partial_sort nth_element is_sorted lower_bound upper_bound equal_range binary_search merge "
                 "includes set_union set_intersection set_difference push_heap pop_heap make_heap sort_heap max min minmax clamp "
                 "max_element min_element minmax_element next_permutation adjacent_find partition_point",
    "array": "array to_array",
    "cmath": "sqrt cbrt pow exp exp2 log log2 log10 log1p expm1 sin cos tan asin acos atan atan2 sinh cosh tanh hypot floor ceil "
             "round lround llround nearbyint trunc fmod remainder isfinite isnan isinf fabs copysign erf erfc tgamma lgamma frexp ldexp fma",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t uintptr_t",
    "filesystem": "filesystem",
    "functional": "function reference_wrapper ref cref less greater plus minus hash bind mem_fn equal_to",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "unique_ptr shared_ptr weak_ptr make_unique make_shared enable_shared_from_this",
    "numbers": "numbers",
    "numeric": "accumulate inner_product iota reduce transform_reduce partial_sum exclusive_scan inclusive_scan gcd lcm midpoint",
    "optional": "optional nullopt make_optional",
    "span": "span",
    "string": "string to_string stoi stol stoul stod stof getline u8string",
    "string_view": "string_view",
    "utility": "pair make_pair exchange swap as_const",
    "vector": "vector",
}
EIGEN = {
    "Eigen/Cholesky": "LLT LDLT",
    "Eigen/LU": "PartialPivLU FullPivLU",
    "Eigen/Geometry": "Quaterniond Quaternionf Quaternion AngleAxisd AngleAxisf Isometry3d Affine3d Translation3d AlignedBox3d "
                      "AlignedBox2d ParametrizedLine Hyperplane",
}
# Members of Eigen's matrices that only these headers define.
MEMBERS = {"Eigen/Cholesky": "llt ldlt", "Eigen/LU": "determinant partialPivLu fullPivLu", "Eigen/Geometry": "cross homogeneous hnormalized"}
# Headers that bring another by their own documentation.
BRINGS = {
    "Eigen/Dense": {"Eigen/Core", "Eigen/Geometry", "Eigen/Cholesky", "Eigen/LU"},
    "Eigen/Geometry": {"Eigen/LU"},
    "Eigen/SVD": {"Eigen/Cholesky"},
    "gtest/gtest.h": {"string", "vector", "memory", "utility", "limits"},
    "map": {"utility"}, "unordered_map": {"utility"}, "tuple": {"utility"}, "algorithm": {"utility"},
    "string": {"string_view"}, "iostream": {"string"}, "sstream": {"string"}, "fstream": {"string"},
}
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def patterns():
    """[(header, pattern of what it gives)]"""
    std = [(header, re.compile(r"\bstd::(?:ranges::)?(" + "|".join(names.split()) + r")\b")) for header, names in STD.items()]
    eigen = [(header, re.compile(r"\bEigen::(" + "|".join(names.split()) + r")\b")) for header, names in EIGEN.items()]
    members = [(header, re.compile(r"(\.(?:" + "|".join(names.split()) + r")\()")) for header, names in MEMBERS.items()]
    return [*std, *eigen, *members, ("Eigen/Core", re.compile(r"\b(Eigen)::")), ("fmt/format.h", re.compile(r"\b(fmt)::"))]


class Includes:
    """What is included where, through our own headers."""

    def __init__(self, root):
        self.root = root

    @functools.cache
    def all_of(self, path):
        libraries, ours = includes_of(path, self.root)
        found = set().union(*(self.all_of(header) for header in ours))
        for header in libraries:
            found |= {header, *BRINGS.get(header, ())}
            if header.startswith("Eigen/"):
                found.add("Eigen/Core")
        return frozenset(found)


def complaints(path, includes, wanted):
    code = NOT_CODE.sub(lambda match: "\n" * match.group().count("\n"), path.read_text())
    have = includes.all_of(path)
    for header, pattern in wanted:
        use = pattern.search(code) if header not in have else None
        if use:
            line = code.count("\n", 0, use.start()) + 1
            yield f"{path.relative_to(includes.root)}:{line}: uses {use.group()} and does not include <{header}>"


FIRST_INCLUDE = re.compile(r'^\s*#\s*include\s*(\S+)', re.MULTILINE)


def complaints_about_first(path, includes):
    """A source whose header lies beside it and is not its first include."""
    header = path.with_suffix(".h")
    if path.suffix != ".cpp" or not header.exists() or not header.is_relative_to(includes.root / "src"):
        return
    own = f'"{header.relative_to(includes.root / "src").as_posix()}"'
    first = FIRST_INCLUDE.search(path.read_text())
    if not first or first.group(1) != own:
        yield f"{path.relative_to(includes.root)}: does not include {own} before all others"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=ROOT)
    root = parser.parse_args().root.resolve()
    known = {header for header, _ in patterns()}
    precompiled = re.search(r"set\(CAIRN_PRECOMPILED_HEADERS([^)]*)\)", (root / PRECOMPILED).read_text()).group(1)
    found = [f"{PRECOMPILED}: <{header}> is precompiled, and {Path(__file__).name} does not know what it gives"
             for header in re.findall(r"<([^>]+)>", precompiled) if header not in known]
    includes, wanted = Includes(root), patterns()
    for path in cpp_files(root, folders=("src", "apps", "examples", "benchmarks")):
        found.extend(complaints(path, includes, wanted))
        found.extend(complaints_about_first(path, includes))
    print("\n".join([*found, f"includes: {len(found)} complaints"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
