// The same light shown otherwise (flat, on the mesh, unrestricted), texels and landings in the picture.
#include "fixture.h"
#include "tests/support/light_maps.h"
#include "ui/viewport/light_views.h"
#include "ui/viewport/look_at.h"

#include <QTest>

#include <cmath>

namespace atrium::ui {
namespace {

constexpr std::uint32_t kSide = 64;

/// A plane of 2 x 2 m in `cells` x `cells` squares of two triangles, charted over 4 x 4 tiles.
struct Stage {
    Scene scene;
    NodeId plane, other;
    std::shared_ptr<Solution> solution;

    explicit Stage(int cells) {
        auto mesh = std::make_shared<MeshData>();
        for (int y = 0; y <= cells; ++y) {
            for (int x = 0; x <= cells; ++x) {
                mesh->positions.emplace_back(2.0F * float(x) / float(cells) - 1.0F, 2.0F * float(y) / float(cells) - 1.0F,
                                             0.0F);
            }
        }
        mesh->normals.assign(mesh->positions.size(), vec3(0, 0, 1));
        for (int y = 0; y < cells; ++y) {
            for (int x = 0; x < cells; ++x) {
                const auto v = std::uint32_t(y * (cells + 1) + x), up = v + std::uint32_t(cells) + 1;
                mesh->indices.insert(mesh->indices.end(), {v, v + 1, up + 1, v, up + 1, up});
            }
        }
        mesh->parts = {{0, std::uint32_t(mesh->indices.size())}};
        Material material;
        material.base_color = Rgb(0.5F);
        Node node;
        node.name = "Plane";
        node.shape = scene.shapes.insert({"Plane", Mesh{mesh}, {}});
        node.materials = {scene.materials.insert(material)};
        plane = scene.nodes.insert(node);
        Node far;
        far.name = "Other";
        far.shape = scene.shapes.insert({"Other", Box{vec3(0.1F)}, {}});
        far.transform.translation = {5, 5, 0};
        other = scene.nodes.insert(far);
        scene.roots = {plane, other};
        solution = light_scene(scene, [](const dvec3& p, const dvec3&) { return Rgb(float(100.0 + 50.0 * p.x)); });
        solution->mean_radiance = 60.0;
        solution->final = true;
        for (auto& layer : solution->surfaces) {
            if (layer->node != plane) {
                continue;
            }
            auto lit = std::make_shared<SurfaceLayer>(*layer);
            auto charted = std::make_shared<DisplayMesh>(*layer->mesh);
            test::chart_plane(*charted, {-1, -1}, 2.0F);
            lit->mesh = charted;
            auto texture = std::make_shared<CausticTexture>();
            texture->low = vec2(1.0F);
            texture->high = vec2(3.0F);
            texture->width = texture->height = kSide;
            for (std::uint32_t i = 0; i < kSide * kSide; ++i) { // black and white, eight texels a field
                texture->image.push_back(Rgb(((i / kSide / 8) + (i % kSide / 8)) % 2 == 0 ? 1000.0F : 0.0F));
            }
            lit->caustic_textures_front = {texture};
            layer = lit;
        }
        CausticRecord record;
        record.node = plane;
        record.decision = record.found = CausticRecord::Decision::Texture;
        record.extent = {2.0F, 2.0F};
        record.width = record.height = 2 * kSide;
        record.boxes = {vec4(0.25F, 0.25F, 0.75F, 0.75F)};
        solution->caustic_records = {record};
    }
    [[nodiscard]] const SurfaceLayer& layer(const Solution& of) const {
        for (const auto& layer : of.surfaces) {
            if (layer->node == plane) {
                return *layer;
            }
        }
        return *of.surfaces.front();
    }
};

double power(const CausticTexture& t) {
    double sum = 0.0;
    for (const Rgb& texel : t.image) {
        sum += double(luminance(texel));
    }
    return sum / double(t.image.size());
}

TEST(CausticViews, FlatIsOneValueAFace) {
    const Stage stage(16);
    const auto shown = shown_as(*stage.solution, CausticView::Flat);
    const SurfaceLayer &flat = stage.layer(*shown), &smooth = stage.layer(*stage.solution);
    ASSERT_EQ(flat.mesh->indices.size(), smooth.mesh->indices.size());
    EXPECT_TRUE(flat.caustic_textures_front.empty());
    double sum = 0.0;
    for (std::size_t t = 0; t + 2 < flat.mesh->indices.size(); t += 3) {
        const std::uint32_t* v = &flat.mesh->indices[t];
        EXPECT_EQ(vertex_irradiance(flat, v[0], false), vertex_irradiance(flat, v[1], false));
        EXPECT_EQ(vertex_irradiance(flat, v[0], false), vertex_irradiance(flat, v[2], false));
        for (std::size_t k = 0; k < 3; ++k) { // the same triangles
            EXPECT_EQ(flat.mesh->positions[v[k]], smooth.mesh->positions[smooth.mesh->indices[t + k]]);
        }
        const float x = (flat.mesh->positions[v[0]].x + flat.mesh->positions[v[1]].x + flat.mesh->positions[v[2]].x) / 3.0F;
        EXPECT_NEAR(flat.irradiance_front[v[0]].g, 100.0F + 50.0F * x, 0.1F) << "the mean of what is smooth";
        sum += double(flat.caustic_front[v[0]].g);
    }
    EXPECT_NEAR(sum / double(flat.mesh->indices.size() / 3), 500.0 / 4.0, 15.0) << "half of a quarter of the plane";
    EXPECT_EQ(shown->revision, stage.solution->revision);
}

TEST(CausticViews, OnTheMeshKeepsTheLightButNotItsDetail) {
    const Stage stage(16); // corners every 12.5 cm, fields of 12.5 cm
    const auto shown = shown_as(*stage.solution, CausticView::Mesh);
    const SurfaceLayer& mesh = stage.layer(*shown);
    EXPECT_TRUE(mesh.caustic_textures_front.empty());
    EXPECT_EQ(mesh.mesh, stage.layer(*stage.solution).mesh) << "shared";
    double sum = 0.0;
    for (const Rgb& e : mesh.caustic_front) {
        EXPECT_LE(e.g, 1000.0F);
        sum += double(e.g);
    }
    EXPECT_NEAR(sum / double(mesh.caustic_front.size()), 125.0, 20.0);
    for (std::size_t i = 0; i < shown->surfaces.size(); ++i) {
        if (shown->surfaces[i]->node != stage.plane) {
            EXPECT_EQ(shown->surfaces[i], stage.solution->surfaces[i]) << "what has no texture is shared";
        }
    }
}

TEST(CausticViews, WithoutRestrictionTexelsAreSoMuchCoarser) {
    const Stage stage(2);
    const auto shown = shown_as(*stage.solution, CausticView::Whole);
    const CausticTexture& whole = *stage.layer(*shown).caustic_textures_front.at(0);
    const CausticTexture& boxed = *stage.layer(*stage.solution).caustic_textures_front.at(0);
    EXPECT_EQ(whole.width, kSide / 2) << "a quarter of the plane is covered: twice the edge";
    EXPECT_EQ(whole.height, kSide / 2);
    EXPECT_EQ(whole.low, boxed.low);
    EXPECT_EQ(whole.high, boxed.high);
    EXPECT_NEAR(power(whole), power(boxed), 1e-3);
    EXPECT_EQ(shown_as(*stage.solution, CausticView::Texture)->surfaces, stage.solution->surfaces);
}

TEST(LookingAtAPiece, StaysInTheRoomAndInFrontOfTheSurface) {
    NodeId box;
    const Scene scene = small_room(&box);
    ViewScene view;
    view.sync(scene, nullptr);
    CameraController now;
    now.set_viewport(640, 480);
    const DBox3 room = scene.bounds();
    DBox3 floor = room;
    floor.max.y = floor.min.y;
    const dvec3 focus(floor.centre() + dvec3(1.0, 0.0, 1.2)); // beside the box in the middle
    const auto eye_from = [&](const dvec3& eye) {
        now.set_camera({glm::inverse(glm::lookAt(eye, room.centre(), dvec3(0, 1, 0))), Camera{}});
        const auto found = camera_towards(now, view, floor, focus, {0, 1, 0});
        EXPECT_TRUE(found);
        const dmat4 place = found ? found->to_world : dmat4(1.0);
        const dvec3 forward = -dvec3(place[2]);
        EXPECT_NEAR(glm::length(glm::normalize(focus - dvec3(place[3])) - forward), 0.0, 1e-9);
        return dvec3(place[3]);
    };
    for (const dvec3& from : {room.centre() + dvec3(0.5, 0.8, 1.0), room.centre() - dvec3(0.3, 20.0, 1.0),
                              room.centre() + dvec3(30.0, 5.0, 2.0)}) {
        const dvec3 eye = eye_from(from);
        EXPECT_GT(eye.y, floor.min.y);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT(eye[axis], room.min[axis]);
            EXPECT_LT(eye[axis], room.max[axis]);
        }
        EXPECT_GT(glm::length(eye - focus), 0.5) << "not with the nose on it";
        const dvec3 start = focus + dvec3(0, 0.01, 0);
        EXPECT_FALSE(view.pick({start, glm::normalize(eye - start)}, glm::length(eye - start))) << "nothing is between";
    }
    EXPECT_FALSE(camera_towards(now, view, floor, focus, dvec3(0.0))) << "no normal, no front";
}

class CausticOverlays : public ViewportFixture {
protected:
    QImage picture() {
        QTest::qWait(400);   // light and maps are there
        view_->refine_now(); // the smoothed one, however long it takes
        return grab();
    }
    static int differing(const QImage& a, const QImage& b, const QRect& where) {
        int count = 0;
        for (int y = where.top(); y <= where.bottom(); ++y) {
            for (int x = where.left(); x <= where.right(); ++x) {
                count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
            }
        }
        return count;
    }
};

TEST_F(CausticOverlays, ViewsChangeThePictureAndComeBack) {
    Stage stage(8);
    open(stage.scene, stage.solution, {0.05, 0.1, 2.6}, {0, 0, 0});
    const QImage as_it_is = picture();
    QImage last = as_it_is;
    std::shared_ptr<const Solution> last_shown = stage.solution;
    for (const CausticView view : {CausticView::Flat, CausticView::Mesh, CausticView::Whole}) {
        view_->set_caustic_view(view);
        ASSERT_TRUE(QTest::qWaitFor([&] { return view_->shown_solution() != last_shown; }, 5000));
        last_shown = view_->shown_solution();
        const QImage now = picture();
        EXPECT_NE(now, as_it_is);
        EXPECT_NE(now, last);
        last = now;
    }
    view_->set_caustic_view(CausticView::Texture);
    ASSERT_TRUE(QTest::qWaitFor([&] { return view_->shown_solution() == stage.solution; }, 5000));
    EXPECT_EQ(picture(), as_it_is);
    // New light comes in the same view.
    view_->set_caustic_view(CausticView::Mesh);
    auto next = std::make_shared<Solution>(*stage.solution);
    engine_->load(next);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            const auto shown = view_->shown_solution();
            return shown && shown != next && stage.layer(*shown).caustic_textures_front.empty();
        },
        5000));
}

