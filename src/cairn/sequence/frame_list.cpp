// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/frame_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {

std::vector<std::int64_t> read_frame_list(const std::filesystem::path& path) {
  const TextFile file(path);
  std::vector<std::int64_t> numbers;
  for (const TextLine& line : file.lines()) {
    const std::size_t count = line.fields.size();
    std::int64_t number = 0;
    if (count > 2 || !parse_integer(line.fields[count - 1], number) || number < 0)
      file.fail(line, "the number of a frame, or of a keyframe and its frame",
                fmt::format("'{}'", fmt::join(line.fields, " ")), "Correct or delete the line.");
    numbers.push_back(number);
  }
  if (numbers.empty())
    throw InputError({path.string(), 0, "numbers of frames, one in a line", "none", "Check the file."});
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace cairn
