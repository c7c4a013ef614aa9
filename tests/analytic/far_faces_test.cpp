// Lamps of many small faces from far away, by direction instead of face by face.
#include "engine/radiosity/far_faces.h"

#include "engine/geometry/form_factor.h"
#include "engine/radiosity/light_split.h"
#include "engine/raycast/ray_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

struct Lamp {
    explicit Lamp(const Geometry& geometry) {
        Shape shape;
        shape.geometry = geometry;
        Node node;
        node.shape = scene.shapes.insert(shape);
        node.materials = {add_material(scene, 0.0F, 1000.0F)};
        scene.roots.push_back(scene.nodes.insert(node));
        rays = std::make_unique<RayScene>(scene);
        const Hierarchy all = build_hierarchy(*rays, {0.15F, 0.5F});
        LeafFlags shines(all.elements.size(), 0);
        for (std::size_t i = 0; i < shines.size(); ++i) {
            shines[i] = all.elements[i].leaf() && max_component(all.elements[i].emitted) > 0.0F ? 1 : 0;
        }
        emitters = only_flagged(all, shines, true);
    }
    /// Sum over a group's faces, each in closed form.
    [[nodiscard]] double exact(const Element& e, const SurfacePoint& p) const {
        double sum = 0.0;
        for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
            const auto corner = rays->triangle(emitters.faces[f].surface, emitters.faces[f].triangle);
            if (glm::dot(p.position - corner[0], emitters.faces[f].normal) > 0.0F) {
                sum += form_factor_to_polygon(p.position, p.normal, corner);
            }
        }
        return sum;
    }
    Scene scene;
    std::unique_ptr<RayScene> rays;
    Hierarchy emitters;
};

TEST(FarFaces, GroupsLookAsTheirFacesDoAllRound) {
    // Flat pieces go dark with a kink, which interpolation between directions up to 0.1 radians apart rounds off by a
    // quarter of that.
    for (const auto& [geometry, tolerance] :
         {std::pair(Geometry(Sphere{0.06F}), 0.005), std::pair(Geometry(Cone{0.08F, 0.03F, 0.1F}), 0.025)}) {
        const Lamp lamp(geometry);
        const FarFaces far(lamp.emitters, *lamp.rays);
        std::mt19937 random(3);
        std::normal_distribution<float> normal;
        int known = 0;
        for (std::uint32_t i = 0; i < lamp.emitters.elements.size(); ++i) {
            const Element& e = lamp.emitters.elements[i];
            if (e.kind != Element::Kind::Faces || !(e.power > 0.0F)) {
                continue;
            }
            double most = 0.0; // of a group, at one distance: what is seen edge-on is small beside it
            std::vector<std::pair<double, double>> seen;
            for (int k = 0; k < 300; ++k) {
                const vec3 out = glm::normalize(vec3(normal(random), normal(random), normal(random)));
                const SurfacePoint p{e.centre + 20.0F * e.radius * out,
                                     glm::normalize(0.3F * vec3(normal(random), normal(random), normal(random)) - out)};
                const float factor = far.factor(lamp.emitters, i, p);
                if (factor >= 0.0F) {
                    seen.emplace_back(factor, lamp.exact(e, p));
                    most = std::max(most, seen.back().second);
                }
            }
            for (const auto& [factor, exact] : seen) {
                EXPECT_NEAR(factor, exact, tolerance * most);
            }
            known += seen.empty() ? 0 : 1;
        }
        EXPECT_GE(known, 1);
    }
}

TEST(FarFaces, NotFromCloseByNorWhereTheHorizonMayCut) {
    const Lamp lamp(Sphere{0.06F});
    const FarFaces far(lamp.emitters, *lamp.rays);
    for (std::uint32_t i = 0; i < lamp.emitters.elements.size(); ++i) {
        const Element& e = lamp.emitters.elements[i];
        EXPECT_LT(far.factor(lamp.emitters, i, {e.centre + vec3(0, 5.0F * e.radius, 0), {0, -1, 0}}), 0.0F);
        EXPECT_LT(far.factor(lamp.emitters, i, {e.centre + vec3(0, 30.0F * e.radius, 0), {1, 0, 0}}), 0.0F);
    }
}

} // namespace
} // namespace atrium
