#include "fixture.h"

#include "engine/view/tone.h"
#include "ui/tools/gizmo.h"

#include <QSignalSpy>
#include <QTest>
#include <QUndoStack>

namespace atrium::ui {
namespace {

const Rgb kIrradiance(900.0F, 700.0F, 500.0F);

Rgb even_light(const dvec3& /*point*/, const dvec3& /*normal*/) { return kIrradiance; }

void expect_color(QRgb pixel, const Rgb& expected, const char* what) {
    EXPECT_NEAR(qRed(pixel), 255.0F * expected.r, 2.0) << what;
    EXPECT_NEAR(qGreen(pixel), 255.0F * expected.g, 2.0) << what;
    EXPECT_NEAR(qBlue(pixel), 255.0F * expected.b, 2.0) << what;
}

/// A polygon 2 x 2 m in the plane z = 0 with texture coordinates as glTF has them, and one material.
Scene one_quad(const Material& material) {
    Scene scene;
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh->normals.assign(4, vec3(0, 0, 1));
    mesh->texcoords0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}}; // v = 0 on top
    mesh->texcoords1 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}; // the other way up
    mesh->indices = {0, 1, 2, 0, 2, 3};
    mesh->parts = {{0, 6}};
    Node node;
    node.name = "Quad";
    node.shape = scene.shapes.insert({"Quad", Mesh{mesh}, {}});
    node.materials = {scene.materials.insert(material)};
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

/// Two by two texels: red, green on top; blue, white below. Given twice as large, so that their middles are flat.
TextureId add_texture(Scene& scene) {
    auto image = std::make_shared<Image>();
    image->width = image->height = 64;
    image->channels = 3;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool right = x >= 32;
            const bool low = y >= 32;
            image->bytes.push_back(right == low ? 200 : 0);
            image->bytes.push_back(right ? 200 : 0);
            image->bytes.push_back(low ? 200 : 0);
        }
    }
    Texture texture;
    texture.image = image;
    return scene.textures.insert(texture);
}

std::shared_ptr<Solution> lit(const Scene& scene) {
    auto solution = light_scene(scene, even_light);
    solution->mean_radiance = 150.0;
    return solution;
}

Rgb expected_of(const Rgb& rho, const Rgb& emitted = Rgb(0.0F), float ev = 0.0F) {
    return display_color(emitted + rho * kIrradiance * kInvPi, exposure_scale(150.0, ev));
}

class Viewport : public ViewportFixture {};

TEST_F(Viewport, PixelsAreDisplayColorOfTheRadiance) {
    Material material;
    material.base_color = Rgb(0.6F, 0.4F, 0.2F);
    const Scene scene = one_quad(material);
    open(scene, lit(scene), {0, 0, 3}, {0, 0, 0});
    expect_color(grab().pixel(at({0.3, 0.2, 0})), expected_of(material.base_color), "automatic exposure");
    view_->set_exposure(1.5F);
    expect_color(grab().pixel(at({0.3, 0.2, 0})), expected_of(material.base_color, Rgb(0.0F), 1.5F), "1.5 stops more");
}

TEST_F(Viewport, EmissionIsAddedAndVertexColoursMultiply) {
    Material material;
    material.base_color = Rgb(0.5F);
    material.emissive_color = Rgb(1.0F, 0.5F, 0.0F);
    material.emissive_strength = 80.0F;
    Scene scene = one_quad(material);
    Shape& shape = *scene.shapes.find(scene.nodes.find(scene.roots[0])->shape);
    auto mesh = std::make_shared<MeshData>(*std::get<Mesh>(shape.geometry).data);
    mesh->colors.assign(4, vec3(1.0F, 0.25F, 0.5F));
    shape.geometry = Mesh{mesh};
    open(scene, lit(scene), {0, 0, 3}, {0, 0, 0});
    expect_color(grab().pixel(at({0.3, 0.2, 0})), expected_of(Rgb(0.5F, 0.125F, 0.25F), Rgb(80.0F, 40.0F, 0.0F)), "sum");
}

