#include "engine/radiosity/light_split.h"

#include <unordered_map>

namespace atrium {
namespace {

template <class Value>
LeafFlags stand_out(const Hierarchy& h, const std::vector<std::uint32_t>& room, float contrast, const Value& value) {
    struct Mean {
        double sum = 0.0;
        double area = 0.0;
    };
    std::unordered_map<std::uint32_t, Mean> mean;
    const auto room_of = [&](std::uint32_t i) { return room.empty() ? 0U : room[i]; };
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        if (e.leaf()) {
            Mean& m = mean[room_of(i)];
            m.sum += double(e.area) * value(e);
            m.area += e.area;
        }
    }
    LeafFlags out(h.elements.size(), 0);
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        if (e.leaf()) {
            const Mean& m = mean[room_of(i)];
            out[i] = double(value(e)) * m.area > double(contrast) * m.sum ? 1 : 0;
        }
    }
    return out;
}

} // namespace

LeafFlags named_emitters(const Hierarchy& h, const std::vector<std::uint32_t>& room, float contrast) {
    return stand_out(h, room, contrast, [](const Element& e) { return luminance(e.emitted); });
}

LeafFlags bright_leaves(const Hierarchy& h, const std::vector<std::uint32_t>& room, float contrast) {
    return stand_out(h, room, contrast, [](const Element& e) { return luminance(e.radiosity); });
}

Hierarchy only_flagged(const Hierarchy& h, const LeafFlags& flags, bool emission) {
    Hierarchy out = h;
    for (std::size_t i = 0; i < out.elements.size(); ++i) {
        Element& e = out.elements[i];
        e.radiosity = !e.leaf() || flags[i] == 0 ? Rgb(0.0F) : (emission ? e.emitted : e.radiosity);
    }
    out.pull_radiosity();
    return out;
}

} // namespace atrium
