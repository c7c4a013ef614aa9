// Overlays by which the light is inspected: what is drawn and where, with a real solution of a small room.
#include "fixture.h"

#include "engine/debug/element_view.h"
#include "engine/solver/gi_engine.h"
#include "ui/viewport/inspection_figures.h"

#include <QTest>

#include <fmt/format.h>

namespace atrium::ui {
namespace {

constexpr dvec3 kEye{0.0, 1.5, 2.2};
constexpr dvec3 kTarget{0.0, 0.6, -1.0};

class Inspection : public ViewportFixture {
protected:
    void SetUp() override {
        scene_ = small_room(&box_);
        Light light;
        light.intensity = 200.0F;
        Node lamp;
        lamp.name = "Lamp";
        lamp.light = scene_.lights.insert(light);
        lamp.transform.translation = {0.6, 2.5, 0.4};
        scene_.roots.push_back(scene_.nodes.insert(lamp));
        options_.quality = SolverSettings::Quality::Draft;
        options_.keep_for_updates = true;
        options_.keep_insides = true;
        options_.revision = 1U << 30U;
        auto solved = engine_of_test_.solve(scene_, options_, {});
        ASSERT_TRUE(solved);
        solution_ = std::make_shared<Solution>(**solved);
    }
    /// What opens the room, with overlays on and their figures made.
    void open_with(const InspectionChoice& choice) {
        open(scene_, solution_, kEye, kTarget);
        turn_on(choice);
    }
    void turn_on(const InspectionChoice& choice) {
        view_->set_inspection(choice);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !view_->inspector().busy(); }, 20000));
        settle();
    }
    /// How many pixels of a square about a point differ.
    static int changed(const QImage& a, const QImage& b, const QPoint& middle, int half) {
        int out = 0;
        for (int y = -half; y <= half; ++y) {
            for (int x = -half; x <= half; ++x) {
                const QRgb p = a.pixel(middle + QPoint(x, y)), q = b.pixel(middle + QPoint(x, y));
                out += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) + std::abs(qBlue(p) - qBlue(q)) > 24
                           ? 1
                           : 0;
            }
        }
        return out;
    }
    [[nodiscard]] NodeId named(const char* name) const {
        NodeId found;
        scene_.nodes.for_each([&](NodeId id, const Node& n) { found = n.name == name ? id : found; });
        return found;
    }
    [[nodiscard]] dvec3 world(NodeId node, const vec3& p) const {
        return dvec3(scene_.world_matrix(node) * dvec4(dvec3(p), 1.0));
    }
    /// Whether nothing stands between the eye and a point, by the boxes of the room alone.
    [[nodiscard]] bool in_sight(const dvec3& point) const {
        const DBox3 box = scene_.world_bounds(box_);
        for (int i = 1; i < 200; ++i) {
            const dvec3 p = kEye + (point - kEye) * (0.005 * i);
            if (p == glm::clamp(p, box.min - 0.03, box.max + 0.03)) {
                return false;
            }
        }
        return true;
    }
    [[nodiscard]] bool on_screen(const QPoint& p) const {
        return p.x() > 120 && p.y() > 120 && p.x() < view_->width() - 120 && p.y() < view_->height() - 20;
    }

    Scene scene_;
    NodeId box_;
    GiEngine engine_of_test_;
    SolveOptions options_;
    std::shared_ptr<Solution> solution_;
};

