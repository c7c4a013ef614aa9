#include "ui/document/sample_room.h"

#include <string>

namespace atrium::ui {

namespace {

constexpr float kWidth = 5.0F; // x
constexpr float kDepth = 4.0F; // z
constexpr float kHeight = 2.7F;

class Room {
public:
    Scene scene;

    MaterialId material(const char* name, const Rgb& color, float roughness = 0.7F, float metallic = 0.0F) {
        Material m;
        m.name = name;
        m.base_color = color;
        m.roughness = roughness;
        m.metallic = metallic;
        return scene.materials.insert(std::move(m));
    }
    NodeId group(const char* name, const dvec3& at = dvec3(0.0)) {
        Node node;
        node.name = name;
        node.transform.translation = at;
        return place(std::move(node), {});
    }
    NodeId shape(const char* name, Geometry geometry, MaterialId look, NodeId parent, const dvec3& at,
                 const dquat& turn = dquat(1, 0, 0, 0)) {
        Node node;
        node.name = name;
        node.shape = scene.shapes.insert(Shape{name, std::move(geometry), {}});
        node.materials = {look};
        node.transform.translation = at;
        node.transform.rotation = turn;
        return place(std::move(node), parent);
    }
    NodeId place(Node node, NodeId parent) {
        node.parent = parent;
        const NodeId id = scene.nodes.insert(std::move(node));
        (parent ? scene.nodes.find(parent)->children : scene.roots).push_back(id);
        return id;
    }
};

Polygon rectangle(float width, float height) {
    const float x = width / 2;
    const float y = height / 2;
    return Polygon{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {}};
}

dquat turn(double degrees, const dvec3& axis) { return glm::angleAxis(radians_from_degrees(degrees), axis); }

} // namespace

Scene sample_room() {
    Room room;
    room.scene.name = "Sample room";
    const MaterialId white = room.material("White plaster", Rgb(0.78F, 0.77F, 0.74F));
    const MaterialId green = room.material("Sage wall", Rgb(0.38F, 0.46F, 0.36F));
    const MaterialId oak = room.material("Oak floor", Rgb(0.42F, 0.28F, 0.17F));
    const MaterialId walnut = room.material("Walnut", Rgb(0.23F, 0.13F, 0.08F));
    const MaterialId cloth = room.material("Blue cloth", Rgb(0.12F, 0.2F, 0.36F), 0.9F);
    const MaterialId clay = room.material("Terracotta", Rgb(0.55F, 0.24F, 0.14F));
    const MaterialId steel = room.material("Brushed steel", Rgb(0.6F), 0.35F, 1.0F);

    const dvec3 x(1, 0, 0);
    const dvec3 y(0, 1, 0);
    const NodeId shell = room.group("Room");
    room.shape("Floor", rectangle(kWidth, kDepth), oak, shell, {0, 0, 0}, turn(-90, x));
    room.shape("Ceiling", rectangle(kWidth, kDepth), white, shell, {0, kHeight, 0}, turn(90, x));
    room.shape("Back wall", rectangle(kWidth, kHeight), green, shell, {0, kHeight / 2, -kDepth / 2});
    room.shape("Front wall", rectangle(kWidth, kHeight), white, shell, {0, kHeight / 2, kDepth / 2}, turn(180, y));
    room.shape("Left wall", rectangle(kDepth, kHeight), white, shell, {-kWidth / 2, kHeight / 2, 0}, turn(90, y));
    room.shape("Right wall", rectangle(kDepth, kHeight), white, shell, {kWidth / 2, kHeight / 2, 0}, turn(-90, y));

    const NodeId table = room.group("Table", {0.3, 0, -0.4});
    room.shape("Table top", Box{{1.6F, 0.04F, 0.8F}}, walnut, table, {0, 0.73, 0});
    const double leg_x = 0.72;
    const double leg_z = 0.32;
    room.shape("Leg 1", Cylinder{0.025F, 0.71F, true}, steel, table, {leg_x, 0.355, leg_z});
    room.shape("Leg 2", Cylinder{0.025F, 0.71F, true}, steel, table, {-leg_x, 0.355, leg_z});
    room.shape("Leg 3", Cylinder{0.025F, 0.71F, true}, steel, table, {leg_x, 0.355, -leg_z});
    room.shape("Leg 4", Cylinder{0.025F, 0.71F, true}, steel, table, {-leg_x, 0.355, -leg_z});
    room.shape("Bowl", Sphere{0.12F}, clay, table, {0.35, 0.871, 0.05});
    room.shape("Vase", Cone{0.09F, 0.05F, 0.32F, true}, white, table, {-0.4, 0.911, -0.1});

    const NodeId sofa = room.group("Sofa", {-1.85, 0, -0.2});
    room.shape("Seat", Box{{0.85F, 0.42F, 1.9F}}, cloth, sofa, {0, 0.211, 0});
    room.shape("Back rest", Box{{0.2F, 0.45F, 1.9F}}, cloth, sofa, {-0.32, 0.646, 0});
    room.shape("Shelf", Box{{0.32F, 1.9F, 0.9F}}, walnut, {}, {2.3, 0.951, -1.3});

    Material lamp;
    lamp.name = "Ceiling lamp";
    lamp.base_color = Rgb(0.8F);
    lamp.emissive_color = Rgb(1.0F, 0.9F, 0.76F);
    lamp.emissive_strength = 3200.0F; // about 2800 lm over its 0.28 m2
    const MaterialId glow = room.scene.materials.insert(std::move(lamp));
    room.shape("Ceiling lamp", Disc{0.3F}, glow, {}, {0.3, 2.62, -0.4}, turn(90, x));

    Light spot;
    spot.name = "Wall spot";
    spot.kind = Light::Kind::Spot;
    spot.intensity = 450.0F;
    spot.color = Rgb(1.0F, 0.86F, 0.68F);
    spot.inner_cone = float(radians_from_degrees(16));
    spot.outer_cone = float(radians_from_degrees(32));
    Node wall_spot;
    wall_spot.name = "Wall spot";
    wall_spot.light = room.scene.lights.insert(std::move(spot));
    wall_spot.transform.translation = {-1.6, 2.5, -1.0};
    wall_spot.transform.rotation = turn(-60, x);
    room.place(std::move(wall_spot), {});

    Camera lens;
    lens.name = "View";
    lens.yfov = 1.0F;
    Node camera;
    camera.name = "View";
    camera.camera = room.scene.cameras.insert(std::move(lens));
    camera.transform.translation = {1.75, 1.55, 1.8};
    camera.transform.rotation = turn(32, y) * turn(-9, x);
    room.place(std::move(camera), {});
    return std::move(room.scene);
}

} // namespace atrium::ui
