#include "engine/io/gltf_shape_json.h"

#include "engine/io/json_numbers.h"

namespace atrium::gltf {
namespace {

Json ring_to_json(const std::vector<vec2>& ring) {
    Json out = Json::array();
    for (const vec2& p : ring) {
        out.push_back(short_number(p.x));
        out.push_back(short_number(p.y));
    }
    return out;
}

std::vector<vec2> ring_from_json(const Json& json) {
    std::vector<vec2> out;
    if (!json.is_array() || json.size() % 2 != 0) {
        refuse("", "a ring is not a list of coordinate pairs");
    }
    for (std::size_t i = 0; i < json.size(); i += 2) {
        const auto x = float_of(json[i]);
        const auto y = float_of(json[i + 1]);
        if (!x || !y) {
            refuse("", "a coordinate is no number, or too large");
        }
        out.emplace_back(*x, *y);
    }
    return out;
}

/// A size that must be there, finite and not negative.
float size_of(const Json& json, const char* key) {
    const auto value = float(number(json, key, -1.0, ""));
    if (!(value >= 0.0F)) {
        refuse("", std::string(key) + " is missing or negative");
    }
    return value;
}

Geometry geometry_from_json(const Json& json) {
    const std::string kind = text(json, "kind", "");
    if (kind == "polygon") {
        Polygon polygon;
        polygon.outer = ring_from_json(json.at("outer"));
        if (const Json* holes = find_array(json, "holes", "")) {
            for (const Json& hole : *holes) {
                polygon.holes.push_back(ring_from_json(hole));
            }
        }
        return polygon;
    }
    if (kind == "box") {
        const vec3 size = number3(json, "size", vec3(-1.0F), "");
        if (!(glm::min(size.x, glm::min(size.y, size.z)) >= 0.0F)) {
            refuse("", "size is missing or negative");
        }
        return Box{size};
    }
    if (kind == "sphere") {
        return Sphere{size_of(json, "radius")};
    }
    if (kind == "disc") {
        return Disc{size_of(json, "radius")};
    }
    if (kind == "cylinder") {
        return Cylinder{size_of(json, "radius"), size_of(json, "height"), boolean(json, "capped", true, "")};
    }
    if (kind == "cone") {
        return Cone{size_of(json, "baseRadius"), size_of(json, "topRadius"), size_of(json, "height"),
                    boolean(json, "capped", true, "")};
    }
    refuse("", "unknown kind");
}

struct ToJson {
    Json operator()(const Polygon& p) const {
        Json out = {{"kind", "polygon"}, {"outer", ring_to_json(p.outer)}};
        for (const auto& hole : p.holes) {
            out["holes"].push_back(ring_to_json(hole));
        }
        return out;
    }
    Json operator()(const Box& b) const { return {{"kind", "box"}, {"size", short_numbers(b.size)}}; }
    Json operator()(const Sphere& s) const { return {{"kind", "sphere"}, {"radius", short_number(s.radius)}}; }
    Json operator()(const Disc& d) const { return {{"kind", "disc"}, {"radius", short_number(d.radius)}}; }
    Json operator()(const Cylinder& c) const {
        return {{"kind", "cylinder"},
                {"radius", short_number(c.radius)},
                {"height", short_number(c.height)},
                {"capped", c.capped}};
    }
    Json operator()(const Cone& c) const {
        return {{"kind", "cone"},
                {"baseRadius", short_number(c.base_radius)},
                {"topRadius", short_number(c.top_radius)},
                {"height", short_number(c.height)},
                {"capped", c.capped}};
    }
    Json operator()(const Mesh&) const { return nullptr; }
};

} // namespace

Json shape_to_json(const Geometry& geometry) { return std::visit(ToJson{}, geometry); }

std::optional<Geometry> shape_from_json(const Json& json) {
    try {
        return geometry_from_json(json);
    } catch (const Refusal&) {
    } catch (const Json::exception&) {
    }
    return std::nullopt;
}

} // namespace atrium::gltf