TEST_F(Inspection, BordersOfElementsAreDrawnWhereTheyAreAndHiddenOnesAreNot) {
    open(scene_, solution_, kEye, kTarget);
    const QImage plain = grab_pixels();
    InspectionChoice choice;
    choice.elements = true;
    turn_on(choice);
    const QImage lines = grab_pixels();
    const auto elements = view_elements(*solution_);
    std::string missing;
    int seen = 0, drawn = 0, middles = 0, touched = 0;
    for (const SurfaceElements& s : elements->surfaces) {
        if (s.node != named("Floor") && s.node != named("Back")) {
            continue;
        }
        for (const auto& line : s.lines) {
            const dvec3 p = world(s.node, 0.5F * (line[0] + line[1]));
            if (glm::dot(p - kEye, kTarget - kEye) > 0.0 && in_sight(p) && on_screen(at(p))) {
                ++seen;
                const bool there = changed(plain, lines, pixel_at(p), 1) > 0;
                drawn += there ? 1 : 0;
                missing += there ? "" : fmt::format(" ({:.2f} {:.2f} {:.2f})", p.x, p.y, p.z);
            }
        }
        for (std::size_t i = 0; i < s.triangles.size(); ++i) { // large enough to have a middle
            const auto& t = s.triangles[i];
            const dvec3 p = world(s.node, 0.4F * t[0] + 0.3F * t[1] + 0.3F * t[2]);
            const QPoint q = at(p);
            if (on_screen(q) && in_sight(p) && glm::dot(p - kEye, kTarget - kEye) > 0.0 &&
                elements->leaves[s.triangle_leaf[i]].area > 0.2F) {
                ++middles;
                touched += changed(plain, lines, pixel_at(p), 0);
            }
        }
    }
    EXPECT_GT(seen, 20);
    EXPECT_EQ(drawn, seen) << "a line at every border, where floor and wall meet too; missing:" << missing;
    EXPECT_GT(middles, 2);
    EXPECT_LE(touched, middles / 4) << "and nothing within large elements";
    // The floor's lines below and behind the box do not come through its front.
    InspectionChoice none;
    turn_on(none);
    view_->set_inspection(choice);
    document_->selection()->set({named("Floor")});
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view_->inspector().busy(); }, 20000));
    const QImage floor_only = grab_pixels();
    document_->selection()->set({});
    EXPECT_EQ(changed(plain, floor_only, pixel_at({0.0, 0.35, 0.4}), 12), 0) << "hidden lines are removed";
    turn_on(none);
    EXPECT_EQ(changed(plain, grab_pixels(), QPoint(320, 240) * view_->devicePixelRatioF(), 100), 0) << "off is off";
}

