// The library and what it does in the window, by mouse, keys and drops.
#include "engine/io/scene_file.h"
#include "engine/layers/surface_layer.h"
#include "engine/scene/problems.h"
#include "ui/document/insert_commands.h"
#include "ui/document/scene_mime.h"
#include "ui/panels/library_model.h"
#include "ui/panels/library_panel.h"
#include "ui/panels/thumbnail.h"
#include "window_fixture.h"

#include <QApplication>
#include <QDragEnterEvent>
#include <QLineEdit>
#include <QListView>

namespace atrium::ui {
namespace {

const LibraryItem& shipped(const char* key) {
    for (const LibraryItem& item : shipped_library()) {
        if (item.key == QLatin1StringView(key)) {
            return item;
        }
    }
    ADD_FAILURE() << key;
    return shipped_library().front();
}

/// Lumens that leave an object's emitting surfaces and lights.
double flux(const Scene& scene) {
    double sum = 0;
    for (const NodeId id : scene.in_tree_order()) {
        const Node* node = scene.nodes.find(id);
        if (const Light* light = scene.lights.find(node->light)) {
            // By rings of directions, without the formula that the library uses.
            constexpr int kRings = 20000;
            for (int i = 0; i < kRings; ++i) {
                const double c = -1 + 2 * (i + 0.5) / kRings;
                const double share = light->kind == Light::Kind::Spot ? double(spot_falloff(*light, float(c))) : 1.0;
                sum += 2 * kPiD * (2.0 / kRings) * share * double(luminance(light->color) * light->intensity);
            }
        }
        const Material* material = node->shape ? scene.material_of(*node, 0) : nullptr;
        if (material != nullptr && material->emits()) {
            const Geometry& g = scene.shapes.find(node->shape)->geometry;
            double area = 0;
            if (const auto* sphere = std::get_if<Sphere>(&g)) {
                area = 4 * kPiD * double(sphere->radius) * double(sphere->radius);
            } else if (const auto* disc = std::get_if<Disc>(&g)) {
                area = kPiD * double(disc->radius) * double(disc->radius);
            } else {
                const Box3 box = local_bounds(g);
                area = double(box.max.x - box.min.x) * double(box.max.y - box.min.y);
            }
            sum += kPiD * area * double(luminance(material->emitted_radiance()));
        }
    }
    return sum;
}

TEST(Library, HasEverySectionAndLampsSendOutWhatTheirNamesSay) {
    std::array<int, 4> count{};
    for (const LibraryItem& item : shipped_library()) {
        ++count[std::size_t(item.section)];
        EXPECT_TRUE(item.ships());
        ASSERT_EQ(bool(item.scene), item.section != LibrarySection::Furniture) << item.key.toStdString();
        if (item.section == LibrarySection::Lamps) {
            const QString lumens = item.name.section(QStringLiteral(" lm"), 0, 0).section(QLatin1Char(' '), -1);
            EXPECT_NEAR(flux(*item.scene), lumens.toDouble(), 0.04 * lumens.toDouble()) << item.name.toStdString();
        }
    }
    EXPECT_GE(count[std::size_t(LibrarySection::Materials)], 25);
    EXPECT_GE(count[std::size_t(LibrarySection::Lamps)], 8);
    EXPECT_GE(count[std::size_t(LibrarySection::Shapes)], 6);
    EXPECT_GE(count[std::size_t(LibrarySection::Furniture)], 12);
}

TEST(Library, FurnitureThatShipsStandsOnItsFeetAndIsMadeOfLikelyMaterials) {
    for (const LibraryItem& item : shipped_library()) {
        if (item.section != LibrarySection::Furniture) {
            continue;
        }
        const auto scene = read_shipped_furniture(item);
        ASSERT_TRUE(scene) << scene.error().message();
        ASSERT_EQ(scene->roots.size(), 1U) << "one click takes all of it";
        EXPECT_EQ(scene->nodes.find(scene->roots[0])->name, item.name.toStdString());
        const DBox3 box = scene->bounds();
        EXPECT_NEAR(box.min.y, 0.0, 0.005) << item.name.toStdString();
        EXPECT_GT(glm::length(box.size()), 0.1) << item.name.toStdString();
        EXPECT_LT(glm::length(box.size()), 3.0) << item.name.toStdString();
        EXPECT_LT(std::abs(box.centre().x) + std::abs(box.centre().z), 0.35) << item.name.toStdString();
        EXPECT_TRUE(find_problems(*scene).size() <= 1) << "but that it has no light";
        scene->materials.for_each([&](MaterialId, const Material& m) {
            EXPECT_LE(m.transmission > 0 ? 0.0F : luminance(m.base_color), 0.82F) << m.name;
            EXPECT_FALSE(m.emits()) << m.name;
        });
        const Shape* shape = scene->shapes.find(scene->nodes.find(scene->roots[0])->shape);
        ASSERT_NE(shape, nullptr);
        for (std::size_t part = 0; part < part_count(*shape); ++part) {
            const DisplayMesh mesh = make_display_mesh(*shape, part);
            int inside_out = 0;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                const vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                           c = mesh.positions[mesh.indices[i + 2]];
                inside_out += glm::dot(glm::cross(b - a, c - a), mesh.normals[mesh.indices[i]]) < 0.0F ? 1 : 0;
            }
            EXPECT_EQ(inside_out, 0) << item.name.toStdString() << " part " << part;
        }
    }
}

TEST(Library, PaintsReflectTheirLightReflectanceValue) {
    int paints = 0;
    for (const LibraryItem& item : shipped_library()) {
        const int at = int(item.name.indexOf(QStringLiteral("LRV ")));
        if (item.is_material() && at >= 0) {
            const Material* material = item.scene->materials.find(material_in(*item.scene));
            ASSERT_NE(material, nullptr);
            EXPECT_NEAR(100 * luminance(material->base_color), item.name.mid(at + 4).toDouble(), 0.05)
                << item.name.toStdString();
            ++paints;
        }
    }
    EXPECT_GE(paints, 20);
}

TEST(Library, BlackBodiesHaveTheColoursOfTheStandard) {
    // CIE illuminant A, 2856 K: x 0.44757, y 0.40745; from linear Rec. 709 back to chromaticity.
    const Rgb c = black_body_color(2856);
    const double X = 0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b;
    const double Z = 0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b;
    EXPECT_NEAR(X / (X + 1.0 + Z), 0.44757, 0.002);
    EXPECT_NEAR(1.0 / (X + 1.0 + Z), 0.40745, 0.002);
    EXPECT_NEAR(luminance(c), 1.0F, 1e-4F);
    EXPECT_NEAR(luminance(black_body_color(1000)), 1.0F, 1e-4F) << "outside the range: the nearest end";
}

TEST(Library, ErrorsNameTheEntry) {
    const auto bad = [](const char* json) {
        const auto read = parse_library(json);
        EXPECT_FALSE(read);
        return read ? std::string() : read.error().message();
    };
    EXPECT_NE(bad(R"({"materials":[{"key":"red","name":"Red","color":"#FF0000","lrv":90}]})").find("red"), std::string::npos)
        << "pure red cannot reflect 90 %";
    EXPECT_NE(
        bad(R"({"lamps":[{"key":"l","name":"L","mount":"stand","parts":[{"shape":"sphere","radius":-1}]}]})").find("radius"),
        std::string::npos);
    EXPECT_NE(bad(R"({"shapes":[{"key":"s","name":"S","mount":"sideways","parts":[]}]})").find("sideways"),
              std::string::npos);
    bad("{");
}

TEST(Placement, ObjectsRestAndTurnWithFaces) {
    const DBox3 box{dvec3(-1, 0, -0.5), dvec3(1, 2, 0.5)};
    const auto at = [&](Mount mount, const dvec3& normal, const dvec3& p) {
        return dvec3(place_on(box, mount, dvec3(1, 2, 3), normal) * dvec4(p, 1.0));
    };
    EXPECT_NEAR(glm::length(at(Mount::Stand, {0, 1, 0}, {0, 0, 0}) - dvec3(1, 2, 3)), 0.0, 1e-12);
    for (const dvec3& n :
         {dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(0, 0, -1), glm::normalize(dvec3(1, 1, 1))}) {
        EXPECT_NEAR(glm::length(at(Mount::Face, n, {0, 0, 0}) - dvec3(1, 2, 3)), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(turn_to_face(n) * dvec3(0, 1, 0) - n), 0.0, 1e-12);
    }
    EXPECT_NEAR((turn_to_face({1, 0, 0}) * dvec3(0, 0, -1)).y, 1.0, 1e-12) << "pictures hang upright";
    EXPECT_NEAR(glm::length(turn_to_face({0, 1, 0}) * dvec3(0, 0, -1) - dvec3(0, 0, -1)), 0.0, 1e-12);
}

TEST(Thumbnails, ShowSomethingAndTellMaterialsApart) {
    const QImage lamp = object_thumbnail(*shipped("floor_lamp").scene, 64);
    int drawn = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            drawn += qAlpha(lamp.pixel(x, y)) > 128 ? 1 : 0;
        }
    }
    EXPECT_GT(drawn, 60);
    EXPECT_EQ(qAlpha(lamp.pixel(1, 32)), 0);
    const auto picture = [](const char* key) {
        const Scene& scene = *shipped(key).scene;
        return material_thumbnail(*scene.materials.find(material_in(scene)), 48);
    };
    EXPECT_NE(picture("oak_35"), picture("walnut_12"));
    EXPECT_NE(picture("mirror"), picture("paint_white_90"));
}

class LibraryWindowTest : public WindowTest {
protected:
    /// A drag of a library entry over the view, as the window system reports it.
    void drag_in(const char* key, const std::vector<QPoint>& way, bool drop) {
        ViewportWidget* view = &window->viewport();
        SceneMime mime(std::make_shared<const LibraryItem>(shipped(key)));
        QDragEnterEvent enter(way.front(), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(view, &enter);
        EXPECT_TRUE(enter.isAccepted());
        for (const QPoint& point : way) {
            QDragMoveEvent move(point, Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
            QApplication::sendEvent(view, &move);
            settle();
        }
        if (drop) {
            QDropEvent event(QPointF(way.back()), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
            QApplication::sendEvent(view, &event);
        } else {
            QDragLeaveEvent leave;
            QApplication::sendEvent(view, &leave);
        }
        settle();
    }
};

TEST_F(LibraryWindowTest, ADroppedBoxStandsUnderTheCursorAsOneEntry) {
    open_sample();
    const dvec3 spot = window->viewport().placement_point();
    const Scene before = scene();
    drag_in("box", {at(spot) + QPoint(60, 0), at(spot)}, false);
    EXPECT_TRUE(scene() == before) << "left without a drop";
    EXPECT_EQ(entries(), 0);
    drag_in("box", {at(spot) + QPoint(60, 0), at(spot) + QPoint(30, 0), at(spot)}, true);
    EXPECT_EQ(entries(), 1);
    const NodeId box = window->document().selection()->active();
    EXPECT_EQ(node(box).name, "Box");
    const DBox3 bounds = scene().world_bounds(box);
    EXPECT_NEAR(bounds.min.y, spot.y, 1e-4);
    EXPECT_NEAR(bounds.centre().x, spot.x, 0.03);
    EXPECT_NEAR(bounds.centre().z, spot.z, 0.03);
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == before);
}

TEST_F(LibraryWindowTest, APendantGoesToTheCeilingAboveTheCursor) {
    open_sample();
    const dvec3 spot = window->viewport().placement_point();
    drag_in("pendant_globe", {at(spot)}, true);
    const NodeId lamp = window->document().selection()->active();
    ASSERT_EQ(node(lamp).name, "Pendant globe");
    EXPECT_NEAR(scene().subtree_bounds(lamp).max.y, 2.7, 0.02) << "the room is 2.7 m high";
    EXPECT_NEAR((node(lamp).transform.rotation * dvec3(0, 1, 0)).y, -1.0, 1e-9);
}

TEST_F(LibraryWindowTest, AMaterialDropsOnTheObjectUnderTheCursor) {
    open_sample();
    const NodeId vase = named("Vase");
    select(vase);
    trigger(ActionId::FrameSelection);
    window->document().selection()->clear();
    settle();
    const Scene before = scene();
    drag_in("oak_35", {at(scene().world_bounds(vase).centre())}, true);
    EXPECT_EQ(entries(), 1);
    ASSERT_NE(scene().material_of(node(vase), 0), nullptr);
    EXPECT_EQ(scene().material_of(node(vase), 0)->name, "Oak, LRV 35");
    const std::size_t materials = scene().materials.size();
    select(named("Shelf"));
    drag_in("oak_35", {at(scene().world_bounds(vase).centre())}, true);
    EXPECT_EQ(scene().materials.size(), materials) << "the same material is not added twice";
    EXPECT_EQ(entries(), 1) << "it has the material already";
    trigger(ActionId::Undo);
    EXPECT_TRUE(scene() == before);
}

TEST_F(LibraryWindowTest, KeysReachAndPlaceEntries) {
    open_sample();
    trigger(ActionId::Library);
    settle();
    auto* search = window->findChild<QLineEdit*>(QStringLiteral("library_search"));
    ASSERT_TRUE(search != nullptr && search->isVisible());
    QTest::keyClicks(search, QStringLiteral("floor 1500"));
    ASSERT_EQ(window->library().view()->model()->rowCount(), 1);
    QTest::keyClick(search, Qt::Key_Return);
    QTest::keyClick(window->library().view(), Qt::Key_Return);
    settle();
    EXPECT_EQ(entries(), 1);
    EXPECT_EQ(node(window->document().selection()->active()).name, "Floor lamp");
    const NodeId bowl = named("Bowl");
    select(bowl);
    search->setText(QStringLiteral("walnut"));
    QTest::keyClick(search, Qt::Key_Down);
    QTest::keyClick(window->library().view(), Qt::Key_Return);
    EXPECT_EQ(scene().material_of(node(bowl), 0)->name, "Walnut, LRV 12");
}

TEST_F(LibraryWindowTest, FurnitureIsThereAtTheFirstStart) {
    open_sample();
    trigger(ActionId::Library);
    window->library().show_section(LibrarySection::Furniture);
    QListView* view = window->library().view();
    ASSERT_GE(view->model()->rowCount(), 12);
    const QModelIndex chair = window->library().view_index(QStringLiteral(":/library/furniture/chair.glb"));
    ASSERT_TRUE(chair.isValid());
    EXPECT_EQ(chair.data().toString(), QStringLiteral("Chair"));
    view->setFocus();
    view->setCurrentIndex(chair);
    QTest::keyClick(view, Qt::Key_Return); // waits for its file where that has not been read yet
    ASSERT_TRUE(QTest::qWaitFor([&] { return entries() == 1; }, 10000));
    const NodeId id = window->document().selection()->active();
    EXPECT_EQ(node(id).name, "Chair");
    EXPECT_NEAR(scene().subtree_bounds(id).size().y, 0.82, 0.02);
    window->library().set_folder(folder.path()); // one's own models come beside it
    EXPECT_TRUE(window->library().view_index(QStringLiteral(":/library/furniture/chair.glb")).isValid());
    window->library().set_folder({});
}

TEST_F(LibraryWindowTest, AFolderOfModelsBecomesFurniture) {
    Scene chair = *shipped("floor_lamp").scene;
    const QString path = folder.filePath(QStringLiteral("Reading chair.glb"));
    ASSERT_TRUE(write_scene(path.toStdString(), chair));
    open_sample();
    trigger(ActionId::Library);
    window->library().show_section(LibrarySection::Furniture);
    window->library().set_folder(folder.path());
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->library().view_index(path).isValid(); }));
    QListView* view = window->library().view();
    view->setFocus();
    view->setCurrentIndex(window->library().view_index(path));
    QTest::keyClick(view, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return entries() == 1; }, 10000));
    EXPECT_EQ(node(window->document().selection()->active()).name, "Reading chair");
    window->library().set_folder({});
}

} // namespace
} // namespace atrium::ui
