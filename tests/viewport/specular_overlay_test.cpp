// Mirrors and glass of the view at rest are those of a still.
#include "engine/io/scene_file.h"
#include "engine/measure/compare.h"
#include "engine/solver/gi_engine.h"
#include "engine/view/specular_pixels.h"
#include "engine/view/tone.h"
#include "fixture.h"

#include <QTest>

#include <functional>

namespace atrium::ui {
namespace {

Picture linear(const QImage& image) {
    Picture out{image.width(), image.height(), {}};
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QRgb c = image.pixel(x, y);
            out.pixels.emplace_back(srgb_to_linear(float(qRed(c)) / 255.0F), srgb_to_linear(float(qGreen(c)) / 255.0F),
                                    srgb_to_linear(float(qBlue(c)) / 255.0F));
        }
    }
    return out;
}

/// The middle three fifths each way: the view has its axes in a corner, within 80 pixels of its side, a still has none.
Picture middle(const Picture& picture) {
    const int left = picture.width / 5;
    const int top = picture.height / 5;
    Picture out{picture.width - 2 * left, picture.height - 2 * top, {}};
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            out.pixels.push_back(picture.pixels[std::size_t(y + top) * std::size_t(picture.width) + std::size_t(x + left)]);
        }
    }
    return out;
}

/// A room whose walls differ in light, with something of `material` in it.
Scene room_with(const Material& material, bool ball) {
    NodeId box;
    Scene scene = small_room(&box);
    Shape shape;
    if (ball) {
        shape.geometry = Sphere{0.6F};
    } else {
        shape.geometry = Polygon{{{-0.8F, -0.6F}, {0.8F, -0.6F}, {0.8F, 0.6F}, {-0.8F, 0.6F}}, {}};
    }
    Node node;
    node.name = "specular";
    node.shape = scene.shapes.insert(shape);
    node.materials = {scene.materials.insert(material)};
    node.transform.translation = {0.2, 1.4, -1.2};
    node.transform.rotation = glm::quat_cast(glm::dmat3(1.0)); // a polygon faces +z: the eye
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

Rgb wall_light(const dvec3& p, const dvec3& n) {
    return Rgb(float(200.0 + 150.0 * std::sin(3.0 * p.x) + 100.0 * n.y), float(220.0 + 120.0 * std::sin(4.0 * p.y)),
               float(180.0 + 140.0 * std::sin(2.0 * p.z)));
}

class SpecularOverlayTest : public ViewportFixture {
protected:
    struct Figures {
        double rasterised = 0; ///< FLIP of the picture without traced pixels
        double traced = 0;
    };
    /// The picture when nothing changes any more: the finest pixels come last.
    static QImage at_rest(const std::function<QImage()>& seen) {
        QImage now = seen();
        int same = 0;
        for (int i = 0; i < 40 && same < 4; ++i) {
            QTest::qWait(300);
            const QImage next = seen();
            same = next == now ? same + 1 : 0;
            now = next;
        }
        return now;
    }
    /// Share of the pixels in the middle that differ plainly: not only along edges that are smoothed at rest.
    static double unlike(const QImage& a, const QImage& b) {
        const Picture x = middle(linear(a)), y = middle(linear(b));
        int count = 0;
        for (std::size_t i = 0; i < x.pixels.size(); ++i) {
            count += max_component(glm::abs(x.pixels[i] - y.pixels[i])) > 0.03F ? 1 : 0;
        }
        return count / double(x.pixels.size());
    }
    Figures compare(const Scene& scene) {
        auto solution = light_scene(scene, wall_light);
        solution->mean_radiance = 50.0;
        return compare(scene, solution, {0.0, 1.6, 2.2}, {0.1, 1.4, -1.0});
    }
    /// Compares the view with the still of its camera, before and after the rays.
    Figures compare(const Scene& scene, const std::shared_ptr<Solution>& solution, const dvec3& eye, const dvec3& target) {
        open(scene, solution, eye, target);
        StillOptions options;
        view_->resize(420, 320);
        QTest::qWait(50);
        const QSize size = view_->grabFramebuffer().size(); // device pixels
        options.width = size.width();
        options.height = size.height();
        Picture still = render_still(scene, *solution, view_->camera(), options, RunContext{});
        const float scale = exposure_scale(solution->mean_radiance, view_->exposure());
        for (Rgb& c : still.pixels) {
            c = filmic(c * scale);
        }
        const auto seen = [&] { return view_->grabFramebuffer().convertToFormat(QImage::Format_RGB32); };
        Figures out;
        look(eye, target);
        out.rasterised = flip(middle(linear(seen())), middle(still));
        out.traced = flip(middle(linear(at_rest(seen))), middle(still));
        RecordProperty("flip", QString::number(out.traced).toStdString());
        return out;
    }
};

TEST_F(SpecularOverlayTest, AMirrorIsThatOfTheStill) {
    Material m;
    m.base_color = Rgb(0.9F);
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    const Figures f = compare(room_with(m, false));
    EXPECT_LT(f.traced, f.rasterised);
    EXPECT_LT(f.traced, 0.05);
}

TEST_F(SpecularOverlayTest, ABallOfGlassIsThatOfTheStill) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.thickness = 1.0F;
    const Figures f = compare(room_with(m, true));
    EXPECT_LT(f.traced, f.rasterised);
    EXPECT_LT(f.traced, 0.05);
}

