#include "fixture.h"

#include "engine/measure/light_range.h"
#include "ui/viewport/legend.h"

#include <QTest>

namespace atrium::ui {
namespace {

constexpr float kMiddle = 0.3F; ///< where on the quad pixels are read

/// A polygon 2 x 2 m in the plane z = 0.
Scene quad(const Material& material) {
    Scene scene;
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh->normals.assign(4, vec3(0, 0, 1));
    mesh->texcoords0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh->indices = {0, 1, 2, 0, 2, 3};
    mesh->parts = {{0, 6}};
    Node node;
    node.shape = scene.shapes.insert({"Quad", Mesh{mesh}, {}});
    node.materials = {scene.materials.insert(material)};
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

/// Black on the left half, white on the right one.
TextureId halves(Scene& scene) {
    auto image = std::make_shared<Image>();
    image->width = image->height = 64;
    image->channels = 3;
    for (int i = 0; i < 64 * 64; ++i) {
        image->bytes.insert(image->bytes.end(), 3, i % 64 < 32 ? std::uint8_t(0) : std::uint8_t(255));
    }
    Texture texture;
    texture.image = image;
    return scene.textures.insert(texture);
}

template <class Light> std::shared_ptr<Solution> lit(const Scene& scene, Light&& light) {
    auto solution = light_scene(scene, light);
    solution->mean_radiance = 100.0; // a scene without any light is shown in a working light
    return solution;
}

class FalseColors : public ViewportFixture {
protected:
    void expect_amount(const QPoint& point, const FalseColor& scale, double amount, const char* what) {
        const QRgb pixel = grab().pixel(point);
        const Rgb expected = 255.0F * false_color(scale, amount);
        EXPECT_NEAR(qRed(pixel), expected.r, 2.0) << what;
        EXPECT_NEAR(qGreen(pixel), expected.g, 2.0) << what;
        EXPECT_NEAR(qBlue(pixel), expected.b, 2.0) << what;
    }
    [[nodiscard]] int lightness(const dvec3& world) { return qGray(grab().pixel(at(world))); }
};

TEST_F(FalseColors, IlluminanceHasTheColourOfItsLuxAndNoTexture) {
    Material material;
    material.base_color = Rgb(0.9F, 0.2F, 0.1F);
    material.emissive_color = Rgb(1.0F);
    material.emissive_strength = 5000.0F; // what shines itself is not what arrives
    Scene scene = quad(material);
    scene.materials.find(scene.nodes.find(scene.roots[0])->materials[0])->base_color_texture.texture = halves(scene);
    // 0.2126 * 600 + 0.7152 * 400 + 0.0722 * 100 = 420.86 lux.
    const auto light = lit(scene, [](const dvec3&, const dvec3&) { return Rgb(600.0F, 400.0F, 100.0F); });
    open(scene, light, {0, 0, 3}, {0, 0, 0});
    for (const bool logarithmic : {false, true}) {
        const FalseColor scale{LightQuantity::Illuminance, logarithmic, 10.0, 1000.0, false};
        view_->set_false_color(scale);
        expect_amount(at({-kMiddle, 0.2, 0}), scale, 420.86, "on black");
        expect_amount(at({kMiddle, 0.2, 0}), scale, 420.86, "on white");
    }
    view_->set_false_color({{LightQuantity::Illuminance, false, 0.0, 100.0, false}});
    expect_amount(at({kMiddle, 0.2, 0}), *view_->false_color(), 100.0, "beyond the upper end");
}

TEST_F(FalseColors, LuminanceIsWhatLeavesTheSurface) {
    Material material;
    material.base_color = Rgb(0.5F);
    material.emissive_color = Rgb(1.0F);
    material.emissive_strength = 70.0F;
    const Scene scene = quad(material);
    const auto light = lit(scene, [](const dvec3&, const dvec3&) { return Rgb(600.0F); });
    open(scene, light, {0, 0, 3}, {0, 0, 0});
    const FalseColor scale{LightQuantity::Luminance, false, 0.0, 300.0, false};
    view_->set_false_color(scale);
    view_->set_exposure(3.0F); // never reaches amounts
    expect_amount(at({kMiddle, 0.2, 0}), scale, 70.0 + 0.5 * 600.0 / kPiD, "L = L0 + rho E / pi");
}

TEST_F(FalseColors, FollowsTheSwitchesOfTheLight) {
    const Scene scene = quad({});
    auto light = lit(scene, [](const dvec3&, const dvec3&) { return Rgb(300.0F); });
    auto layer = std::make_shared<SurfaceLayer>(*light->surfaces[0]);
    layer->direct_front.assign(layer->mesh->positions.size(), Rgb(200.0F));
    light->surfaces[0] = layer;
    open(scene, light, {0, 0, 3}, {0, 0, 0});
    const FalseColor scale{LightQuantity::Illuminance, false, 0.0, 1000.0, false};
    view_->set_false_color(scale);
    expect_amount(at({kMiddle, 0.2, 0}), scale, 500.0, "all");
    view_->set_light_shares({false, true, false});
    expect_amount(at({kMiddle, 0.2, 0}), scale, 200.0, "direct light alone");
    view_->set_light_shares({});
    const QRgb told = grab().pixel(at({kMiddle, 0.2, 0}));
    view_->set_false_color(std::nullopt);
    EXPECT_NE(grab().pixel(at({kMiddle, 0.2, 0})), told) << "the picture is back";
}

TEST_F(FalseColors, ContoursRunWhereTheLightIsRound) {
    const Scene scene = quad({});
    // 100 lux on the left edge, 500 on the right one.
    const auto light = lit(scene, [](const dvec3& p, const dvec3&) { return Rgb(float(300.0 + 200.0 * p.x)); });
    open(scene, light, {0, 0, 3}, {0, 0, 0});
    FalseColor scale{LightQuantity::Illuminance, true, 100.0, 1000.0, false};
    view_->set_false_color(scale);
    const QImage plain = grab();
    scale.contours = true;
    view_->set_false_color(scale);
    const QImage lines = grab();
    const auto change = [&](double lux) { // the largest within a pixel, since the line need not meet its middle
        int largest = 0;
        for (int dx = -1; dx <= 1; ++dx) {
            const QPoint point = at({(lux - 300.0) / 200.0, 0.4, 0}) + QPoint(dx, 0);
            largest = std::max(largest, std::abs(qGray(lines.pixel(point)) - qGray(plain.pixel(point))));
        }
        return largest;
    };
    for (const double lux : {200.0, 300.0}) { // of 100, 200, 300, 500 and 1000
        EXPECT_GT(change(lux), 40) << lux;
    }
    for (const double lux : {140.0, 245.0, 350.0, 400.0, 450.0}) {
        EXPECT_LE(change(lux), 2) << lux;
    }
}

TEST_F(FalseColors, WhatHasNoIlluminanceIsGreyAndGlassIsLookedThrough) {
    Material metal;
    metal.metallic = 1.0F;
    metal.roughness = 0.2F;
    Scene scene = quad(metal);
    Material glass;
    glass.transmission = 1.0F;
    glass.roughness = 0.0F;
    const auto even = [](const dvec3&, const dvec3&) { return Rgb(300.0F); };
    open(scene, lit(scene, even), {0, 0, 3}, {0, 0, 0});
    const FalseColor scale{LightQuantity::Illuminance, false, 0.0, 500.0, false};
    view_->set_false_color(scale);
    const QColor grey(grab().pixel(at({kMiddle, 0.2, 0})));
    EXPECT_LT(grey.saturation(), 4) << "no colour of the scale";
    EXPECT_GT(grey.lightness(), 60);
    // A matt quad behind a pane.
    scene = quad({});
    Node pane = *scene.nodes.find(scene.roots[0]);
    pane.materials = {scene.materials.insert(glass)};
    pane.transform.translation = dvec3(0.0, 0.0, 1.0);
    scene.roots.push_back(scene.nodes.insert(pane));
    TearDown();
    open(scene, lit(scene, even), {0, 0, 3}, {0, 0, 0});
    view_->set_false_color(scale);
    expect_amount(at({kMiddle, 0.2, 0}), scale, 300.0, "through glass");
}

TEST_F(FalseColors, TheLegendStandsOutInLightAndDarkColours) {
    const Scene scene = quad({});
    open(scene, lit(scene, [](const dvec3&, const dvec3&) { return Rgb(300.0F); }), {0, 0, 3}, {0, 0, 0});
    for (const bool dark : {false, true}) {
        QPalette palette;
        palette.setColor(QPalette::Base, dark ? QColor(25, 25, 25) : QColor(250, 250, 250));
        palette.setColor(QPalette::Text, dark ? QColor(235, 235, 235) : QColor(10, 10, 10));
        view_->setPalette(palette);
        const FalseColor scale{LightQuantity::Illuminance, true, 100.0, 1000.0, false};
        view_->set_false_color(scale);
        const QImage picture = grab();
        const QSizeF size = Legend(scale, view_->font(), palette).size();
        const QRect area(picture.width() - 12 - int(size.width()), (picture.height() - int(size.height())) / 2,
                         int(size.width()), int(size.height()));
        // Its ground is nearly the palette's, and there is ink of the other lightness on it.
        EXPECT_NEAR(QColor(picture.pixel(area.center() + QPoint(area.width() / 2 - 4, 0))).lightness(), dark ? 25 : 250, 30);
        int ink = 0;
        for (int y = area.top(); y < area.bottom(); ++y) {
            for (int x = area.left() + area.width() / 2; x < area.right(); ++x) {
                const int lightness = QColor(picture.pixel(x, y)).lightness();
                ink += (dark ? lightness > 180 : lightness < 80) ? 1 : 0;
            }
        }
        EXPECT_GT(ink, 60) << (dark ? "dark" : "light");
        if (const QByteArray folder = qgetenv("ATRIUM_PICTURES"); !folder.isEmpty()) {
            picture.save(QString::fromLocal8Bit(folder) +
                         (dark ? QStringLiteral("/legend_dark.png") : QStringLiteral("/legend_light.png")));
        }
    }
}

TEST(LegendTest, WritesTheEndsAndRoundAmountsBetween) {
    const Legend legend({LightQuantity::Illuminance, true, 100.0, 1000.0, false}, QFont(), QPalette());
    const std::vector<double> expected{100.0, 200.0, 300.0, 500.0, 1000.0};
    ASSERT_EQ(legend.values().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(legend.values()[i], expected[i], 1e-9);
    }
    const Legend odd({LightQuantity::Illuminance, false, 37.0, 1234.0, false}, QFont(), QPalette());
    EXPECT_EQ(odd.values().front(), 37.0);
    EXPECT_EQ(odd.values().back(), 1234.0);
    EXPECT_GE(odd.values().size(), 5U);
    EXPECT_EQ(amount_text(0.0), QStringLiteral("0"));
    EXPECT_EQ(amount_text(0.5), QLocale().toString(0.5));
    EXPECT_EQ(amount_text(312.4), QStringLiteral("312"));
    EXPECT_EQ(amount_text(12345.0), QLocale().toString(12300.0, 'f', 0));
}

} // namespace
} // namespace atrium::ui
