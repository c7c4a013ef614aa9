// The figures of `--stats` by their keys, for whoever writes or shows them: one list, so that all say the same.
#pragma once

#include "engine/solver/statistics.h"

#include <variant>

namespace atrium {

/// One number of the statistics. Keys of groups are joined by a point: "memory.links".
struct StatisticsFigure {
    enum class Unit : std::uint8_t { None, Seconds, Bytes, Lumen, Share };
    std::string key;
    std::variant<bool, std::int64_t, std::uint64_t, double> value;
    Unit unit = Unit::None;
    [[nodiscard]] double number() const;
};

/// Counts, errors, memory and energy in the order of CONTRACTS. Times, phases and features are lists of their own.
std::vector<StatisticsFigure> statistics_figures(const Statistics& statistics);

} // namespace atrium
