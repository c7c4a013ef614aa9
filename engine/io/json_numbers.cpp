#include "engine/io/json_numbers.h"

#include "engine/base/float_traps.h"

#include <cmath>
#include <limits>

namespace atrium::gltf {

Json parse_json(std::string_view text) {
    const FloatTrapsOff library;
    return Json::parse(text);
}

std::optional<float> float_of(const Json& value) {
    if (!value.is_number()) {
        return std::nullopt;
    }
    const auto number = value.get<double>();
    return std::abs(number) <= double(std::numeric_limits<float>::max()) ? std::optional(float(number)) : std::nullopt;
}

} // namespace atrium::gltf
