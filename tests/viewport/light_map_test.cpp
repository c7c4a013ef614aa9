// Light maps in the view: what is drawn is what irradiance_at() says, at every pixel.
#include "fixture.h"

#include "engine/view/tone.h"
#include "tests/support/light_maps.h"
#include "ui/viewport/caustic_cache.h"

#include <QDir>
#include <QSignalSpy>
#include <QTest>

#include <ctime>

namespace atrium::ui {
namespace {

constexpr float kTilesPerMetre = 2.0F; // 4 x 4 tiles on 2 x 2 m
constexpr double kMeanRadiance = 300.0;
constexpr double kAxes = 90.0; ///< logical pixels from the lower left corner

/// Sharp diagonal edge between sun and shadow, and a slope of colour on both sides.
Rgb diagonal(const vec2& uv) {
    const bool sun = uv.x + 0.62F * uv.y > 3.1F;
    return sun ? Rgb(1800.0F, 1500.0F, 1200.0F) * (1.0F + 0.1F * uv.y) : Rgb(150.0F, 220.0F, 320.0F) * (1.0F + 0.2F * uv.x);
}
Rgb rings(const vec2& uv) {
    const float r = glm::length(uv - vec2(1.7F, 2.1F));
    return Rgb(700.0F, 500.0F, 300.0F) * (1.2F + std::sin(4.0F * r));
}

/// Level 0 to 6 in turns; on the front one tile in the corner is not used.
int mixed_level(int u, int v) { return u == 3 && v == 0 ? -1 : (u * 3 + v * 5) % 7; }

/// The plane z = 0 from -1 to 1, two-sided, in two triangles, and a third that is not charted beyond x = 1.
Scene plane() {
    Scene scene;
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {1.4F, 0, 0}, {1, 1, 0}};
    mesh->normals.assign(7, vec3(0, 0, 1));
    mesh->indices = {0, 1, 2, 0, 2, 3, 4, 5, 6};
    mesh->parts = {{0, 9}};
    Material material;
    material.base_color = Rgb(0.5F);
    material.double_sided = true;
    Node node;
    node.name = "Plane";
    node.shape = scene.shapes.insert({"Plane", Mesh{mesh}, {}});
    node.materials = {scene.materials.insert(material)};
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

enum class Maps { None, Front, Both };

std::shared_ptr<Solution> lit_plane(const Scene& scene, Maps maps) {
    auto solution =
        light_scene(scene, [](const dvec3& p, const dvec3&) { return Rgb(200.0F, 150.0F, 100.0F) * float(1.5 + p.x); });
    solution->mean_radiance = kMeanRadiance;
    auto layer = std::make_shared<SurfaceLayer>(*solution->surfaces[0]);
    layer->irradiance_back.assign(layer->mesh->positions.size(), Rgb(50.0F, 100.0F, 150.0F));
    if (maps != Maps::None) {
        auto mesh = std::make_shared<DisplayMesh>(*layer->mesh);
        test::chart_plane(*mesh, {-1, -1}, kTilesPerMetre);
        layer->direct_front.assign(mesh->positions.size(), Rgb(0.0F));
        for (std::size_t i = 4; i < 7; ++i) {
            mesh->light_uv[i] = vec2(-1.0F);
            layer->direct_front[i] = Rgb(400.0F, 900.0F, 100.0F);
        }
        layer->mesh = mesh;
        layer->direct_map_front = std::make_shared<LightMap>(test::sampled_map(4, 4, mixed_level, diagonal));
        if (maps == Maps::Both) {
            layer->direct_map_back = std::make_shared<LightMap>(test::sampled_map(
                4, 4, [](int u, int v) { return (u + v) % 5; }, rings));
        }
    }
    solution->surfaces[0] = layer;
    return solution;
}

std::shared_ptr<const CausticTexture> caustic(const vec2& low, const vec2& high, std::uint32_t width, std::uint32_t height,
                                              const std::function<Rgb(const vec2& uv)>& light) {
    auto texture = std::make_shared<CausticTexture>();
    texture->low = low;
    texture->high = high;
    texture->width = width;
    texture->height = height;
    for (std::uint32_t j = 0; j < height; ++j) {
        for (std::uint32_t i = 0; i < width; ++i) {
            texture->image.push_back(light(vec2(float(i) + 0.5F, float(j) + 0.5F) / vec2(float(width), float(height))));
        }
    }
    return texture;
}
Rgb arc(const vec2& uv) { return Rgb(2500.0F, 900.0F, 300.0F) * std::exp(-80.0F * std::pow(length(uv) - 0.6F, 2.0F)); }
Rgb even_green(const vec2& uv) { return Rgb(100.0F, 900.0F, 200.0F) * (0.6F + 0.4F * uv.x); }

/// Two overlapping textures, one of them up to the chart's edge, and a small one in a corner; on the back another.
std::shared_ptr<Solution> with_caustics(std::shared_ptr<Solution> solution) {
    auto layer = std::make_shared<SurfaceLayer>(*solution->surfaces[0]);
    layer->caustic_textures_front = {caustic({1.0F, 1.0F}, {3.0F, 3.5F}, 40, 50, arc),
                                     caustic({2.2F, 0.6F}, {4.0F, 2.1F}, 9, 6, even_green),
                                     caustic({0.2F, 3.5F}, {0.6F, 3.9F}, 3, 200, even_green)};
    layer->caustic_textures_back = {caustic({0.5F, 0.5F}, {1.5F, 3.0F}, 20, 30, even_green)};
    layer->caustic_front.assign(layer->mesh->positions.size(), Rgb(0.0F, 40.0F, 160.0F));
    layer->caustic_front[0] = Rgb(500.0F, 0.0F, 0.0F);
    solution->surfaces[0] = layer;
    return solution;
}

/// Processor time of this thread: what others on the machine do does not count.
double thread_milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

class LightMaps : public ViewportFixture {
protected:
    /// Irradiance at a point of the plane, on the processor; nullopt off the plane.
    std::optional<Rgb> expected(const SurfaceLayer& layer, const vec2& p, bool back, const LightShares& shares) const {
        const DisplayMesh& mesh = *layer.mesh;
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
            const std::array<std::uint32_t, 3> v{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
            const vec2 a(mesh.positions[v[0]]), ab = vec2(mesh.positions[v[1]]) - a, ac = vec2(mesh.positions[v[2]]) - a;
            const float area = ab.x * ac.y - ab.y * ac.x;
            const vec2 ap = p - a;
            const float b = (ap.x * ac.y - ap.y * ac.x) / area, c = (ab.x * ap.y - ab.y * ap.x) / area;
            if (b >= 0.0F && c >= 0.0F && b + c <= 1.0F) {
                return irradiance_at(layer, v, vec3(1.0F - b - c, b, c), back, shares);
            }
        }
        return std::nullopt;
    }