TEST_F(Viewport, TexturesAreTheRightWayUp) {
    const float c = srgb_to_linear(200.0F / 255.0F);
    struct Case {
        const char* what;
        int texcoord;
        vec2 offset;
        Rgb top_left, top_right, bottom_left;
    };
    const Rgb red(c, 0, 0);
    const Rgb green(0, c, 0);
    const Rgb blue(0, 0, c);
    const Rgb white(c);
    for (const Case& k : {Case{"first set", 0, {0, 0}, red, green, blue}, Case{"second set", 1, {0, 0}, blue, white, red},
                          Case{"shifted half a picture", 0, {0.5F, 0}, green, red, white}}) {
        Material material;
        material.base_color = Rgb(1.0F);
        Scene scene = one_quad(material);
        Material& m = *scene.materials.find(scene.nodes.find(scene.roots[0])->materials[0]);
        m.base_color_texture.texture = add_texture(scene);
        m.base_color_texture.texcoord = k.texcoord;
        m.base_color_texture.offset = k.offset;
        open(scene, lit(scene), {0, 0, 3}, {0, 0, 0});
        const QImage picture = grab();
        expect_color(picture.pixel(at({-0.5, 0.5, 0})), expected_of(k.top_left), k.what);
        expect_color(picture.pixel(at({0.5, 0.5, 0})), expected_of(k.top_right), k.what);
        expect_color(picture.pixel(at({-0.5, -0.5, 0})), expected_of(k.bottom_left), k.what);
    }
}

TEST_F(Viewport, BacksOfSingleSidedSurfacesAreNotDrawn) {
    for (const bool double_sided : {false, true}) {
        Material material;
        material.base_color = Rgb(0.9F, 0.1F, 0.1F);
        material.double_sided = double_sided;
        const Scene scene = one_quad(material);
        open(scene, lit(scene), {0, 0, -3}, {0, 0, 0});
        const QRgb pixel = grab().pixel(at({0.3, 0.2, 0}));
        EXPECT_EQ(qRed(pixel) > qGreen(pixel) + 50, double_sided);
        look({0, 0, 3}, {0, 0, 0});
        EXPECT_GT(qRed(grab().pixel(at({0.3, 0.2, 0}))), 100);
    }
}

TEST_F(Viewport, BackSideShowsItsOwnLightAlsoWhenMirrored) {
    for (const double sign : {1.0, -1.0}) {
        Material material;
        material.base_color = Rgb(0.5F);
        material.double_sided = true;
        Scene scene = one_quad(material);
        scene.nodes.find(scene.roots[0])->transform.scale.x = sign;
        auto solution = lit(scene);
        auto layer = std::make_shared<SurfaceLayer>(*solution->surfaces[0]);
        layer->irradiance_back.assign(layer->mesh->positions.size(), Rgb(100.0F));
        solution->surfaces[0] = layer;
        open(scene, solution, {0, 0, 3}, {0, 0, 0});
        expect_color(grab().pixel(at({0.3, 0.2, 0})), expected_of(Rgb(0.5F)), "front");
        look({0, 0, -3}, {0, 0, 0});
        expect_color(grab().pixel(at({0.3, 0.2, 0})), display_color(Rgb(50.0F) * kInvPi, exposure_scale(150.0, 0.0F)),
                     "back");
    }
}

TEST_F(Viewport, SurveyCoordinatesShowTheSamePicture) {
    Scene scene = small_room(nullptr);
    open(scene, lit(scene), {1.5, 1.7, 2.2}, {0, 0.5, 0});
    const QImage near_zero = grab();
    const dvec3 offset(4500000.0, 0.0, 5300000.0);
    for (const NodeId id : scene.roots) {
        scene.nodes.find(id)->transform.translation += offset;
    }
    open(scene, lit(scene), offset + dvec3(1.5, 1.7, 2.2), offset + dvec3(0, 0.5, 0));
    const QImage far_away = grab();
    int different = 0;
    for (int y = 0; y < near_zero.height(); ++y) {
        for (int x = 0; x < near_zero.width(); ++x) {
            different += std::abs(qGreen(near_zero.pixel(x, y)) - qGreen(far_away.pixel(x, y))) > 8 ? 1 : 0;
        }
    }
    EXPECT_LT(different, near_zero.width() * near_zero.height() / 500);
}

