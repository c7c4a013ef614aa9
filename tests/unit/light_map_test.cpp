// Direct light in maps: evaluated, added up, stored in few bytes, read from damaged ones.
#include "tests/support/light_maps.h"

#include "engine/base/float_traps.h"
#include "engine/base/half.h"
#include "engine/base/rng.h"
#include "engine/solver/gi_engine.h"
#include "engine/solver/light_map_codec.h"
#include "engine/view/still.h"

#include <gtest/gtest.h>

#include <cstring>
#include <zstd.h>

namespace atrium {
namespace {

using namespace test;

Rgb slope(const vec2& uv) { return {100.0F + 30.0F * uv.x - 7.0F * uv.y, 5.0F + uv.y, 250.0F - 20.0F * uv.x}; }

void expect_near(const Rgb& a, const Rgb& b, float tolerance, const std::string& what) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c], b[c], tolerance) << what << ", channel " << c;
    }
}

TEST(LightMap, SlopesAreExactOnTilesOfEveryLevel) {
    // Bilinear interpolation reproduces a linear function, whatever the level: also on edges, corners and between samples.
    const LightMap map = sampled_map(
        4, 3, [](int u, int v) { return (u + 2 * v) % 6; }, slope);
    for (float v = 0.0F; v <= 3.0F; v += 0.0625F) {
        for (float u = 0.0F; u <= 4.0F; u += 0.03125F) {
            expect_near(map.irradiance({u, v}), slope({u, v}), 1e-3F, std::to_string(u) + ", " + std::to_string(v));
        }
    }
}

TEST(LightMap, EqualNeighboursMeetWithoutAStepAndFinerTilesShowMore) {
    const auto waves = [](const vec2& uv) { return Rgb(100.0F + 50.0F * std::sin(9.0F * uv.x) * std::cos(7.0F * uv.y)); };
    const LightMap even = sampled_map(
        3, 3, [](int, int) { return 3; }, waves);
    float worst = 0.0F;
    for (float v = 0.05F; v < 3.0F; v += 0.1F) {
        for (const float border : {1.0F, 2.0F}) {
            const float step = std::abs(even.irradiance({border - 1e-5F, v}).r - even.irradiance({border + 1e-5F, v}).r);
            worst = std::max(worst, step);
        }
    }
    EXPECT_LT(worst, 0.05F) << "lux, of 100";
    const auto error = [&](int level) {
        const LightMap map = sampled_map(
            1, 1, [&](int, int) { return level; }, waves);
        float sum = 0.0F;
        for (float t = 0.01F; t < 1.0F; t += 0.013F) {
            sum += std::abs(map.irradiance({t, 0.7F * t}).r - waves({t, 0.7F * t}).r);
        }
        return sum;
    };
    EXPECT_LT(error(4), error(3) * 0.35F) << "second order: a quarter for half the step";
    EXPECT_LT(error(7), error(3) * 0.01F);
}

TEST(LightMap, UnusedTilesTakeTheNearestUsedOneOfTheEightAround) {
    // Used: (0, 0) and (2, 2) of 5 x 4 tiles.
    const LightMap map = sampled_map(
        5, 4, [](int u, int v) { return (u == 0 && v == 0) || (u == 2 && v == 2) ? 1 : -1; }, slope);
    expect_near(map.irradiance({1.3F, 0.6F}), slope({1.0F, 0.6F}), 1e-3F, "left of it");
    expect_near(map.irradiance({1.9F, 1.8F}), slope({2.0F, 2.0F}), 1e-3F, "(2, 2) is nearer");
    expect_near(map.irradiance({1.2F, 1.1F}), slope({1.0F, 1.0F}), 1e-3F, "(0, 0) is nearer");
    EXPECT_EQ(map.irradiance({4.5F, 0.5F}), Rgb(0.0F)) << "nothing around";
    expect_near(map.irradiance({-3.0F, 0.25F}), slope({0.0F, 0.25F}), 1e-3F, "outside the map");
    EXPECT_EQ(LightMap().irradiance({0.5F, 0.5F}), Rgb(0.0F));
}

// ---- adding up ----

