// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/localize_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/map_files/stored_map.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/survey/survey.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/survey/street_survey.h"

namespace cairn {
namespace {

constexpr int kFrames = 12;

using testkit::Watcher;

/// A map of a simulated street, in which the street's own images are found; made once for all tests.
class LocalizeSequence : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<const testkit::TemporaryFolder>();
    const auto street = folder_->make_folder("street");
    testkit::write_small_street(street, kFrames);
    const Sequence sequence = open_sequence(street);
    Progress silent;
    (void)run_survey({sequence, read_given_poses(sequence), ""}, {}, folder_->make_folder("map"), Executor(2),
                     silent);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  LocalizeSequence() : sequence_(open_sequence(*folder_ / "street")), map_(*folder_ / "map") {}

  LocalizedSequence localize(const LocalizeSequenceOptions& options, int threads = 2,
                             Progress* progress = nullptr) const {
    const Localizer localizer(map_, {map_.info().rig, map_.info().width, map_.info().height},
                              LocalizeOptions());
    const FrameObserver observer(sequence_, SurveyOptions().observer);
    Progress silent;
    return localize_sequence(localizer, sequence_, observer, options, Executor(threads),
                             progress != nullptr ? *progress : silent);
  }
  [[nodiscard]] double error_m(const LocalizedImage& image) const {
    const Rigid3& truth = (*sequence_.truth)[static_cast<std::size_t>(image.position)].world_from_camera;
    return (image.found.camera_from_world.inverse().translation - truth.translation).norm();
  }

  static inline std::unique_ptr<const testkit::TemporaryFolder> folder_;
  Sequence sequence_;
  const StoredMap map_;
};

TEST_F(LocalizeSequence, finds_the_images_of_the_map_in_their_order) {
  const LocalizedSequence result = localize({});
  ASSERT_EQ(result.images.size(), static_cast<std::size_t>(kFrames));
  EXPECT_TRUE(result.unreadable.empty());
  for (std::size_t i = 0; i < result.images.size(); ++i) {
    const LocalizedImage& image = result.images[i];
    EXPECT_EQ(image.position, static_cast<std::int64_t>(i));
    EXPECT_EQ(image.stamp_ns, sequence_.frames[i].stamp_ns);
    EXPECT_EQ(image.file, sequence_.frames[i].color.filename().string());
    EXPECT_EQ(image.found.verdict, Verdict::good) << i;
    EXPECT_FALSE(image.found.from_prior) << i;
    EXPECT_LT(error_m(image), 0.1) << i;
  }
}

TEST_F(LocalizeSequence, is_the_same_at_any_number_of_threads) {
  for (const bool follow : {false, true}) {
    LocalizeSequenceOptions options;
    options.follow = follow;
    const LocalizedSequence one = localize(options, 1), many = localize(options, 4);
    ASSERT_EQ(one.images.size(), many.images.size());
    for (std::size_t i = 0; i < one.images.size(); ++i) {
      EXPECT_EQ(one.images[i].found.camera_from_world.translation,
                many.images[i].found.camera_from_world.translation);
      EXPECT_EQ(one.images[i].found.inliers, many.images[i].found.inliers);
    }
  }
}

TEST_F(LocalizeSequence, an_image_that_follows_another_has_its_pose_as_prior) {
  LocalizeSequenceOptions options;
  options.follow = true;
  const LocalizedSequence result = localize(options);
  ASSERT_EQ(result.images.size(), static_cast<std::size_t>(kFrames));
  EXPECT_FALSE(result.images[0].found.from_prior);
  for (std::size_t i = 1; i < result.images.size(); ++i) {
    EXPECT_TRUE(result.images[i].found.from_prior) << i;
    EXPECT_LT(error_m(result.images[i]), 0.1) << i;
  }
}

TEST_F(LocalizeSequence, each_image_takes_its_own_prior) {
  LocalizeSequenceOptions options;
  for (const StampedPose& truth : *sequence_.truth)
    options.priors.emplace_back(WorldFromCamera(truth.world_from_camera));
  options.priors[3].reset();
  const LocalizedSequence result = localize(options);
  ASSERT_EQ(result.images.size(), static_cast<std::size_t>(kFrames));
  for (std::size_t i = 0; i < result.images.size(); ++i)
    EXPECT_EQ(result.images[i].found.from_prior, i != 3) << i;
}

TEST_F(LocalizeSequence, an_unreadable_image_is_named_and_left_out) {
  const testkit::TemporaryFolder scratch;
  sequence_.frames[4].color = scratch.write("damaged.png", "no image");
  const LocalizedSequence result = localize({});
  ASSERT_EQ(result.unreadable.size(), 1U);
  EXPECT_NE(result.unreadable[0].find("damaged.png"), std::string::npos) << result.unreadable[0];
  ASSERT_EQ(result.images.size(), static_cast<std::size_t>(kFrames - 1));
  EXPECT_EQ(result.images[4].position, 5);
}

TEST_F(LocalizeSequence, stops_when_asked) {
  Watcher stop(5);
  const LocalizedSequence result = localize({}, 2, &stop);
  EXPECT_EQ(result.images.size(), 5U);
}

TEST_F(LocalizeSequence, refuses_priors_of_another_sequence) {
  LocalizeSequenceOptions options;
  options.priors.resize(3);
  EXPECT_THROW((void)localize(options), PreconditionError);
}

}  // namespace
}  // namespace cairn
