// Where accessors become numbers: all component types, strides, sparse, normalised and quantised values.
#pragma once

#include "engine/io/gltf_read_context.h"

namespace atrium::gltf {

/// Elements of one accessor as floats: integers converted, and divided by their largest value where `normalized` is set.
struct FloatElements {
    std::vector<float> values; ///< count * components
    std::size_t components = 0;
    [[nodiscard]] std::size_t count() const { return components != 0 ? values.size() / components : 0; }
    [[nodiscard]] vec2 at2(std::size_t i) const { return {values[2 * i], values[2 * i + 1]}; }
    [[nodiscard]] vec3 at3(std::size_t i) const {
        return {values[components * i], values[components * i + 1], values[components * i + 2]};
    }
};

/// What to do with values that are not finite.
enum class NonFinite : std::uint8_t { Refuse, Keep };

/// Accessor `index` must be in range and checked (gltf_check). Charges the budget.
FloatElements read_floats(ReadContext& context, int index, NonFinite policy = NonFinite::Refuse);
/// Of a SCALAR accessor of unsigned integers.
std::vector<std::uint32_t> read_indices(ReadContext& context, int index);

} // namespace atrium::gltf
