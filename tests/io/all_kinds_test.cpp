#include "tests/io/io_test_support.h"

namespace atrium::test {
namespace {

std::shared_ptr<const std::vector<std::uint8_t>> small_png(std::uint8_t shade) {
    Image image;
    image.width = image.height = 2;
    image.channels = 4;
    for (int i = 0; i < 16; ++i) {
        image.bytes.push_back(std::uint8_t(shade + 10 * i));
    }
    return std::make_shared<const std::vector<std::uint8_t>>(encode_png(image).value());
}

Texture texture(const char* name, std::uint8_t shade) {
    Texture t;
    t.name = name;
    t.mime_type = "image/png";
    t.encoded = small_png(shade);
    t.image = std::make_shared<const Image>(decode_image(*t.encoded, name).value());
    return t;
}

std::vector<MaterialId> add_materials(Scene& s) {
    Texture nearest = texture("Tiles", 0);
    nearest.nearest = true;
    nearest.wrap_u = Texture::Wrap::MirroredRepeat;
    nearest.wrap_v = Texture::Wrap::ClampToEdge;
    const TextureId tiles = s.textures.insert(nearest);
    const TextureId glow = s.textures.insert(texture("Glow", 40));
    const TextureId bumps = s.textures.insert(texture("Bumps", 80));

    std::vector<MaterialId> out;
    Material floor;
    floor.name = "Floor ä ⌂";
    floor.base_color = {0.1F, 0.7F, 1.0F / 3.0F};
    floor.base_color_texture = {tiles, 1, {0.25F, -0.5F}, {2.0F, 3.0F}, 0.3F};
    floor.double_sided = true;
    floor.alpha_mode = Material::Alpha::Mask;
    floor.alpha_cutoff = 0.3F;
    floor.alpha = 0.9F;
    floor.extras = R"({"cost":12.5,"tags":["a","b"]})";
    floor.other_extensions = R"({"KHR_materials_sheen":{"sheenRoughnessFactor":0.5}})";
    floor.other_textures = {{"extensions/KHR_materials_sheen/sheenColorTexture", {bumps}, 1.0F},
                            {"normalTexture", {bumps, 0, {}, {4.0F, 4.0F}, 0.0F}, 0.7F},
                            {"occlusionTexture", {bumps}, 0.6F},
                            {"pbrMetallicRoughness/metallicRoughnessTexture", {bumps}, 1.0F}};
    out.push_back(s.materials.insert(floor));

    Material lamp;
    lamp.name = "Lamp";
    lamp.emissive_color = {1.0F, 0.9F, 0.123456789F};
    lamp.emissive_strength = 28489.3F;
    lamp.emissive_texture = {glow};
    out.push_back(s.materials.insert(lamp));

    Material glass;
    glass.name = "Glass";
    glass.base_color = Rgb(1.0F);
    glass.roughness = 0.0F;
    glass.transmission = 0.95F;
    glass.ior = 1.45F;
    glass.thickness = 0.02F;
    glass.attenuation_color = {0.8F, 0.9F, 0.85F};
    glass.attenuation_distance = 0.1F;
    glass.specular = 0.7F;
    glass.specular_color = {1.0F, 0.5F, 1.2F};
    glass.alpha_mode = Material::Alpha::Blend;
    out.push_back(s.materials.insert(glass));

    Material mirror;
    mirror.name = "Mirror";
    mirror.metallic = 1.0F;
    mirror.roughness = 0.01F;
    mirror.unlit = false;
    out.push_back(s.materials.insert(mirror));

    Material sign;
    sign.unlit = true;
    sign.base_color = Rgb(0.2F);
    out.push_back(s.materials.insert(sign));
    return out;
}

Mesh two_part_mesh() {
    auto m = std::make_shared<MeshData>();
    m->positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1.1F, 0, 1}, {1, 1.0F / 3.0F, 1}, {0, 1, 1}};
    m->normals.assign(7, vec3(0, 0, 1));
    for (int i = 0; i < 7; ++i) {
        m->texcoords0.push_back({0.1F * float(i), 0.5F});
        m->texcoords1.push_back({0.5F, 0.1F * float(i)});
        m->colors.push_back(vec3(0.1F * float(i), 0.5F, 1.0F));
    }
    m->indices = {0, 1, 2, 3, 4, 5, 3, 5, 6};
    m->parts = {{0, 3}, {3, 6}};
    return {m};
}