TEST_F(Viewport, ExposureStaysWhileOneEdits) {
    NodeId box;
    const Scene scene = small_room(&box);
    open(scene, lit(scene), {1.5, 1.7, 2.2}, {0, 0.5, 0});
    const QRgb before = grab().pixel(at({-1.0, 2.0, -2.5}));
    auto brighter = std::make_shared<Solution>(*lit(scene));
    brighter->mean_radiance = 300.0;
    QSignalSpy changed(engine_.get(), &EngineLink::solution_changed);
    engine_->load(brighter);
    if (changed.isEmpty()) {
        ASSERT_TRUE(changed.wait(5000));
    }
    EXPECT_EQ(grab().pixel(at({-1.0, 2.0, -2.5})), before);
}

TEST_F(Viewport, MovedHiddenAndDeletedNodesAnswerAtOnce) {
    NodeId box;
    const Scene scene = small_room(&box);
    open(scene, lit(scene), {0, 2.5, 2.4}, {0, 0, 0});
    const QPoint top = at({0, 0.8, 0});
    const Rgb cabinet = expected_of(Rgb(0.6F, 0.6F, 0.65F));
    const Rgb floor = expected_of(Rgb(0.45F, 0.35F, 0.25F));
    expect_color(grab().pixel(top), cabinet, "in place");
    Transform away = document_->scene().nodes.find(box)->transform;
    away.translation.x = 1.4;
    ASSERT_TRUE(document_->apply({SetTransform{box, away}}, QStringLiteral("Move")));
    expect_color(grab().pixel(top), floor, "moved away, lit by the old solution");
    document_->undo_stack()->undo();
    expect_color(grab().pixel(top), cabinet, "back again");
    Node hidden = *document_->scene().nodes.find(box);
    hidden.visible = false;
    ASSERT_TRUE(document_->apply({SetNode{box, hidden}}, QStringLiteral("Hide")));
    expect_color(grab().pixel(top), floor, "hidden");
    document_->undo_stack()->undo();
    ASSERT_TRUE(document_->apply({RemoveNode{box}}, QStringLiteral("Delete")));
    expect_color(grab().pixel(top), floor, "deleted");
}

TEST_F(Viewport, MirrorsShowTheRoomAndFollowIt) {
    Scene scene = small_room(nullptr);
    Material material;
    material.base_color = Rgb(0.95F);
    material.metallic = 1.0F;
    material.roughness = 0.0F;
    Node node;
    node.name = "Mirror";
    node.shape = scene.shapes.insert({"Mirror", Polygon{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, {}}, {}});
    node.materials = {scene.materials.insert(material)};
    node.transform.translation = dvec3(0.0, 1.5, -2.45);
    scene.roots.push_back(scene.nodes.insert(node));
    // From here the mirror's middle shows the red wall on the left at z = 2.2.
    open(scene, lit(scene), {1.5, 1.5, 1.0}, {0.0, 1.5, -2.45});
    QTest::qWait(1500);
    const QImage picture = grab();
    const QRgb red = picture.pixel(QPoint(320, 240));
    EXPECT_GT(qRed(red), 2 * qGreen(red));
    // A flat mirror is exact: radiance of the wall times the mirror's reflectance.
    expect_color(red, display_color(Rgb(0.95F) * Rgb(0.7F, 0.2F, 0.15F) * kIrradiance * kInvPi, exposure_scale(150.0, 0.0F)),
                 "the red wall in the mirror");
    // The cabinet stands in front of the mirror's plane and is seen where its mirror image lies.
    look({-1.0, 1.5, 1.5}, {0.0, 1.2, -2.45});
    const dvec3 top(0.3, 0.8, 0.2);
    const dvec3 image(top.x, top.y, -2.45 - (top.z + 2.45));
    const dvec3 eye(-1.0, 1.5, 1.5);
    const dvec3 on_mirror = eye + (image - eye) * ((-2.45 - eye.z) / (image.z - eye.z));
    ASSERT_LT(std::abs(on_mirror.x), 0.45);
    ASSERT_LT(std::abs(on_mirror.y - 1.5), 0.45);
    expect_color(grab().pixel(at(on_mirror)),
                 display_color(Rgb(0.95F) * Rgb(0.6F, 0.6F, 0.65F) * kIrradiance * kInvPi, exposure_scale(150.0, 0.0F)),
                 "the cabinet's top in the mirror");
    look({1.5, 1.5, 1.0}, {0.0, 1.5, -2.45});
    Material green;
    green.base_color = Rgb(0.1F, 0.7F, 0.1F);
    const Scene& now = document_->scene();
    const NodeId left =
        *std::find_if(now.roots.begin(), now.roots.end(), [&](NodeId id) { return now.nodes.find(id)->name == "Left"; });
    ASSERT_TRUE(
        document_->apply({SetResource<Material>{now.nodes.find(left)->materials[0], green}}, QStringLiteral("Paint")));
    QTest::qWait(1500);
    const QRgb repainted = grab().pixel(QPoint(320, 240));
    EXPECT_GT(qGreen(repainted), 2 * qRed(repainted));
}

