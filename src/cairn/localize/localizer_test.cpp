// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/localizer.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <thread>

#include "cairn/localize/retrieval.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/localize/street_world.h"

namespace cairn {
namespace {

using testkit::StreetWorld;

/// A map and what finds images in it.
struct MappedWorld {
  explicit MappedWorld(const StreetWorld::Options& options = {}) : world(options) {
    world.write_map(folder.path() / "map");
    map = std::make_unique<StoredMap>(folder.path() / "map");
    localizer = std::make_unique<Localizer>(*map, testkit::street_query_camera(), LocalizeOptions());
  }
  testkit::TemporaryFolder folder;
  StreetWorld world;
  std::unique_ptr<StoredMap> map;
  std::unique_ptr<Localizer> localizer;
};

double squared_error_of(const Localization& found, const WorldFromCamera& truth) {
  const Vector6d error = left_perturbation(found.camera_from_world, truth.inverse());
  return error.dot(found.precision.covariance.ldlt().solve(error));
}

TEST(Localizer, finds_images_with_honest_covariances) {
  for (const bool stereo : {true, false}) {
    const MappedWorld place;
    double nees = 0;
    constexpr int kQueries = 60;
    for (int i = 0; i < kQueries; ++i) {
      const WorldFromCamera truth = StreetWorld::pose_at(2 + 0.9 * i, 0.3, 0.05);
      const auto view = place.world.see(truth, 5000U + static_cast<std::uint64_t>(i), stereo);
      const Localization found = place.localizer->localize(view.frame);
      ASSERT_EQ(found.verdict, Verdict::good) << i << " " << to_string(found.weakness);
      EXPECT_FALSE(found.from_prior);
      EXPECT_LT((found.camera_from_world.inverse().translation - truth.translation).norm(), 0.1);
      nees += squared_error_of(found, truth) / (6 * kQueries);
    }
    EXPECT_GT(nees, 0.7) << stereo;
    EXPECT_LT(nees, 1.4) << stereo;
  }
}

TEST(Localizer, the_protection_level_holds) {
  const MappedWorld place;
  constexpr int kQueries = 100;
  int count = 0;
  for (int i = 0; i < kQueries; ++i) {
    const WorldFromCamera truth = StreetWorld::pose_at(2 + 0.5 * i, -0.2, -0.03);
    const auto view = place.world.see(truth, 7000U + static_cast<std::uint64_t>(i), true, 80);
    const Localization found = place.localizer->localize(view.frame);
    if (!found.found()) continue;
    ++count;
    const Vector6d error = left_perturbation(found.camera_from_world, truth.inverse());
    for (int axis = 0; axis < 6; ++axis) {
      EXPECT_LE(std::abs(error[axis]), found.precision.protection[axis]) << i << " " << axis;
      EXPECT_GT(found.precision.protection[axis], 3 * std::sqrt(found.precision.covariance(axis, axis)));
    }
  }
  EXPECT_GT(count, kQueries / 2);
}

TEST(Localizer, a_prior_pose_leads_there) {
  const MappedWorld place;
  const WorldFromCamera truth = StreetWorld::pose_at(20, 0.2, 0.02);
  const auto view = place.world.see(truth, 900, true);
  const Localization found = place.localizer->localize(view.frame, StreetWorld::pose_at(20.2, 0.1, 0.03));
  EXPECT_EQ(found.verdict, Verdict::good);
  EXPECT_TRUE(found.from_prior);
  const Localization misled = place.localizer->localize(view.frame, StreetWorld::pose_at(50, 0, 0));
  EXPECT_EQ(misled.verdict, Verdict::good);  // found all the same
  EXPECT_FALSE(misled.from_prior);
  EXPECT_LT((misled.camera_from_world.inverse().translation - truth.translation).norm(), 0.1);
}

TEST(Localizer, an_image_of_another_place_is_not_good) {
  const MappedWorld place;
  StreetWorld::Options elsewhere;
  elsewhere.seed = 77;
  const StreetWorld other(elsewhere);
  for (int i = 0; i < 20; ++i) {
    const auto view = other.see(StreetWorld::pose_at(3.0 * i), 300U + static_cast<std::uint64_t>(i), true);
    EXPECT_NE(place.localizer->localize(view.frame).verdict, Verdict::good) << i;
  }
}

TEST(Localizer, says_why_a_pose_is_weak) {
  const MappedWorld place;
  const WorldFromCamera truth = StreetWorld::pose_at(20);
  const auto few = place.world.see(truth, 900, true, 20);
  const Localization found = place.localizer->localize(few.frame);
  EXPECT_EQ(found.verdict, Verdict::weak);
  EXPECT_EQ(found.weakness, Weakness::few_inliers);
  EXPECT_EQ(place.localizer->localize(ObservedFrame()).verdict, Verdict::none);

  LocalizeOptions strict;
  strict.trust.max_position = 1e-4;
  const auto view = place.world.see(truth, 901, true);
  EXPECT_EQ(Localizer(*place.map, testkit::street_query_camera(), strict).localize(view.frame).weakness,
            Weakness::large_covariance);
  strict.trust.max_gdop = 1e-6;
  EXPECT_EQ(Localizer(*place.map, testkit::street_query_camera(), strict).localize(view.frame).weakness,
            Weakness::bad_geometry);
}

TEST(Localizer, several_threads_find_the_same) {
  const MappedWorld place;
  constexpr std::size_t kQueries = 12;
  std::vector<StreetWorld::View> views;
  for (std::size_t i = 0; i < kQueries; ++i)
    views.push_back(place.world.see(StreetWorld::pose_at(4.0 * static_cast<double>(i)), 400 + i, true));
  const auto find_all = [&](std::vector<Localization>& found) {
    for (std::size_t i = 0; i < kQueries; ++i) found.push_back(place.localizer->localize(views[i].frame));
  };
  std::vector<Localization> alone, first, second;
  find_all(alone);
  std::thread one([&] { find_all(first); }), two([&] { find_all(second); });
  one.join();
  two.join();
  for (std::size_t i = 0; i < kQueries; ++i) {
    for (const auto* found : {&first[i], &second[i]}) {
      EXPECT_EQ(found->camera_from_world.translation, alone[i].camera_from_world.translation);
      EXPECT_EQ(found->inliers, alone[i].inliers);
    }
  }
}

TEST(Retrieval, the_best_place_is_near) {
  const MappedWorld place;
  for (int i = 0; i < 10; ++i) {
    const double x = 5.0 * i + 1;
    const auto view =
        place.world.see(StreetWorld::pose_at(x, 0, 0.1), 600U + static_cast<std::uint64_t>(i), true);
    const auto places = find_places(*place.map, view.frame.features.descriptors, 3);
    ASSERT_EQ(places.size(), 3U);
    EXPECT_NEAR(place.map->poses()[static_cast<std::size_t>(places[0].id)].translation.x(), x, 8);
    EXPECT_GE(places[0].score, places[1].score);
  }
}

TEST(Retrieval, keyframes_near_a_pose_look_the_same_way) {
  const MappedWorld place;
  const WorldFromCamera pose = StreetWorld::pose_at(30);
  const auto near = keyframes_near(*place.map, pose, 4);
  ASSERT_EQ(near.size(), 4U);
  for (const KeyframeId id : near) EXPECT_NEAR(place.map->poses()[id.index()].translation.x(), 30, 4);
  EXPECT_TRUE(keyframes_near(*place.map, StreetWorld::pose_at(30, 0, 3.1), 4).empty());  // the other way
}

}  // namespace
}  // namespace cairn
