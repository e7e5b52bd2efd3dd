// SPDX-License-Identifier: Apache-2.0
// A control byte below 32 announces that many literal bytes, and one more. Any other refers to bytes already
// written: its upper three bits are their number less two (seven: a byte to be added follows), its lower five
// and the next byte how far back they begin, less one.
#include "cairn/dense/lzf.h"

namespace cairn {
namespace {

constexpr std::size_t kLongestRun = 264;  // bytes, of two or three

/// Takes bytes from the front of a text.
class Source {
 public:
  explicit Source(std::string_view bytes) : rest_(bytes) {}
  [[nodiscard]] std::size_t left() const { return rest_.size(); }
  /// There must be one left.
  [[nodiscard]] std::size_t next() {
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }
  /// There must be so many left.
  [[nodiscard]] std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

 private:
  std::string_view rest_;
};

/// Appends bytes already written; they may overlap those that are appended. Returns false if they are cut off
/// or begin before the first.
bool append_reference(std::size_t control, Source& source, std::size_t size, std::string& bytes) {
  constexpr std::size_t kExtended = 7;
  std::size_t length = control >> 5U;
  if (length == kExtended) {
    if (source.left() == 0) return false;
    length += source.next();
  }
  length += 2;
  if (source.left() == 0) return false;
  const std::size_t back = ((control & 31U) << 8U | source.next()) + 1;
  if (back > bytes.size() || length > size - bytes.size()) return false;
  for (std::size_t i = 0; i < length; ++i) bytes.push_back(bytes[bytes.size() - back]);
  return true;
}

bool append_literals(std::size_t count, Source& source, std::size_t size, std::string& bytes) {
  if (count > source.left() || count > size - bytes.size()) return false;
  bytes += source.take(count);
  return true;
}

}  // namespace

std::optional<std::string> decompress_lzf(std::string_view packed, std::size_t size) {
  constexpr std::size_t kFirstReference = 32;
  if (size / kLongestRun > packed.size()) return std::nullopt;
  std::string bytes;
  bytes.reserve(size);
  Source source(packed);
  while (source.left() > 0) {
    const std::size_t control = source.next();
    const bool fits = control < kFirstReference ? append_literals(control + 1, source, size, bytes)
                                                : append_reference(control, source, size, bytes);
    if (!fits) return std::nullopt;
  }
  return bytes.size() == size ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace cairn
