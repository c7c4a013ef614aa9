#include "engine/view/lit_scene.h"

#include <algorithm>

namespace atrium {
namespace {

// Appends a layer's mesh as one more part; returns its first vertex.
std::uint32_t append(MeshData& mesh, const DisplayMesh& part) {
    const auto base = std::uint32_t(mesh.positions.size());
    // Attributes must cover all parts or none: a part without one gets neutral values.
    const auto extend = [&](auto& all, const auto& own, auto neutral) {
        if (own.empty() && all.empty()) {
            return;
        }
        all.resize(base, neutral);
        all.insert(all.end(), own.begin(), own.end());
        all.resize(base + part.positions.size(), neutral);
    };
    extend(mesh.texcoords0, part.texcoords0, vec2(0.0F));
    extend(mesh.texcoords1, part.texcoords1, vec2(0.0F));
    extend(mesh.colors, part.colors, vec3(1.0F));
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    mesh.parts.push_back({std::uint32_t(mesh.indices.size()), std::uint32_t(part.indices.size())});
    for (const std::uint32_t i : part.indices) {
        mesh.indices.push_back(base + i);
    }
    return base;
}

} // namespace

LitScene::LitScene(const Scene& scene, const Solution& solution) {
    Scene lit = scene;
    for (const auto& layer : solution.surfaces) {
        if (scene.nodes.contains(layer->node)) {
            parts_[layer->node].push_back({layer, 0});
        }
    }
    for (auto& [id, parts] : parts_) {
        Node& node = *lit.nodes.find(id);
        auto mesh = std::make_shared<MeshData>();
        std::vector<MaterialId> materials;
        for (Part& part : parts) {
            part.first_vertex = append(*mesh, *part.layer->mesh);
            materials.push_back(part.layer->part < node.materials.size() ? node.materials[part.layer->part] : MaterialId{});
        }
        Shape shape;
        shape.geometry = Mesh{mesh};
        node.shape = lit.shapes.insert(std::move(shape));
        node.materials = std::move(materials);
    }
    rays_ = std::make_unique<RayScene>(lit);
}

Rgb LitScene::radiance(const Hit& hit) const {
    if (!hit.front && !rays_->surfaces()[hit.surface].back_side) {
        return Rgb(0.0F);
    }
    Material at_point = rays_->material(hit.surface);
    const vec4 color = rays_->base_color(hit.surface, hit.triangle, hit.barycentric);
    const float covered = at_point.alpha_mode == Material::Alpha::Blend ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F;
    at_point.base_color = Rgb(color);
    const Rgb reflectance = diffuse_reflectance(at_point);
    Rgb out = rays_->emission(hit.surface, hit.triangle, hit.barycentric);
    if (max_component(reflectance) > 0.0F) {
        out += reflectance * kInvPi * irradiance(hit);
    }
    return out * covered;
}

Rgb LitScene::irradiance(const Hit& hit, const LightShares& shares) const {
    const RaySurface& surface = rays_->surfaces()[hit.surface];
    const auto it = parts_.find(surface.node);
    if (it == parts_.end() || surface.part >= it->second.size()) {
        return Rgb(0.0F);
    }
    const Part& part = it->second[surface.part];
    // Single-sided back sides and solids' insides have no light of their own; what has two sides shows the one met.
    const bool use_back = !hit.front && part.layer->has_back();
    if (!hit.front && !use_back) {
        return Rgb(0.0F);
    }
    const uvec3 t = surface.triangles[hit.triangle] - uvec3(part.first_vertex);
    const vec2& b = hit.barycentric;
    return irradiance_at(*part.layer, {t.x, t.y, t.z}, vec3(1.0F - b.x - b.y, b.x, b.y), use_back, shares);
}

} // namespace atrium
