// --threshold NAME=VALUE: thresholds of the solver on the command line, by the names that project files have for them.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/solver_thresholds.h"

#include <string>
#include <utility>
#include <vector>

namespace atrium::cli {

/// One threshold and the value asked for; 0 is automatic.
using ThresholdWish = std::pair<const ThresholdInfo*, float>;

/// Reads NAME=VALUE, where VALUE is a number in the threshold's unit or `auto`. What is wrong says what is allowed.
Result<ThresholdWish> parse_threshold(const std::string& text);

/// What every threshold is called and may be, a line each, for --help and the manual page.
std::string threshold_help();

/// "elementEdge=" and so on, for the completion.
std::vector<std::string> threshold_beginnings();

} // namespace atrium::cli
