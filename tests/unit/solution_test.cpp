// A solution stored and read back, read at a point, and shown in a still.
#include "engine/solver/solution.h"
#include "engine/view/lit_scene.h"
#include "engine/view/still.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

namespace atrium {
namespace {

using namespace test;
using Quality = SolverSettings::Quality;

/// Maps are stored to a thousandth.
bool same_map(const std::shared_ptr<const LightMap>& a, const std::shared_ptr<const LightMap>& b) {
    if (!a || !b) {
        return a == b;
    }
    bool same = a->tiles == b->tiles && a->image.size() == b->image.size();
    for (std::size_t i = 0; same && i < a->image.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            same = same && std::abs(a->image[i][c] - b->image[i][c]) <= 1e-3F * std::abs(a->image[i][c]) + 1e-6F;
        }
    }
    return same;
}

bool same_textures(const std::vector<std::shared_ptr<const CausticTexture>>& a,
                   const std::vector<std::shared_ptr<const CausticTexture>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return *x == *y; });
}

bool same_layers(const Solution& a, const Solution& b) {
    if (a.surfaces.size() != b.surfaces.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        const SurfaceLayer &x = *a.surfaces[i], &y = *b.surfaces[i];
        if (x.node != y.node || x.part != y.part || !(*x.mesh == *y.mesh) || x.irradiance_front != y.irradiance_front ||
            x.irradiance_back != y.irradiance_back || x.direct_front != y.direct_front || x.direct_back != y.direct_back ||
            x.caustic_front != y.caustic_front || x.caustic_back != y.caustic_back ||
            !same_textures(x.caustic_textures_front, y.caustic_textures_front) ||
            !same_textures(x.caustic_textures_back, y.caustic_textures_back) ||
            !same_map(x.direct_map_front, y.direct_map_front) || !same_map(x.direct_map_back, y.direct_map_back)) {
            return false;
        }
    }
    return a.caustic_records == b.caustic_records;
}

