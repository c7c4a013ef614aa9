#include "engine/scene/problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace atrium {
namespace {

using testing::HasSubstr;
using Severity = Problem::Severity;

/// A sound scene: a lit box. Each test breaks one thing.
struct Problems : testing::Test {
    Scene scene;
    NodeId box, lamp;

    void SetUp() override {
        Node n;
        n.name = "Box";
        n.shape = scene.shapes.insert({"box", Box{}, {}});
        n.materials = {scene.materials.insert(Material{})};
        box = add(n);
        scene.materials.find(n.materials[0])->name = "Wall";
        Node l;
        l.name = "Lamp";
        l.light = scene.lights.insert(Light{});
        lamp = add(l);
        ASSERT_THAT(find_problems(scene), testing::IsEmpty());
    }
    NodeId add(const Node& n) {
        const NodeId id = scene.nodes.insert(n);
        scene.roots.push_back(id);
        return id;
    }
    Node& node(NodeId id) { return *scene.nodes.find(id); }
    Material& wall() { return *scene.materials.find(node(box).materials[0]); }
    Light& light() { return *scene.lights.find(node(lamp).light); }
    void set_shape(Geometry g) { scene.shapes.find(node(box).shape)->geometry = std::move(g); }

    /// The one problem there is; fails when there is another number of them.
    Problem only() {
        const auto found = find_problems(scene);
        EXPECT_EQ(found.size(), 1U);
        if (found.empty()) {
            return {};
        }
        EXPECT_FALSE(found[0].hint.empty());
        return found[0];
    }
};

TEST_F(Problems, NoLightAtAll) {
    node(lamp).visible = false;
    Problem p = only();
    EXPECT_EQ(p.severity, Severity::Warning);
    EXPECT_THAT(p.what, HasSubstr("no light"));
    EXPECT_FALSE(p.node);
    scene.environment.sky_radiance = Rgb(1.0F);
    EXPECT_TRUE(find_problems(scene).empty());
    scene.environment.sky_radiance = Rgb(0.0F);
    wall().emissive_color = Rgb(10.0F);
    EXPECT_TRUE(find_problems(scene).empty()) << "a material that emits is a light";
    node(box).visible = false;
    EXPECT_THAT(only().what, HasSubstr("no visible surface"));
}

TEST_F(Problems, ReflectanceAtTheLimit) {
    wall().base_color = Rgb(0.9999F);
    const Problem p = only();
    EXPECT_EQ(p.node, box);
    EXPECT_EQ(p.where, "material 'Wall'");
    EXPECT_THAT(p.what, HasSubstr("99.99 %"));
    wall().base_color = Rgb(0.99F);
    EXPECT_TRUE(find_problems(scene).empty());
    wall().base_color = Rgb(1.0F);
    wall().transmission = 1.0F;
    EXPECT_TRUE(find_problems(scene).empty()) << "clear glass reflects nothing diffusely";
    wall().transmission = 0.0F;
    wall().base_color_texture.texture = scene.textures.insert(Texture{});
    EXPECT_TRUE(find_problems(scene).empty()) << "the texture scales it down";
}

TEST_F(Problems, ZeroScaleButNotMirroredScale) {
    node(box).transform.scale = dvec3(-1.0, 1.0, 1.0);
    EXPECT_TRUE(find_problems(scene).empty());
    node(box).transform.scale.y = 0.0;
    const Problem p = only();
    EXPECT_EQ(p.node, box);
    EXPECT_THAT(p.what, HasSubstr("scale is zero"));
    node(box).transform.scale.y = 1.0;
    node(lamp).transform.scale = dvec3(0.0);
    EXPECT_TRUE(find_problems(scene).empty()) << "scale has no effect on a light";
}

TEST_F(Problems, EmptyShapes) {
    auto empty = std::make_shared<MeshData>();
    empty->parts.resize(1);
    const std::vector<Geometry> shapes{Polygon{{{0, 0}, {1, 0}}, {}},
                                       Polygon{{{0, 0}, {1, 0}, {2, 0}}, {}},
                                       Box{vec3(1.0F, 0.0F, 0.0F)},
                                       Sphere{0.0F},
                                       Cylinder{0.0F},
                                       Cone{0.0F, 0.0F},
                                       Disc{-1.0F},
                                       Mesh{empty}};
    for (const Geometry& g : shapes) {
        set_shape(g);
        const auto found = find_problems(scene);
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Problem& p) {
            return p.node == box && p.what.find("shows nothing") == 3;
        })) << shape_kind(*scene.shapes.find(node(box).shape));
    }
    set_shape(Box{vec3(1.0F, 1.0F, 0.0F)});
    EXPECT_TRUE(find_problems(scene).empty()) << "a flat box still has two faces";
}

