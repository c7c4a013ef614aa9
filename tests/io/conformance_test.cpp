// Real facts about each of the shared conformance files, objects and interiors.
#include "tests/io/io_test_support.h"

#include <nlohmann/json.hpp>

namespace atrium::test {
namespace {

LoadedScene load(const std::string& name) {
    auto loaded = read_scene(shared_scenes() / name);
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message();
        return {};
    }
    EXPECT_FALSE(has_warning(*loaded)) << all_problems(*loaded);
    return std::move(*loaded);
}

const Shape* shape_named(const Scene& scene, const std::string& name) {
    const Shape* out = nullptr;
    scene.shapes.for_each([&](ShapeId, const Shape& s) { out = s.name == name ? &s : out; });
    return out;
}
const Material* material_named(const Scene& scene, const std::string& name) {
    const Material* out = nullptr;
    scene.materials.for_each([&](MaterialId, const Material& m) { out = m.name == name ? &m : out; });
    return out;
}
const MeshData& first_mesh(const Scene& scene) {
    return *std::get<Mesh>(scene.shapes.find(scene.shapes.keys().at(0))->geometry).data;
}
void expect_near(const dvec3& a, const dvec3& b, double tolerance) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
    }
}

TEST(Conformance, every_shared_file_loads_with_the_counted_triangles_and_area) {
    ATRIUM_NEED_SHARED_SCENES();
    const nlohmann::json facts = nlohmann::json::parse(content(shared_scenes() / "facts.json"));
    int files = 0;
    for (const auto& fact : facts) {
        const std::string name = fact["file"];
        if (name.starts_with("broken") || !(name.ends_with(".gltf") || name.ends_with(".glb"))) {
            continue;
        }
        SCOPED_TRACE(name);
        const LoadedScene loaded = load(name);
        EXPECT_EQ(drawn_triangles(loaded.scene), fact["gltf"]["tris_drawn"].get<std::size_t>());
        EXPECT_EQ(loaded.scene.materials.size(), fact["gltf"]["materials"].get<std::size_t>());
        EXPECT_EQ(loaded.scene.cameras.size(), fact["gltf"]["cameras"].get<std::size_t>());
        EXPECT_EQ(loaded.scene.lights.size(), fact["gltf"]["lights"].get<std::size_t>());
        EXPECT_EQ(loaded.scene.textures.size(), fact["gltf"]["textures"].get<std::size_t>());
        loaded.scene.textures.for_each([](TextureId, const Texture& t) { EXPECT_TRUE(t.image && t.encoded) << t.name; });
        if (fact.contains("geometry")) {
            double area = 0.0;
            double emitting = 0.0;
            for_each_mesh(loaded.scene, [&](const Node& node, const MeshData& mesh, const dmat4& world) {
                for (std::size_t part = 0; part < mesh.parts.size(); ++part) {
                    double part_area = 0.0;
                    for (std::uint32_t i = 0; i < mesh.parts[part].index_count; i += 3) {
                        const std::uint32_t* v = &mesh.indices[mesh.parts[part].first_index + i];
                        const auto p = [&](int k) { return dvec3(world * dvec4(mesh.positions[v[k]], 1.0)); };
                        part_area += 0.5 * glm::length(glm::cross(p(1) - p(0), p(2) - p(0)));
                    }
                    area += part_area;
                    const Material* material = loaded.scene.material_of(node, part);
                    emitting += material != nullptr && material->emits() ? part_area : 0.0;
                }
            });
            // The facts are rounded to six digits after the point.
            EXPECT_NEAR(area, fact["geometry"]["area_m2"].get<double>(), 1e-3 + 1e-5 * area);
            EXPECT_NEAR(emitting, fact["geometry"]["emitting_area_m2"].get<double>(), 1e-5 + 1e-5 * emitting);
        }
        ++files;
    }
    EXPECT_EQ(files, 28);
}