TEST_F(Viewport, ClickSelectsTogglesAndClears) {
    NodeId box;
    const Scene scene = small_room(&box);
    open(scene, lit(scene), {1.0, 1.7, 2.2}, {0, 0.5, 0});
    const QPoint on_box = at({0.1, 0.8, 0.1});
    QTest::mouseClick(view_.get(), Qt::LeftButton, Qt::NoModifier, on_box);
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box});
    const QPoint on_wall = at({-2.0, 1.5, -1.5});
    QTest::mouseClick(view_.get(), Qt::LeftButton, Qt::ControlModifier, on_wall);
    ASSERT_EQ(document_->selection()->nodes().size(), 2U);
    EXPECT_EQ(document_->scene().nodes.find(document_->selection()->active())->name, "Left");
    QTest::mouseClick(view_.get(), Qt::LeftButton, Qt::ShiftModifier, on_wall);
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box});
    look({10.0, 1.7, 12.2}, {20, 0.5, 20});
    QTest::mouseClick(view_.get(), Qt::LeftButton, Qt::NoModifier, QPoint(320, 240));
    EXPECT_TRUE(document_->selection()->nodes().empty());
}

TEST_F(Viewport, LightsWithoutASurfaceCanBePicked) {
    Scene scene = small_room(nullptr);
    Node lamp;
    lamp.name = "Lamp";
    lamp.light = scene.lights.insert({});
    lamp.transform.translation = dvec3(0.5, 2.0, -1.0);
    const NodeId id = scene.nodes.insert(lamp);
    scene.roots.push_back(id);
    open(scene, lit(scene), {1.0, 1.7, 2.2}, {0, 1.0, 0});
    ASSERT_FALSE(grab().isNull());
    QTest::mouseClick(view_.get(), Qt::LeftButton, Qt::NoModifier, at(lamp.transform.translation));
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{id});
}

TEST_F(Viewport, BoxSelectionTakesWhatLiesInside) {
    NodeId box;
    const Scene scene = small_room(&box);
    open(scene, lit(scene), {0, 8.0, 3.0}, {0, 0, 0}); // from above, through the ceiling
    drag(at({-0.8, 0.8, -0.8}), at({0.9, 0.0, 0.9}));
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box});
}

TEST_F(Viewport, DoubleClickFramesAndWheelGoesToTheCursor) {
    NodeId box;
    const Scene scene = small_room(&box);
    open(scene, lit(scene), {1.5, 1.7, 2.2}, {0, 0.5, 0});
    const dvec3 before(view_->camera().to_world[3]);
    const dvec3 corner(0.4, 0.8, 0.4);
    const QPoint point = at(corner);
    QWheelEvent wheel(QPointF(point), view_->mapToGlobal(QPointF(point)), QPoint(), QPoint(0, 120), Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(view_.get(), &wheel);
    const dvec3 after(view_->camera().to_world[3]);
    EXPECT_LT(glm::length(after - corner), glm::length(before - corner) - 0.1);
    EXPECT_LE((at(corner) - point).manhattanLength(), 3);
    QTest::mouseDClick(view_.get(), Qt::LeftButton, Qt::NoModifier, at({0.1, 0.8, 0.1}));
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box});
    EXPECT_LE((at({0, 0.4, 0}) - QPoint(320, 240)).manhattanLength(), 3);
}

// ---- tools ----

