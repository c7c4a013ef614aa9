// Pictures in and out through OpenImageIO, which is included by image_file.cpp and nowhere else.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/material.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace atrium {

/// Decodes an image file held in memory (PNG, JPEG, HDR, EXR and what OpenImageIO reads). `name` is for messages.
/// Refuses more than 2^28 samples before allocating.
Result<Image> decode_image(std::span<const std::uint8_t> bytes, const std::string& name);
Result<Image> read_image(const std::filesystem::path& path);

/// Linear RGB float picture, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<vec3> pixels;
};
/// One more number per pixel beside a picture's colours.
struct PictureChannel {
    std::string name;          ///< as EXR readers show it, "layer.component"
    std::vector<float> values; ///< rows from the top
};
/// Writes .exr (float, linear) or .png (8 bit, pixels already display-encoded in [0,1]) by extension; atomic (temporary
/// file, then rename). `extra` channels go into .exr files only.
Result<void> write_picture(const std::filesystem::path& path, const Picture& picture,
                           const std::vector<PictureChannel>& extra = {});
/// Encodes 8-bit samples as PNG in memory, for generated textures.
Result<std::vector<std::uint8_t>> encode_png(const Image& image);

} // namespace atrium
