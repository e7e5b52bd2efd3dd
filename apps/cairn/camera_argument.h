// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common.h"

namespace cairn::app {

/// --camera FILE|NAME|fx,fy,cx,cy[,scale] for commands that work on single images or lists of points.
Option add_camera_option(CommandLine& app, std::string& camera);

/// Numbers separated by commas or blanks. InputError that names `option` unless there are `count`, all
/// finite.
[[nodiscard]] std::vector<double> parse_number_list(const std::string& text, std::size_t count,
                                                    const std::string& option, const std::string& layout);

}  // namespace cairn::app
