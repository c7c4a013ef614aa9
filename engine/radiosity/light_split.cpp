#include "engine/radiosity/light_split.h"

#include <unordered_map>

namespace atrium {
namespace {

template <class Value>
LeafFlags stand_out(const Hierarchy& h, const std::vector<std::uint32_t>& room, float contrast, const Value& value) {
    struct Sum {
        double light = 0.0;
        double area = 0.0;
    };
    // A surface is judged by what the others of its room do: it may be most of what there is, and still stand out.
    std::unordered_map<std::uint32_t, Sum> rooms;
    std::unordered_map<std::uint64_t, Sum> surfaces; // by room and surface
    const auto room_of = [&](std::uint32_t i) { return room.empty() ? 0U : room[i]; };
    const auto surface_of = [&](const Element& e) {
        return e.kind == Element::Kind::Faces ? h.faces[e.triangle].surface : e.surface;
    };
    const auto key_of = [&](std::uint32_t i) { return std::uint64_t(room_of(i)) << 32 | surface_of(h.elements[i]); };
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        if (e.leaf()) {
            for (Sum* sum : {&rooms[room_of(i)], &surfaces[key_of(i)]}) {
                sum->light += double(e.area) * value(e);
                sum->area += e.area;
            }
        }
    }
    LeafFlags out(h.elements.size(), 0);
    // Who gathers by name starts from the root.
    const std::size_t below_root = std::min<std::size_t>(h.elements.size(), h.first_appended);
    for (std::uint32_t i = 0; i < below_root; ++i) {
        const Element& e = h.elements[i];
        if (e.leaf() && value(e) > 0.0F) {
            const Sum& all = rooms[room_of(i)];
            const Sum& own = surfaces[key_of(i)];
            const double others = all.area - own.area;
            // Alone in its room: nothing to stand out from but the rest of itself.
            const Sum against = others > 1e-6 * all.area ? Sum{std::max(all.light - own.light, 0.0), others} : all;
            out[i] = double(value(e)) * against.area > double(contrast) * against.light ? 1 : 0;
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
