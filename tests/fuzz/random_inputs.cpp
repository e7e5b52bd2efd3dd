// SPDX-License-Identifier: Apache-2.0
// Feeds a fuzz target where libFuzzer is not there: random inputs from numbered seeds, or the files named.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cairn/core/random.h"

// libFuzzer's name, NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::uint8_t> random_input(std::uint64_t seed) {
  constexpr std::uint32_t kLargest = 4096;
  cairn::Random random(seed);
  std::vector<std::uint8_t> input(random.index(kLargest));
  for (auto& byte : input) byte = static_cast<std::uint8_t>(random.index(256));
  return input;
}

void run_seed(std::uint64_t seed) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  std::fflush(stdout);  // the last line tells which input it was that crashed
  const auto input = random_input(seed);
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

void run_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "--seeds") {
    const std::uint64_t first = std::strtoull(argv[2], nullptr, 10),
                        count = std::strtoull(argv[3], nullptr, 10);
    for (std::uint64_t seed = first; seed < first + count; ++seed) run_seed(seed);
    return 0;
  }
  if (argc == 1) {
    std::fprintf(stderr, "usage: %s --seeds FIRST COUNT | FILE...\n", argv[0]);
    return 2;
  }
  for (int i = 1; i < argc; ++i) run_file(argv[i]);
  return 0;
}
