#include "tests/bench/tessellated_room.h"

#include "tests/support/rooms.h"

#include <fmt/format.h>

#include <algorithm>

namespace atrium::bench {
namespace {

// A parallelogram, its front towards u x v.
struct Side {
    vec3 corner;
    vec3 u;
    vec3 v;
};
struct Thing {
    std::string name;
    std::vector<Side> sides;
    float rho = 0.0F;
    float exitance = 0.0F; // lumen per square metre
};

std::uint32_t steps(const vec3& edge, float cell) {
    return std::max(1U, std::uint32_t(std::ceil(glm::length(edge) / cell)));
}

Thing box(const std::string& name, const vec3& foot, const vec3& size, float turn, float rho) {
    const vec3 x = vec3(std::cos(turn), 0.0F, std::sin(turn)) * size.x;
    const vec3 y(0.0F, size.y, 0.0F);
    const vec3 z = vec3(-std::sin(turn), 0.0F, std::cos(turn)) * size.z;
    const vec3 p = foot - 0.5F * (x + z);
    return {name, {{p, y, x}, {p + z, x, y}, {p, z, y}, {p + x, y, z}, {p, x, z}, {p + y, z, x}}, rho};
}

Thing column(const std::string& name, const vec3& foot, float radius, float height, float rho) {
    constexpr int kSides = 8;
    Thing out{name, {}, rho};
    const auto rim = [&](int k) {
        const float angle = 2.0F * kPi * float(k) / kSides;
        return foot + radius * vec3(std::cos(angle), 0.0F, std::sin(angle));
    };
    for (int k = 0; k < kSides; ++k) {
        out.sides.push_back({rim(k), {0.0F, height, 0.0F}, rim(k + 1) - rim(k)});
    }
    return out;
}

std::vector<Thing> things() {
    constexpr float kX = 5.0F, kY = 2.7F, kZ = 6.0F;
    const vec3 x(kX, 0, 0), y(0, kY, 0), z(0, 0, kZ);
    std::vector<Thing> out = {{"floor", {{{}, z, x}}, 0.4F},   {"ceiling", {{y, x, z}}, 0.8F},
                              {"wall x0", {{{}, y, z}}, 0.8F}, {"wall x1", {{x, z, y}}, 0.8F},
                              {"wall z0", {{{}, x, y}}, 0.8F}, {"wall z1", {{z, y, x}}, 0.8F}};
    out.push_back({"lamp", {{{1.9F, kY - 0.01F, 2.85F}, {1.2F, 0, 0}, {0, 0, 0.3F}}}, 0.5F, 10000.0F});
    for (int i = 0; i < 12; ++i) {
        const vec3 foot(0.6F + 1.2F * float(i % 4), 0.1F, 0.8F + 1.8F * float(i / 4));
        const vec3 size(0.5F, 0.4F + 0.1F * float(i % 4), 0.3F);
        out.push_back(box(fmt::format("box {}", i), foot, size, 0.4F * float(i), i % 2 == 0 ? 0.4F : 0.8F));
    }
    out.push_back(column("column 0", {1.2F, 0.0F, 1.7F}, 0.12F, kY, 0.8F));
    out.push_back(column("column 1", {3.7F, 0.0F, 4.3F}, 0.12F, kY, 0.8F));
    return out;
}

std::size_t count(const std::vector<Thing>& all, float cell) {
    std::size_t triangles = 0;
    for (const Thing& thing : all) {
        for (const Side& side : thing.sides) {
            triangles += 2 * std::size_t(steps(side.u, cell)) * steps(side.v, cell);
        }
    }
    return triangles;
}

void add_side(MeshData& mesh, const Side& side, float cell) {
    const std::uint32_t nu = steps(side.u, cell);
    const std::uint32_t nv = steps(side.v, cell);
    const auto first = std::uint32_t(mesh.positions.size());
    for (std::uint32_t j = 0; j <= nv; ++j) {
        for (std::uint32_t i = 0; i <= nu; ++i) {
            mesh.positions.push_back(side.corner + side.u * (float(i) / float(nu)) + side.v * (float(j) / float(nv)));
        }
    }
    for (std::uint32_t j = 0; j < nv; ++j) {
        for (std::uint32_t i = 0; i < nu; ++i) {
            const std::uint32_t a = first + j * (nu + 1) + i;
            const std::uint32_t b = a + nu + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
}

} // namespace

Scene tessellated_room(std::size_t triangles) {
    const std::vector<Thing> all = things();
    float fine = 1e-4F;
    float coarse = 10.0F;
    for (int i = 0; i < 50; ++i) {
        const float middle = std::sqrt(fine * coarse);
        (count(all, middle) > triangles ? fine : coarse) = middle;
    }
    Scene scene;
    for (const Thing& thing : all) {
        auto mesh = std::make_shared<MeshData>();
        for (const Side& side : thing.sides) {
            add_side(*mesh, side, coarse);
        }
        mesh->parts.push_back({0, std::uint32_t(mesh->indices.size())});
        Shape shape;
        shape.name = thing.name;
        shape.geometry = Mesh{std::move(mesh)};
        Node node;
        node.name = thing.name;
        node.shape = scene.shapes.insert(shape);
        node.materials = {test::add_material(scene, thing.rho, thing.exitance)};
        scene.roots.push_back(scene.nodes.insert(node));
    }
    return scene;
}

} // namespace atrium::bench
