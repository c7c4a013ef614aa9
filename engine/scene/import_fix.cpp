// Files in another unit of length or with +Z up, recognised by size and shape. Suggestions only: when in doubt, none.
#include "engine/geometry/tessellate.h"
#include "engine/scene/problems.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

namespace atrium {
namespace {

// Anything from a door handle to a large building is taken as metres.
constexpr double kLargestCredible = 500.0;

struct Unit {
    const char* name;
    double metres;
    double min_height, max_height; ///< of a building in this unit, metres: the coarser the guess, the narrower
};
// Millimetres first: by far the most frequent. A hall's or house's height settles it, a single storey's has to in the units
// whose numbers a piece of furniture in millimetres could have as well.
constexpr std::array<Unit, 4> kUnits{{{"millimetres", 0.001, 2.0, 60.0},
                                      {"centimetres", 0.01, 2.0, 4.5},
                                      {"inches", 0.0254, 2.0, 4.5},
                                      {"feet", 0.3048, 2.0, 60.0}}};

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

/// Bounds and the area of surfaces that face along each axis (within 25 degrees), of all shown shapes.
struct Form {
    DBox3 bounds;
    dvec3 area_along{0.0};
    dvec3 area_at_sides{0.0}; ///< the part of it that lies in the outer 15 % of the bounds on either side
};

Form form_of(const Scene& scene) {
    struct Facing {
        int axis;
        double at; ///< of the triangle's centre, along the axis
        double area;
    };
    Form out;
    std::vector<Facing> faces;
    std::map<ShapeId, std::shared_ptr<const MeshData>> meshes; // instances share one tessellation
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        const Shape* shape = scene.shapes.find(node.shape);
        if (shape == nullptr || !scene.shown(id)) {
            return;
        }
        auto& mesh = meshes[node.shape];
        if (!mesh) {
            mesh = tessellate(shape->geometry, {8});
        }
        const dmat4 m = scene.world_matrix(id);
        std::vector<dvec3> world(mesh->positions.size());
        for (std::size_t i = 0; i < world.size(); ++i) {
            world[i] = dvec3(m * dvec4(dvec3(mesh->positions[i]), 1.0));
        }
        for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
            const dvec3& a = world[mesh->indices[i]];
            const dvec3& b = world[mesh->indices[i + 1]];
            const dvec3& c = world[mesh->indices[i + 2]];
            for (const dvec3& p : {a, b, c}) {
                out.bounds.add(p);
            }
            const dvec3 n = glm::cross(b - a, c - a) * 0.5;
            const double area = glm::length(n);
            for (int axis = 0; axis < 3; ++axis) {
                if (std::abs(n[axis]) > 0.9 * area) {
                    faces.push_back({axis, (a[axis] + b[axis] + c[axis]) / 3.0, area});
                }
            }
        }
    });
    for (const Facing& f : faces) {
        const double inset = 0.15 * out.bounds.size()[f.axis];
        const bool at_side = f.at < out.bounds.min[f.axis] + inset || f.at > out.bounds.max[f.axis] - inset;
        out.area_along[f.axis] += f.area;
        out.area_at_sides[f.axis] += at_side ? f.area : 0.0;
    }
    return out;
}

/// Cameras stand upright: -1 when they say +Y is up, 1 for +Z, 0 when there are none or they disagree.
int cameras_say(const Scene& scene) {
    int y = 0;
    int z = 0;
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        if (!scene.cameras.contains(node.camera)) {
            return;
        }
        const dvec3 up = glm::normalize(dvec3(scene.world_matrix(id)[1]));
        y += up.y > 0.7 ? 1 : 0;
        z += up.z > 0.7 ? 1 : 0;
    });
    return y > 0 ? -1 : z > 0 ? 1 : 0;
}

/// The unit in which a building of this size would be credible, or null for metres.
const Unit* unit_for(const dvec3& size, int up) {
    const double largest = std::max({size.x, size.y, size.z});
    if (largest <= kLargestCredible) {
        return nullptr;
    }
    const double height = size[up];
    const double width = std::max(size[(up + 1) % 3], size[(up + 2) % 3]);
    for (const Unit& unit : kUnits) {
        const double metres = largest * unit.metres;
        // Buildings are wider than high; what is not may be a wardrobe in millimetres.
        if (metres >= 1.0 && metres <= 200.0 && height < width && height * unit.metres >= unit.min_height &&
            height * unit.metres <= unit.max_height) {
            return &unit;
        }
    }
    return nullptr;
}

/// A room lying on its side: flat along z, with most surface facing z, and walls about it.
bool shaped_z_up(const Form& form) {
    const dvec3 size = form.bounds.size();
    const dvec3& area = form.area_along;
    const bool flat = size.z < 0.8 * std::min(size.x, size.y);
    const bool floors = area.z > 1.3 * std::max(area.x, area.y);
    // A picture or a facade has next to no walls, and a row of exhibits before a backdrop none at its sides; a room has
    // four.
    const bool walls = std::min(area.x, area.y) > 0.1 * area.z && form.area_at_sides.x > 0.5 * size.y * size.z &&
                       form.area_at_sides.y > 0.5 * size.x * size.z;
    return flat && floors && walls;
}

/// Signs that +Y was up after all.
bool stands_on_y(const Form& form, int cameras, double metres) {
    const dvec3 size = form.bounds.size() * metres;
    const dvec3 base = glm::abs(form.bounds.min * metres);
    if (cameras != 0) {
        return cameras < 0;
    }
    if (std::max(size.x, size.y) < 2.5) {
        return true; // furniture: a shelf is flat along z as well
    }
    if (size.y >= 2.2 && size.y <= 3.2) {
        return true; // the usual height of a room
    }
    return base.y < 0.05 * size.y && base.z > 0.15 * size.z; // it stands on y = 0
}

} // namespace

ImportSuggestion suggest_import_fix(const Scene& scene) {
    ImportSuggestion out;
    const Form form = form_of(scene);
    if (form.bounds.empty()) {
        return out;
    }
    const dvec3 size = form.bounds.size();
    const Unit* unit = nullptr;
    if (shaped_z_up(form)) {
        unit = unit_for(size, 2);
        out.z_up = !stands_on_y(form, cameras_say(scene), unit != nullptr ? unit->metres : 1.0);
    }
    if (!out.z_up) {
        unit = unit_for(size, 1);
    }
    const double largest = std::max({size.x, size.y, size.z});
    if (unit != nullptr) {
        out.unit_scale = unit->metres;
        out.why = "The scene would be " + number(largest) + " m large; taken as " + unit->name + " it is a building of " +
                  number(largest * unit->metres) + " m.";
    }
    if (out.z_up) {
        out.why += std::string(out.why.empty() ? "" : " ") +
                   "It is flat along z and most of its surfaces face z, as floors and ceilings do when +Z is up.";
    }
    return out;
}

} // namespace atrium