/// Parts that share vertices, as loaded from a file whose primitives use the same accessors.
Mesh shared_vertex_mesh() {
    auto m = std::make_shared<MeshData>();
    m->positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    m->indices = {0, 1, 2, 0, 2, 3};
    m->parts = {{0, 3}, {3, 3}};
    return {m};
}

NodeId add(Scene& s, NodeId parent, Node node) {
    node.parent = parent;
    const NodeId id = s.nodes.insert(std::move(node));
    if (Node* above = s.nodes.find(parent)) {
        above->children.push_back(id);
    } else {
        s.roots.push_back(id);
    }
    return id;
}

} // namespace

Scene all_kinds_scene() {
    Scene s;
    s.name = "All kinds";
    s.extras = R"({"project":"test"})";
    s.asset_extras = R"({"copyright":"Nobody","extras":{"unit":"m"},"generator":"A test"})";
    s.environment.sky_radiance = {100.0F, 120.5F, 200.0F};
    s.settings.quality = SolverSettings::Quality::Fine;
    s.settings.seed = 4000000000U;
    float threshold = 0.03125F; // no number has to be rounded
    for (const ThresholdInfo& info : kThresholds) {
        s.settings.thresholds.*info.value = std::clamp(threshold, info.least, info.most);
        threshold *= 2.0F;
    }
    const std::vector<MaterialId> materials = add_materials(s);

    Light point;
    point.name = "Bulb";
    point.intensity = 123.456F;
    point.color = {1.0F, 0.8F, 0.6F};
    Light spot;
    spot.kind = Light::Kind::Spot;
    spot.inner_cone = 0.2F;
    spot.outer_cone = 1.1F;
    spot.enabled = false;
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = 90000.0F;
    sun.angular_diameter_degrees = 0.0F;
    sun.extras = R"({"angularDiameterDegrees":0.7})";
    Camera camera;
    camera.name = "Eye";
    camera.yfov = 1.1F;
    camera.zfar = 55.5F;
    camera.exposure_ev = -1.5F;
    camera.extras = "[1,2]";
    Camera plan;
    plan.perspective = false;
    plan.ymag = 3.3F;
    plan.znear = 0.0F;
    const LightId lights[] = {s.lights.insert(point), s.lights.insert(spot), s.lights.insert(sun)};
    const CameraId cameras[] = {s.cameras.insert(camera), s.cameras.insert(plan)};

    const Geometry geometries[] = {Polygon{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}},
                                   Box{{1, 2, 0.3F}},
                                   Sphere{0.25F},
                                   Cylinder{0.2F, 1.5F, false},
                                   Cone{0.5F, 0.1F, 1.0F, true},
                                   Disc{0.75F},
                                   two_part_mesh(),
                                   shared_vertex_mesh()};
    Node storey = node_named("Room");
    storey.extras = R"({"storey":2})";
    const NodeId room = add(s, {}, storey);
    int i = 0;
    for (const Geometry& geometry : geometries) {
        Shape shape{"Shape " + std::to_string(i), geometry, i == 1 ? R"({"maker":"x"})" : ""};
        const ShapeId id = s.shapes.insert(shape);
        Node node;
        node.name = "Object " + std::to_string(i);
        node.shape = id;
        node.materials.assign(part_count(shape), materials[std::size_t(i) % materials.size()]);
        node.transform.translation = {1e6 + 0.1 * i, 1.0 / 3.0, -2.0 * i};
        node.transform.rotation = glm::normalize(dquat(1.0, 0.1 * i, 0.2, -0.3));
        node.transform.scale = {1.0 + i, i == 3 ? -1.0 : 1.0, 0.7};
        node.visible = i != 4;
        node.locked = i == 5;
        add(s, room, node);
        ++i;
    }
    // The same shape with other materials, and with none: one shape all the same.
    Node copy;
    copy.name = "Copy";
    copy.shape = s.nodes.find(s.nodes.find(room)->children[6])->shape;
    copy.materials = {materials[2], MaterialId{}};
    add(s, room, copy);
    // A material that names texture coordinates which the shape does not have.
    copy.shape = s.nodes.find(s.nodes.find(room)->children[7])->shape;
    copy.materials = {materials[0], materials[1]};
    add(s, room, copy);
    add(s, {}, node_named("Bulb", lights[0]));
    add(s, {}, node_named("Bulb", lights[0], cameras[0]));
    add(s, {}, node_named("", lights[1]));
    add(s, {}, node_named("Sun", lights[2]));
    add(s, {}, node_named("Plan", {}, cameras[1]));
    return s;
}

} // namespace atrium::test