    /// Compares every pixel of the plane with what the processor finds at its centre. Pixels where less than a pixel aside
    /// the light differs by more than 3 % lie on an edge: each of those must be between its neighbours. Returns the number
    /// of pixels compared.
    int compare(const SurfaceLayer& layer, const dvec3& eye, const LightShares& shares, const std::string& what) {
        QTest::qWait(800); // the smoothed picture, where the interactive one goes without
        const QImage picture = view_->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
        const ViewCamera camera = view_->camera();
        const bool back = eye.z < 0.0;
        const double scale = std::tan(0.5 * double(camera.lens.yfov)) * 2.0 / picture.height();
        const auto meet = [&](double x, double y) {
            const dvec3 ray(camera.to_world *
                            dvec4((x - 0.5 * picture.width()) * scale, (0.5 * picture.height() - y) * scale, -1.0, 0.0));
            const dvec3 p = eye - ray * (eye.z / ray.z);
            return vec2(float(p.x), float(p.y));
        };
        const auto shown = [&](const Rgb& irradiance) {
            return display_color(irradiance * 0.5F * kInvPi, exposure_scale(kMeanRadiance, 0.0F)) * 255.0F;
        };
        int compared = 0, wrong = 0, edges = 0, doubtful = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                if (x < kAxes * view_->devicePixelRatioF() && y > picture.height() - kAxes * view_->devicePixelRatioF()) {
                    continue; // the axes lie over the picture there
                }
                Rgb low(1e9F), high(-1e9F);
                bool inside = true;
                for (const dvec2& d : {dvec2(0, 0), dvec2(1, 1), dvec2(-1, 1), dvec2(1, -1), dvec2(-1, -1)}) {
                    const auto e = expected(layer, meet(x + 0.5 + 0.7 * d.x, y + 0.5 + 0.7 * d.y), back, shares);
                    inside = inside && e;
                    low = e ? glm::min(low, shown(*e)) : low;
                    high = e ? glm::max(high, shown(*e)) : high;
                }
                if (!inside) {
                    continue;
                }
                const QRgb pixel = picture.pixel(x, y);
                const Rgb is(float(qRed(pixel)), float(qGreen(pixel)), float(qBlue(pixel)));
                const bool edge = max_component(high - low) > 8.0F;
                edges += edge ? 1 : 0;
                const Rgb centre = shown(*expected(layer, meet(x + 0.5, y + 0.5), back, shares));
                bool off = false;
                for (int c = 0; c < 3; ++c) { // 1.5 of 255 is 1 to 2 % of the light
                    const float miss = std::abs(is[c] - centre[c]);
                    const bool good = edge ? is[c] >= low[c] - 4.0F && is[c] <= high[c] + 4.0F : miss <= 3.0F;
                    off = off || (!edge && miss > 1.5F);
                    if (!good && wrong++ < 5) {
                        ADD_FAILURE() << what << ": pixel " << x << ", " << y << " channel " << c << " is " << is[c]
                                      << ", not " << centre[c] << (edge ? " (edge)" : "");
                    }
                }
                doubtful += off ? 1 : 0;
                ++compared;
            }
        }
        EXPECT_EQ(wrong, 0) << what;
        if (wrong > 0) {
            const QString path = QDir::temp().filePath(QStringLiteral("light_map_%1.png").arg(QString::fromStdString(what)));
            std::printf("[ light map ] picture in %s\n", picture.save(path) ? qPrintable(path) : "no file");
        }
        EXPECT_LE(doubtful, compared / 20'000) << what << ": light bends within a pixel here and there, no more";
        EXPECT_LT(edges, compared / 5) << what;
        return compared;
    }
};

TEST_F(LightMaps, AreDrawnAsTheyAreEvaluatedOnBothSides) {
    const Scene scene = plane();
    const auto solution = lit_plane(scene, Maps::Both);
    const SurfaceLayer& layer = *solution->surfaces[0];
    struct View {
        const char* what;
        dvec3 eye;
    };
    for (const View& v : {View{"front", {0.1, 0.2, 2.4}}, View{"back", {0.1, 0.1, -2.4}}, View{"slanted", {1.6, -0.9, 1.3}},
                          View{"near", {0.3, 0.1, 0.25}}}) {
        open(scene, solution, v.eye, {0.1, 0.0, 0.0});
        EXPECT_GT(compare(layer, v.eye, {}, v.what), 50'000);
    }
}

TEST_F(LightMaps, ASideWithoutAMapShowsItsVertices) {
    const Scene scene = plane();
    const auto solution = lit_plane(scene, Maps::Front);
    const dvec3 behind(0.0, 0.1, -2.4);
    open(scene, solution, behind, {0, 0, 0});
    EXPECT_GT(compare(*solution->surfaces[0], behind, {}, "back without"), 50'000);
}

TEST_F(LightMaps, SurfacesWithoutOneAreDrawnAsBefore) {
    const Scene scene = plane();
    const auto solution = lit_plane(scene, Maps::None);
    const dvec3 eye(0.1, 0.2, 2.4);
    open(scene, solution, eye, {0, 0, 0});
    EXPECT_GT(compare(*solution->surfaces[0], eye, {}, "without"), 50'000);
}

TEST_F(LightMaps, SharesAreShownOneAtATime) {
    const Scene scene = plane();
    const auto solution = lit_plane(scene, Maps::Both);
    const dvec3 eye(0.1, 0.2, 2.4);
    open(scene, solution, eye, {0, 0, 0});
    for (const LightShares& shares : {LightShares{false, true}, LightShares{true, false}, LightShares{}}) {
        view_->set_light_shares(shares);
        EXPECT_TRUE(view_->light_shares() == shares);
        compare(*solution->surfaces[0], eye, shares, shares.direct ? (shares.diffuse ? "all" : "direct") : "diffuse");
    }
}

TEST_F(LightMaps, CausticTexturesAreAddedUpOnBothSides) {
    const Scene scene = plane();
    for (const Maps maps : {Maps::Both, Maps::Front}) {
        const auto solution = with_caustics(lit_plane(scene, maps));
        for (const double side : {1.0, -1.0}) {
            const dvec3 eye(0.1, 0.2, 2.4 * side);
            open(scene, solution, eye, {0, 0, 0});
            EXPECT_GT(compare(*solution->surfaces[0], eye, {}, side > 0 ? "caustics" : "caustics behind"), 50'000);
        }
    }
}

TEST_F(LightMaps, CausticsAreALayerOfTheirOwn) {
    const Scene scene = plane();
    const auto solution = with_caustics(lit_plane(scene, Maps::Both));
    const dvec3 eye(0.1, 0.2, 2.4);
    open(scene, solution, eye, {0, 0, 0});
    for (const LightShares& shares :
         {LightShares{false, false, true}, LightShares{true, true, false}, LightShares{true, false, true}, LightShares{}}) {
        view_->set_light_shares(shares);
        compare(*solution->surfaces[0], eye, shares, shares.caustic ? "with caustics" : "without caustics");
    }
    // By hand: outside, in one, where two add up.
    view_->set_light_shares({false, false, true});
    const SurfaceLayer& layer = *solution->surfaces[0];
    const auto light = [&](const vec2& uv) {
        return *expected(layer, uv / kTilesPerMetre - vec2(1.0F), false, {false, false, true});
    };
    const vec2 outside(0.9F, 0.5F), one(3.5F, 1.5F), both(2.6F, 1.5F);
    EXPECT_LT(light(outside).g, 40.0F) << "what the vertices hold";
    const auto& textures = layer.caustic_textures_front;
    EXPECT_GT(textures[0]->irradiance(both).r, 10.0F);
    EXPECT_GT(textures[1]->irradiance(both).g, 100.0F);
    EXPECT_GT(light(both).g, textures[0]->irradiance(both).g + textures[1]->irradiance(both).g);
    const auto green = [&](const vec2& uv) {
        const vec2 p = uv / kTilesPerMetre - vec2(1.0F);
        return qGreen(grab().pixel(QPoint(at({p.x, p.y, 0}))));
    };
    EXPECT_GT(green(one), green(outside) + 50);
}

TEST_F(LightMaps, CausticBoxesAreOutlinedWhenAsked) {
    const Scene scene = plane();
    const auto solution = with_caustics(lit_plane(scene, Maps::Both));
    open(scene, solution, {0.1, 0.2, 2.4}, {0, 0, 0});
    const auto picture = [&] {
        QTest::qWait(800);
        return grab();
    };
    const auto place = [&](const vec2& uv) {
        const vec2 p = uv / kTilesPerMetre - vec2(1.0F);
        return at({p.x, p.y, 0});
    };
    const QImage before = picture();
    view_->set_caustic_boxes(true);
    const QImage outlined = picture();
    // Across the middle of the first one's left edge there is white; in its middle all is as before.
    int whitest = 0;
    const QPoint edge(place({1.0F, 2.3F}));
    for (int d = -4; d <= 4; ++d) {
        const QRgb pixel = outlined.pixel(edge + QPoint(d, 0));
        whitest = std::max(whitest, std::min({qRed(pixel), qGreen(pixel), qBlue(pixel)}));
    }
    EXPECT_GT(whitest, 240);
    const QPoint middle(place({1.8F, 3.0F}));
    EXPECT_EQ(outlined.pixel(middle), before.pixel(middle));
    // They stay when the layer is switched off, and go when not asked for any more.
    view_->set_light_shares({true, true, false});
    EXPECT_NE(picture(), before);
    view_->set_light_shares({});
    view_->set_caustic_boxes(false);
    EXPECT_EQ(picture(), before);
}

TEST(CausticPlaces, NeverOverlapAndFillMostOfTheImage) {
    CausticList list;
    std::uint32_t seed = 7;
    double area = 0.0;
    for (int i = 0; i < 200; ++i) {
        auto texture = std::make_shared<CausticTexture>();
        seed = seed * 1664525U + 1013904223U;
        texture->width = 1 + (seed >> 24U);
        texture->height = 1 + ((seed >> 12U) & 127U);
        area += double(texture->width) * texture->height;
        list.push_back(texture);
    }
    const CausticPlaces places = place_caustics(list, 16384);
    ASSERT_EQ(places.places.size(), list.size());
    EXPECT_LT(double(places.width) * places.height, 1.4 * area);
    std::vector<std::uint8_t> used(std::size_t(places.width) * places.height);
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::uint32_t y = 0; y < list[i]->height; ++y) {
            for (std::uint32_t x = 0; x < list[i]->width; ++x) {
                ASSERT_LT(places.places[i].x + x, places.width);
                ASSERT_LT(places.places[i].y + y, places.height);
                std::uint8_t& texel = used[(places.places[i].y + y) * std::size_t(places.width) + places.places[i].x + x];
                ASSERT_EQ(texel, 0);
                texel = 1;
            }
        }
    }
    EXPECT_TRUE(place_caustics(list, 128).places.empty()) << "too large";
}

TEST_F(LightMaps, NewLightIsShownWhenItsMapsAreThereAndNothingWaitsForThem) {
    const Scene scene = plane();
    const dvec3 eye(0.1, 0.2, 2.4);
    open(scene, lit_plane(scene, Maps::Both), eye, {0, 0, 0});
    QTest::qWait(800); // the smoothed picture must not come in between
    const QImage before = grab();
    // 4 M samples: several turns of the event loop, on any machine.
    auto next = lit_plane(scene, Maps::Front);
    auto layer = std::make_shared<SurfaceLayer>(*next->surfaces[0]);
    auto large = std::make_shared<LightMap>(*layer->direct_map_front);
    large->image_height = 2048;
    std::vector<Rgb> wide(std::size_t(2048) * large->image_height, Rgb(5.0F));
    for (std::size_t y = 0; y < layer->direct_map_front->image_height; ++y) {
        std::copy_n(&layer->direct_map_front->image[y * large->image_width], large->image_width, &wide[y * 2048]);
    }
    large->image_width = 2048;
    large->image = std::move(wide);
    for (Rgb& e : large->image) {
        e *= 0.5F;
    }
    layer->direct_map_front = large;
    next->surfaces[0] = layer;
    engine_->load(next);
    double worst = 0.0, second = 0.0;
    int old_turns = 0;
    bool done = false;
    const QPoint sunny(at({0.9, 0.6, 0}));
    for (int turn = 0; turn < 20'000 && !done; ++turn) {
        const double start = thread_milliseconds();
        QCoreApplication::processEvents(QEventLoop::AllEvents, 1);
        const double spent = thread_milliseconds() - start;
        const QRgb now = view_->grabFramebuffer().pixel(sunny * view_->devicePixelRatioF());
        done = std::abs(qRed(now) - qRed(before.pixel(sunny))) > 2;
        old_turns += done ? 0 : 1;
        if (!done) { // the last one draws the new picture
            second = std::max(second, std::min(worst, spent));
            worst = std::max(worst, spent);
        }
    }
    std::printf("[ light map ] %d turns of the event loop, the worst %.1f ms\n", old_turns, worst);
    EXPECT_TRUE(done);
    EXPECT_GT(old_turns, 2) << "the old light stays meanwhile";
    // One turn may be made longer by the machine (pages that are touched for the first time).
    EXPECT_LT(second, 16.0) << "a slice is a few milliseconds";
    EXPECT_LT(worst, 50.0) << "all at once takes a hundred";
    compare(*layer, eye, {}, "exchanged");
}

} // namespace
} // namespace atrium::ui
