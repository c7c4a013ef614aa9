#include "app/cli_points.h"

#include "app/cli_support.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace atrium::cli {

namespace {

std::string_view trimmed(std::string_view s) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t begin = s.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) {
        return {};
    }
    return s.substr(begin, s.find_last_not_of(kBlank) - begin + 1);
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> out;
    for (;;) {
        const std::size_t comma = line.find(',');
        out.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return out;
        }
        line.remove_prefix(comma + 1);
    }
}

std::optional<double> number(std::string_view s) {
    if (!s.empty() && s.front() == '+') {
        s.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error != std::errc() || end != s.data() + s.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

/// A cell as it may be shown in a message: short, printable.
std::string shown(std::string_view cell) {
    std::string out(cell.substr(0, 40));
    for (char& c : out) {
        c = c >= ' ' && c < 127 ? c : '?';
    }
    return out;
}

constexpr std::array<std::string_view, 6> kColumns = {"x", "y", "z", "nx", "ny", "nz"};

} // namespace

Result<std::vector<SensorPoint>> read_points(const std::string& path) {
    auto text = read_text(path);
    if (!text) {
        return tl::unexpected(text.error());
    }
    return parse_points(*text, path);
}

Result<std::vector<SensorPoint>> parse_points(const std::string& text, const std::string& name) {
    std::string_view rest = text;
    if (rest.substr(0, 3) == "\xEF\xBB\xBF") {
        rest.remove_prefix(3);
    }
    std::vector<SensorPoint> points;
    std::array<std::size_t, 6> column{};
    std::size_t illuminance = SIZE_MAX;
    std::size_t width = 0; // 0 = the header has not come yet
    for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (line.empty()) {
            continue;
        }
        const std::string where = fmt::format("line {}", line_number);
        const auto cells = split(line);
        if (width == 0) {
            for (std::size_t k = 0; k < kColumns.size(); ++k) {
                const auto found = std::find(cells.begin(), cells.end(), kColumns[k]);
                if (found == cells.end()) {
                    return fail(name, where, fmt::format("the header has no column '{}'", kColumns[k]),
                                "Begin the file with the line x,y,z,nx,ny,nz.");
                }
                column[k] = std::size_t(found - cells.begin());
            }
            const auto found = std::find(cells.begin(), cells.end(), "E");
            illuminance = found == cells.end() ? SIZE_MAX : std::size_t(found - cells.begin());
            width = cells.size();
            continue;
        }
        if (cells.size() != width) {
            return fail(name, where, fmt::format("has {} values where the header names {}", cells.size(), width),
                        "Separate values by commas and use a point as the decimal sign.");
        }
        std::array<double, 6> v{};
        for (std::size_t k = 0; k < v.size(); ++k) {
            const auto value = number(cells[column[k]]);
            if (!value) {
                return fail(name, where,
                            fmt::format("'{}' in column {} is not a number", shown(cells[column[k]]), kColumns[k]));
            }
            v[k] = *value;
        }
        SensorPoint point;
        point.position = {v[0], v[1], v[2]};
        point.normal = {v[3], v[4], v[5]};
        point.line = line_number;
        const double length = glm::length(point.normal);
        if (!(length > 1e-9) || !std::isfinite(length)) {
            return fail(name, where, "the direction nx,ny,nz has no length", "Give the direction that the sensor faces.");
        }
        point.normal /= length;
        if (illuminance != SIZE_MAX) {
            point.illuminance = number(cells[illuminance]);
        }
        points.push_back(point);
    }
    if (width == 0) {
        return fail(name, "", "is empty", "Begin the file with the line x,y,z,nx,ny,nz.");
    }
    return points;
}

std::string measurement_csv(const std::vector<SensorPoint>& points, const std::vector<SensorReading>& readings) {
    std::string out = "x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface\n";
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec3& p = points[i].position;
        const dvec3& n = points[i].normal;
        const Rgb& e = readings[i].irradiance;
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", p.x, p.y, p.z, n.x, n.y, n.z, e.r, e.g, e.b,
                           luminance(e), readings[i].standard_error, readings[i].on_surface ? 1 : 0);
    }
    return out;
}

} // namespace atrium::cli
