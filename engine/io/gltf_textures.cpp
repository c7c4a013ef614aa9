// glTF textures, samplers and images -> Texture. Decoding itself is image_file.cpp.
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_read_context.h"
#include "engine/io/image_file.h"

#include <tiny_gltf.h>

namespace atrium::gltf {
namespace {

Texture::Wrap wrap_of(int value) {
    switch (value) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Texture::Wrap::ClampToEdge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Texture::Wrap::MirroredRepeat;
    default: return Texture::Wrap::Repeat;
    }
}

/// Image of a texture: the core source, else the one of EXT_texture_webp; -1 for none.
int source_of(const Json& texture) {
    if (const Json* source = find(texture, "source")) {
        return source->get<int>();
    }
    const Json* webp = find_extension(texture, kWebp);
    const Json* source = webp != nullptr ? find(*webp, "source") : nullptr;
    return source != nullptr ? source->get<int>() : -1;
}

std::shared_ptr<const Image> decode(ReadContext& context, const EncodedImage& encoded, const std::string& where) {
    auto image = decode_image(*encoded.bytes, encoded.uri);
    if (!image) {
        context.warn(where, image.error().what, "Surfaces that use it show their plain colour.");
        return nullptr;
    }
    if (!context.budget.try_charge(image->bytes.size() + image->floats.size() * sizeof(float))) {
        context.warn(where, "is left out: decoded, the images take more memory than a file of this size may",
                     "Surfaces that use it show their plain colour.");
        return nullptr;
    }
    return std::make_shared<const Image>(std::move(*image));
}

} // namespace

void read_textures(ReadContext& context, const std::vector<EncodedImage>& images) {
    std::vector<std::shared_ptr<const Image>> decoded(images.size());
    std::vector<bool> tried(images.size(), false);
    const Json& textures = section(context.root, "textures");
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const std::string where = place(context.root, "textures", i);
        Texture texture;
        texture.name = text(textures[i], "name", where);
        const int source = source_of(textures[i]);
        if (source < 0) {
            context.warn(where, "has no image that can be read", "Surfaces that use it show their plain colour.");
        } else {
            const auto s = std::size_t(source);
            if (texture.name.empty()) {
                texture.name = text(section(context.root, "images")[s], "name", where);
            }
            texture.mime_type = images[s].mime_type;
            texture.uri = images[s].uri;
            texture.encoded = images[s].bytes;
            if (texture.encoded && !tried[s]) {
                tried[s] = true;
                decoded[s] = decode(context, images[s], place(context.root, "images", s));
            }
            texture.image = decoded[s];
        }
        if (const int sampler = context.model.textures[i].sampler; sampler >= 0) {
            const tinygltf::Sampler& s = context.model.samplers[std::size_t(sampler)];
            texture.wrap_u = wrap_of(s.wrapS);
            texture.wrap_v = wrap_of(s.wrapT);
            texture.nearest = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        context.textures.push_back(context.out.scene.textures.insert(std::move(texture)));
    }
    // An image that no texture shows still belongs to the file: a damaged one is worth a word.
    for (std::size_t s = 0; s < images.size(); ++s) {
        if (images[s].bytes && !tried[s]) {
            decode(context, images[s], place(context.root, "images", s));
        }
    }
}

} // namespace atrium::gltf
