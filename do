#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds, tests and shows cairn on Debian 12 and Ubuntu 24.04. `./do help` lists the commands.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

usage() {
  cat <<'END'
usage: ./do COMMAND [ARGUMENTS]

  build              install what is missing, then build the program: build/release/cairn
  test [CTEST ARGS]  build everything and run the tests, e.g. ./do test -R core
  demo               build, then simulate a room, map it and compare with the truth
  asan [CTEST ARGS]  the tests with the address and undefined-behaviour sanitizers of clang
  tsan [CTEST ARGS]  the tests with the thread sanitizer
  gcc                build the program with g++, whose warnings are errors: build/gcc/cairn
  bench [ARGS]       time cairn beside its peers and print a table; ARGS go to Google Benchmark,
                     e.g. ./do bench --benchmark_filter=ORB
  figures [ARGS]     measure what README.md and docs/ claim, and compare; --update writes it there,
                     names say which, e.g. ./do figures slam --update; --check-text runs nothing
  tidy [FILES]       clang-tidy over our sources, or over these
  format [FILES]     clang-format, in place; --check only says what is wrong
  clean              remove build/ and demo/
  help               this text

Missing packages are installed with apt-get, as root or with sudo; nothing is downloaded where all are there.
CAIRN_INSTALL=no leaves the packages alone. CAIRN_DATA_DIR names a folder of recordings for the tests that need
real data (default: ../shared/data); those tests are skipped where it is absent.
END
}

# Packages, each with its reason. The libraries are explained in cmake/dependencies.cmake.
packages_build=(
  clang-16 cmake ninja-build pkg-config  # compiler (half the time of g++), build description, build tool, finds turbojpeg
  libeigen3-dev                         # linear algebra
  libtbb-dev                            # parallel loops
  libfmt-dev                            # text formatting
  libpng-dev libturbojpeg0-dev          # images
  zlib1g-dev                            # checksums of maps
  libopencv-core-dev libopencv-imgproc-dev libopencv-features2d-dev  # detectors by name
  libyaml-cpp-dev nlohmann-json3-dev    # camera.yaml, run.json
  libceres-dev                          # pose graph
  liboctomap-dev                        # octrees
  libgeographiclib-dev                  # geodetic poses
  libcli11-dev                          # the command line
  libgtest-dev python3                  # the build description knows the tests, too, which are C++ and Python
  universal-ctags                       # says which sources can be compiled together, cmake/unity.cmake
)
packages_test=(
  clang-format-14  # tests/check_format.py
  octomap-tools    # reads our octrees in tests/quality/recordings.py
)
packages_bench=(libbenchmark-dev libopencv-calib3d-dev)
packages_figures=(python3-pil colmap)  # photos of other sizes; the peer of cairn map
packages_gcc=(g++)
packages_sanitizers=(
  libclang-rt-16-dev  # what sanitized programs are linked with
  llvm-16             # names and lines in what the sanitizers report
)
packages_tidy=(clang-tidy-14)
packages_format=(clang-format-14 python3)

say() { printf 'do: %s\n' "$*" >&2; }
die() { say "$@"; exit 1; }

missing_packages() {  # prints those of the arguments that are not installed
  local installed
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    grep -qxF "installed $package" <<<"$installed" || echo "$package"
  done
}

apt() {
  local root=()
  if [ "$(id -u)" -ne 0 ]; then root=(sudo); fi
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@" </dev/null >&2
}

need() {  # installs what is missing of the packages named
  [ "${CAIRN_INSTALL:-yes}" != no ] || return 0
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    die "packages can be installed on Debian and Ubuntu only. Elsewhere install by hand what provides: $*
    and run CAIRN_INSTALL=no ./do ..."
  local missing
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null ||
    die "these packages are missing, and this is neither root nor is there sudo. As root, run:
    apt-get install --no-install-recommends ${missing[*]}"
  say "installing ${missing[*]}"
  apt update || say "apt-get update failed; going on with the package lists that are here"
  apt install -y --no-install-recommends "${missing[@]}" ||
    die "apt-get could not install: ${missing[*]}. cairn needs Debian 12, Ubuntu 24.04 or later."
}

