#include "engine/scene/problems.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

namespace atrium {
namespace {

using Severity = Problem::Severity;

constexpr double kMaxExtent = 1e4;  // metres: beyond, float coordinates leave form factors 0.2 % and more off
constexpr double kMinExtent = 1e-3; // metres
constexpr double kFarFromOrigin = 1e4;

/// A number for a message: four digits, no trailing zeros.
std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

std::string node_name(const Scene& scene, NodeId id) {
    const Node* node = scene.nodes.find(id);
    return node == nullptr || node->name.empty() ? "node " + std::to_string(id.slot) : "node '" + node->name + "'";
}
std::string material_name(const Material& m) { return m.name.empty() ? "unnamed material" : "material '" + m.name + "'"; }
std::string light_name(const Light& l, const std::string& node) {
    return l.name.empty() ? "light of " + node : "light '" + l.name + "'";
}

/// What leaves a shape without any surface, or null.
const char* emptiness(const Shape& shape) {
    struct Check {
        const char* operator()(const Polygon& g) const {
            double twice_area = 0.0;
            for (std::size_t i = 0; i < g.outer.size(); ++i) {
                const dvec2 a(g.outer[i]);
                const dvec2 b(g.outer[(i + 1) % g.outer.size()]);
                twice_area += a.x * b.y - a.y * b.x;
            }
            return g.outer.size() < 3 || twice_area == 0.0 ? "its polygon has no area" : nullptr;
        }
        const char* operator()(const Box& g) const {
            // A flat box still has two faces; a line or point has none.
            const int zero = int(g.size.x <= 0.0F) + int(g.size.y <= 0.0F) + int(g.size.z <= 0.0F);
            return zero > 1 ? "its box has no area" : nullptr;
        }
        const char* operator()(const Sphere& g) const { return g.radius <= 0.0F ? "its radius is zero" : nullptr; }
        const char* operator()(const Cylinder& g) const { return g.radius <= 0.0F ? "its radius is zero" : nullptr; }
        const char* operator()(const Cone& g) const {
            return std::fmax(g.base_radius, g.top_radius) <= 0.0F ? "its radius is zero" : nullptr;
        }
        const char* operator()(const Disc& g) const { return g.radius <= 0.0F ? "its radius is zero" : nullptr; }
        const char* operator()(const Mesh& g) const {
            return !g.data || g.data->indices.size() < 3 ? "its mesh has no triangles" : nullptr;
        }
    };
    return std::visit(Check{}, shape.geometry);
}

class Finder {
public:
    explicit Finder(const Scene& s) : scene_(s) {}

    std::vector<Problem> find() {
        for (const NodeId id : scene_.in_tree_order()) {
            check_node(id, *scene_.nodes.find(id));
        }
        check_extent();
        if (!any_light_ && !bounds_.empty()) {
            add(Severity::Warning, {}, "scene", "there is no light in it, so everything is black",
                "Add a light, let a material emit, or give the environment a sky");
        }
        // Nodes came in tree order; within one severity that order stays, and what concerns the whole file comes last.
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Problem& a, const Problem& b) { return a.severity > b.severity; });
        return std::move(found_);
    }

private:
    void add(Severity severity, NodeId node, std::string where, std::string what, std::string hint) {
        found_.push_back({severity, node, std::move(where), std::move(what), std::move(hint)});
    }

