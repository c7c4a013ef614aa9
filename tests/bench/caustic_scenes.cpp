#include "tests/bench/caustic_scenes.h"

#include "tests/support/rooms.h"

namespace atrium::bench {
namespace {

MaterialId add_metal(Scene& scene, float roughness) {
    Material m;
    m.base_color = Rgb(0.9F);
    m.metallic = 1.0F;
    m.roughness = roughness;
    return scene.materials.insert(m);
}

MaterialId add_glass(Scene& scene) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.thickness = 1.0F;
    m.ior = 1.5F;
    return scene.materials.insert(m);
}

void add_sun(Scene& scene, const dvec3& direction) {
    Light light;
    light.kind = Light::Kind::Directional;
    light.intensity = 100'000.0F;
    Node node;
    node.name = "sun";
    node.light = scene.lights.insert(light);
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0.1, 1, 0.2), z));
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(x, glm::cross(z, x), z)));
    scene.roots.push_back(scene.nodes.insert(node));
}

NodeId add_node(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

CausticScene with_floor(const std::string& name, float floor, const vec2& corner, float size) {
    CausticScene out;
    out.name = name;
    out.corner = corner;
    out.size = size;
    test::add_rectangle(out.scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, floor, floor,
                        test::add_material(out.scene, 0.6F));
    return out;
}

// Half a ring of polished metal, inside towards the light: 5 cm radius, 2 cm high.
Mesh half_ring(float radius, float height) {
    auto mesh = std::make_shared<MeshData>();
    constexpr int kSteps = 256;
    for (int i = 0; i <= kSteps; ++i) {
        const double phi = radians_from_degrees(-90.0 + 180.0 * i / kSteps);
        for (const float y : {0.0F, height}) {
            mesh->positions.push_back(vec3(dvec3(radius * std::cos(phi), double(y), -radius * std::sin(phi))));
            mesh->normals.push_back(vec3(dvec3(-std::cos(phi), 0.0, std::sin(phi))));
        }
        if (i > 0) {
            const auto a = std::uint32_t(2 * (i - 1));
            mesh->indices.insert(mesh->indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
        }
    }
    mesh->parts = {{0, std::uint32_t(mesh->indices.size())}};
    return Mesh{mesh};
}

} // namespace

vec2 CausticScene::place(const RayScene& rays, const Landing& l) const {
    const auto p = rays.triangle(l.surface, l.triangle);
    const dvec3 at = dvec3(p[0] + (p[1] - p[0]) * l.barycentric.x + (p[2] - p[0]) * l.barycentric.y) + rays.origin();
    return (vec2(float(at.x), float(at.z)) - corner) / size;
}

vec2 CausticScene::chart_position(const SurfaceCharts& charts, const vec2& place) const {
    const Chart& c = charts.charts.front();
    const dvec3 world(double(corner.x) + double(place.x) * size, 0.0, double(corner.y) + double(place.y) * size);
    const vec3 from = vec3(world - origin) - c.origin;
    return vec2(float(c.tile_u), float(c.tile_v)) + vec2(glm::dot(from, c.axis_u), glm::dot(from, c.axis_v)) / c.scale;
}

Hierarchy CausticScene::emitters(const RayScene& rays) const {
    bool shines = false;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        shines = shines || rays.material(s).emits();
    }
    if (!shines) {
        return {};
    }
    HierarchySettings settings;
    settings.smallest_patch = 0.01F;
    settings.group_size = 0.005F;
    return build_hierarchy(rays, settings);
}

std::vector<CausticScene> caustic_scenes() {
    std::vector<CausticScene> out;
    {
        CausticScene c = with_floor("ring", 0.5F, {-0.07F, -0.07F}, 0.14F);
        add_node(c.scene, half_ring(0.05F, 0.02F), {0, 0, 0}, add_metal(c.scene, 0.0F));
        add_sun(c.scene, {1, -1, 0});
        out.push_back(std::move(c));
    }
    {
        CausticScene c = with_floor("glass-ball", 1.0F, {-0.05F, -0.1F}, 0.2F);
        add_node(c.scene, Sphere{0.05F}, {0, 0.06, 0}, add_glass(c.scene));
        add_sun(c.scene, {0.6, -1, 0.1});
        out.push_back(std::move(c));
    }
    {
        CausticScene c = with_floor("sun-mirror", 6.0F, {-1.8F, -0.6F}, 1.8F);
        test::add_rectangle(c.scene, "mirror", {0.9, 1.0, 0.3}, glm::normalize(dvec3(-1, -0.1, 0)), {0, 0, 1}, 0.6F, 0.8F,
                            add_metal(c.scene, 0.0F));
        add_sun(c.scene, {1, -1, 0});
        out.push_back(std::move(c));
    }
    {
        CausticScene c = with_floor("lamp", 2.0F, {-0.5F, -0.5F}, 1.0F);
        const MaterialId bulb = test::add_material(c.scene, 0.0F, 1e6F);
        add_node(c.scene, Sphere{0.01F}, {0.0, 0.25, 0.0}, bulb);
        add_node(c.scene, Cylinder{0.12F, 0.2F, false}, {0.35, 0.1, 0.1}, add_metal(c.scene, 0.1F));
        add_node(c.scene, Sphere{0.06F}, {-0.2, 0.12, 0.15}, add_glass(c.scene));
        out.push_back(std::move(c));
    }
    for (CausticScene& c : out) {
        c.origin = RayScene(c.scene).origin();
    }
    return out;
}

} // namespace atrium::bench