configure() {  # preset: only where that was not done yet; ninja sees later changes of the build description itself
  local data=${CAIRN_DATA_DIR:-}
  local fresh=
  if [ CMakePresets.json -nt "build/$1/CMakeCache.txt" ]; then
    fresh=--fresh  # another compiler, perhaps
  elif [ -e "build/$1/build.ninja" ]; then
    [ -n "$data" ] || return 0
    ! grep -qxF "CAIRN_DATA_DIR:PATH=$data" "build/$1/CMakeCache.txt" || return 0
  fi
  mkdir -p build
  cmake $fresh --preset "$1" ${data:+"-DCAIRN_DATA_DIR=$data"} >"build/configure-$1.log" 2>&1 ||
    { cat "build/configure-$1.log" >&2; die "cmake could not configure build/$1"; }
}

build() {
  need "${packages_build[@]}"
  configure release
  [ -x build/release/cairn ] || say "building; the first time takes some minutes"
  ninja --quiet -C build/release cairn
}

build_with_gcc() {
  need "${packages_build[@]}" "${packages_gcc[@]}"
  configure gcc
  ninja --quiet -C build/gcc
}

build_and_test() {  # preset, ctest arguments
  local preset=$1 packages=("${packages_build[@]}" "${packages_test[@]}")
  shift
  if [ "$preset" != release ]; then
    packages+=("${packages_sanitizers[@]}")
    export ASAN_SYMBOLIZER_PATH=/usr/lib/llvm-16/bin/llvm-symbolizer
    export TSAN_SYMBOLIZER_PATH=$ASAN_SYMBOLIZER_PATH
  fi
  need "${packages[@]}"
  configure "$preset"
  say "building build/$preset; the first time takes some minutes"
  ninja --quiet -C "build/$preset"
  ctest --test-dir "build/$preset" --output-on-failure -j "$(nproc)" "$@"
}

demo() {
  build
  local cairn=build/release/cairn
  mkdir -p demo
  "$cairn" simulate room -o demo/room
  "$cairn" slam demo/room -o demo/run
  "$cairn" evaluate demo/run demo/room
  cat <<'END'

The sequence is in demo/room, the result in demo/run:
  trajectory.txt   world_from_camera of every frame, TUM format
  landmarks.png    the map from above, landmarks in the colours of their standard deviations
  cloud.ply        coloured cloud: open it in MeshLab, CloudCompare or Blender
  octree.ot        occupancy for navigation: octovis demo/run/octree.ot
  run.json         figures of the run
END
}

bench() {
  need "${packages_build[@]}" "${packages_bench[@]}"
  configure release
  grep -qx CAIRN_BENCHMARKS:BOOL=ON build/release/CMakeCache.txt ||
    cmake -DCAIRN_BENCHMARKS=ON build/release >build/configure-release.log
  ninja --quiet -C build/release cairn_bench
  build/release/cairn_bench "$@"
}

figures() {
  local script=benchmarks/figures/run.py data=${CAIRN_DATA_DIR:-}
  case ${1:-} in
    --check-text | --mend | --list | --help) python3 "$script" "$@"; return ;;
  esac
  need "${packages_build[@]}" "${packages_bench[@]}" "${packages_figures[@]}"
  configure release
  grep -qx CAIRN_BENCHMARKS:BOOL=ON build/release/CMakeCache.txt ||
    cmake -DCAIRN_BENCHMARKS=ON build/release >build/configure-release.log
  ninja --quiet -C build/release cairn cairn_bench cairn_survey_tests
  python3 "$script" --program build/release/cairn ${data:+--data "$data"} "$@"
}

tidy() {
  need "${packages_build[@]}" "${packages_bench[@]}" "${packages_tidy[@]}"
  configure tidy
  ninja -C build/tidy build.ninja >/dev/null  # where the build description changed
  python3 tests/run_tidy.py --build build/tidy "$@"
}

format() {
  need "${packages_format[@]}"
  if [ "${1:-}" = --check ]; then
    python3 tests/check_format.py
  elif [ $# -gt 0 ]; then
    clang-format-14 -i "$@"
  else
    python3 tests/check_format.py --fix
  fi
}

main() {
  local command=${1:-help}
  [ $# -eq 0 ] || shift
  case $command in
    build) build ;;
    test) build_and_test release "$@" ;;
    asan) build_and_test asan "$@" ;;
    tsan) TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp ignore_noninstrumented_modules=1" build_and_test tsan "$@" ;;
    gcc) build_with_gcc ;;
    demo) demo ;;
    bench) bench "$@" ;;
    figures) figures "$@" ;;
    tidy) tidy "$@" ;;
    format) format "$@" ;;
    clean) rm -rf build demo ;;
    help | -h | --help) usage ;;
    *) usage >&2; die "'$command' is no command" ;;
  esac
}

main "$@"