NodeId add_shape(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

NodeId add_camera(Scene& scene, const std::string& node_name, const std::string& camera_name, const dvec3& at) {
    Camera camera;
    camera.name = camera_name;
    Node node;
    node.name = node_name;
    node.camera = scene.cameras.insert(camera);
    node.transform.translation = at;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

/// A small room with a two-sided screen in it, solved once for all tests here.
struct StoredRoom {
    Scene scene;
    std::shared_ptr<const Solution> solution;
    StoredRoom() {
        add_room(scene, 4, 2.5F, 3, add_material(scene, 0.5F));
        Material screen;
        screen.base_color = Rgb(0.2F, 0.5F, 0.8F);
        screen.double_sided = true;
        add_rectangle(scene, "screen", {2, 0.7, 1.5}, {0, 0, 1}, {1, 0, 0}, 1, 1, scene.materials.insert(screen));
        add_point_light(scene, {1, 2, 1}, 1000);
        solution = solve(scene, Quality::Draft).solution;
    }
};
const StoredRoom& stored_room() {
    static const StoredRoom room;
    return room;
}

TEST(SolutionCodec, RoundTripGivesEverythingBack) {
    const StoredRoom& room = stored_room();
    ASSERT_TRUE(room.solution);
    const std::vector<std::byte> bytes = encode_solution(*room.solution, room.scene);
    const auto back = decode_solution(bytes, room.scene);
    ASSERT_TRUE(back);
    EXPECT_TRUE(same_layers(**back, *room.solution));
    EXPECT_TRUE((*back)->final);
    EXPECT_EQ((*back)->mean_radiance, room.solution->mean_radiance);
    const Statistics &a = (*back)->statistics, &b = room.solution->statistics;
    EXPECT_EQ(a.quality, b.quality);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.links, b.links);
    EXPECT_EQ(a.memory.layers, b.memory.layers);
    EXPECT_EQ(a.energy.defect, b.energy.defect);
    ASSERT_EQ(a.features.size(), b.features.size());
    EXPECT_EQ(a.features[3].why, b.features[3].why);
    EXPECT_EQ(a.phases.size(), b.phases.size());
    EXPECT_EQ(encode_solution(**back, room.scene), bytes) << "the same solution gives the same bytes";
}

CausticTexture sample_texture() {
    CausticTexture texture;
    texture.low = {0.25F, 0.5F};
    texture.high = {1.5F, 1.25F};
    texture.width = 5;
    texture.height = 3;
    for (int i = 0; i < 15; ++i) {
        texture.image.emplace_back(100.0F + float(i), 1e5F / float(i + 1), 0.0F);
    }
    return texture;
}

/// The room's light with caustic light of every kind added by hand.
std::shared_ptr<Solution> with_caustics(const StoredRoom& room, const CausticTexture& texture = sample_texture()) {
    auto out = std::make_shared<Solution>(*room.solution);
    auto layer = std::make_shared<SurfaceLayer>(*out->surfaces.back()); // the two-sided screen
    const std::size_t n = layer->mesh->positions.size();
    layer->caustic_front.assign(n, Rgb(7.0F, 0.0F, 1.0F));
    layer->caustic_back.assign(n, Rgb(0.0F, 3.5F, 1.0F));
    layer->caustic_back[0] = Rgb(1e6F, 0.0F, 1e-6F);
    auto second = sample_texture();
    second.image[4] = Rgb(9.0F);
    layer->caustic_textures_front = {std::make_shared<CausticTexture>(texture), std::make_shared<CausticTexture>(second)};
    layer->caustic_textures_back = {std::make_shared<CausticTexture>(second)};
    CausticRecord record;
    record.node = layer->node;
    record.chart = 2;
    record.back = true;
    record.decision = CausticRecord::Decision::Texture;
    record.particles = 123'456;
    record.contrast = 0.75F;
    record.dispersion = 12.5F;
    record.threshold = 5.0F;
    record.extent = {1.0F, 2.0F};
    record.width = 64;
    record.height = 128;
    record.why = "bright lines, 5 mm";
    record.boxes = {vec4(0.0F, 0.25F, 0.5F, 1.0F), vec4(0.5F, 0.0F, 1.0F, 0.5F)};
    record.power_texture = 12.25;
    record.power_mesh = 0.5;
    record.bytes = 4711;
    record.found = CausticRecord::Decision::Coarse;
    record.sizing = CausticRecord::Sizing::ByHand;
    record.kernel = 0.0125F;
    record.wish = {CausticWish::Show::Texture, 0.005F, 9.0F};
    out->caustic_records.push_back(record);
    record.node = out->surfaces.front()->node;
    record.decision = CausticRecord::Decision::Uncharted;
    record.why.clear();
    record.boxes.clear();
    out->caustic_records.push_back(record);
    out->statistics.particles_emitted = 1'000'000;
    out->statistics.particles_stored = 345'678;
    out->statistics.memory.particles = 11;
    out->statistics.memory.octree = 12;
    out->statistics.memory.caustic_textures = 13;
    out->surfaces.back() = layer;
    return out;
}

TEST(SolutionCodec, CausticLightAndRecordsComeBack) {
    const StoredRoom& room = stored_room();
    const auto solution = with_caustics(room);
    const std::vector<std::byte> bytes = encode_solution(*solution, room.scene);
    const auto back = decode_solution(bytes, room.scene);
    ASSERT_TRUE(back);
    EXPECT_TRUE(same_layers(**back, *solution));
    EXPECT_FALSE(same_layers(**back, *room.solution));
    ASSERT_EQ((*back)->caustic_records.size(), 2U);
    EXPECT_EQ((*back)->statistics.particles_emitted, 1'000'000U);
    EXPECT_EQ((*back)->statistics.particles_stored, 345'678U);
    EXPECT_EQ((*back)->statistics.memory.particles, 11U);
    EXPECT_EQ((*back)->statistics.memory.octree, 12U);
    EXPECT_EQ((*back)->statistics.memory.caustic_textures, 13U);
    EXPECT_EQ(encode_solution(**back, room.scene), bytes);
    // Records of nodes that are gone go with them.
    Scene fewer = room.scene;
    fewer.nodes.erase(fewer.roots.front());
    fewer.roots.erase(fewer.roots.begin());
    ASSERT_EQ(solution->caustic_records[1].node, room.scene.roots.front());
    const auto rest = decode_solution(encode_solution(*solution, fewer), fewer);
    ASSERT_TRUE(rest);
    ASSERT_EQ((*rest)->caustic_records.size(), 1U);
    EXPECT_EQ((*rest)->caustic_records[0], solution->caustic_records[0]);
}

TEST(SolutionCodec, CausticLightThatCannotBeIsRefused) {
    const StoredRoom& room = stored_room();
    const auto refused = [&](const std::function<void(CausticTexture&)>& damage) {
        CausticTexture texture = sample_texture();
        damage(texture);
        return !decode_solution(encode_solution(*with_caustics(room, texture), room.scene), room.scene);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(refused([](CausticTexture&) {}));
    EXPECT_TRUE(refused([](CausticTexture& t) { t.width = 6; }));
    EXPECT_TRUE(refused([](CausticTexture& t) {
        t.width = t.height = 0;
        t.image.clear();
    }));
    EXPECT_TRUE(refused([](CausticTexture& t) {
        t.width = t.height = 0x10000;
        t.image.clear();
    })); // wraps to 0
    EXPECT_TRUE(refused([](CausticTexture& t) { t.high.x = t.low.x; }));
    EXPECT_TRUE(refused([nan](CausticTexture& t) { t.low.y = nan; }));
    EXPECT_TRUE(refused([](CausticTexture& t) { t.high.y = 1e30F; }));
    EXPECT_TRUE(refused([nan](CausticTexture& t) { t.image[3].g = nan; }));
    auto odd = with_caustics(room);
    auto layer = std::make_shared<SurfaceLayer>(*odd->surfaces.back());
    layer->caustic_front.pop_back();
    odd->surfaces.back() = layer;
    EXPECT_FALSE(decode_solution(encode_solution(*odd, room.scene), room.scene)) << "not one per vertex";
    odd = with_caustics(room);
    odd->caustic_records[0].decision = CausticRecord::Decision(77);
    EXPECT_FALSE(decode_solution(encode_solution(*odd, room.scene), room.scene));
}

TEST(SolutionCodec, IdsOfAnotherSessionAreFoundByTreeOrder) {
    const StoredRoom& room = stored_room();
    Scene other; // the same tree with other ids: slots have been used before
    for (int i = 0; i < 3; ++i) {
        other.nodes.erase(other.nodes.insert({}));
    }
    const Scene& scene = room.scene;
    for (const NodeId id : scene.roots) {
        other.roots.push_back(other.nodes.insert(*scene.nodes.find(id)));
    }
    const auto back = decode_solution(encode_solution(*room.solution, scene), other);
    ASSERT_TRUE(back);
    ASSERT_EQ((*back)->surfaces.size(), room.solution->surfaces.size());
    for (std::size_t i = 0; i < (*back)->surfaces.size(); ++i) {
        const Node* a = scene.nodes.find(room.solution->surfaces[i]->node);
        const Node* b = other.nodes.find((*back)->surfaces[i]->node);
        ASSERT_NE(b, nullptr);
        EXPECT_EQ(a->name, b->name);
    }
}

TEST(SolutionCodec, LayersOfNodesThatAreGoneAreLeftOut) {
    const StoredRoom& room = stored_room();
    Scene fewer = room.scene;
    fewer.nodes.erase(fewer.roots.front());
    fewer.roots.erase(fewer.roots.begin());
    const auto back = decode_solution(encode_solution(*room.solution, fewer), fewer);
    ASSERT_TRUE(back);
    EXPECT_EQ((*back)->surfaces.size(), room.solution->surfaces.size() - 1);
    // Stored with more nodes than the scene now has: refused.
    EXPECT_FALSE(decode_solution(encode_solution(*room.solution, room.scene), Scene{}));
}

TEST(SolutionCodec, FlippedBitsNeverGiveOtherLight) {
    const StoredRoom& room = stored_room();
    const auto solution = with_caustics(room);
    std::vector<std::byte> bytes = encode_solution(*solution, room.scene);
    ASSERT_GT(bytes.size(), 1000U);
    int refused = 0, tried = 0;
    const std::size_t stride = std::max<std::size_t>(bytes.size() / 300, 1);
    for (std::size_t at = 0; at < bytes.size(); at += at < 64 ? 1 : stride) {
        for (const int bit : {0, 7}) {
            const std::byte before = bytes[at];
            bytes[at] ^= std::byte(1 << bit);
            const auto back = decode_solution(bytes, room.scene);
            ++tried;
            if (back) {
                // Only what carries no information (reserved bytes) may be damaged unnoticed.
                EXPECT_TRUE(same_layers(**back, *solution)) << "byte " << at << " bit " << bit;
            } else {
                ++refused;
                EXPECT_FALSE(back.error().message().empty());
            }
            bytes[at] = before;
        }
    }
    EXPECT_GT(refused, tried * 9 / 10);
}

TEST(SolutionCodec, TruncatedOrOfAnotherVersionIsRefused) {
    const StoredRoom& room = stored_room();
    const std::vector<std::byte> bytes = encode_solution(*room.solution, room.scene);
    for (const std::size_t length : {std::size_t(0), std::size_t(1), std::size_t(8), std::size_t(23), std::size_t(24),
                                     std::size_t(40), bytes.size() / 2, bytes.size() - 1}) {
        EXPECT_FALSE(decode_solution(std::span(bytes).first(length), room.scene)) << length;
    }
    std::vector<std::byte> longer = bytes;
    longer.push_back(std::byte(7));
    EXPECT_FALSE(decode_solution(longer, room.scene));
    std::vector<std::byte> newer = bytes;
    newer[8] = std::byte(99);
    const auto refused = decode_solution(newer, room.scene);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message().find("version"), std::string::npos);
    // Version 3 said less of what was decided about caustics, and nothing else differs.
    std::vector<std::byte> older = bytes;
    older[8] = std::byte(3);
    const auto read = decode_solution(older, room.scene);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ((*read)->surfaces.size(), room.solution->surfaces.size());
    older[8] = std::byte(2);
    EXPECT_FALSE(decode_solution(older, room.scene));
    // A header that claims four gigabytes allocates nothing.
    std::vector<std::byte> huge = bytes;
    std::memset(huge.data() + 16, 0xFF, 8);
    EXPECT_FALSE(decode_solution(huge, room.scene));
}

// ---- reading at a point ----

Scene furnace(float rho, float x = 4, float y = 3, float z = 5) {
    Scene scene;
    add_room(scene, x, y, z, add_material(scene, rho, 1.0F));
    return scene;
}

TEST(ReadSurface, WithinACentimetreAndFacingTheSameWay) {
    const Scene scene = furnace(0.5F);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const auto read = [&](const dvec3& p, const dvec3& n) { return read_surface(scene, *s.solution, p, n); };
    EXPECT_TRUE(read({2, 0, 2}, {0, 1, 0}).on_surface);
    EXPECT_NEAR(luminance(read({2, 0, 2}, {0, 1, 0}).irradiance), 2.0, 0.1);
    EXPECT_TRUE(read({2, 0.009, 2}, {0, 1, 0}).on_surface);
    EXPECT_TRUE(read({2, -0.009, 2}, {0, 1, 0}).on_surface);
    EXPECT_FALSE(read({2, 0.011, 2}, {0, 1, 0}).on_surface);
    EXPECT_FALSE(read({2, 0, 2}, {0, -1, 0}).on_surface) << "the floor's back knows no light";
    EXPECT_FALSE(read({2, 0, 2}, {1, 0, 0}).on_surface) << "at right angles";
    EXPECT_FALSE(read({2, 1.5, 2}, {0, 1, 0}).on_surface) << "in the air";
    EXPECT_EQ(read({2, 1.5, 2}, {0, 1, 0}).irradiance, Rgb(0.0F));
    // In a corner the surface is chosen by its facing.
    EXPECT_TRUE(read({0.005, 0.005, 2}, {1, 0, 0}).on_surface);
    EXPECT_TRUE(read({0.005, 0.005, 2}, {0, 1, 0}).on_surface);
}

TEST(ReadSurface, BackSidesOfTwoSidedSurfacesAndMirroredNodes) {
    const StoredRoom& room = stored_room();
    const SensorReading front = read_surface(room.scene, *room.solution, {2, 0.7, 1.5}, {0, 0, 1});
    const SensorReading back = read_surface(room.scene, *room.solution, {2, 0.7, 1.5}, {0, 0, -1});
    ASSERT_TRUE(front.on_surface);
    ASSERT_TRUE(back.on_surface);
    EXPECT_GT(luminance(back.irradiance), 1.5F * luminance(front.irradiance)) << "the lamp is on the back's side";

    Scene mirrored;
    const MaterialId m = add_material(mirrored, 0.5F, 1.0F);
    add_room(mirrored, 4, 3, 5, m);
    mirrored.nodes.find(mirrored.roots[0])->transform.scale = {-1, 1, 1}; // the floor, turned over by its scale
    const Solved s = solve(mirrored, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const SensorReading floor = read_surface(mirrored, *s.solution, {1, 0, 2}, {0, 1, 0});
    EXPECT_TRUE(floor.on_surface) << "a negative scale turns the winding, not the side that is lit";
    EXPECT_NEAR(luminance(floor.irradiance), 2.0, 0.1);
    EXPECT_FALSE(read_surface(mirrored, *s.solution, {1, 0, 2}, {0, -1, 0}).on_surface);
}

TEST(ReadSurface, ManyAtOnceAreTheSameAsOneByOne) {
    const StoredRoom& room = stored_room();
    std::vector<SensorPlace> places;
    for (int i = 0; i < 500; ++i) { // on and off the floor, both sides of what stands there, and out of the room
        const double u = i % 25 * 0.2 - 0.5, v = i / 25 * 0.2 - 0.5;
        places.push_back({{u, i % 3 == 0 ? 0.0 : v, i % 3 == 0 ? v : 1.5},
                          i % 3 == 0 ? dvec3(0, 1, 0) : dvec3(0, 0, i % 3 == 1 ? 1 : -1)});
    }
    const std::vector<SensorReading> many = read_surfaces(room.scene, *room.solution, places);
    ASSERT_EQ(many.size(), places.size());
    std::size_t found = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const SensorReading one = read_surface(room.scene, *room.solution, places[i].point, places[i].normal);
        EXPECT_EQ(many[i].on_surface, one.on_surface) << i;
        EXPECT_EQ(many[i].irradiance, one.irradiance) << i;
        found += one.on_surface ? 1 : 0;
    }
    EXPECT_GT(found, 80U);
    EXPECT_LT(found, 450U);
}

TEST(ReadSurface, MirrorsAreNoIlluminanceMeters) {
    Scene scene = furnace(0.5F);
    Material mirror;
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    scene.nodes.find(scene.roots[0])->materials = {scene.materials.insert(mirror)};
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    EXPECT_FALSE(read_surface(scene, *s.solution, {2, 0, 2}, {0, 1, 0}).on_surface);
}

// ---- stills ----

ViewCamera camera_at(const dvec3& at, const dvec3& look) {
    ViewCamera camera;
    const dvec3 back = -glm::normalize(look);
    const dvec3 right = glm::normalize(glm::cross(std::abs(back.y) > 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0), back));
    camera.to_world[0] = dvec4(right, 0);
    camera.to_world[1] = dvec4(glm::cross(back, right), 0);
    camera.to_world[2] = dvec4(back, 0);
    camera.to_world[3] = dvec4(at, 1);
    camera.lens.yfov = 1.4F;
    return camera;
}

StillOptions small_picture(int width = 48, int height = 36) {
    StillOptions out;
    out.width = width;
    out.height = height;
    out.samples_per_axis = 1;
    return out;
}

TEST(Still, AFurnaceIsOneColourAllOver) {
    const Scene scene = furnace(0.6F);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const double expected = 1.0 / (1.0 - 0.6) / kPiD; // B / pi
    for (const dvec3& look : {dvec3(1, 0.1, 0.3), dvec3(-1, -0.8, 0.2), dvec3(0.01, 1, 0)}) {
        const Picture picture =
            render_still(scene, *s.solution, camera_at({1.7, 1.4, 2.2}, look), small_picture(), RunContext{});
        ASSERT_EQ(picture.pixels.size(), 48U * 36U);
        for (const vec3& p : picture.pixels) {
            EXPECT_NEAR(luminance(p) / expected, 1.0, 0.03);
        }
    }
}

TEST(Still, IsDeterministicAndOfTheSizeAsked) {
    const StoredRoom& room = stored_room();
    const ViewCamera camera = default_camera(room.scene);
    const Picture a = render_still(room.scene, *room.solution, camera, small_picture(31, 17), RunContext{});
    EXPECT_EQ(a.width, 31);
    EXPECT_EQ(a.height, 17);
    EXPECT_EQ(a.pixels, render_still(room.scene, *room.solution, camera, small_picture(31, 17), RunContext{}).pixels);
    double lit = 0;
    for (const vec3& p : a.pixels) {
        ASSERT_TRUE(is_finite(p));
        lit += luminance(p) > 0.0F ? 1 : 0;
    }
    EXPECT_GT(lit / double(a.pixels.size()), 0.99);
}

TEST(Still, StoppedAtOnceIsBlackAndOfFullSize) {
    const StoredRoom& room = stored_room();
    RunContext context;
    context.stop.request_stop();
    const Picture picture = render_still(room.scene, *room.solution, default_camera(room.scene), small_picture(), context);
    ASSERT_EQ(picture.pixels.size(), 48U * 36U);
    EXPECT_EQ(picture.pixels.front(), vec3(0.0F));
}

TEST(Still, AMirrorShowsWhatItReflects) {
    // A black room with one glowing wall (z = 5); the mirror on the wall z = 0 shows it, weakened by the mirror's colour.
    Scene scene;
    const MaterialId black = add_material(scene, 0.0F);
    const MaterialId glow = add_material(scene, 0.0F, 100.0F);
    Material mirror;
    mirror.base_color = Rgb(0.9F, 0.6F, 0.3F);
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    add_room(scene, 4, 3, 5, {black, black, black, black, scene.materials.insert(mirror), glow});
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    // Straight at the mirror: the middle pixels see the glowing wall behind the eye.
    const Picture picture =
        render_still(scene, *s.solution, camera_at({2, 1.5, 2}, {0, 0, -1}), small_picture(9, 9), RunContext{});
    const vec3 centre = picture.pixels[40];
    const float grazing = 0.0F; // normal incidence: F = F0
    for (int c = 0; c < 3; ++c) {
        const float f0 = mirror.base_color[c];
        EXPECT_NEAR(centre[c] / (100.0F * kInvPi), f0 + (1 - f0) * grazing, 0.01F);
    }
}

TEST(Still, AnEyeOutsideLooksInThroughTheBackOfTheWall) {
    const Scene scene = furnace(0.5F);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const Picture picture =
        render_still(scene, *s.solution, camera_at({2, 1.5, 9}, {0, 0, -1}), small_picture(9, 9), RunContext{});
    EXPECT_NEAR(luminance(picture.pixels[40]) * kPi, 2.0F, 0.1F);
}

TEST(Still, DamagedPartNumbersDoNotCrash) {
    const StoredRoom& room = stored_room();
    auto odd = std::make_shared<Solution>(*room.solution);
    auto layer = std::make_shared<SurfaceLayer>(*odd->surfaces[0]);
    layer->part = 77;
    odd->surfaces[0] = layer;
    const Picture picture = render_still(room.scene, *odd, default_camera(room.scene), small_picture(8, 8), RunContext{});
    for (const vec3& p : picture.pixels) {
        EXPECT_TRUE(is_finite(p));
    }
}

// ---- cameras ----

TEST(FindCamera, ByNodeNameCameraNameIndexOrFirst) {
    Scene scene = furnace(0.5F);
    add_camera(scene, "by the door", "wide", {1, 1.6, 1});
    add_camera(scene, "1", "tele", {3, 1.6, 4});
    const auto x_of = [&](const std::string& name) {
        const auto camera = find_camera(scene, name);
        return camera ? camera->to_world[3].x : -1.0;
    };
    EXPECT_EQ(x_of("by the door"), 1.0);
    EXPECT_EQ(x_of("wide"), 1.0);
    EXPECT_EQ(x_of("tele"), 3.0);
    EXPECT_EQ(x_of("0"), 1.0);
    EXPECT_EQ(x_of("1"), 3.0) << "a name goes before an index";
    EXPECT_EQ(x_of(""), 1.0) << "the first";
    for (const char* unknown : {"2", "-1", "1x", "Wide", " "}) {
        const auto none = find_camera(scene, unknown);
        ASSERT_FALSE(none) << unknown;
        EXPECT_NE(none.error().message().find(unknown), std::string::npos);
        EXPECT_NE(none.error().message().find("by the door"), std::string::npos) << "says which there are";
    }
    const auto none = find_camera(furnace(0.5F), "wide");
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message().find("no camera"), std::string::npos);
    EXPECT_TRUE(find_camera(furnace(0.5F), "")) << "no camera and none asked for: the default view";
}

