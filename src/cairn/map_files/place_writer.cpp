// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/map_files/landmark_files.h"
#include "cairn/map_files/place_file.h"
#include "cairn/matching/matching_candidates.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {
namespace {

constexpr std::size_t kBranching = 16;
constexpr std::size_t kLeafRows = 128;                     // at most, where all rows are in the sample
constexpr std::size_t kSampleRows = std::size_t{1} << 19;  // 67 MB of SIFT
constexpr std::size_t kBatchRows = 4096;
constexpr std::uint32_t kObservationsPerRow = 4;  // neighbouring views of a landmark look alike

/// Maps a file as memory: what is written goes to the disk if memory is short.
class ScratchFile {
 public:
  ScratchFile(const std::filesystem::path& path, std::uint64_t bytes) : path_(path), bytes_(bytes) {
    if (bytes == 0) return;
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    int error_number = file < 0 ? errno : ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
    if (error_number == 0) memory_ = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (error_number == 0 && memory_ == MAP_FAILED) error_number = errno;
    if (file >= 0) ::close(file);
    if (error_number != 0) fail_writing(path, "write the file", error_number);
  }
  ~ScratchFile() {
    if (memory_ != nullptr && memory_ != MAP_FAILED) ::munmap(memory_, bytes_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] char* data() { return static_cast<char*>(memory_); }
  /// Allows the system to keep what was written on the disk alone.
  void forget() {
    if (bytes_ > 0) ::madvise(memory_, bytes_, MADV_DONTNEED);
  }
  [[nodiscard]] std::string_view all() const { return {static_cast<const char*>(memory_), bytes_}; }

 private:
  std::filesystem::path path_;
  std::uint64_t bytes_;
  void* memory_ = nullptr;
};

/// Holds some rows of Descriptor.bin, with the landmarks that they show.
struct Batch {
  Descriptors descriptors;
  std::vector<std::uint32_t> landmarks;
};

/// Reads the rows of a map that go into the index, batch by batch: of each landmark one of four observations,
/// spread evenly.
class IndexedRows {
 public:
  IndexedRows(const std::filesystem::path& folder, const MapInfo& info)
      : info_(info),
        points_(folder / kPointFile, kPointKind, info.checksum_of(kPointFile)),
        descriptors_(folder / kDescriptorFile, kDescriptorKind, info.checksum_of(kDescriptorFile)) {}

  [[nodiscard]] std::uint64_t count() const {
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i < info_.landmarks; ++i) count += rows_of(landmark(i).observations);
    return count;
  }

  /// Passes on each `step`th row, from the first on.
  template <class Take>
  void for_each_batch(std::uint64_t step, const Take& take) const {
    Batch batch = empty_batch();
    std::uint64_t number = 0;
    for (std::uint32_t i = 0; i < info_.landmarks; ++i) {
      const Extent of_landmark = landmark(i);
      const std::uint64_t rows = rows_of(of_landmark.observations);
      for (std::uint64_t k = 0; k < rows; ++k, ++number) {
        if (number % step != 0) continue;
        const std::uint64_t within = (k * of_landmark.observations + of_landmark.observations / 2) / rows;
        append(of_landmark.first_row + within, i, batch);
        if (batch.landmarks.size() < kBatchRows) continue;
        take(batch);
        batch.landmarks.clear();
        forget();
      }
    }
    if (batch.landmarks.empty()) return;
    Batch last = empty_batch(batch.landmarks.size());
    std::memcpy(last.descriptors.row(0), batch.descriptors.row(0),
                last.descriptors.stride() * batch.landmarks.size());
    last.landmarks = std::move(batch.landmarks);
    take(last);
    forget();
  }

  /// Limits the memory to a batch, however large the map is.
  void forget() const {
    points_.forget();
    descriptors_.forget();
  }

