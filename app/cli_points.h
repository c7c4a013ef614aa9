// Sensor points as CSV: `x,y,z,nx,ny,nz`, more columns allowed.
#pragma once

#include "engine/base/math.h"
#include "engine/base/result.h"
#include "engine/solver/gi_engine.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace atrium::cli {

/// One line of a point list or of a measurement.
struct SensorPoint {
    dvec3 position{0.0};               ///< metres, world
    dvec3 normal{0.0, 1.0, 0.0};       ///< unit
    std::size_t line = 0;              ///< in the file, from 1
    std::optional<double> illuminance; ///< column E, lux, where the file has one
};

/// Reads a CSV file with a header that names x, y, z, nx, ny, nz in any order; other columns are left alone, E is kept.
/// Accepts a byte order mark, CRLF, spaces around numbers and empty lines. The first bad line is reported by its number.
Result<std::vector<SensorPoint>> read_points(const std::string& path);
/// The same from text; `name` is for messages.
Result<std::vector<SensorPoint>> parse_points(const std::string& text, const std::string& name);

/// Readings of as many points as CSV with the columns of CONTRACTS, in lux.
std::string measurement_csv(const std::vector<SensorPoint>& points, const std::vector<SensorReading>& readings);

} // namespace atrium::cli