/// Two triangles of the unit square, the second one uncharted; other numbers on the back.
SurfaceLayer square_layer(NodeId node = {}) {
    auto mesh = std::make_shared<DisplayMesh>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh->normals.assign(6, vec3(0, 0, 1));
    mesh->indices = {0, 1, 2, 3, 4, 5};
    chart_plane(*mesh, {0, 0}, 2.0F);
    mesh->light_uv[3] = mesh->light_uv[4] = mesh->light_uv[5] = vec2(-1.0F);
    SurfaceLayer layer;
    layer.node = node;
    layer.mesh = mesh;
    for (int i = 0; i < 6; ++i) {
        const auto f = float(i);
        layer.irradiance_front.push_back({10.0F + f, 20.0F, 30.0F});
        layer.irradiance_back.push_back({1.0F, 2.0F + f, 3.0F});
        layer.direct_front.push_back(i < 3 ? Rgb(0.0F) : Rgb(100.0F, 200.0F, 300.0F + f));
    }
    layer.direct_map_front = std::make_shared<LightMap>(sampled_map(
        2, 2, [](int u, int v) { return u + 2 * v; }, slope));
    layer.direct_map_back = std::make_shared<LightMap>(sampled_map(
        2, 2, [](int, int) { return 2; }, [](const vec2& uv) { return slope(uv) * 0.25F; }));
    return layer;
}

TEST(IrradianceAt, IsDiffusePlusDirectOfTheSideAskedFor) {
    const SurfaceLayer layer = square_layer();
    const std::array<std::uint32_t, 3> charted{0, 1, 2}, uncharted{3, 4, 5};
    const vec3 weight(0.2F, 0.5F, 0.3F);
    const vec2 uv(1.6F, 0.6F); // 2 * (0.5 + 0.3, 0.3)
    const auto at = [&](const auto& vertices, bool back, bool diffuse, bool direct) {
        return irradiance_at(layer, vertices, weight, back, {diffuse, direct});
    };
    expect_near(at(charted, false, true, false), {11.1F, 20.0F, 30.0F}, 1e-3F, "diffuse");
    expect_near(at(charted, false, false, true), slope(uv), 1e-3F, "the map alone");
    expect_near(at(charted, false, true, true), slope(uv) + Rgb(11.1F, 20.0F, 30.0F), 1e-3F, "both");
    expect_near(at(uncharted, false, false, true), {100.0F, 200.0F, 304.1F}, 1e-3F, "vertices alone");
    expect_near(at(uncharted, false, true, true), {114.1F, 220.0F, 334.1F}, 1e-3F, "vertices, both");
    expect_near(at(charted, true, true, false), {1.0F, 3.1F, 3.0F}, 1e-3F, "diffuse behind");
    expect_near(at(charted, true, false, true), slope(uv) * 0.25F, 1e-3F, "the map behind");
    expect_near(at(uncharted, true, false, true), Rgb(0.0F), 0.0F, "no direct light on the vertices behind");
    expect_near(at(charted, false, false, false), Rgb(0.0F), 0.0F, "nothing");
    EXPECT_EQ(vertex_irradiance(layer, 4, false), Rgb(114.0F, 220.0F, 334.0F));
    EXPECT_EQ(vertex_irradiance(layer, 1, false), Rgb(11.0F, 20.0F, 30.0F)) << "without the map";
    EXPECT_EQ(vertex_irradiance(layer, 4, true, {false, true}), Rgb(0.0F));
}

// ---- halves ----

TEST(Half, EveryHalfComesBackAndEveryFloatGoesToTheNearest) {
    for (std::uint32_t bits = 0; bits < 0x10000U; ++bits) {
        const auto half = std::uint16_t(bits);
        if (half_is_finite(half)) {
            ASSERT_EQ(half_from_float(float_from_half(half)), half);
        }
    }
    EXPECT_EQ(float_from_half(0x3C00), 1.0F);
    EXPECT_EQ(float_from_half(0x7BFF), 65504.0F);
    EXPECT_EQ(float_from_half(0x0001), 0x1p-24F);
    EXPECT_EQ(half_from_float(2049.0F), half_from_float(2048.0F)) << "ties to even";
    EXPECT_EQ(half_from_float(2051.0F), half_from_float(2052.0F));
    EXPECT_FALSE(half_is_finite(half_from_float(65536.0F)));
    EXPECT_FALSE(half_is_finite(half_from_float(std::numeric_limits<float>::quiet_NaN())));
    for (int i = 0; i < 20000; ++i) {
        const vec2 u = sobol_owen2(std::uint32_t(i), 0, 7);
        const float value = std::exp2(-14.0F + 29.9F * u.x) * (u.y < 0.5F ? -1.0F : 1.0F);
        ASSERT_LE(std::abs(float_from_half(half_from_float(value)) / value - 1.0F), 0x1p-11F) << value;
    }
}

