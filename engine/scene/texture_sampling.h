// Reading decoded textures on the CPU, as the viewport's shader does.
#pragma once

#include "engine/scene/material.h"

namespace atrium {

/// Texel at (u, v) with the texture's wrap modes and filter; linear RGB with alpha (8-bit colour is decoded from sRGB).
/// White with alpha 1 when the image could not be decoded.
vec4 sample_texture(const Texture& texture, const vec2& uv);

} // namespace atrium