    void check_node(NodeId id, const Node& node) {
        const std::string where = node_name(scene_, id);
        const bool shown = scene_.shown(id);
        check_ids(id, node, where);
        const dvec3& s = node.transform.scale;
        if (shown && (s.x == 0.0 || s.y == 0.0 || s.z == 0.0) && has_shape_below(id)) {
            add(Severity::Warning, id, where, "its scale is zero, so it has no volume",
                "Set the scale to 1 or hide the node");
        }
        if (const Shape* shape = scene_.shapes.find(node.shape)) {
            if (const char* why = emptiness(*shape)) {
                add(Severity::Warning, id, where, std::string("it shows nothing: ") + why, "Give it a size or delete it");
            }
            if (node.materials.size() > part_count(*shape)) {
                add(Severity::Warning, id, where, "it names more materials than its shape has parts",
                    "The surplus is ignored");
            }
            for (std::size_t part = 0; part < part_count(*shape); ++part) {
                if (const Material* m = scene_.material_of(node, part)) {
                    any_light_ = any_light_ || (shown && m->emits());
                    if (checked_materials_.insert(node.materials[part]).second) {
                        check_material(id, *m);
                    }
                }
            }
            if (shown) {
                measure(id, where);
            }
        }
        if (const Light* light = scene_.lights.find(node.light)) {
            any_light_ =
                any_light_ || (shown && light->enabled && light->intensity > 0.0F && max_component(light->color) > 0.0F);
            check_light(id, *light, light_name(*light, where));
        }
        if (const Camera* camera = scene_.cameras.find(node.camera)) {
            check_camera(id, *camera, camera->name.empty() ? "camera of " + where : "camera '" + camera->name + "'");
        }
    }

    void check_ids(NodeId id, const Node& node, const std::string& where) {
        const auto dangling = [&](bool is, const char* kind, const char* instead) {
            if (is) {
                add(Severity::Warning, id, where, std::string("it refers to a ") + kind + " that does not exist", instead);
            }
        };
        dangling(node.shape && !scene_.shapes.contains(node.shape), "shape", "It shows nothing");
        dangling(node.light && !scene_.lights.contains(node.light), "light", "It gives no light");
        dangling(node.camera && !scene_.cameras.contains(node.camera), "camera", "It is left out of the list of views");
        dangling(std::any_of(node.materials.begin(), node.materials.end(),
                             [&](MaterialId m) { return m && !scene_.materials.contains(m); }),
                 "material", "The default material stands in");
    }

    bool has_shape_below(NodeId id) const {
        const auto below = scene_.in_tree_order(id);
        return std::any_of(below.begin(), below.end(), [&](NodeId n) { return bool(scene_.nodes.find(n)->shape); });
    }

    void check_material(NodeId id, const Material& m) {
        const std::string where = material_name(m);
        const auto dangling = [&](const TextureRef& ref) { return ref && !scene_.textures.contains(ref.texture); };
        if (dangling(m.base_color_texture) || dangling(m.emissive_texture)) {
            add(Severity::Warning, id, where, "it refers to a texture that does not exist", "The plain colour stands in");
        }
        const auto range = [&](float value, float low, float high, const char* what) {
            if (!(value >= low && value <= high)) {
                add(Severity::Warning, id, where,
                    std::string("its ") + what + " of " + number(double(value)) + " is outside " + number(double(low)) +
                        " to " + number(double(high)),
                    "Set it within that range");
            }
        };
        range(m.roughness, 0.0F, 1.0F, "roughness");
        range(m.metallic, 0.0F, 1.0F, "metallic factor");
        range(m.transmission, 0.0F, 1.0F, "transmission");
        range(m.alpha, 0.0F, 1.0F, "alpha");
        // glTF allows 0 for "reflects everything"; everything in a room is between air and diamond.
        if (m.transmission > 0.0F || m.ior != 0.0F) {
            range(m.ior, 1.0F, 3.0F, "index of refraction");
        }
        const vec3& c = m.base_color;
        const Rgb e = m.emitted_radiance();
        if (std::fmin(c.x, std::fmin(c.y, c.z)) < 0.0F || std::fmin(e.x, std::fmin(e.y, e.z)) < 0.0F) {
            add(Severity::Warning, id, where, "a colour of it is negative", "Negative light and reflectance count as zero");
        }
        // A texture scales the colour down, as glTF's white factor expects.
        const float reflectance = max_component(c * (m.metallic + (1.0F - m.metallic) * (1.0F - m.transmission)));
        if (!m.base_color_texture && reflectance >= kMaxReflectance) {
            add(Severity::Warning, id, where,
                "it reflects " + number(double(reflectance) * 100.0) +
                    " % of the light, with which a closed room would grow brighter without end",
                "It counts as 99.99 %; white paint has 80 to 90 %");
        }
    }