TEST(Conformance, sparse_values_replace_the_base) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/SimpleSparseAccessor/SimpleSparseAccessor.gltf");
    const MeshData& mesh = first_mesh(loaded.scene);
    ASSERT_EQ(mesh.positions.size(), 14U);
    EXPECT_EQ(mesh.positions[7], vec3(0, 1, 0));
    EXPECT_EQ(mesh.positions[8], vec3(1, 2, 0));
    EXPECT_EQ(mesh.positions[10], vec3(3, 3, 0));
    EXPECT_EQ(mesh.positions[12], vec3(5, 4, 0));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(Conformance, strips_and_fans_face_the_same_way_as_lists) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/MeshPrimitiveModes/MeshPrimitiveModes.gltf");
    int meshes = 0;
    for_each_mesh(loaded.scene, [&](const Node&, const MeshData& mesh, const dmat4&) {
        double area = 0.0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const vec3 a = mesh.positions[mesh.indices[i]];
            const vec3 n = glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
            EXPECT_GT(n.z, 0.0F);
            area += 0.5 * n.z;
        }
        EXPECT_NEAR(area, 2.598, 1e-3); // hexagon of side 1
        ++meshes;
    });
    EXPECT_EQ(meshes, 3);
    EXPECT_TRUE(has_problem(loaded, "points or lines"));
}

TEST(Conformance, mirrored_nodes_keep_their_outside_out) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/NegativeScaleTest/NegativeScaleTest.glb");
    int mirrored = 0;
    for_each_mesh(loaded.scene, [&](const Node&, const MeshData& mesh, const dmat4& world) {
        const double sign = glm::determinant(dmat3(world));
        mirrored += sign < 0.0 ? 1 : 0;
        const dmat3 normal_matrix = glm::transpose(glm::inverse(dmat3(world)));
        std::size_t outward = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto p = [&](std::size_t k) { return dvec3(world * dvec4(mesh.positions[mesh.indices[i + k]], 1.0)); };
            const dvec3 face = glm::cross(p(1) - p(0), p(2) - p(0)) * (sign < 0.0 ? -1.0 : 1.0);
            outward += glm::dot(face, normal_matrix * dvec3(mesh.normals[mesh.indices[i]])) > 0.0 ? 1 : 0;
        }
        EXPECT_GT(double(outward), 0.95 * double(mesh.indices.size() / 3));
    });
    EXPECT_GT(mirrored, 0);
}

TEST(Conformance, instances_become_children_that_share_one_shape) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/SimpleInstancing/SimpleInstancing.glb");
    ASSERT_EQ(loaded.scene.roots.size(), 1U);
    const Node& root = *loaded.scene.nodes.find(loaded.scene.roots[0]);
    EXPECT_FALSE(root.shape);
    ASSERT_EQ(root.children.size(), 125U);
    for (const NodeId id : root.children) {
        EXPECT_EQ(loaded.scene.nodes.find(id)->shape, loaded.scene.shapes.keys()[0]);
        EXPECT_NEAR(glm::length(loaded.scene.nodes.find(id)->transform.rotation), 1.0, 1e-12);
    }
    EXPECT_TRUE(has_problem(loaded, "125 instances"));
}

TEST(Conformance, texture_transforms_are_read) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/TextureTransformTest/TextureTransformTest.gltf");
    const TextureRef all = material_named(loaded.scene, "All")->base_color_texture;
    EXPECT_EQ(all.offset, vec2(-0.2F, -0.1F));
    EXPECT_EQ(all.scale, vec2(1.5F));
    EXPECT_EQ(all.rotation, 0.3F);
    EXPECT_EQ(material_named(loaded.scene, "Offset U")->base_color_texture.offset, vec2(0.5F, 0.0F));
    EXPECT_FLOAT_EQ(material_named(loaded.scene, "Rotation")->base_color_texture.rotation, kPi / 8.0F);
    const Texture& texture = *loaded.scene.textures.find(all.texture);
    EXPECT_EQ(texture.uri, "UV.png");
    ASSERT_TRUE(texture.image);
    EXPECT_GT(texture.image->width, 1);
}