TEST_F(Problems, DanglingIds) {
    node(box).materials[0] = MaterialId{9, 9};
    EXPECT_THAT(only().what, HasSubstr("a material that does not exist"));
    node(box).materials = {MaterialId{}};
    EXPECT_TRUE(find_problems(scene).empty()) << "none is the default material";
    node(lamp).camera = CameraId{3, 1};
    EXPECT_EQ(only().node, lamp);
    node(lamp).camera = {};
    node(lamp).light = LightId{7, 1};
    EXPECT_EQ(find_problems(scene).size(), 2U) << "and so it is dark";
}

TEST_F(Problems, Extents) {
    set_shape(Box{vec3(20000.0F, 1.0F, 1.0F)});
    EXPECT_THAT(only().what, HasSubstr("2e+04 m"));
    set_shape(Box{vec3(0.0005F)});
    EXPECT_THAT(only().what, HasSubstr("0.5 mm"));
    set_shape(Box{vec3(1.0F)});
    Node tiny;
    tiny.name = "Screw";
    tiny.shape = scene.shapes.insert({"tiny", Sphere{0.0002F}, {}});
    const NodeId first = add(tiny);
    EXPECT_EQ(only().severity, Severity::Note);
    EXPECT_EQ(only().node, first);
    add(tiny);
    EXPECT_THAT(only().what, HasSubstr("1 more")) << "one note for all of them";
    node(first).visible = false;
    EXPECT_THAT(only().where, HasSubstr("0.4 mm"));
}

TEST_F(Problems, SurveyCoordinatesAreANote) {
    node(box).transform.translation = dvec3(4.5e5, 0.0, 5.2e6);
    const Problem p = only();
    EXPECT_EQ(p.severity, Severity::Note);
    EXPECT_THAT(p.what, HasSubstr("from the origin"));
}

TEST_F(Problems, Lights) {
    light().intensity = 0.0F;
    EXPECT_EQ(find_problems(scene).size(), 2U) << "the light itself, and darkness";
    scene.environment.sky_radiance = Rgb(1.0F);
    EXPECT_THAT(only().what, HasSubstr("intensity is zero"));
    light().enabled = false;
    EXPECT_TRUE(find_problems(scene).empty()) << "switched off on purpose";
    light() = Light{};
    light().color.g = -1.0F;
    EXPECT_THAT(only().what, HasSubstr("negative"));
    light() = Light{};
    light().kind = Light::Kind::Spot;
    EXPECT_TRUE(find_problems(scene).empty());
    light().inner_cone = light().outer_cone;
    EXPECT_THAT(only().what, HasSubstr("inner angle"));
    EXPECT_EQ(only().where, "light of node 'Lamp'");
}

TEST_F(Problems, MaterialsOutOfRange) {
    wall().roughness = 1.5F;
    EXPECT_THAT(only().what, HasSubstr("roughness of 1.5 is outside 0 to 1"));
    wall() = Material{};
    wall().ior = 0.5F;
    EXPECT_THAT(only().what, HasSubstr("index of refraction"));
    wall().ior = 0.0F;
    EXPECT_TRUE(find_problems(scene).empty()) << "glTF's way to say that everything is reflected";
    wall() = Material{};
    wall().base_color.b = -0.1F;
    EXPECT_THAT(only().what, HasSubstr("negative"));
    // Used by two nodes, told once.
    add(node(box));
    EXPECT_EQ(find_problems(scene).size(), 1U);
}

