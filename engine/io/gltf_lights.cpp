// KHR_lights_punctual and cameras -> Light, Camera.
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_read_context.h"

#include <fmt/format.h>

namespace atrium::gltf {
namespace {

void read_spot(ReadContext& context, const Json& json, Light& light, const std::string& where) {
    constexpr float kHalfPi = kPi / 2.0F;
    const Json none = Json::object();
    const Json* found = find_object(json, "spot", where);
    const Json& spot = found != nullptr ? *found : none;
    light.outer_cone = clamped(context, spot, "outerConeAngle", kPi / 4.0F, 1e-4F, kHalfPi, where);
    light.inner_cone = clamped(context, spot, "innerConeAngle", 0.0F, 0.0F, kHalfPi, where);
    if (light.inner_cone >= light.outer_cone) {
        context.warn(where,
                     fmt::format("the inner cone ({:.3g}) is not inside the outer cone ({:.3g}); the beam has a hard edge",
                                 light.inner_cone, light.outer_cone));
        light.inner_cone = std::nextafter(light.outer_cone, 0.0F);
    }
}

void read_sun(ReadContext& context, const Json& json, Light& light, const std::string& where) {
    // Our own extension first: an edited value wins over what an exporter once wrote into the extras.
    const Json* extras = find(json, "extras");
    for (const Json* source : {extras, find_extension(json, kLight)}) {
        const Json* value = source != nullptr ? find(*source, "angularDiameterDegrees") : nullptr;
        if (value != nullptr && value->is_number()) {
            light.angular_diameter_degrees = clamped(context, *source, "angularDiameterDegrees", 0.0F, 0.0F, 90.0F, where);
        }
    }
}

/// False for a light of an unknown kind, which is left out.
bool read_light(ReadContext& context, const Json& json, Light& light, const std::string& where) {
    light.name = text(json, "name", where);
    const std::string type = text(json, "type", where);
    if (type == "directional") {
        light.kind = Light::Kind::Directional;
        read_sun(context, json, light, where);
    } else if (type == "spot") {
        light.kind = Light::Kind::Spot;
        read_spot(context, json, light, where);
    } else if (type != "point") {
        context.warn(where, "a light of the unknown type \"" + type + "\" was left out",
                     "Use a point, spot or directional light.");
        return false;
    }
    light.color = glm::max(number3(json, "color", Rgb(1.0F), where), Rgb(0.0F));
    light.intensity = clamped(context, json, "intensity", 1.0F, 0.0F, std::numeric_limits<float>::max(), where);
    if (json.contains("range")) {
        context.count("lights have a range, which is ignored: light does not end at a distance");
    }
    if (const Json* ours = find_extension(json, kLight)) {
        light.enabled = boolean(*ours, "enabled", true, where);
        const int profile = index(*ours, "photometry", context.webs.size(), where);
        if (profile >= 0 && light.kind != Light::Kind::Directional) {
            light.photometry.web = context.webs[std::size_t(profile)];
        }
    }
    light.extras = json_text(json, "extras");
    return true;
}

Camera read_camera(ReadContext& context, const Json& json, const std::string& where) {
    Camera camera;
    camera.name = text(json, "name", where);
    camera.extras = json_text(json, "extras");
    const std::string type = text(json, "type", where);
    camera.perspective = type != "orthographic";
    const Json none = Json::object();
    const Json* found = find_object(json, camera.perspective ? "perspective" : "orthographic", where);
    if (found == nullptr) {
        context.warn(where, "has no parameters; a usual camera is used");
    }
    const Json& values = found != nullptr ? *found : none;
    if (camera.perspective) {
        camera.yfov = clamped(context, values, "yfov", camera.yfov, 0.001F, 3.1F, where);
        camera.znear = clamped(context, values, "znear", camera.znear, 1e-6F, 1e6F, where);
    } else {
        camera.ymag = clamped(context, values, "ymag", 1.0F, -1e6F, 1e6F, where);
        if (camera.ymag == 0.0F) {
            context.warn(where, "a height of 0 was set to 1 m");
            camera.ymag = 1.0F;
        }
        camera.znear = clamped(context, values, "znear", 0.0F, 0.0F, 1e6F, where);
    }
    const Json* ours = find_extension(json, kCamera);
    camera.zfar = float(number(values, "zfar", 0.0, where));
    if (ours != nullptr) {
        camera.exposure_ev = clamped(context, *ours, "exposure", 0.0F, -100.0F, 100.0F, where);
        if (boolean(*ours, "infinite", false, where)) {
            camera.zfar = 0.0F;
        }
    }
    if (camera.zfar != 0.0F && camera.zfar <= camera.znear) {
        context.warn(where, "the far plane is not behind the near one; the camera sees without end");
        camera.zfar = 0.0F;
    }
    return camera;
}

} // namespace

void read_lights(ReadContext& context) {
    const Json* extension = find_extension(context.root, kLightsPunctual);
    const Json* lights = extension != nullptr ? find_array(*extension, "lights", kLightsPunctual) : nullptr;
    for (std::size_t i = 0; lights != nullptr && i < lights->size(); ++i) {
        Light light;
        std::string where = "lights/" + std::to_string(i);
        if (const Json* name = find((*lights)[i], "name"); name != nullptr && name->is_string()) {
            where += " (" + name->get<std::string>() + ")";
        }
        const bool good = read_light(context, (*lights)[i], light, where);
        context.lights.push_back(good ? context.out.scene.lights.insert(std::move(light)) : LightId{});
    }
}

void read_cameras(ReadContext& context) {
    const Json& cameras = section(context.root, "cameras");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        context.cameras.push_back(
            context.out.scene.cameras.insert(read_camera(context, cameras[i], place(context.root, "cameras", i))));
    }
}

} // namespace atrium::gltf
