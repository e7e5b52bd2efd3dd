// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/aligned_floats.h"

#include <cstdlib>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace cairn {
namespace {

constexpr std::size_t kCacheLine = 64, kLargePage = std::size_t{2} << 20;  // bytes

float* allocate(std::size_t count) {
  const std::size_t bytes = count * sizeof(float);
  const std::size_t alignment = bytes < 2 * kLargePage ? kCacheLine : kLargePage;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, rounded);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  if (alignment == kLargePage)
    madvise(memory, rounded, MADV_HUGEPAGE);  // a wish: failing, it changes nothing
#endif
  return static_cast<float*>(memory);
}

}  // namespace

AlignedFloats::AlignedFloats(std::size_t count) : floats_(allocate(count)) {}

void AlignedFloats::Free::operator()(float* floats) const {
  std::free(floats);
}

}  // namespace cairn