class Tools : public ViewportFixture {
protected:
    void SetUp() override {
        Scene scene = small_room(&box_);
        // A parent that turns and scales: world motion must be answered in the parent's terms.
        Node group;
        group.name = "Group";
        group.transform.rotation = glm::angleAxis(kPiD / 2, dvec3(0, 1, 0));
        group.transform.scale = dvec3(2.0);
        const NodeId parent = scene.nodes.insert(group);
        Node& cabinet = *scene.nodes.find(box_);
        cabinet.parent = parent;
        cabinet.transform.translation = dvec3(0.0, 0.2, 0.0);
        cabinet.transform.scale = dvec3(0.5);
        scene.nodes.find(parent)->children.push_back(box_);
        std::erase(scene.roots, box_);
        scene.roots.push_back(parent);
        open(scene, lit(scene), {1.2, 1.9, 2.3}, {0, 0.5, 0});
        document_->selection()->set({box_});
    }
    [[nodiscard]] dvec3 place() const { return dvec3(document_->scene().world_matrix(box_)[3]); }
    [[nodiscard]] const Transform& local() const { return document_->scene().nodes.find(box_)->transform; }
    /// World point on a handle, given as a share of the gizmo's length.
    [[nodiscard]] dvec3 on_handle(const dvec3& share) const {
        CameraController camera;
        camera.set_viewport(view_->width(), view_->height());
        camera.set_camera(view_->camera());
        return place() + share * (Gizmo::kLength * camera.pixel_size(place()));
    }
    [[nodiscard]] QPoint handle(const dvec3& share) const { return at(on_handle(share)); }
    void type_and_confirm(const char* text) {
        for (const char* c = text; *c != 0; ++c) {
            QTest::keyClick(view_.get(), *c);
        }
        QTest::keyClick(view_.get(), Qt::Key_Return);
        QTest::mouseRelease(view_.get(), Qt::LeftButton);
    }
    NodeId box_;
};

TEST_F(Tools, DraggingTheXArrowMovesAlongXAsOneUndoEntry) {
    view_->set_tool(ToolKind::Move);
    const Transform start = local();
    const dvec3 from = place();
    const dvec3 grabbed = on_handle({0.7, 0, 0});
    drag(at(grabbed), at(grabbed + dvec3(0.5, 0, 0)));
    EXPECT_NEAR(place().x, from.x + 0.5, 0.02); // two pixels' rounding
    EXPECT_NEAR(place().y, from.y, 1e-9);
    EXPECT_NEAR(place().z, from.z, 1e-9);
    EXPECT_EQ(document_->undo_stack()->count(), 1);
    document_->undo_stack()->undo();
    EXPECT_EQ(local(), start);
}

TEST_F(Tools, HandlesStandAlongTheWorldOrTheObjectsOwnAxes) {
    view_->set_tool(ToolKind::Move);
    Snapping own = view_->snapping();
    own.own_axes = true;
    // The group turns by 90 degrees, the box in it by 30 more.
    Transform turned = local();
    turned.rotation = glm::angleAxis(kPiD / 6, dvec3(0, 1, 0));
    ASSERT_TRUE(document_->apply({SetTransform{box_, turned}}, QStringLiteral("Turn")));
    const dvec3 x(glm::normalize(document_->scene().world_matrix(box_)[0]));
    const dvec3 from = place();
    view_->set_snapping(own);
    settle();
    const QPoint grab_point = handle(x * 0.7);
    drag(grab_point, grab_point + QPoint(30, -10), Qt::NoModifier, false);
    type_and_confirm("0.5");
    EXPECT_LT(glm::length(place() - (from + 0.5 * x)), 1e-9) << "along its own x";
    own.own_axes = false;
    view_->set_snapping(own);
    settle();
    const dvec3 before = place();
    const QPoint again = handle(dvec3(0.7, 0, 0));
    drag(again, again + QPoint(30, 0), Qt::NoModifier, false);
    type_and_confirm("0.25");
    EXPECT_LT(glm::length(place() - (before + dvec3(0.25, 0, 0))), 1e-9) << "along the world's";
}

TEST_F(Tools, EscapeInTheMiddleOfADragRestores) {
    view_->set_tool(ToolKind::Move);
    const Transform start = local();
    const QPoint grab_point = handle({0.7, 0, 0});
    drag(grab_point, grab_point + QPoint(80, 10), Qt::NoModifier, false);
    EXPECT_NE(local(), start);
    QTest::keyClick(view_.get(), Qt::Key_Escape);
    EXPECT_EQ(local(), start);
    QTest::mouseRelease(view_.get(), Qt::LeftButton, Qt::NoModifier, grab_point + QPoint(80, 10));
    EXPECT_EQ(local(), start);
    EXPECT_EQ(document_->undo_stack()->count(), 0);
    EXPECT_FALSE(document_->in_gesture());
}