// ---- stored ----

Rgb sun_on_a_floor(const vec2& uv) { // a bright patch with a soft edge, skylight that falls off, a coloured lamp
    const float edge = std::clamp(12.0F * (uv.x + 0.4F * uv.y - 2.1F), 0.0F, 1.0F);
    const float sky = 900.0F / (1.0F + uv.x * uv.x + uv.y * uv.y);
    return Rgb(0.9F, 1.0F, 1.1F) * sky + Rgb(98'000.0F, 92'000.0F, 85'000.0F) * edge;
}

void expect_same_map(const LightMap& a, const LightMap& b) {
    ASSERT_EQ(a.tiles.size(), b.tiles.size());
    EXPECT_TRUE(a.tiles == b.tiles);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.image_width, b.image_width);
    ASSERT_EQ(a.image.size(), b.image.size());
    float worst = 0.0F;
    for (std::size_t i = 0; i < a.image.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float expected = a.image[i][c];
            worst = std::max(worst, std::abs(b.image[i][c] - expected) / std::max(expected, 1e-20F));
        }
    }
    EXPECT_LE(worst, 1e-3F);
}

LightMap round_trip(const LightMap& map) {
    ByteWriter out;
    write_light_map(out, map);
    ByteReader in(out.bytes);
    LightMap back;
    EXPECT_TRUE(read_light_map(in, back));
    EXPECT_EQ(in.left(), 0U);
    return back;
}

TEST(LightMapCodec, IsExactToAThousandthFromTheSunToMoonlight) {
    const auto wide = [](const vec2& uv) { return Rgb(1.3e5F, 77.0F, 0.04F) * std::exp2(-2.0F * uv.x) * (1.0F + uv.y); };
    for (const float scale : {1.0F, 1e-6F, 1e6F}) {
        LightMap map = sampled_map(
            3, 2, [](int u, int v) { return u + v == 3 ? -1 : 2 * u + v; }, wide);
        for (Rgb& e : map.image) {
            e *= scale;
        }
        const LightMap back = round_trip(map);
        expect_same_map(map, back);
        EXPECT_TRUE(round_trip(back) == back) << "stored again nothing changes any more";
    }
    LightMap dark = sampled_map(
        1, 1, [](int, int) { return 1; }, [](const vec2&) { return Rgb(0.0F); }, 0);
    EXPECT_EQ(round_trip(dark).image[0], Rgb(0.0F));
    // The largest sample rounds up to the next power of two, and the scale is the same the second time.
    dark.image[0] = Rgb(std::nextafter(65536.0F, 0.0F), 0x1p-13F, 1.0F);
    const LightMap rounded = round_trip(dark);
    EXPECT_EQ(rounded.image[0].r, 65536.0F);
    EXPECT_TRUE(round_trip(rounded) == rounded);
}

TEST(LightMapCodec, TakesFewBytes) {
    const LightMap map = sampled_map(
        12, 12, [](int u, int v) { return (u + v) % 3 == 0 ? 5 : 4; },
        [](const vec2& uv) { return sun_on_a_floor(uv * 0.3F); }, 0);
    ByteWriter out;
    write_light_map(out, map);
    std::vector<std::byte> packed(ZSTD_compressBound(out.bytes.size()));
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), out.bytes.data(), out.bytes.size(), 3);
    std::printf("light map: %zu samples, %.2f bytes each\n", map.image.size(), double(size) / double(map.image.size()));
    EXPECT_LT(double(size), 2.5 * double(map.image.size())) << "of 12 in memory";
}