    void check_light(NodeId id, const Light& l, const std::string& where) {
        if (l.intensity < 0.0F || std::fmin(l.color.x, std::fmin(l.color.y, l.color.z)) < 0.0F) {
            add(Severity::Warning, id, where, "its intensity or colour is negative", "Negative light counts as none");
        } else if (l.enabled && (l.intensity == 0.0F || max_component(l.color) == 0.0F)) {
            add(Severity::Warning, id, where, "it is switched on but its intensity is zero",
                "Set an intensity or switch it off");
        }
        if (l.kind == Light::Kind::Directional && l.photometry) {
            add(Severity::Note, id, where, "it has a photometric file, which a sun cannot have", "The file is ignored");
        }
        if (l.kind == Light::Kind::Spot &&
            !(l.inner_cone >= 0.0F && l.inner_cone < l.outer_cone && l.outer_cone <= kPi / 2.0F)) {
            add(Severity::Warning, id, where,
                "the inner angle of its cone is not smaller than the outer, or that is over 90 degrees",
                "Set 0 <= inner < outer <= 90 degrees");
        }
    }

    void check_camera(NodeId id, const Camera& c, const std::string& where) {
        if (c.perspective && !(c.yfov > 0.0F && c.yfov < kPi)) {
            add(Severity::Warning, id, where, "its field of view is not between 0 and 180 degrees",
                "40 to 70 degrees suit a room");
        }
        if (!c.perspective && c.ymag == 0.0F) {
            add(Severity::Warning, id, where, "it shows a height of zero", "Set its height in metres");
        }
        if ((c.perspective && c.znear <= 0.0F) || (c.zfar != 0.0F && c.zfar <= c.znear)) {
            add(Severity::Warning, id, where, "its far plane is not behind its near plane", "Set 0 < near < far");
        }
    }

    void measure(NodeId id, const std::string& where) {
        const DBox3 b = scene_.world_bounds(id);
        if (b.empty()) {
            return;
        }
        bounds_.add(b);
        const dvec3 size = b.size();
        const double largest = std::max({size.x, size.y, size.z});
        if (largest < kMinExtent && largest > 0.0 && small_count_++ == 0) {
            first_small_ = id;
            first_small_name_ = where + " (" + number(largest * 1000.0) + " mm)";
        }
    }

    void check_extent() {
        if (bounds_.empty()) {
            add(Severity::Warning, {}, "scene", "it has no visible surface", "Show a node, or add a shape");
            return;
        }
        const dvec3 size = bounds_.size();
        const double largest = std::max({size.x, size.y, size.z});
        if (largest > kMaxExtent) {
            add(Severity::Warning, {}, "scene",
                "it extends over " + number(largest) + " m; light becomes inaccurate beyond 10 km",
                "Check the unit of length, or delete what lies far outside");
        } else if (largest < kMinExtent) {
            add(Severity::Warning, {}, "scene", "it is only " + number(largest * 1000.0) + " mm large",
                "Check the unit of length: glTF is in metres");
        } else if (small_count_ > 0) {
            add(Severity::Note, first_small_, first_small_name_,
                small_count_ == 1 ? "it is smaller than a millimetre"
                                  : "it and " + std::to_string(small_count_ - 1) + " more are smaller than a millimetre",
                "Such detail costs time and is hardly seen");
        }
        const double away = glm::length(bounds_.centre());
        if (away > kFarFromOrigin && away > 2.0 * bounds_.diagonal()) {
            add(Severity::Note, {}, "scene",
                "it lies " + number(away / 1000.0) + " km from the origin, as survey coordinates do",
                "The light is computed about its own centre; nothing needs to be done");
        }
    }

    const Scene& scene_;
    std::vector<Problem> found_;
    std::set<MaterialId> checked_materials_;
    DBox3 bounds_;
    std::size_t small_count_ = 0;
    NodeId first_small_;
    std::string first_small_name_;
    bool any_light_ = max_component(scene_.environment.sky_radiance) > 0.0F;
};

} // namespace

const char* severity_name(Problem::Severity severity) {
    switch (severity) {
    case Severity::Note: return "note";
    case Severity::Warning: return "warning";
    case Severity::Error: return "error";
    }
    return "unknown";
}

std::vector<Problem> find_problems(const Scene& scene) { return Finder(scene).find(); }

} // namespace atrium
