// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Names the unit of a stamp.
enum class TimeUnit : std::uint8_t { second, millisecond, microsecond, nanosecond };

/// Parses a decimal number of `unit` into nanoseconds, exactly if it has no exponent. Returns false if it is
/// not a number, lies beyond 9e18 nanoseconds, or is a fraction of a nanosecond: another unit was meant.
[[nodiscard]] bool parse_stamp_in(TimeUnit unit, std::string_view text, std::int64_t& stamp_ns);

/// Infers the unit of the stamps of one file by their size: those since 1970 have ten digits in seconds and
/// three more in each smaller unit. Whole numbers that are 1e5 or more apart on average are nanoseconds, as
/// no poses are a day apart. Returns seconds otherwise.
[[nodiscard]] TimeUnit infer_time_unit(const std::vector<std::string_view>& stamps);

/// Writes nanoseconds as seconds with as many decimals as are needed, at least one: "-0.25".
[[nodiscard]] std::string format_seconds(std::int64_t ns);

}  // namespace cairn
