// SPDX-License-Identifier: Apache-2.0
#include "bundle.h"

#include <algorithm>
#include <memory>

#include "cairn/testing/optimize/bundle_scene.h"
#include "cairn/testing/optimize/ceres_bundle.h"

namespace cairn::bench {
namespace {

using testkit::BundleSceneOptions;
using testkit::CeresBundle;
using testkit::make_bundle_scene;

/// The window of a SLAM run: half its keyframes free.
constexpr BundleSceneOptions kStereoWindow{.cameras = 20, .fixed = 10, .points = 2000, .longest_track = 9};

BundleSceneOptions mono_window() {
  BundleSceneOptions options = kStereoWindow;
  options.disparity_share = 0;
  return options;
}

/// All keyframes of a round trip.
constexpr BundleSceneOptions kRoundTrip{.cameras = 250, .fixed = 1, .points = 20000, .longest_track = 12};

const BundleOptions kOptions{.max_iterations = 50, .converged_relative_cost = 1e-6};

void add(Comparisons& comparisons, const std::string& work, const BundleSceneOptions& scene,
         double at_most_share) {
  const auto problem = std::make_shared<const BundleProblem>(make_bundle_scene(1, scene).problem);
  const auto ours = [problem] {
    BundleProblem adjusted = *problem;
    return adjust_bundle(adjusted, kOptions).cost_after;
  };
  // not slower than DENSE_SCHUR on any of these
  const auto theirs = [problem] {
    return CeresBundle(*problem).solve(kOptions, CeresBundle::Schur::sparse).final;
  };
  comparisons.timed.push_back({"bundle beside Ceres: " + work,
                               1,
                               [ours] { (void)ours(); },
                               [theirs] { (void)theirs(); },
                               at_most_share,
                               {}});
  const double cost = theirs();
  comparisons.quality.push_back({"bundle: cost above Ceres', parts in a million, " + work,
                                 std::max(0.0, 1e6 * (ours() / cost - 1)),
                                 0.0,
                                 {},
                                 1.0});
}

}  // namespace

void add_bundle(Comparisons& comparisons) {
  constexpr double kStereoShare = 0.2, kMonoShare = 0.25, kRoundTripShare = 0.5;
  add(comparisons, "20 cameras, 2000 points, stereo", kStereoWindow, kStereoShare);
  add(comparisons, "20 cameras, 2000 points, mono", mono_window(), kMonoShare);
  add(comparisons, "250 cameras, 20000 points, stereo", kRoundTrip, kRoundTripShare);
}

}  // namespace cairn::bench
