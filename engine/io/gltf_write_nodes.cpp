// Node, Light, Camera -> glTF.
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_write_context.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace atrium::gltf {
namespace {

Json light_json(WriteContext& context, const Light& light) {
    Json json = {{"intensity", short_number(std::max(light.intensity, 0.0F))}};
    if (!light.name.empty()) {
        json["name"] = light.name;
    }
    if (light.color != Rgb(1.0F)) {
        json["color"] = short_numbers(glm::clamp(light.color, Rgb(0.0F), Rgb(1.0F)));
        // A colour above 1 moves into the intensity: the light is the same.
        if (const float most = max_component(light.color); most > 1.0F) {
            json["color"] = short_numbers(glm::max(light.color, Rgb(0.0F)) / most);
            json["intensity"] = short_number(light.intensity * most);
        }
    }
    Json ours = Json::object();
    switch (light.kind) {
    case Light::Kind::Point: json["type"] = "point"; break;
    case Light::Kind::Spot: {
        json["type"] = "spot";
        const float outer = std::clamp(light.outer_cone, 1e-4F, kPi / 2.0F);
        const float inner = std::clamp(light.inner_cone, 0.0F, std::nextafter(outer, 0.0F));
        json["spot"] = {{"innerConeAngle", short_number(inner)}, {"outerConeAngle", short_number(outer)}};
        break;
    }
    case Light::Kind::Directional:
        json["type"] = "directional";
        // Also where it is the usual value, if the extras say otherwise.
        if (light.angular_diameter_degrees != kSunAngularDiameterDegrees ||
            light.extras.find("angularDiameterDegrees") != std::string::npos) {
            ours["angularDiameterDegrees"] = short_number(light.angular_diameter_degrees);
        }
        break;
    }
    if (!light.enabled) {
        ours["enabled"] = false;
    }
    if (light_distribution(light) != nullptr) {
        ours["photometry"] = write_profile(context, light.photometry);
    }
    if (!ours.empty()) {
        json["extensions"][kLight] = std::move(ours);
    }
    put_text(json, "extras", light.extras);
    return json;
}

Json camera_json(const Camera& camera) {
    constexpr float kOrthographicDepth = 1e4F;
    Json json = Json::object();
    if (!camera.name.empty()) {
        json["name"] = camera.name;
    }
    Json ours = Json::object();
    Json values = Json::object();
    const bool infinite = camera.zfar <= camera.znear;
    if (camera.perspective) {
        json["type"] = "perspective";
        values["yfov"] = short_number(std::clamp(camera.yfov, 0.001F, 3.1F));
        values["znear"] = short_number(std::max(camera.znear, 1e-6F));
        if (!infinite) {
            values["zfar"] = short_number(camera.zfar);
        }
    } else {
        json["type"] = "orthographic";
        values["xmag"] = values["ymag"] = short_number(camera.ymag != 0.0F ? camera.ymag : 1.0F);
        values["znear"] = short_number(std::max(camera.znear, 0.0F));
        values["zfar"] = short_number(infinite ? std::max(camera.znear, 0.0F) + kOrthographicDepth : camera.zfar);
        if (infinite) {
            ours["infinite"] = true; // glTF has no orthographic camera without a far plane
        }
    }
    json[camera.perspective ? "perspective" : "orthographic"] = std::move(values);
    if (camera.exposure_ev != 0.0F) {
        ours["exposure"] = short_number(camera.exposure_ev);
    }
    if (!ours.empty()) {
        json["extensions"][kCamera] = std::move(ours);
    }
    put_text(json, "extras", camera.extras);
    return json;
}

bool is_finite_transform(const Transform& t) {
    const dquat& q = t.rotation;
    const std::array numbers{
        t.translation.x, t.translation.y, t.translation.z, t.scale.x, t.scale.y, t.scale.z, q.x, q.y, q.z, q.w};
    // The reader's bound: lengths and areas must stay finite.
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x) && std::abs(x) < 1e30; }) &&
           glm::dot(q, q) > 0.0;
}

