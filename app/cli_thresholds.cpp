#include "app/cli_thresholds.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace atrium::cli {

namespace {

std::string range_text(const ThresholdInfo& info) {
    using T = SolverThresholds;
    const bool length = info.value == &T::element_edge || info.value == &T::mesh_edge || info.value == &T::shadow_texel;
    return fmt::format("{} to {}{}", info.least, info.most, length ? " m" : "");
}

} // namespace

Result<ThresholdWish> parse_threshold(const std::string& text) {
    const std::size_t sign = text.find('=');
    const std::string name = text.substr(0, sign);
    const auto info =
        std::find_if(kThresholds.begin(), kThresholds.end(), [&](const ThresholdInfo& one) { return name == one.key; });
    if (info == kThresholds.end()) {
        std::vector<const char*> names;
        std::transform(kThresholds.begin(), kThresholds.end(), std::back_inserter(names),
                       [](const ThresholdInfo& one) { return one.key; });
        return fail("", "", fmt::format("'{}' is not a threshold", name),
                    fmt::format("There are {}.", fmt::join(names, ", ")));
    }
    const std::string value = sign == std::string::npos ? "" : text.substr(sign + 1);
    if (value == "auto") {
        return ThresholdWish{&*info, 0.0F};
    }
    float number = 0.0F;
    const auto read = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool whole = read.ec == std::errc() && read.ptr == value.data() + value.size();
    if (!whole || !(number >= info->least && number <= info->most)) {
        return fail("", "", fmt::format("'{}' is not a value of {}", value, name),
                    fmt::format("It may be {}, or auto.", range_text(*info)));
    }
    return ThresholdWish{&*info, number};
}

std::string threshold_help() {
    std::string out;
    for (const ThresholdInfo& info : kThresholds) {
        out += fmt::format("{}{}: {}", out.empty() ? "" : ",\n", info.key, range_text(info));
    }
    return out;
}

std::vector<std::string> threshold_beginnings() {
    std::vector<std::string> out;
    for (const ThresholdInfo& info : kThresholds) {
        out.push_back(fmt::format("{}=", info.key));
    }
    return out;
}

} // namespace atrium::cli
