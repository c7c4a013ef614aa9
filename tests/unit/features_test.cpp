#include "engine/scene/features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace atrium {
namespace {

using testing::HasSubstr;

struct Features : testing::Test {
    Scene scene;
    NodeId add(const Material& m, bool visible = true) {
        Node n;
        n.shape = scene.shapes.insert({"box", Box{}, {}});
        n.materials = {scene.materials.insert(m)};
        n.visible = visible;
        const NodeId id = scene.nodes.insert(n);
        scene.roots.push_back(id);
        return id;
    }
    void add(const Light& l) {
        Node n;
        n.light = scene.lights.insert(l);
        scene.roots.push_back(scene.nodes.insert(n));
    }
    [[nodiscard]] Feature get(const char* name) const { return find_feature(scene_features(scene), name); }
};

Material mirror() {
    Material m;
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    return m;
}
Material glass(float thickness) {
    Material m;
    m.transmission = 1.0F;
    m.thickness = thickness;
    return m;
}

TEST_F(Features, ComeInAFixedOrderEachWithASentence) {
    std::vector<std::string> names;
    for (const Feature& f : scene_features(scene)) {
        names.push_back(f.name);
        EXPECT_FALSE(f.used) << f.name << ": the scene is empty";
        ASSERT_FALSE(f.why.empty());
        EXPECT_EQ(f.why.back(), '.') << f.why;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"particles", "caustic_textures", "octree", "refraction", "glossy", "sun",
                                               "sky", "textures", "direct_layer", "specular_view", "transmittance",
                                               "alpha_cutouts", "photometry"}));
}

TEST_F(Features, ADiffuseSceneNeedsNothing) {
    add(Material{});
    EXPECT_EQ(get("particles").why, "There is no specular surface in the scene.");
    EXPECT_EQ(get("transmittance").why, "Every surface is opaque.");
    EXPECT_FALSE(get("specular_view").used);
}

TEST_F(Features, MirrorsNeedParticlesWhereSomethingShinesOnThem) {
    add(mirror());
    EXPECT_TRUE(get("specular_view").used);
    EXPECT_THAT(get("specular_view").why, HasSubstr("1 mirror."));
    EXPECT_FALSE(get("particles").used);
    EXPECT_THAT(get("particles").why, HasSubstr("No lamp, sun or luminous surface shines on the scene's 1 mirror"));
    EXPECT_EQ(get("refraction").why, "There is no glass in the scene.");
    add(Light{});
    EXPECT_TRUE(get("particles").used);
    EXPECT_TRUE(get("caustic_textures").used);
    EXPECT_THAT(get("particles").why, HasSubstr("1 mirror"));
    EXPECT_FALSE(get("octree").used);
    EXPECT_EQ(get("octree").why, "Nothing is selected to move.");
}

TEST_F(Features, SolidGlassBendsLight) {
    add(glass(0.0F));
    EXPECT_FALSE(get("refraction").used);
    EXPECT_THAT(get("refraction").why, HasSubstr("thin sheets"));
    add(glass(0.01F));
    EXPECT_TRUE(get("transmittance").used);
    EXPECT_TRUE(get("refraction").used);
    EXPECT_THAT(get("refraction").why, HasSubstr("1 solid of glass"));
    EXPECT_TRUE(get("specular_view").used);
}

TEST_F(Features, OnlyShownNodesCount) {
    const NodeId id = add(mirror(), false);
    add(glass(0.0F));
    scene.nodes.find(scene.roots.back())->visible = false;
    EXPECT_FALSE(get("specular_view").used);
    EXPECT_FALSE(get("transmittance").used);
    scene.nodes.find(id)->visible = true;
    EXPECT_TRUE(get("specular_view").used);
}

TEST_F(Features, SunAndSky) {
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.name = "Sun";
    sun.enabled = false;
    add(sun);
    EXPECT_FALSE(get("sun").used);
    EXPECT_FALSE(get("direct_layer").used);
    sun.enabled = true;
    add(sun);
    EXPECT_TRUE(get("sun").used);
    EXPECT_TRUE(get("direct_layer").used);
    EXPECT_EQ(get("sun").why, "The directional light 'Sun' shines.");
    add(Light{});
    EXPECT_EQ(get("sun").why, "The directional light 'Sun' shines.") << "a point light is no sun";
    EXPECT_FALSE(get("sky").used);
    scene.environment.sky_radiance = Rgb(2500.0F);
    EXPECT_TRUE(get("sky").used);
    EXPECT_THAT(get("sky").why, HasSubstr("2500 cd/m2"));
}

TEST_F(Features, TexturesAndCutoutsCountWhereTheyChangeLight) {
    Texture t;
    const TextureId broken = scene.textures.insert(t);
    t.image = std::make_shared<Image>();
    const TextureId good = scene.textures.insert(t);
    Material m;
    m.base_color_texture.texture = broken;
    m.emissive_texture.texture = good;
    add(m);
    EXPECT_FALSE(get("textures").used) << "one could not be decoded, the other colours no emission";
    m.emissive_color = Rgb(1.0F);
    m.alpha_mode = Material::Alpha::Mask;
    add(m);
    EXPECT_TRUE(get("textures").used);
    EXPECT_TRUE(get("alpha_cutouts").used);
    EXPECT_FALSE(get("transmittance").used);
    m.alpha_mode = Material::Alpha::Blend;
    add(m);
    EXPECT_TRUE(get("transmittance").used);
    EXPECT_EQ(get("textures").why, "Surfaces are coloured by 1 texture.");
}

} // namespace
} // namespace atrium