  /// Passes on the keyframe of each row of Descriptor.bin.
  template <class Take>
  void for_each_keyframe(const Take& take) const {
    for (std::uint64_t row = 0; row < info_.observations; ++row)
      take(descriptors_.at<std::int32_t>(place_of(row)));
  }

 private:
  struct Extent {
    std::uint64_t first_row;
    std::uint32_t observations;
  };

  static std::uint64_t rows_of(std::uint32_t observations) {
    return (observations + kObservationsPerRow - 1) / kObservationsPerRow;
  }
  [[nodiscard]] Batch empty_batch(std::size_t rows = kBatchRows) const {
    return {Descriptors(info_.descriptor.norm, info_.descriptor.bytes, rows), {}};
  }
  [[nodiscard]] Extent landmark(std::uint32_t number) const {
    const std::uint64_t place = kPointBegin + kLandmarkBytes * std::uint64_t{number};
    return {points_.at<std::uint64_t>(place + 8), points_.at<std::uint32_t>(place + 4)};
  }
  [[nodiscard]] std::uint64_t place_of(std::uint64_t row) const {
    return kDescriptorBegin + row * observation_bytes(info_.descriptor);
  }
  void append(std::uint64_t row, std::uint32_t landmark, Batch& batch) const {
    std::memcpy(batch.descriptors.row(batch.landmarks.size()),
                descriptors_.bytes(place_of(row) + kObservationHead, info_.descriptor.bytes),
                info_.descriptor.bytes);
    batch.landmarks.push_back(landmark);
  }

  const MapInfo& info_;
  MappedFile points_, descriptors_;
};

/// Holds the tree of a sample, and the mean distance of descriptors in it that show different landmarks.
struct SampledTree {
  DescriptorTree tree;
  double unrelated_distance = 0;
};

SampledTree sample_tree(const IndexedRows& rows, std::uint64_t count, const Descriptors& kind) {
  const std::uint64_t step = std::max<std::uint64_t>(1, (count + kSampleRows - 1) / kSampleRows);
  DescriptorTreeOptions options;
  options.branching = static_cast<int>(kBranching);
  options.leaf_capacity = static_cast<int>(std::max<std::uint64_t>(kBranching, kLeafRows / step));
  SampledTree sampled{DescriptorTree(kind, options)};
  double sum = 0;
  std::size_t pairs = 0;
  rows.for_each_batch(step, [&](const Batch& batch) {
    for (std::size_t i = 0; i < batch.landmarks.size(); ++i) sampled.tree.add(batch.descriptors, i, 0);
    const std::size_t half = batch.landmarks.size() / 2;
    Candidates pair;
    for (std::size_t i = 0; i < half; ++i) {
      if (batch.landmarks[i] == batch.landmarks[i + half]) continue;
      pair.trains = {static_cast<std::int32_t>(i + half)};
      pair.measure(batch.descriptors, i, batch.descriptors);
      sum += static_cast<double>(match_distance(kind.norm(), pair.distances[0]));
      ++pairs;
    }
  });
  sampled.unrelated_distance = pairs > 0 ? sum / static_cast<double>(pairs) : 0;
  return sampled;
}

/// Returns the first row of each leaf, and at the end the number of rows.
std::vector<std::uint64_t> leaf_begins(const IndexedRows& rows, const DescriptorTree& tree) {
  std::vector<std::uint64_t> begins(tree.leaf_count() + 1);
  rows.for_each_batch(1, [&](const Batch& batch) {
    for (const DescriptorTree::Visit& visit : tree.find_leaves(batch.descriptors, 1))
      ++begins[static_cast<std::size_t>(visit.leaf) + 1];
  });
  for (std::size_t leaf = 1; leaf < begins.size(); ++leaf) begins[leaf] += begins[leaf - 1];
  return begins;
}

template <class Value>
std::string_view bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// Writes sections, each filled up to a multiple of 8 bytes.
class SectionWriter {
 public:
  SectionWriter(const std::filesystem::path& path, const PlaceHeader& header)
      : file_(path, begin_place_file(header)) {}
  void write(std::string_view section) {
    add(section);
    end();
  }
  void add(std::string_view bytes) {
    file_.write(bytes);
    bytes_ += bytes.size();
  }
  void end() {
    constexpr std::string_view kZeros("\0\0\0\0\0\0\0", 7);
    file_.write(kZeros.substr(0, (8 - bytes_ % 8) % 8));
    bytes_ = 0;
  }
  std::uint32_t finish() { return file_.finish(); }