TEST(Conformance, quantised_positions_and_morph_targets) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/AnimatedMorphCube/AnimatedMorphCube.gltf");
    const DBox3 box = loaded.scene.bounds();
    expect_near(box.min, dvec3(-1.0), 1e-4);
    expect_near(box.max, dvec3(1.0), 1e-4);
    EXPECT_TRUE(has_problem(loaded, "morph targets"));
    EXPECT_TRUE(has_problem(loaded, "animations"));
    for (const vec3& n : first_mesh(loaded.scene).normals) {
        EXPECT_NEAR(glm::length(n), 1.0F, 1e-5F);
    }
}

TEST(Conformance, interleaved_vertices) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/BoxInterleaved/BoxInterleaved.glb");
    const MeshData& mesh = first_mesh(loaded.scene);
    ASSERT_EQ(mesh.normals.size(), 24U);
    for (std::size_t i = 0; i < 24; ++i) {
        EXPECT_FLOAT_EQ(glm::length(mesh.normals[i]), 1.0F);
        EXPECT_FLOAT_EQ(glm::dot(mesh.normals[i], mesh.positions[i]), 0.5F); // a unit cube's faces lie 0.5 out
    }
}

TEST(Conformance, vertex_colours) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/BoxVertexColors/BoxVertexColors.gltf");
    const MeshData& mesh = first_mesh(loaded.scene);
    ASSERT_EQ(mesh.colors.size(), 24U);
    // Every corner of the cube is coloured by its position.
    Box3 range;
    for (const vec3& c : mesh.colors) {
        range.add(c);
    }
    EXPECT_EQ(range.min, vec3(0.0F));
    EXPECT_EQ(range.max, vec3(1.0F));
}

TEST(Conformance, cameras) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/Cameras/Cameras.gltf");
    const Camera& eye = *loaded.scene.cameras.find(loaded.scene.cameras.keys()[0]);
    const Camera& plan = *loaded.scene.cameras.find(loaded.scene.cameras.keys()[1]);
    EXPECT_TRUE(eye.perspective);
    EXPECT_EQ(eye.yfov, 0.7F);
    EXPECT_EQ(eye.znear, 0.01F);
    EXPECT_EQ(eye.zfar, 100.0F);
    EXPECT_FALSE(plan.perspective);
    EXPECT_EQ(plan.ymag, 1.0F);
    expect_near(loaded.scene.nodes.find(loaded.scene.roots[1])->transform.translation, dvec3(0.5, 0.5, 3.0), 1e-12);
}

TEST(Conformance, emission_in_candela_per_square_metre) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/EmissiveStrengthTest/EmissiveStrengthTest.glb");
    for (const int strength : {1, 2, 4, 8, 16}) {
        const Material* m = material_named(loaded.scene, "Emit" + std::to_string(strength));
        ASSERT_TRUE(m);
        EXPECT_FLOAT_EQ(m->emissive_strength, float(strength));
        EXPECT_FLOAT_EQ(m->emitted_radiance().r, m->emissive_color.r * float(strength));
    }
    const LoadedScene office = load("interiors/office_b90.glb");
    float brightest = 0.0F;
    office.scene.materials.for_each(
        [&](MaterialId, const Material& m) { brightest = std::max(brightest, luminance(m.emitted_radiance())); });
    EXPECT_NEAR(brightest, 28489.0F, 30.0F); // the README of the shared scenes: 89,500 lm/m2
}

TEST(Conformance, glass) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/AttenuationTest/AttenuationTest.gltf");
    const Material* m = material_named(loaded.scene, "R2_ThicknessFac_0.25");
    ASSERT_TRUE(m);
    EXPECT_EQ(m->transmission, 1.0F);
    EXPECT_EQ(m->thickness, 0.25F);
    EXPECT_EQ(m->attenuation_distance, 1.0F);
    EXPECT_FALSE(std::isfinite(material_named(loaded.scene, "LabelMaterial")->attenuation_distance));
    EXPECT_EQ(material_named(loaded.scene, "R3_ThicknessTex_Mat")->other_textures.at(0).slot,
              "extensions/KHR_materials_volume/thicknessTexture");
}

TEST(Conformance, the_default_scene_is_shown_and_said) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/MultipleScenes/MultipleScenes.gltf");
    EXPECT_EQ(loaded.scene.nodes.size(), 1U);
    EXPECT_TRUE(has_problem(loaded, "2 scenes"));
}

