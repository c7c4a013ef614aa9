// ATRIUM_shape (gltf_extensions.h): a high-level primitive as JSON and back.
#pragma once

#include "engine/geometry/primitives.h"
#include "engine/io/gltf_json.h"

#include <optional>

namespace atrium::gltf {

/// The extension object of a high-level primitive; null for a Mesh.
Json shape_to_json(const Geometry& geometry);
/// Nothing when the object is malformed or holds sizes that are negative or not finite.
std::optional<Geometry> shape_from_json(const Json& json);

} // namespace atrium::gltf
