// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cairn/features/extractor.h"
#include "features.h"
#include "matched_geometry.h"

namespace cairn::bench {
namespace {

constexpr int kCount = 1000;

std::shared_ptr<const Extractor> extractor(const std::string& name) {
  return make_extractor({name, name, kCount});
}

}  // namespace

void add_orb(Comparisons& comparisons, const Inputs& inputs) {
  const auto ours = extractor("ORB");
  const auto peers = extractor("OPENCV_ORB");
  comparisons.timed.push_back({"ORB 1000, 640x480",
                               1,
                               [=, &inputs] { (void)ours->extract(inputs.vga); },
                               [=, &inputs] { (void)peers->extract(inputs.vga); },
                               1.0 / 3,
                               {}});
  add_correct_matches(comparisons, "ORB 1000", *ours, *peers, inputs.pairs, 1.0);
}

}  // namespace cairn::bench
