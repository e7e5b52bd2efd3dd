// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "cairn/core/random.h"
#include "cairn/features/extractor.h"
#include "cairn/places/place_index.h"
#include "features.h"

namespace cairn::bench {
namespace {

/// Keyframes of a long walk, twenty to a place: each has half of the descriptors of its place and half of
/// those of any other, with twenty bits changed in every one. A place is an image with bits of its own
/// flipped in all descriptors, which leaves their distances to each other as they are.
class Keyframes {
 public:
  explicit Keyframes(const std::vector<ImagePair>& pairs) {
    const auto extractor = make_extractor({"ORB", "ORB", 1000});
    for (const ImagePair& pair : pairs) images_.push_back(extractor->extract(pair.first).descriptors);
  }

  [[nodiscard]] Descriptors make(std::uint64_t number) const {
    constexpr std::uint64_t kOfOnePlace = 20;
    constexpr std::uint32_t kPlaces = 250;
    constexpr int kChangedBits = 20;
    Random random(1, number);
    Descriptors mixed = place(number / kOfOnePlace % kPlaces);
    const Descriptors other = place(random.index(kPlaces));
    for (std::size_t i = 0; i < mixed.count(); ++i) {
      if (random.uniform() < 0.5 && i < other.count()) std::copy_n(other.row(i), other.bytes(), mixed.row(i));
      flip(mixed.row(i), mixed.bytes(), kChangedBits, random);
    }
    return mixed;
  }

 private:
  static void flip(std::uint8_t* row, std::size_t bytes, int count, Random& random) {
    for (int k = 0; k < count; ++k) {
      const std::uint32_t bit = random.index(static_cast<std::uint32_t>(8 * bytes));
      row[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    }
  }

  [[nodiscard]] Descriptors place(std::uint64_t number) const {
    constexpr int kFlippedBits = 100;
    Descriptors shown = images_[number % images_.size()];
    for (std::size_t i = 0; i < shown.count(); ++i) {
      Random same_for_all(2, number);
      flip(shown.row(i), shown.bytes(), kFlippedBits, same_for_all);
    }
    return shown;
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
  comparisons.timed.push_back({work(kFew),
                               1,
                               [=] { (void)few->get().query(*query, kCandidates); },
                               query_by_opencv(*keyframes, kFew, *query),
                               kAtMostShare,
                               {}});
  comparisons.timed.push_back(
      {work(kMany), 1, [=] { (void)many->get().query(*query, kCandidates); }, {}, {}, kAtMostMs});
  comparisons.timed.push_back(
      {fmt::format("places, {} ORB added to {} keyframes and removed", query->count(), kMany),
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