TEST(DefaultCamera, StandsInsideAClosedRoomAtEyeHeight) {
    for (const dvec3& offset : {dvec3(0.0), dvec3(-300, 10, 5000)}) {
        Scene scene = furnace(0.5F, 6, 2.7F, 4);
        add_shape(scene, Box{{1.0F, 1.0F, 1.0F}}, {3, 0.5, 2}, add_material(scene, 0.5F));
        for (const NodeId id : scene.roots) {
            scene.nodes.find(id)->transform.translation += offset;
        }
        const ViewCamera camera = default_camera(scene);
        const dvec3 eye = dvec3(camera.to_world[3]) - offset;
        EXPECT_GT(eye.x, 0.1);
        EXPECT_LT(eye.x, 5.9);
        EXPECT_GT(eye.z, 0.1);
        EXPECT_LT(eye.z, 3.9);
        EXPECT_GT(eye.y, 1.0);
        EXPECT_LT(eye.y, 2.7);
        EXPECT_FALSE(std::abs(eye.x - 3) < 0.5 && std::abs(eye.z - 2) < 0.5 && eye.y < 1.0) << "not in the box";
        EXPECT_NEAR(glm::determinant(dmat3(camera.to_world)), 1.0, 1e-9);
        EXPECT_GT(camera.to_world[1].y, 0.9) << "upright";
    }
}

TEST(DefaultCamera, EmptyOrFlatScenesHaveOneToo) {
    for (int kind = 0; kind < 2; ++kind) {
        Scene scene;
        if (kind == 1) {
            add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0.5F));
        }
        const ViewCamera camera = default_camera(scene);
        for (int c = 0; c < 4; ++c) {
            EXPECT_TRUE(is_finite(dvec3(camera.to_world[c])));
        }
    }
}

} // namespace
} // namespace atrium
