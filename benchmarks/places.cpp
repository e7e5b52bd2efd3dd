// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/core/random.h"
#include "cairn/features/extractor.h"
#include "cairn/features/place_index.h"
#include "features.h"

namespace cairn::bench {
namespace {

/// Keyframes as like each other and as different as a few images make them: each has half of the descriptors
/// of one image and half of those of another, with twenty bits changed in every one.
class Keyframes {
 public:
  explicit Keyframes(const std::vector<ImagePair>& pairs) {
    const auto extractor = make_extractor({"ORB", "ORB", 1000});
    for (const ImagePair& pair : pairs) images_.push_back(extractor->extract(pair.first).descriptors);
  }

  [[nodiscard]] Descriptors make(std::uint64_t number) const {
    constexpr int kChangedBits = 20;
    Random random(1, number);
    const Descriptors &one = any(random), &other = any(random);
    Descriptors mixed = one;
    for (std::size_t i = 0; i < mixed.count(); ++i) {
      const bool of_other = random.uniform() < 0.5 && i < other.count();
      std::copy_n((of_other ? other : one).row(i), one.bytes(), mixed.row(i));
      for (int k = 0; k < kChangedBits; ++k)
        mixed.row(i)[random.index(32)] ^= static_cast<std::uint8_t>(1U << random.index(8));
    }
    return mixed;
  }

 private:
  [[nodiscard]] const Descriptors& any(Random& random) const {
    return images_[random.index(static_cast<std::uint32_t>(images_.size()))];
  }

  std::vector<Descriptors> images_;
};

/// An index that is filled when it is first used: it takes seconds, which a run that asks for other rows need
/// not spend.
class LazyIndex {
 public:
  LazyIndex(std::shared_ptr<const Keyframes> keyframes, std::int32_t count)
      : keyframes_(std::move(keyframes)), count_(count) {}

  PlaceIndex& get() {
    while (index_.size() < static_cast<std::size_t>(count_)) {
      const auto id = static_cast<std::int32_t>(index_.size());
      index_.add(id, keyframes_->make(static_cast<std::uint64_t>(id)));
    }
    return index_;
  }

 private:
  std::shared_ptr<const Keyframes> keyframes_;
  std::int32_t count_;
  PlaceIndex index_;
};

cv::Mat to_opencv(const Descriptors& descriptors) {
  cv::Mat rows(static_cast<int>(descriptors.count()), static_cast<int>(descriptors.bytes()), CV_8U);
  for (int i = 0; i < rows.rows; ++i)
    std::copy_n(descriptors.row(static_cast<std::size_t>(i)), descriptors.bytes(), rows.ptr(i));
  return rows;
}

/// The nearest of all keyframes' descriptors, which a vote for keyframes begins with.
Work query_by_opencv(const Keyframes& keyframes, std::int32_t count, const Descriptors& query) {
  const auto matcher = std::make_shared<cv::BFMatcher>(cv::NORM_HAMMING);
  std::vector<cv::Mat> trains;
  for (std::int32_t id = 0; id < count; ++id)
    trains.push_back(to_opencv(keyframes.make(static_cast<std::uint64_t>(id))));
  matcher->add(trains);
  return [matcher, rows = to_opencv(query)] {
    std::vector<cv::DMatch> found;
    matcher->match(rows, found);
  };
}

}  // namespace

void add_places(Comparisons& comparisons, const Inputs& inputs) {
  constexpr std::int32_t kFew = 100, kMany = 5000;
  constexpr std::uint64_t kUnseen = 1000000;
  constexpr std::size_t kCandidates = 10;
  constexpr double kAtMostShare = 1.0 / 50, kAtMostMs = 5;
  const auto keyframes = std::make_shared<const Keyframes>(inputs.pairs);
  const auto query = std::make_shared<const Descriptors>(keyframes->make(kUnseen));
  const auto few = std::make_shared<LazyIndex>(keyframes, kFew);
  const auto many = std::make_shared<LazyIndex>(keyframes, kMany);
  const auto work = [&](std::int32_t count) {
    return fmt::format("places, {} ORB asked of {} keyframes", query->count(), count);
  };
  comparisons.timed.push_back({work(kFew), 1, [=] { (void)few->get().query(*query, kCandidates); },
                               query_by_opencv(*keyframes, kFew, *query), kAtMostShare, {}});
  comparisons.timed.push_back(
      {work(kMany), 1, [=] { (void)many->get().query(*query, kCandidates); }, {}, {}, kAtMostMs});
  comparisons.timed.push_back({fmt::format("places, {} ORB added to {} keyframes and removed", query->count(), kMany),
                               1,
                               [=] {
                                 many->get().add(kMany, *query);
                                 many->get().remove(kMany);
                               },
                               {},
                               {},
                               kAtMostMs});
}

}  // namespace cairn::bench