TEST_F(Tools, ControlSnapsAndATypedNumberIsExact) {
    view_->set_tool(ToolKind::Move);
    QSignalSpy messages(view_.get(), &ViewportWidget::message);
    const dvec3 from = place();
    QPoint grab_point = handle({0.7, 0, 0});
    drag(grab_point, grab_point + QPoint(47, 8), Qt::ControlModifier);
    const double tenths = (place().x - from.x) * 10.0;
    EXPECT_GT(std::abs(tenths), 0.5);
    EXPECT_NEAR(tenths, std::round(tenths), 1e-6);
    ASSERT_FALSE(messages.isEmpty());
    EXPECT_TRUE(messages.last().at(0).toString().startsWith(QStringLiteral("x +")))
        << qPrintable(messages.last().at(0).toString());

    const double before = place().y;
    grab_point = handle({0, 0.7, 0});
    drag(grab_point, grab_point + QPoint(0, -30), Qt::NoModifier, false);
    type_and_confirm("1,25");
    EXPECT_NEAR(place().y, before + 1.25, 1e-9);
    EXPECT_FALSE(document_->in_gesture());
}

TEST_F(Tools, RotatingAboutYKeepsThePlaceAndTurnsInTheWorld) {
    view_->set_tool(ToolKind::Rotate);
    const dvec3 from = place();
    const dvec3 x_before(glm::normalize(document_->scene().world_matrix(box_)[0]));
    // On the ring about y, on the side towards the eye.
    const dvec3 arm = glm::normalize(dvec3(1.2, 0, 2.3));
    const QPoint grab_point = handle(arm * 0.9);
    drag(grab_point, grab_point + QPoint(40, 0), Qt::NoModifier, false);
    type_and_confirm("90");
    const dvec3 x_after(glm::normalize(document_->scene().world_matrix(box_)[0]));
    const dvec3 expected = glm::angleAxis(kPiD / 2, dvec3(0, 1, 0)) * x_before;
    EXPECT_LT(glm::length(x_after - expected), 1e-9);
    EXPECT_LT(glm::length(place() - from), 1e-9);
    EXPECT_EQ(document_->undo_stack()->count(), 1);
}

TEST_F(Tools, ScalingOneAxisAndAllOfThem) {
    view_->set_tool(ToolKind::Scale);
    const dvec3 start = local().scale;
    const QPoint middle = handle({0, 0, 0});
    drag(middle, middle + QPoint(30, 0), Qt::NoModifier, false);
    type_and_confirm("2");
    EXPECT_LT(glm::length(local().scale - start * 2.0), 1e-9);
    const QPoint up = handle({0, 0.8, 0});
    drag(up, up + QPoint(0, -40), Qt::ControlModifier);
    EXPECT_GT(local().scale.y, start.y * 2.0);
    EXPECT_NEAR(local().scale.x, start.x * 2.0, 1e-9);
}

TEST_F(Tools, LockedNodesStayWhereTheyAre) {
    Node locked = *document_->scene().nodes.find(box_);
    locked.locked = true;
    ASSERT_TRUE(document_->apply({SetNode{box_, locked}}, QStringLiteral("Lock")));
    view_->set_tool(ToolKind::Move);
    const Transform start = local();
    const QPoint on_box = at(place() + dvec3(0, 0.35, 0.1));
    drag(on_box, on_box + QPoint(60, 20));
    EXPECT_EQ(local(), start);
    EXPECT_EQ(document_->undo_stack()->count(), 1);
}

TEST_F(Tools, DraggingTheBodySlidesItOnTheFloor) {
    document_->selection()->clear();
    view_->set_tool(ToolKind::Move);
    const dvec3 from = place();
    const QPoint on_box = at({0.1, 0.8, 0.1});
    drag(on_box, at({0.5, 0.8, -0.4}));
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box_});
    EXPECT_NEAR(place().y, from.y, 1e-9);
    EXPECT_NEAR(place().x - from.x, 0.4, 0.03);
    EXPECT_NEAR(place().z - from.z, -0.5, 0.03);
    EXPECT_EQ(document_->undo_stack()->count(), 1);
}

