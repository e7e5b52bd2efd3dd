// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/gps_time.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace cairn {
namespace {

using std::chrono::sys_days;
using std::chrono::year;

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kDayNs = 86'400 * kSecondNs;

/// Days on which a leap second came into force since 1980 (IERS Bulletin C).
constexpr std::array<sys_days, 18> kLeapDays{
    {sys_days(year(1981) / 7 / 1), sys_days(year(1982) / 7 / 1), sys_days(year(1983) / 7 / 1),
     sys_days(year(1985) / 7 / 1), sys_days(year(1988) / 1 / 1), sys_days(year(1990) / 1 / 1),
     sys_days(year(1991) / 1 / 1), sys_days(year(1992) / 7 / 1), sys_days(year(1993) / 7 / 1),
     sys_days(year(1994) / 7 / 1), sys_days(year(1996) / 1 / 1), sys_days(year(1997) / 7 / 1),
     sys_days(year(1999) / 1 / 1), sys_days(year(2006) / 1 / 1), sys_days(year(2009) / 1 / 1),
     sys_days(year(2012) / 7 / 1), sys_days(year(2015) / 7 / 1), sys_days(year(2017) / 1 / 1)}};

}  // namespace

int leap_seconds_at(std::int64_t stamp_ns) {
  return static_cast<int>(std::count_if(kLeapDays.begin(), kLeapDays.end(), [&](sys_days day) {
    return day.time_since_epoch().count() * kDayNs <= stamp_ns;
  }));
}

std::int64_t utc_from_gps(std::int64_t week, std::int64_t nanoseconds_of_week) {
  constexpr std::int64_t kEpochNs = sys_days(year(1980) / 1 / 6).time_since_epoch().count() * kDayNs;
  const std::int64_t gps_ns = kEpochNs + 7 * week * kDayNs + nanoseconds_of_week;
  // The day of a leap second begins in UTC; GPS time is ahead of it by what held before.
  const int before = leap_seconds_at(gps_ns - 20 * kSecondNs);
  return gps_ns - kSecondNs * leap_seconds_at(gps_ns - kSecondNs * before);
}

}  // namespace cairn