TEST(LightMapCodec, RefusesTilesThatReachOutOfTheImage) {
    const LightMap good = sampled_map(
        2, 1, [](int, int) { return 1; }, slope);
    const auto readable = [](const LightMap& map) {
        ByteWriter out;
        write_light_map(out, map);
        ByteReader in(out.bytes);
        LightMap back;
        return read_light_map(in, back);
    };
    ASSERT_TRUE(readable(good));
    const auto with = [&](const std::function<void(LightMap&)>& change) {
        LightMap map = good;
        change(map);
        return readable(map);
    };
    EXPECT_TRUE(with([](LightMap& m) { m.tiles[0].x = std::uint16_t(m.image_width - 3); })) << "just inside";
    EXPECT_FALSE(with([](LightMap& m) { m.tiles[0].x = std::uint16_t(m.image_width - 2); }));
    EXPECT_FALSE(with([](LightMap& m) { m.tiles[1].y = 1; })) << "one row too low";
    EXPECT_FALSE(with([](LightMap& m) { m.tiles[1].level = 5; }));
    EXPECT_FALSE(with([](LightMap& m) { m.tiles[1].level = 40; }));
    EXPECT_TRUE(with([](LightMap& m) { m.tiles[1] = {65535, 65535, 40, 0}; })) << "what is not used is never read";
    {
        const FloatTrapsOff no_number_on_purpose;
        EXPECT_FALSE(with([](LightMap& m) { m.image[0].g = std::numeric_limits<float>::infinity(); }));
        EXPECT_FALSE(with([](LightMap& m) { m.image[0].g = std::numeric_limits<float>::quiet_NaN(); }));
    }
    // Claims of more tiles or samples than there are bytes allocate nothing: 2^64 would wrap round.
    for (const std::size_t at : {std::size_t(0), std::size_t(8) + 2 * sizeof(LightMap::Tile)}) {
        ByteWriter out;
        write_light_map(out, good);
        std::memset(out.bytes.data() + at, 0xFF, 8);
        ByteReader in(out.bytes);
        LightMap back;
        EXPECT_FALSE(read_light_map(in, back));
    }
}

/// The square on a node, as a solution.
struct StoredSquare {
    Scene scene;
    Solution solution;
    StoredSquare() {
        auto mesh = std::make_shared<MeshData>();
        mesh->positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        mesh->normals.assign(4, vec3(0, 0, 1));
        mesh->indices = {0, 1, 2, 0, 2, 3};
        mesh->parts = {{0, 6}};
        Material material;
        material.base_color = Rgb(0.5F);
        material.double_sided = true;
        Node node;
        node.name = "square";
        node.shape = scene.shapes.insert({"square", Mesh{mesh}, {}});
        node.materials = {scene.materials.insert(material)};
        const NodeId id = scene.nodes.insert(node);
        scene.roots.push_back(id);
        solution.final = true;
        solution.mean_radiance = 100.0;
        solution.surfaces.push_back(std::make_shared<SurfaceLayer>(square_layer(id)));
    }
};

struct Header {
    char magic[8];
    std::uint32_t version;
    std::uint32_t reserved;
    std::uint64_t raw_size;
};

/// What encode_solution() compressed.
std::vector<std::byte> unpacked(const std::vector<std::byte>& stored) {
    Header header{};
    std::memcpy(&header, stored.data(), sizeof header);
    std::vector<std::byte> raw(header.raw_size);
    EXPECT_EQ(ZSTD_decompress(raw.data(), raw.size(), stored.data() + sizeof header, stored.size() - sizeof header),
              raw.size());
    return raw;
}
/// The same bytes in a valid frame: the checksum must not be all that stands between damage and the program.
std::vector<std::byte> packed(const std::vector<std::byte>& stored, std::span<const std::byte> raw) {
    std::vector<std::byte> out(sizeof(Header) + ZSTD_compressBound(raw.size()));
    Header header{};
    std::memcpy(&header, stored.data(), sizeof header);
    header.raw_size = raw.size();
    std::memcpy(out.data(), &header, sizeof header);
    const std::size_t size =
        ZSTD_compress(out.data() + sizeof header, out.size() - sizeof header, raw.data(), raw.size(), 1);
    out.resize(sizeof header + size);
    return out;
}