void put_transform(const Transform& t, Json& json) {
    if (t.translation != dvec3(0.0)) {
        json["translation"] = {t.translation.x, t.translation.y, t.translation.z};
    }
    if (t.rotation != dquat(1.0, 0.0, 0.0, 0.0)) {
        dquat q = t.rotation;
        const double square = glm::dot(q, q);
        if (std::abs(square - 1.0) > 1e-12) {
            q /= std::sqrt(square);
        }
        json["rotation"] = {q.x, q.y, q.z, q.w};
    }
    if (t.scale != dvec3(1.0)) {
        json["scale"] = {t.scale.x, t.scale.y, t.scale.z};
    }
}

Json node_json(const WriteContext& context, const Node& node, const std::map<NodeId, int>& indices) {
    if (!is_finite_transform(node.transform)) {
        refuse("node " + node.name, "its placement is not finite, so the scene cannot be saved",
               "Undo the last change, or set its position, rotation and scale again.");
    }
    Json json = Json::object();
    if (!node.name.empty()) {
        json["name"] = node.name;
    }
    put_transform(node.transform, json);
    for (const NodeId child : node.children) {
        if (const auto it = indices.find(child); it != indices.end()) {
            json["children"].push_back(it->second);
        }
    }
    if (const auto mesh = context.meshes.find({node.shape, part_materials(context.scene, node)});
        mesh != context.meshes.end() && mesh->second >= 0) {
        json["mesh"] = mesh->second;
    }
    if (const auto camera = context.cameras.find(node.camera); camera != context.cameras.end()) {
        json["camera"] = camera->second;
    }
    if (const auto light = context.lights.find(node.light); light != context.lights.end()) {
        json["extensions"][kLightsPunctual]["light"] = light->second;
        put_profile(context, *context.scene.lights.find(node.light), json);
    }
    if (!node.visible) {
        json["extensions"][kNode]["visible"] = false;
    }
    if (node.locked) {
        json["extensions"][kNode]["locked"] = true;
    }
    if (const CausticWish& wish = node.caustics; !wish.automatic()) {
        Json& ours = json["extensions"][kNode]["caustics"];
        ours = Json::object();
        if (wish.show != CausticWish::Show::Automatic) {
            ours["show"] = caustic_show_name(wish.show);
        }
        if (wish.texel > 0.0F) {
            ours["texel"] = short_number(wish.texel);
        }
        if (wish.threshold > 0.0F) {
            ours["threshold"] = short_number(wish.threshold);
        }
    }
    put_text(json, "extras", node.extras);
    return json;
}

} // namespace

void write_lights(WriteContext& context) {
    std::set<LightId> used;
    for (const NodeId id : context.nodes) {
        used.insert(context.scene.nodes.find(id)->light);
    }
    for (const LightId id : used) {
        if (const Light* light = context.scene.lights.find(id)) {
            Json json = light_json(context, *light);
            Json& all = context.root["extensions"][kLightsPunctual]["lights"];
            context.lights[id] = int(all.size());
            all.push_back(std::move(json));
        }
    }
}

void write_cameras(WriteContext& context) {
    std::set<CameraId> used;
    for (const NodeId id : context.nodes) {
        used.insert(context.scene.nodes.find(id)->camera);
    }
    for (const CameraId id : used) {
        if (const Camera* camera = context.scene.cameras.find(id)) {
            context.cameras[id] = context.add("cameras", camera_json(*camera));
        }
    }
}

void write_nodes(WriteContext& context) {
    std::map<NodeId, int> indices;
    for (const NodeId id : context.nodes) {
        indices[id] = int(indices.size());
    }
    for (const NodeId id : context.nodes) {
        context.add("nodes", node_json(context, *context.scene.nodes.find(id), indices));
    }
    Json scene = Json::object();
    if (!context.scene.name.empty()) {
        scene["name"] = context.scene.name;
    }
    for (const NodeId id : context.scene.roots) {
        if (const auto it = indices.find(id); it != indices.end()) {
            scene["nodes"].push_back(it->second);
        }
    }
    context.add("scenes", std::move(scene));
    context.root["scene"] = 0;
}

} // namespace atrium::gltf
