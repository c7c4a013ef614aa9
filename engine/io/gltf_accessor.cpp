#include "engine/io/gltf_accessor.h"

#include "engine/io/gltf_check.h"

#include <algorithm>
#include <cstring>
#include <tiny_gltf.h>

namespace atrium::gltf {
namespace {

/// One little-endian component; memcpy because files are not always aligned.
template <class T> T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

float load_float(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const float v = load<std::int8_t>(bytes);
        return normalized ? std::max(v / 127.0F, -1.0F) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
        const float v = load<std::uint8_t>(bytes);
        return normalized ? v / 255.0F : v;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const float v = load<std::int16_t>(bytes);
        return normalized ? std::max(v / 32767.0F, -1.0F) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        const float v = load<std::uint16_t>(bytes);
        return normalized ? v / 65535.0F : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
        const auto v = double(load<std::uint32_t>(bytes));
        return float(normalized ? v / 4294967295.0 : v);
    }
    default: return load<float>(bytes);
    }
}

std::uint32_t load_index(const unsigned char* bytes, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return load<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return load<std::uint16_t>(bytes);
    default: return load<std::uint32_t>(bytes);
    }
}

struct View {
    const unsigned char* data;
    std::size_t stride;
};

View open_view(const tinygltf::Model& model, int index, std::size_t offset, std::size_t element) {
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(index)];
    return {model.buffers[std::size_t(view.buffer)].data.data() + view.byteOffset + offset,
            view.byteStride != 0 ? view.byteStride : element};
}

/// Calls store(element index, bytes) for the base values and then for the sparse replacements.
template <class Store> void for_each_element(const tinygltf::Model& model, int index, std::size_t element, Store&& store) {
    const tinygltf::Accessor& accessor = model.accessors[std::size_t(index)];
    if (accessor.bufferView >= 0) {
        const View view = open_view(model, accessor.bufferView, accessor.byteOffset, element);
        for (std::size_t i = 0; i < accessor.count; ++i) {
            store(i, view.data + i * view.stride);
        }
    }
    if (!accessor.sparse.isSparse) {
        return;
    }
    const auto& sparse = accessor.sparse;
    const std::size_t index_size = component_size(std::uint64_t(sparse.indices.componentType));
    const View indices = open_view(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), index_size);
    const View values = open_view(model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), element);
    for (std::size_t k = 0; k < std::size_t(sparse.count); ++k) {
        const std::uint32_t target = load_index(indices.data + k * indices.stride, sparse.indices.componentType);
        if (target >= accessor.count) {
            refuse("accessors/" + std::to_string(index) + "/sparse",
                   "replaces element " + std::to_string(target) + " of " + std::to_string(accessor.count));
        }
        store(target, values.data + k * values.stride);
    }
}

} // namespace

FloatElements read_floats(ReadContext& context, int index, NonFinite policy) {
    const tinygltf::Accessor& accessor = context.model.accessors[std::size_t(index)];
    const std::string where = place(context.root, "accessors", std::size_t(index));
    const std::size_t size = component_size(std::uint64_t(accessor.componentType));
    FloatElements out;
    out.components = std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)));
    context.budget.charge(std::uint64_t(accessor.count) * out.components * sizeof(float), where);
    out.values.resize(accessor.count * out.components);
    for_each_element(context.model, index, size * out.components, [&](std::size_t i, const unsigned char* bytes) {
        for (std::size_t c = 0; c < out.components; ++c) {
            out.values[i * out.components + c] = load_float(bytes + c * size, accessor.componentType, accessor.normalized);
        }
    });
    if (policy == NonFinite::Refuse) {
        const auto bad = std::find_if(out.values.begin(), out.values.end(), [](float v) { return !std::isfinite(v); });
        if (bad != out.values.end()) {
            refuse(where,
                   "element " + std::to_string(std::size_t(bad - out.values.begin()) / out.components) +
                       " is not a finite number",
                   "The geometry is damaged; export the file again.");
        }
    }
    return out;
}

std::vector<std::uint32_t> read_indices(ReadContext& context, int index) {
    const tinygltf::Accessor& accessor = context.model.accessors[std::size_t(index)];
    context.budget.charge(std::uint64_t(accessor.count) * sizeof(std::uint32_t),
                          place(context.root, "accessors", std::size_t(index)));
    std::vector<std::uint32_t> out(accessor.count);
    for_each_element(context.model, index, component_size(std::uint64_t(accessor.componentType)),
                     [&](std::size_t i, const unsigned char* bytes) { out[i] = load_index(bytes, accessor.componentType); });
    return out;
}

} // namespace atrium::gltf
