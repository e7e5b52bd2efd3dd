// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <opencv2/core.hpp>

#include "cairn/features/extractor.h"
#include "features.h"
#include "matched_geometry.h"

namespace cairn::bench {
namespace {

constexpr int kCount = 2000;

std::shared_ptr<const Extractor> extractor(const std::string& name) {
  return make_extractor({name, name, kCount});
}

void add_timed(Comparisons& comparisons, const std::string& size, const GrayImage& image, int threads) {
  const auto ours = extractor("SIFT");
  const auto peers = extractor("OPENCV_SIFT");
  const auto executor = std::make_shared<Executor>(threads);
  comparisons.timed.push_back({fmt::format("SIFT {}, {}", kCount, size),
                               threads,
                               [=, &image] { (void)ours->extract(image, *executor); },
                               [=, &image] {
                                 cv::setNumThreads(threads > 1 ? threads : 0);
                                 (void)peers->extract(image);
                                 cv::setNumThreads(0);
                               },
                               1.0 / 4,
                               {}});
}

}  // namespace

void add_sift(Comparisons& comparisons, const Inputs& inputs) {
  for (const int threads : {1, 2}) {
    add_timed(comparisons, "640x480", inputs.vga, threads);
    add_timed(comparisons, "1242x375", inputs.wide, threads);
  }
  add_correct_matches(comparisons, fmt::format("SIFT {}", kCount), *extractor("SIFT"),
                      *extractor("OPENCV_SIFT"), inputs.pairs, 0.95);
}

}  // namespace cairn::bench