TEST_F(Problems, CamerasInsideOut) {
    Camera c;
    c.name = "View";
    node(lamp).camera = scene.cameras.insert(c);
    EXPECT_TRUE(find_problems(scene).empty());
    scene.cameras.find(node(lamp).camera)->zfar = 0.01F;
    EXPECT_EQ(only().where, "camera 'View'");
    scene.cameras.find(node(lamp).camera)->zfar = 0.0F;
    scene.cameras.find(node(lamp).camera)->yfov = 3.2F;
    EXPECT_THAT(only().what, HasSubstr("field of view"));
}

TEST_F(Problems, WarningsComeBeforeNotesAndInTreeOrder) {
    node(box).transform.translation = dvec3(4.5e5, 0.0, 5.2e6);
    wall().roughness = 2.0F;
    light().color.g = -1.0F;
    const auto found = find_problems(scene);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].node, box);
    EXPECT_EQ(found[1].node, lamp);
    EXPECT_EQ(found[2].severity, Severity::Note);
    EXPECT_STREQ(severity_name(found[2].severity), "note");
}

// ---- units and the upward axis ----

/// A room of the given inner size, up along y or z, walls as boxes of a tenth of the height, with a table in it.
Scene room(dvec3 size, bool z_up, dvec3 corner = dvec3(0.0)) {
    Scene scene;
    const auto block = [&](dvec3 centre, dvec3 extent) {
        Node n;
        if (z_up) { // the room was made with y up: turn y to z
            centre = dvec3(centre.x, -centre.z, centre.y);
            extent = dvec3(extent.x, extent.z, extent.y);
        }
        n.transform.translation = centre + corner;
        n.shape = scene.shapes.insert({"block", Box{vec3(extent)}, {}});
        scene.roots.push_back(scene.nodes.insert(n));
    };
    const double t = size.y * 0.05;
    block({0.0, 0.0, 0.0}, {size.x, t, size.z});
    block({0.0, size.y, 0.0}, {size.x, t, size.z});
    for (const double side : {-0.5, 0.5}) {
        block({side * size.x, size.y * 0.5, 0.0}, {t, size.y, size.z});
        block({0.0, size.y * 0.5, side * size.z}, {size.x, size.y, t});
    }
    block({0.0, size.y * 0.3, 0.0}, {size.x * 0.3, t, size.z * 0.2});
    return scene;
}

struct UnitCase {
    const char* name;
    double per_metre;
    dvec3 size; ///< metres
    bool z_up;
    double expected;
};
class ImportFix : public testing::TestWithParam<UnitCase> {};