/// Evaluates all light of a solution that was read; true when every number is finite.
bool all_finite(const Solution& solution) {
    for (const auto& layer : solution.surfaces) {
        const auto& indices = layer->mesh->indices;
        for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
            for (const bool back : {false, true}) {
                if ((!back || layer->has_back()) &&
                    !is_finite(
                        irradiance_at(*layer, {indices[t], indices[t + 1], indices[t + 2]}, {0.2F, 0.3F, 0.5F}, back))) {
                    return false;
                }
            }
        }
        for (const auto* map : {layer->direct_map_front.get(), layer->direct_map_back.get()}) {
            for (float v = -0.5F; map != nullptr && v < 3.0F; v += 0.37F) {
                for (float u = -0.5F; u < 3.0F; u += 0.41F) {
                    if (!is_finite(map->irradiance({u, v}))) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

TEST(SolutionCodecWithMaps, RoundTrip) {
    const StoredSquare square;
    const std::vector<std::byte> bytes = encode_solution(square.solution, square.scene);
    const auto back = decode_solution(bytes, square.scene);
    ASSERT_TRUE(back) << back.error().message();
    ASSERT_EQ((*back)->surfaces.size(), 1U);
    const SurfaceLayer &a = *square.solution.surfaces[0], &b = *(*back)->surfaces[0];
    EXPECT_TRUE(*a.mesh == *b.mesh);
    EXPECT_EQ(a.mesh->light_uv, b.mesh->light_uv);
    EXPECT_EQ(a.irradiance_front, b.irradiance_front);
    EXPECT_EQ(a.irradiance_back, b.irradiance_back);
    EXPECT_EQ(a.direct_front, b.direct_front);
    EXPECT_TRUE(b.direct_back.empty());
    ASSERT_TRUE(b.direct_map_front && b.direct_map_back);
    expect_same_map(*a.direct_map_front, *b.direct_map_front);
    expect_same_map(*a.direct_map_back, *b.direct_map_back);
    EXPECT_EQ(encode_solution(**back, square.scene), bytes);

    auto without = std::make_shared<SurfaceLayer>(a);
    without->direct_map_front = nullptr;
    Solution plain = square.solution;
    plain.surfaces = {without};
    const auto read = decode_solution(encode_solution(plain, square.scene), square.scene);
    ASSERT_TRUE(read);
    EXPECT_FALSE((*read)->surfaces[0]->direct_map_front);
    EXPECT_TRUE((*read)->surfaces[0]->direct_map_back);
}

TEST(SolutionCodecWithMaps, EveryTruncationIsRefused) {
    const StoredSquare square;
    const std::vector<std::byte> stored = encode_solution(square.solution, square.scene);
    for (std::size_t length = 0; length < stored.size(); ++length) {
        ASSERT_FALSE(decode_solution(std::span(stored).first(length), square.scene)) << length;
    }
    const std::vector<std::byte> raw = unpacked(stored);
    for (std::size_t length = 0; length < raw.size(); length += length < raw.size() - 3000 ? 17 : 1) {
        ASSERT_FALSE(decode_solution(packed(stored, std::span(raw).first(length)), square.scene)) << "inside, " << length;
    }
}

TEST(SolutionCodecWithMaps, DamageInsideAValidFrameIsRefusedOrHarmless) {
    const StoredSquare square;
    const std::vector<std::byte> stored = encode_solution(square.solution, square.scene);
    std::vector<std::byte> raw = unpacked(stored);
    int refused = 0, tried = 0;
    // The samples are the largest part and all alike: some of them do.
    std::size_t samples = 0;
    for (const auto* map : {&square.solution.surfaces[0]->direct_map_front, &square.solution.surfaces[0]->direct_map_back}) {
        samples += (*map)->image.size() * 6;
    }
    ASSERT_GT(raw.size(), samples);
    const std::size_t step = std::max<std::size_t>(samples / 2000, 1);
    for (std::size_t at = 0; at<raw.size(); at += at> raw.size() - samples ? step : 1) {
        for (const int mask : {0x01, 0x80, 0xFF}) {
            raw[at] ^= std::byte(mask);
            const auto back = decode_solution(packed(stored, raw), square.scene);
            ++tried;
            if (back) {
                ASSERT_TRUE(all_finite(**back)) << "byte " << at << ", " << mask;
            } else {
                ++refused;
            }
            raw[at] ^= std::byte(mask);
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, tried) << "other numbers are no damage that can be seen";
    EXPECT_TRUE(decode_solution(packed(stored, raw), square.scene)) << "and the frame itself is fine";
}

// ---- read and shown ----

TEST(ReadSurfaceWithMaps, GivesDiffuseAndDirectOfTheSideThatTheSensorFaces) {
    const StoredSquare square;
    const auto read = [&](double x, double y, double nz) {
        return read_surface(square.scene, square.solution, {x, y, 0.0}, {0, 0, nz});
    };
    const SurfaceLayer& layer = *square.solution.surfaces[0];
    const SensorReading front = read(0.75, 0.25, 1);
    ASSERT_TRUE(front.on_surface);
    expect_near(front.irradiance, slope({1.5F, 0.5F}) + Rgb(11.0F, 20.0F, 30.0F), 1e-2F, "charted");
    const SensorReading back = read(0.75, 0.25, -1);
    ASSERT_TRUE(back.on_surface);
    expect_near(back.irradiance, slope({1.5F, 0.5F}) * 0.25F + Rgb(1.0F, 3.0F, 3.0F), 1e-2F, "behind");
    const vec3 weight(0.25F, 0.25F, 0.5F); // of (0.25, 0.75) in the second triangle
    expect_near(read(0.25, 0.75, 1).irradiance, irradiance_at(layer, {3, 4, 5}, weight, false), 1e-2F, "uncharted");
}

TEST(StillWithMaps, ShowsThemAndTheSharesAddUp) {
    StoredSquare square;
    Material& material = *square.scene.materials.find(square.scene.nodes.find(square.scene.roots[0])->materials[0]);
    material.emissive_color = Rgb(1.0F);
    material.emissive_strength = 3.0F;
    square.scene.environment.sky_radiance = Rgb(7.0F);
    ViewCamera camera; // looks along -z; the square is seen from x, y in 0 to 1, 1.2 m wide
    camera.to_world[3] = dvec4(0.5, 0.5, 1.0, 1.0);
    camera.lens.perspective = false;
    camera.lens.ymag = 0.6F;
    StillOptions options;
    options.width = options.height = 48;
    options.samples_per_axis = 1;
    const auto render = [&](const LightShares& shares) {
        options.shares = shares;
        return render_still(square.scene, square.solution, camera, options, RunContext{});
    };
    const Picture all = render({}), direct = render({false, true}), diffuse = render({true, false});
    int charted = 0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x) {
            const vec2 p(-0.1F + (float(x) + 0.5F) * 1.2F / 48.0F, 1.1F - (float(y) + 0.5F) * 1.2F / 48.0F);
            const auto i = std::size_t(y * 48 + x);
            const std::string where = std::to_string(p.x) + ", " + std::to_string(p.y);
            expect_near(direct.pixels[i] + diffuse.pixels[i], all.pixels[i], 1e-3F, "sum at " + where);
            if (std::min(p.x, p.y) < 0.0F || std::max(p.x, p.y) > 1.0F) {
                expect_near(all.pixels[i], Rgb(7.0F), 1e-4F, "sky at " + where);
                expect_near(diffuse.pixels[i], Rgb(0.0F), 0.0F, "the sky is direct light, at " + where);
            } else if (p.x > p.y + 0.01F) {
                const Rgb expected = Rgb(3.0F) + 0.5F * kInvPi * slope(p * 2.0F);
                expect_near(direct.pixels[i], expected, 1e-2F, "direct at " + where);
                expect_near(diffuse.pixels[i], 0.5F * kInvPi * Rgb(10.0F + p.x + p.y, 20.0F, 30.0F), 1e-2F,
                            "diffuse at " + where);
                ++charted;
            }
        }
    }
    EXPECT_GT(charted, 600);
}

} // namespace
} // namespace atrium