TEST_F(SpecularOverlayTest, GlossyMetalIsThatOfTheStill) {
    Material m;
    m.base_color = Rgb(0.9F, 0.7F, 0.4F);
    m.metallic = 1.0F;
    m.roughness = 0.2F;
    const Figures f = compare(room_with(m, true));
    EXPECT_LT(f.traced, f.rasterised);
    EXPECT_LT(f.traced, 0.05);
}

TEST_F(SpecularOverlayTest, AWindowPaneIsThatOfTheStill) {
    Material m;
    m.base_color = Rgb(0.8F, 0.95F, 0.9F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.double_sided = true;
    const Figures f = compare(room_with(m, false));
    EXPECT_LT(f.traced, f.rasterised);
    EXPECT_LT(f.traced, 0.05);
}

TEST_F(SpecularOverlayTest, ScenesThatShipAreThoseOfTheirStills) {
    for (const char* name : {"glass-ball", "ring", "sun-mirror", "lamp"}) {
        SCOPED_TRACE(name);
        const auto loaded = read_scene(std::string(ATRIUM_SOURCE_DIR "/scenes/") + name + "/" + name + ".glb");
        ASSERT_TRUE(loaded) << loaded.error().message();
        GiEngine engine;
        SolveOptions wish;
        wish.quality = SolverSettings::Quality::Draft;
        const auto solved = engine.solve(loaded->scene, wish, RunContext{});
        ASSERT_TRUE(solved) << solved.error().message();
        auto solution = std::make_shared<Solution>(**solved);
        solution->revision = 1U << 30U; // newer than any edit of the test
        const auto camera = find_camera(loaded->scene, "");
        ASSERT_TRUE(camera);
        const dvec3 eye(camera->to_world[3]);
        const Figures f = compare(loaded->scene, solution, eye, eye - dvec3(camera->to_world[2]));
        EXPECT_LT(f.traced, 0.05) << "rasterised " << f.rasterised;
        TearDown();
    }
}

TEST_F(SpecularOverlayTest, GoesWhileTheCameraMovesAndComesBackAtRest) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.thickness = 1.0F;
    const Scene scene = room_with(m, true);
    open(scene, light_scene(scene, wall_light), {0.0, 1.6, 2.2}, {0.1, 1.4, -1.0});
    const QImage moving = grab();
    const QImage rest = at_rest([&] { return grab(); });
    EXPECT_GT(unlike(rest, moving), 0.05);
    const QRgb corner = rest.pixel(5, 5);
    EXPECT_EQ(corner, moving.pixel(5, 5)) << "what is matt is the rasteriser's";
    look({0.0, 1.6, 2.1}, {0.1, 1.4, -1.0});
    look({0.0, 1.6, 2.2}, {0.1, 1.4, -1.0});
    EXPECT_GT(unlike(grab(), rest), 0.05) << "an old picture over a new view would be wrong everywhere";
}

TEST(SpecularPixels, AreOfSpecularSurfacesAloneAndSayWhatAStillSays) {
    Material m;
    m.base_color = Rgb(0.9F);
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    const Scene scene = room_with(m, false);
    const auto solution = light_scene(scene, wall_light);
    EXPECT_TRUE(SpecularView::any(scene));
    NodeId box;
    EXPECT_FALSE(SpecularView::any(small_room(&box)));
    ViewCamera camera;
    camera.to_world[3] = dvec4(0.2, 1.4, 1.8, 1.0);
    camera.lens.yfov = 1.0F;
    StillOptions options;
    options.width = 96;
    options.height = 64;
    const StillLayers still = render_layers(scene, *solution, camera, options, RunContext{});
    std::vector<SpecularPixels> got;
    SpecularView(scene, *solution).look(camera, 96, 64, 2, LightShares{}, RunContext{}, [&](SpecularPixels pixels) {
        got.push_back(std::move(pixels));
    });
    ASSERT_EQ(got.size(), 3U);
    EXPECT_EQ(got[0].samples, 1);
    EXPECT_EQ(got[1].samples, 4);
    EXPECT_FALSE(got[1].complete);
    EXPECT_TRUE(got[2].complete);
    const SpecularPixels& last = got[2];
    int covered = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const std::size_t i = std::size_t(y) * 96 + std::size_t(x);
            const int u = x - last.left;
            const int v = y - last.top;
            const bool inside = u >= 0 && v >= 0 && u < last.width && v < last.height;
            const vec4 p = inside ? last.pixels[std::size_t(v) * std::size_t(last.width) + std::size_t(u)] : vec4(0.0F);
            const Rgb seen = still.specular.pixels[i];
            EXPECT_EQ(p.w > 0.0F, luminance(seen) > 0.0F);
            if (p.w == 1.0F) {
                ++covered;
                EXPECT_NEAR(luminance(Rgb(p)), luminance(seen), 1e-4F * luminance(seen));
            }
        }
    }
    EXPECT_GT(covered, 500);
}

} // namespace
} // namespace atrium::ui