 private:
  BinaryFileWriter file_;
  std::uint64_t bytes_ = 0;
};

/// Puts every row in its leaf.
void fill_leaves(const IndexedRows& rows, const DescriptorTree& tree, std::vector<std::uint64_t> next,
                 ScratchFile& descriptors, ScratchFile& landmarks) {
  rows.for_each_batch(1, [&](const Batch& batch) {
    const std::size_t stride = batch.descriptors.stride();
    for (const DescriptorTree::Visit& visit : tree.find_leaves(batch.descriptors, 1)) {
      const std::uint64_t place = next[static_cast<std::size_t>(visit.leaf)]++;
      const auto query = static_cast<std::size_t>(visit.query);
      std::memcpy(descriptors.data() + place * stride, batch.descriptors.row(query), stride);
      std::memcpy(landmarks.data() + place * sizeof(std::uint32_t), &batch.landmarks[query],
                  sizeof(std::uint32_t));
    }
    descriptors.forget();
    landmarks.forget();
  });
}

void write_keyframes(const IndexedRows& rows, SectionWriter& sections) {
  std::vector<std::int32_t> keyframes;
  const auto flush = [&] {
    sections.add(bytes_of(keyframes));
    keyframes.clear();
    rows.forget();
  };
  rows.for_each_keyframe([&](std::int32_t keyframe) {
    keyframes.push_back(keyframe);
    if (keyframes.size() == kBatchRows) flush();
  });
  flush();
  sections.end();
}

/// Writes Place.bin of a map without descriptors.
std::uint32_t write_empty_place_file(const std::filesystem::path& path, PlaceHeader header) {
  header.leaves = 1;
  SectionWriter sections(path, header);
  sections.write(bytes_of(std::vector<std::uint64_t>(2)));
  return sections.finish();
}

}  // namespace

std::uint32_t write_place_file(const std::filesystem::path& folder, const MapInfo& info,
                               const std::filesystem::path& scratch) {
  PlaceHeader header{info.descriptor.bytes, static_cast<std::uint32_t>(info.descriptor.norm), kBranching};
  header.observations = info.observations;
  if (info.landmarks == 0) return write_empty_place_file(folder / kPlaceFile, header);
  const IndexedRows rows(folder, info);
  const Descriptors kind(info.descriptor.norm, info.descriptor.bytes, 0);
  header.rows = rows.count();
  const SampledTree sampled = sample_tree(rows, header.rows, kind);
  const DescriptorTree::Branches branches = sampled.tree.branches();
  header.branches = static_cast<std::uint32_t>(branches.used.size());
  header.leaves = static_cast<std::uint32_t>(branches.leaves);
  header.unrelated_distance = sampled.unrelated_distance;

  const std::vector<std::uint64_t> begins = leaf_begins(rows, sampled.tree);
  ScratchFile descriptors(scratch / "place_rows", header.rows * kind.stride());
  ScratchFile landmarks(scratch / "place_landmarks", header.rows * sizeof(std::uint32_t));
  fill_leaves(rows, sampled.tree, begins, descriptors, landmarks);

  SectionWriter sections(folder / kPlaceFile, header);
  sections.write(bytes_of(branches.used));
  sections.write(bytes_of(branches.children));
  sections.write(bytes_of(branches.centres));
  sections.write(bytes_of(begins));
  sections.write(descriptors.all());
  sections.write(landmarks.all());
  write_keyframes(rows, sections);
  return sections.finish();
}

}  // namespace cairn