TEST_F(CausticOverlays, TexelsOfWhatIsSelected) {
    Stage stage(2);
    open(stage.scene, stage.solution, {0.05, 0.1, 1.2}, {0, 0, 0}); // texels of some eight pixels
    document_->selection()->set({stage.other});
    const QImage before = picture();
    const QRect inside(at({-0.3, 0.3, 0}), at({0.3, -0.3, 0}));
    view_->set_texel_grid(true);
    EXPECT_EQ(differing(picture(), before, inside), 0) << "nothing of it is selected";
    document_->selection()->set({stage.plane});
    const int changed = differing(picture(), before, inside);
    EXPECT_GT(changed, inside.width() * inside.height() / 20);
    EXPECT_LT(changed, inside.width() * inside.height() * 2 / 3) << "lines, not an area";
    // From afar lines would be a grey: they fade.
    look({0.05, 0.1, 12}, {0, 0, 0});
    document_->selection()->set({stage.plane});
    const QImage far = picture();
    view_->set_texel_grid(false);
    const QRect there(at({-0.3, 0.3, 0}), at({0.3, -0.3, 0}));
    EXPECT_EQ(differing(picture(), far, there), 0);
}

TEST_F(CausticOverlays, LandingsOfWhatIsSelected) {
    Stage stage(2);
    auto landings = std::make_shared<std::vector<SurfaceLandings>>();
    landings->push_back({stage.plane, 0, false, {vec3(0.7F, 0.7F, 0.0F)}});
    stage.solution->landings = landings;
    open(stage.scene, stage.solution, {0.05, 0.1, 2.6}, {0, 0, 0});
    document_->selection()->set({stage.plane});
    const QImage before = picture();
    const QRect around(at({0.7, 0.7, 0}) - QPoint(4, 4), QSize(9, 9));
    view_->set_landings(true);
    const QImage with = picture();
    EXPECT_GT(differing(with, before, around), 0);
    EXPECT_EQ(differing(with, before, around.translated(40, 40)), 0);
    document_->selection()->clear();
    document_->selection()->set({stage.other});
    const QImage unselected = picture();
    view_->set_landings(false);
    EXPECT_EQ(differing(picture(), unselected, around), 0);
}

} // namespace
} // namespace atrium::ui