TEST(Conformance, hierarchy_and_order) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene loaded = load("conformance/blender_io_02_node_hierarchy/02_node_hierarchy.gltf");
    const nlohmann::json file =
        nlohmann::json::parse(content(shared_scenes() / "conformance/blender_io_02_node_hierarchy/02_node_hierarchy.gltf"));
    ASSERT_EQ(loaded.scene.roots.size(), file["scenes"][0]["nodes"].size());
    for (std::size_t i = 0; i < loaded.scene.roots.size(); ++i) {
        const std::size_t n = file["scenes"][0]["nodes"][i];
        const Node& node = *loaded.scene.nodes.find(loaded.scene.roots[i]);
        EXPECT_EQ(node.name, file["nodes"][n]["name"]);
        EXPECT_EQ(node.children.size(), file["nodes"][n].value("children", nlohmann::json::array()).size());
    }
    EXPECT_TRUE(shape_named(loaded.scene, "Cube"));
}

TEST(Conformance, lights_and_uninterpreted_extensions) {
    ATRIUM_NEED_SHARED_SCENES();
    const LoadedScene lamp = load("objects/LightsPunctualLamp/LightsPunctualLamp.gltf");
    const Light& light = *lamp.scene.lights.find(lamp.scene.lights.keys()[0]);
    EXPECT_EQ(light.kind, Light::Kind::Point);
    EXPECT_EQ(light.intensity, 15.0F);
    EXPECT_NEAR(light.color.g, 0.631875F, 1e-5F);
    const LoadedScene sofa = load("objects/GlamVelvetSofa/GlamVelvetSofa.glb");
    EXPECT_TRUE(has_problem(sofa, "KHR_materials_sheen"));
    bool kept = false;
    sofa.scene.materials.for_each([&](MaterialId, const Material& m) {
        kept = kept || m.other_extensions.find("KHR_materials_sheen") != std::string::npos;
    });
    EXPECT_TRUE(kept);
    const LoadedScene house = load("interiors/small_house.glb");
    EXPECT_TRUE(has_problem(house, "range"));
}

TEST(Conformance, a_sheared_matrix_keeps_the_picture) {
    const auto loaded =
        read_text(R"({"asset":{"version":"2.0"},"nodes":[{"children":[1],"matrix":[1,0,0,0, 0.5,1,0,0, 0,0,2,0, 7,8,9,1]},
{"mesh":0,"translation":[1,2,3],"rotation":[0,0,0.6,0.8]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_TRUE(has_problem(*loaded, "sheared"));
    const dmat4 parent(1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1);
    Transform child;
    child.translation = {1, 2, 3};
    child.rotation = dquat(0.8, 0, 0, 0.6);
    const dmat4 expected = parent * child.matrix();
    int meshes = 0;
    for_each_mesh(loaded->scene, [&](const Node&, const MeshData& mesh, const dmat4& world) {
        const vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        for (std::size_t i = 0; i < 3; ++i) {
            expect_near(dvec3(world * dvec4(mesh.positions[i], 1.0)), dvec3(expected * dvec4(corners[i], 1.0)), 1e-6);
        }
        ++meshes;
    });
    EXPECT_EQ(meshes, 1);
}

TEST(Conformance, extras_survive_as_text) {
    const auto loaded = read_text(R"({"asset":{"version":"2.0","copyright":"Me","extras":{"a":1}},"extras":{"b":[1,2.5]},
"nodes":[{"extras":"plain","extensions":{"KHR_lights_punctual":{"light":0}}}],"extensionsUsed":["KHR_lights_punctual"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","extras":{"angularDiameterDegrees":2}}]}}})");
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->scene.extras, R"({"b":[1,2.5]})");
    EXPECT_EQ(loaded->scene.asset_extras, R"({"copyright":"Me","extras":{"a":1}})");
    EXPECT_EQ(loaded->scene.nodes.find(loaded->scene.roots[0])->extras, "\"plain\"");
    EXPECT_EQ(loaded->scene.lights.find(loaded->scene.lights.keys()[0])->angular_diameter_degrees, 2.0F);
}

} // namespace
} // namespace atrium::test
