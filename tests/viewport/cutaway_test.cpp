#include "fixture.h"
#include "ui/viewport/cutaway.h"

#include <QSignalSpy>
#include <QTest>

namespace atrium::ui {
namespace {

DBox3 box(const dvec3& a, const dvec3& b) {
    DBox3 out;
    out.add(a);
    out.add(b);
    return out;
}
const DBox3 kRoom = box({-2, 0, -2.5}, {2, 3, 2.5});

TEST(Cutaway, HidesNothingFromInsideNorOfThings) {
    const DBox3 wall = box({-2, 0, 2.4}, {2, 3, 2.5});
    EXPECT_FALSE(Cutaway(kRoom, {0, 1.6, 0}).active());
    EXPECT_FALSE(Cutaway(kRoom, {1.99, 2.99, -2.49}).active());
    EXPECT_EQ(Cutaway(kRoom, {0, 1.6, 2.0}).part_of(wall), Cutaway::Part::None);
    EXPECT_FALSE(Cutaway(box({-1, 0, -0.5}, {1, 0.8, 0.5}), {0, 2, 6}).active()) << "a sofa has no inside";
    EXPECT_FALSE(Cutaway(DBox3{}, {0, 2, 6}).active());
}

TEST(Cutaway, HidesTheNearWallAloneFromOutside) {
    const Cutaway cut(kRoom, {0.5, 1.6, 8});
    using Part = Cutaway::Part;
    EXPECT_EQ(cut.part_of(box({-2, 0, 2.2}, {2, 3, 2.5})), Part::All) << "a thick wall";
    EXPECT_EQ(cut.part_of(box({0, 1, 2.45}, {0.6, 1.4, 2.5})), Part::All) << "a picture on it";
    EXPECT_EQ(cut.part_of(box({-2, 0, -2.5}, {2, 3, -2.2})), Part::None) << "the far wall";
    EXPECT_EQ(cut.part_of(box({0, 0, 2.1}, {0.5, 0.5, 2.45})), Part::None) << "a stool before the wall";
    // A house in one mesh: its near wall goes, what stands across stays.
    EXPECT_EQ(cut.part_of(kRoom), Part::Some);
    EXPECT_TRUE(cut.hides({0, 1, 2.5}, {0, 0, 1}));
    EXPECT_TRUE(cut.hides({0, 1, 2.3}, {0, 0, -1}));
    EXPECT_FALSE(cut.hides({0, 0, 2.4}, {0, 1, 0})) << "the floor";
    EXPECT_FALSE(cut.hides({0, 1, -2.5}, {0, 0, 1}));
}

class CutWalls : public ViewportFixture {
protected:
    /// The small room with walls that are seen from both sides, as most files have them, from outside through the front.
    void open_room(NodeId* cabinet) {
        Scene scene = small_room(cabinet);
        for (const MaterialId id : scene.materials.keys()) {
            scene.materials.find(id)->double_sided = true;
        }
        auto light = light_scene(scene, [](const dvec3&, const dvec3&) { return Rgb(800.0F); });
        light->mean_radiance = 150.0;
        open(std::move(scene), light, {0.3, 1.0, 9}, {0, 0.6, 0});
    }
    NodeId click(const dvec3& world) {
        QTest::mouseClick(view_.get(), Qt::LeftButton, {}, at(world));
        settle();
        return document_->selection()->active();
    }
};

TEST_F(CutWalls, OneLooksAndClicksIntoTheRoom) {
    NodeId cabinet;
    open_room(&cabinet);
    const dvec3 face(0, 0.5, 0.4);
    const QRgb seen = grab().pixel(at(face));
    EXPECT_GT(qBlue(seen), qRed(seen)) << "the cabinet's bluish grey";
    EXPECT_EQ(click(face), cabinet);
    view_->set_cut_walls(false);
    settle();
    const QRgb wall = grab().pixel(at(face));
    EXPECT_EQ(qBlue(wall), qRed(wall)) << "the wall in front";
    document_->selection()->clear();
    const NodeId hit = click(face);
    ASSERT_TRUE(document_->scene().nodes.contains(hit));
    EXPECT_EQ(document_->scene().nodes.find(hit)->name, "Front");
}

} // namespace
} // namespace atrium::ui