TEST_F(Tools, TheSelectToolMovesWhatIsSelected) {
    ASSERT_EQ(view_->tool(), ToolKind::Select);
    const Transform start = local();
    const dvec3 from = place();
    const QPoint on_box = at({0.1, 0.8, 0.1});
    const QPoint to = at({0.5, 0.8, -0.4});
    QMouseEvent over(QEvent::MouseMove, QPointF(on_box), view_->mapToGlobal(QPointF(on_box)), Qt::NoButton, Qt::NoButton,
                     Qt::NoModifier);
    QApplication::sendEvent(view_.get(), &over);
    settle();
    EXPECT_EQ(view_->cursor().shape(), Qt::SizeAllCursor) << "it says what a drag from there does";
    // A hand that shakes while it clicks moves nothing.
    drag(on_box, on_box + QPoint(2, 2));
    EXPECT_EQ(local(), start);
    EXPECT_EQ(document_->undo_stack()->count(), 0);
    drag(on_box, to, Qt::NoModifier, false);
    EXPECT_NE(local(), start);
    QTest::keyClick(view_.get(), Qt::Key_Escape);
    EXPECT_EQ(local(), start);
    QTest::mouseRelease(view_.get(), Qt::LeftButton, Qt::NoModifier, to);
    EXPECT_EQ(document_->undo_stack()->count(), 0);
    drag(on_box, to);
    EXPECT_NEAR(place().y, from.y, 1e-9);
    EXPECT_NEAR(place().x - from.x, 0.4, 0.03);
    EXPECT_NEAR(place().z - from.z, -0.5, 0.03);
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box_});
    EXPECT_EQ(document_->undo_stack()->count(), 1);
    document_->undo_stack()->undo();
    EXPECT_EQ(local(), start);
}

TEST_F(Tools, TheSelectToolSpansABoxFromWhereNothingIsSelected) {
    look({0, 8.0, 3.0}, {0, 0, 0}); // from above, through the ceiling
    const Scene before = document_->scene();
    document_->selection()->clear();
    drag(at({0.1, 0.8, 0.1}), at({0.6, 0.8, 0.5})); // begins on the box, which is not selected
    EXPECT_TRUE(document_->scene() == before);
    drag(at({-0.8, 0.8, -0.8}), at({0.9, 0.0, 0.9}));
    EXPECT_EQ(document_->selection()->nodes(), std::vector<NodeId>{box_});
    drag(at({0.1, 0.8, 0.1}), at({0.6, 0.8, 0.5}), Qt::ShiftModifier); // extends a selection
    EXPECT_TRUE(document_->scene() == before);
    // Locked things stay: the same drag is a box again.
    Node locked = *document_->scene().nodes.find(box_);
    locked.locked = true;
    ASSERT_TRUE(document_->apply({SetNode{box_, locked}}, QStringLiteral("Lock")));
    const Transform start = local();
    drag(at({0.1, 0.8, 0.1}), at({0.6, 0.8, 0.5}));
    EXPECT_EQ(local(), start);
    EXPECT_EQ(document_->undo_stack()->count(), 1);
}

TEST_F(Tools, WalkingStaysOnTheFloorAndEscapeLeaves) {
    look({0.0, 1.1, 2.0}, {0.0, 1.1, 0.0});
    view_->set_walk_mode(true);
    QTest::qWait(1500);
    EXPECT_NEAR(view_->camera().to_world[3].y, 1.6, 0.02);
    const double z = view_->camera().to_world[3].z;
    QTest::keyPress(view_.get(), Qt::Key_S);
    QTest::qWait(200);
    QTest::keyRelease(view_.get(), Qt::Key_S);
    EXPECT_GT(view_->camera().to_world[3].z, z + 0.05);
    QSignalSpy left(view_.get(), &ViewportWidget::walk_mode_changed);
    QTest::keyClick(view_.get(), Qt::Key_Escape);
    EXPECT_FALSE(view_->walk_mode());
    EXPECT_EQ(left.count(), 1);
}

TEST_F(Tools, PlacementPointIsOnTheFloorInView) {
    look({0.0, 1.6, 2.3}, {1.2, 0.0, 0.0});
    const dvec3 on_floor = view_->placement_point();
    EXPECT_NEAR(on_floor.y, 0.0, 1e-6);
    EXPECT_NEAR(on_floor.x, 1.2, 0.05);
    look({0.0, 1.6, 2.3}, {-1.2, 1.8, -2.5}); // at the back wall
    EXPECT_NEAR(view_->placement_point().y, 0.0, 1e-6);
}

} // namespace
} // namespace atrium::ui
