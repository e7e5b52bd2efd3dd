// SPDX-License-Identifier: Apache-2.0
// Private to this room: the time of GPS receivers.
#pragma once

#include <cstdint>

namespace cairn {

/// Returns the leap seconds by which GPS time is ahead of UTC, at nanoseconds since 1970 of either time
/// scale.
[[nodiscard]] int leap_seconds_at(std::int64_t stamp_ns);

/// Converts a GPS week, counted from 6 January 1980 without rollover, and nanoseconds of that week to
/// nanoseconds since 1970, UTC.
[[nodiscard]] std::int64_t utc_from_gps(std::int64_t week, std::int64_t nanoseconds_of_week);

}  // namespace cairn