TEST_P(ImportFix, RecognisesUnitAndUpwardAxis) {
    const UnitCase& c = GetParam();
    const ImportSuggestion s = suggest_import_fix(room(c.size * c.per_metre, c.z_up));
    EXPECT_EQ(s.unit_scale, c.expected) << s.why;
    EXPECT_EQ(s.z_up, c.z_up) << s.why;
    EXPECT_EQ(s.any(), c.expected != 1.0 || c.z_up);
    EXPECT_EQ(s.why.empty(), !s.any());
}
const dvec3 kRoom(6.0, 2.7, 5.0);
const dvec3 kHouse(12.0, 7.5, 9.0);
const dvec3 kHall(60.0, 9.0, 40.0);
INSTANTIATE_TEST_SUITE_P(
    Rooms, ImportFix,
    testing::Values(UnitCase{"room_m", 1.0, kRoom, false, 1.0}, UnitCase{"house_m", 1.0, kHouse, false, 1.0},
                    UnitCase{"hall_m", 1.0, kHall, false, 1.0}, UnitCase{"campus_m", 1.0, {400.0, 30.0, 300.0}, false, 1.0},
                    UnitCase{"room_mm", 1000.0, kRoom, false, 0.001}, UnitCase{"house_mm", 1000.0, kHouse, false, 0.001},
                    UnitCase{"hall_mm", 1000.0, kHall, false, 0.001}, UnitCase{"room_cm", 100.0, kRoom, false, 0.01},
                    UnitCase{"flat_in", 1.0 / 0.0254, {14.0, 2.7, 9.0}, false, 0.0254},
                    UnitCase{"mall_ft", 1.0 / 0.3048, {180.0, 12.0, 90.0}, false, 0.3048},
                    UnitCase{"room_ft_reads_as_hall", 1.0 / 0.3048, kRoom, false, 1.0},
                    UnitCase{"room_z_up", 1.0, kRoom, true, 1.0}, UnitCase{"room_mm_z_up", 1000.0, kRoom, true, 0.001},
                    UnitCase{"room_cm_z_up", 100.0, kRoom, true, 0.01}, UnitCase{"hall_z_up", 1.0, kHall, true, 1.0},
                    UnitCase{"narrow_room_y_up", 1.0, {5.0, 2.8, 2.0}, false, 1.0},
                    UnitCase{"cup", 1.0, {0.1, 0.06, 0.1}, false, 1.0},
                    UnitCase{"table_mm_stays", 1000.0, {1.6, 0.75, 0.8}, false, 1.0}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(ImportFixVeto, AFacadeAShelfAndUprightCamerasAreNotZUp) {
    Scene facade;
    Node n;
    n.shape = facade.shapes.insert({"wall", Box{vec3(10.0F, 6.0F, 0.3F)}, {}});
    facade.roots.push_back(facade.nodes.insert(n));
    EXPECT_FALSE(suggest_import_fix(facade).any());

    EXPECT_FALSE(suggest_import_fix(room({0.9, 0.35, 2.0}, true)).z_up) << "a shelf lying on its back";

    Scene watched = room(kRoom, true);
    Node eye;
    eye.camera = watched.cameras.insert(Camera{});
    const NodeId id = watched.nodes.insert(eye);
    watched.roots.push_back(id);
    EXPECT_FALSE(suggest_import_fix(watched).z_up) << "its camera stands upright along y";
    watched.nodes.find(id)->transform.rotation = glm::angleAxis(kPiD / 2.0, dvec3(1.0, 0.0, 0.0));
    EXPECT_TRUE(suggest_import_fix(watched).z_up);
}

TEST(ImportFixVeto, AnEmptyOrHiddenSceneGetsNone) {
    EXPECT_FALSE(suggest_import_fix(Scene{}).any());
    Scene hidden = room(kRoom * 1000.0, false);
    for (const NodeId id : hidden.roots) {
        hidden.nodes.find(id)->visible = false;
    }
    EXPECT_FALSE(suggest_import_fix(hidden).any());
}

TEST_F(Problems, CoarseCoordinatesOfAMeshFarFromItsOriginAreTold) {
    for (const float away : {1e3F, 1e6F}) {
        Scene site;
        auto data = std::make_shared<MeshData>();
        data->positions = {{away, 0, 0}, {away + 4, 0, 0}, {away, 0, 4}};
        data->indices = {0, 1, 2};
        data->parts = {{0, 3}};
        Shape shape;
        shape.geometry = Mesh{data};
        Node node;
        node.name = "Site";
        node.shape = site.shapes.insert(shape);
        site.roots.push_back(site.nodes.insert(node));
        const auto found = find_problems(site);
        const bool told = std::any_of(found.begin(), found.end(), [](const Problem& p) {
            return p.what.find("steps of 62.5 mm") != std::string::npos && p.where.find("Site") != std::string::npos;
        });
        EXPECT_EQ(told, away > 1e5F) << away;
    }
}

TEST_F(Problems, ACameraOfNoSizeIsTold) {
    Scene site;
    Node node;
    node.name = "Flat camera";
    node.camera = site.cameras.insert(Camera{});
    node.transform.scale = dvec3(1.0, 0.0, 1.0);
    site.roots.push_back(site.nodes.insert(node));
    const auto found = find_problems(site);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Problem& p) {
        return p.what.find("its camera has no direction") != std::string::npos;
    }));
}

} // namespace
} // namespace atrium