TEST_F(Inspection, TheMeshOfASelectionIsDrawnOnItAlone) {
    open(scene_, solution_, kEye, kTarget);
    document_->selection()->set({named("Back")});
    const QImage plain = grab();
    InspectionChoice choice;
    choice.elements = true;
    turn_on(choice);
    const QImage lines = grab();
    const auto elements = view_elements(*solution_);
    int on_wall = 0, on_floor = 0;
    for (const SurfaceElements& s : elements->surfaces) {
        for (const auto& line : s.lines) {
            const dvec3 p = world(s.node, 0.5F * (line[0] + line[1]));
            const bool floor = s.node == named("Floor") && p.z > -2.0;
            if ((floor || s.node == named("Back")) && glm::dot(p - kEye, kTarget - kEye) > 0.0 && in_sight(p) &&
                on_screen(at(p))) {
                (floor ? on_floor : on_wall) += changed(plain, lines, at(p), 1) > 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(on_wall, 5);
    EXPECT_EQ(on_floor, 0);
    EXPECT_TRUE(view_->inspector().words(scene_).value(0).contains(
        QLocale().toString(qulonglong(count_leaves(*elements, {named("Back")})))));
}

TEST_F(Inspection, AClickShowsTheLinksOfTheElementThere) {
    InspectionChoice choice;
    choice.links = true;
    open_with(choice);
    const dvec3 place(0.9, 0.0, -1.9);
    const QImage before = grab();
    QTest::mouseClick(view_.get(), Qt::LeftButton, {}, at(place));
    QTest::mouseMove(view_.get(), {5, 400});
    settle();
    const auto& links = view_->inspector().links();
    ASSERT_TRUE(links);
    EXPECT_EQ(links->receiver.node, named("Floor"));
    EXPECT_LT(glm::length(links->receiver.centre - place), 2.0);
    ASSERT_GT(links->links.size(), 10U);
    const QStringList words = view_->inspector().words(scene_);
    EXPECT_TRUE(words.join(QLatin1Char('\n')).contains(QLocale().toString(qulonglong(links->links.size())))) << "how many";
    const QImage after = grab();
    int drawn = 0, looked = 0;
    for (const ElementLink& link : links->links) {
        for (const double along : {0.2, 0.35, 0.5, 0.65}) {
            const dvec3 p = glm::mix(links->receiver.centre, link.end.centre, along);
            if (link.share > 0.2 * links->links[0].share && glm::dot(p - kEye, kTarget - kEye) > 0.3 &&
                view_->rect().adjusted(5, 120, -5, -5).contains(at(p))) {
                ++looked;
                drawn += changed(before, after, at(p), 2) > 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(looked, 5);
    EXPECT_EQ(drawn, looked) << "the strongest links are lines to the middles of the other elements";
    // Another solution has its own element at that place; off forgets it.
    view_->set_inspection({});
    EXPECT_FALSE(view_->inspector().links());
    EXPECT_TRUE(view_->inspector().figures().empty());
}

TEST_F(Inspection, ElementsHaveTheColourOfTheirLevelOrLinks) {
    open(scene_, solution_, kEye, kTarget);
    const auto elements = view_elements(*solution_);
    for (const ElementColors colors : {ElementColors::Level, ElementColors::Links}) {
        InspectionChoice choice;
        choice.colors = colors;
        turn_on(choice);
        const QImage picture = grab();
        const FalseColor scale = element_scale(*elements, colors);
        const NodeId floor = named("Floor");
        int looked = 0;
        for (const SurfaceElements& s : elements->surfaces) {
            for (std::size_t i = 0; i < s.triangles.size() && s.node == floor; ++i) {
                const auto& t = s.triangles[i];
                const dvec3 p = world(floor, (t[0] + t[1] + t[2]) / 3.0F);
                const LeafFigures& leaf = elements->leaves[s.triangle_leaf[i]];
                const bool front = glm::cross(t[1] - t[0], t[2] - t[0]).z > 0.0F;
                if (!front || leaf.area < 0.05F || glm::dot(p - kEye, kTarget - kEye) < 0.5 || !in_sight(p) ||
                    !on_screen(at(p))) {
                    continue;
                }
                ++looked;
                const Rgb expected = 255.0F * false_color(scale, element_amount(leaf, colors));
                const QRgb pixel = picture.pixel(at(p));
                EXPECT_NEAR(qRed(pixel), expected.r, 3.0);
                EXPECT_NEAR(qGreen(pixel), expected.g, 3.0);
                EXPECT_NEAR(qBlue(pixel), expected.b, 3.0);
            }
        }
        EXPECT_GT(looked, 5);
        ASSERT_TRUE(view_->inspector().scale());
        EXPECT_EQ(view_->inspector().scale()->scale, scale) << "the legend's";
    }
}

TEST_F(Inspection, AnUpdateMarksWhatItChangedAndTheMarksFade) {
    InspectionChoice choice;
    choice.last_update = true;
    open_with(choice);
    Scene moved = scene_;
    moved.nodes.find(box_)->transform.translation.x += 0.3;
    const auto updated = engine_of_test_.update(moved, options_, {});
    ASSERT_TRUE(updated) << updated.error().message();
    EXPECT_TRUE(view_->inspector().figures().empty());
    engine_->load(std::make_shared<Solution>(**updated));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view_->inspector().figures().empty(); }, 20000));
    const UpdateView told = view_update(*solution_, **updated);
    EXPECT_EQ(view_->inspector().words(scene_).value(1).section(QLatin1Char(' '), 0, 0),
              QLocale().toString(qulonglong(told.texels)));
    ASSERT_TRUE(QTest::qWaitFor([&] { return view_->inspector().figures().empty(); }, 20000)) << "gone after a while";
}

TEST_F(Inspection, TheHistogramCountsWhatTheLegendShows) {
    InspectionChoice choice;
    choice.histogram = true;
    open_with(choice);
    EXPECT_TRUE(view_->inspector().bars().empty()) << "the picture has no legend";
    const FalseColor scale{LightQuantity::Illuminance, false, 0.0, 400.0, false};
    view_->set_false_color(scale);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view_->inspector().bars().empty(); }, 20000));
    const std::vector<float> all = view_->inspector().bars();
    EXPECT_EQ(*std::max_element(all.begin(), all.end()), 1.0F);
    document_->selection()->set({named("Floor")});
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view_->inspector().busy() && view_->inspector().bars() != all; }, 20000));
    view_->set_inspection({});
    EXPECT_TRUE(view_->inspector().bars().empty());
}

TEST_F(Inspection, TheErrorIsMeasuredWhenAskedForAndHasALegend) {
    InspectionChoice choice;
    choice.colors = ElementColors::Error;
    open_with(choice);
    ASSERT_TRUE(view_->inspector().scale()) << view_->inspector().words(scene_).join(QLatin1Char('\n')).toStdString();
    EXPECT_GT(view_->inspector().scale()->scale.maximum, view_->inspector().scale()->scale.minimum);
    EXPECT_LE(view_->inspector().scale()->scale.maximum, 100.0) << "per cent";
    ASSERT_EQ(view_->inspector().figures().size(), 1U);
    EXPECT_GT(view_->inspector().figures()[0].set->groups.size(), 6U);
    view_->set_inspection({});
    EXPECT_FALSE(view_->inspector().scale());
}

} // namespace
} // namespace atrium::ui
