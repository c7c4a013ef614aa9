// Numbers in JSON text, which may be larger than anything holds. Internal to engine/io.
#pragma once

#include "engine/io/gltf_json.h"

#include <optional>
#include <string_view>

namespace atrium::gltf {

/// Json::parse; floating-point traps are off in it, as it tells by an infinity that a number is too large.
Json parse_json(std::string_view text);

/// The number as a float; none where it is no number, or beyond what a float can hold.
std::optional<float> float_of(const Json& value);

} // namespace atrium::gltf
