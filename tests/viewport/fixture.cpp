#include "fixture.h"

#include <QApplication>
#include <QSignalSpy>
#include <QTest>

namespace atrium::ui {

std::shared_ptr<Solution> light_scene(const Scene& scene,
                                      const std::function<Rgb(const dvec3& point, const dvec3& normal)>& light) {
    auto solution = std::make_shared<Solution>();
    solution->revision = 1U << 30U; // newer than any edit of a test
    solution->final = true;
    for (const NodeId id : scene.in_tree_order()) {
        const Shape* shape = scene.shapes.find(scene.nodes.find(id)->shape);
        if (shape == nullptr) {
            continue;
        }
        const dmat4 world = scene.world_matrix(id);
        const dmat3 normal_matrix = glm::transpose(glm::inverse(dmat3(world)));
        for (std::uint32_t part = 0; part < part_count(*shape); ++part) {
            auto layer = std::make_shared<SurfaceLayer>();
            auto mesh = std::make_shared<DisplayMesh>(make_display_mesh(*shape, part));
            layer->node = id;
            layer->part = part;
            for (std::size_t i = 0; i < mesh->positions.size(); ++i) {
                const dvec3 point(world * dvec4(dvec3(mesh->positions[i]), 1.0));
                layer->irradiance_front.push_back(light(point, glm::normalize(normal_matrix * dvec3(mesh->normals[i]))));
            }
            layer->mesh = mesh;
            solution->surfaces.push_back(layer);
        }
    }
    return solution;
}

void ViewportFixture::TearDown() {
    view_.reset();
    engine_.reset();
    document_.reset();
}

void ViewportFixture::open(Scene scene, std::shared_ptr<Solution> solution, const dvec3& eye, const dvec3& target) {
    document_ = std::make_unique<Document>();
    engine_ = std::make_unique<EngineLink>(*document_);
    // Edits must not reach the solver: its light would replace the hand-made one at some moment.
    QObject::disconnect(document_.get(), nullptr, engine_.get(), nullptr);
    view_ = std::make_unique<ViewportWidget>(*document_, *engine_);
    view_->resize(640, 480);
    view_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(view_.get()));
    document_->reset(std::move(scene), QString(), {});
    if (solution) {
        QSignalSpy changed(engine_.get(), &EngineLink::solution_changed);
        engine_->load(std::move(solution));
        if (changed.isEmpty()) {
            ASSERT_TRUE(changed.wait(5000));
        }
    }
    look(eye, target);
}

void ViewportFixture::look(const dvec3& eye, const dvec3& target) {
    ViewCamera camera;
    const dvec3 back = glm::normalize(eye - target);
    const dvec3 right = glm::normalize(glm::cross(std::abs(back.y) < 0.99 ? dvec3(0, 1, 0) : dvec3(0, 0, -1), back));
    camera.to_world = dmat4(dvec4(right, 0), dvec4(glm::cross(back, right), 0), dvec4(back, 0), dvec4(eye, 1));
    camera.lens.yfov = 0.9F;
    view_->set_camera(camera);
    settle();
}

QImage ViewportFixture::grab() {
    settle();
    // One pixel per logical pixel, whatever the screen's ratio.
    return view_->grabFramebuffer()
        .convertToFormat(QImage::Format_RGB32)
        .scaled(view_->size(), Qt::IgnoreAspectRatio, Qt::FastTransformation);
}

QImage ViewportFixture::grab_pixels() {
    settle();
    return view_->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
}

QPointF ViewportFixture::place_of(const dvec3& world) const {
    const ViewCamera camera = view_->camera();
    const dvec4 p = glm::inverse(camera.to_world) * dvec4(world, 1.0);
    const double scale = 0.5 * view_->height() / (std::tan(0.5 * double(camera.lens.yfov)) * -p.z);
    return {0.5 * view_->width() + p.x * scale, 0.5 * view_->height() - p.y * scale};
}

QPoint ViewportFixture::at(const dvec3& world) const { return place_of(world).toPoint(); }

QPoint ViewportFixture::pixel_at(const dvec3& world) const {
    // Pixel i covers i to i + 1.
    const QPointF place = place_of(world) * view_->devicePixelRatioF();
    return {int(std::floor(place.x())), int(std::floor(place.y()))};
}

void ViewportFixture::drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers, bool release) {
    QTest::mouseMove(view_.get(), from);
    settle();
    QTest::mousePress(view_.get(), Qt::LeftButton, modifiers, from);
    constexpr int kSteps = 8;
    for (int i = 1; i <= kSteps; ++i) {
        const QPoint point = from + (to - from) * i / kSteps;
        QMouseEvent move(QEvent::MouseMove, QPointF(point), view_->mapToGlobal(QPointF(point)), Qt::NoButton, Qt::LeftButton,
                         modifiers);
        QApplication::sendEvent(view_.get(), &move);
        settle();
    }
    if (release) {
        QTest::mouseRelease(view_.get(), Qt::LeftButton, modifiers, to);
        settle();
    }
}

void ViewportFixture::settle() { QTest::qWait(20); }

Scene small_room(NodeId* box) {
    Scene scene;
    const auto add = [&](const char* name, Geometry geometry, const Transform& place, const Rgb& color) {
        Material material;
        material.name = name;
        material.base_color = color;
        Node node;
        node.name = name;
        node.shape = scene.shapes.insert({name, std::move(geometry), {}});
        node.materials = {scene.materials.insert(material)};
        node.transform = place;
        const NodeId id = scene.nodes.insert(node);
        scene.roots.push_back(id);
        return id;
    };
    const auto rectangle = [](float w, float h) {
        return Polygon{{{-w / 2, -h / 2}, {w / 2, -h / 2}, {w / 2, h / 2}, {-w / 2, h / 2}}, {}};
    };
    const auto turned = [](const dvec3& at, double angle, const dvec3& axis) {
        Transform t;
        t.translation = at;
        t.rotation = glm::angleAxis(angle, axis);
        return t;
    };
    const double half = kPiD / 2;
    add("Floor", rectangle(4, 5), turned({0, 0, 0}, -half, {1, 0, 0}), Rgb(0.45F, 0.35F, 0.25F));
    add("Ceiling", rectangle(4, 5), turned({0, 3, 0}, half, {1, 0, 0}), Rgb(0.85F));
    add("Back", rectangle(4, 3), turned({0, 1.5, -2.5}, 0, {0, 1, 0}), Rgb(0.8F));
    add("Front", rectangle(4, 3), turned({0, 1.5, 2.5}, kPiD, {0, 1, 0}), Rgb(0.8F));
    add("Left", rectangle(5, 3), turned({-2, 1.5, 0}, half, {0, 1, 0}), Rgb(0.7F, 0.2F, 0.15F));
    add("Right", rectangle(5, 3), turned({2, 1.5, 0}, -half, {0, 1, 0}), Rgb(0.2F, 0.5F, 0.25F));
    const NodeId id = add("Cabinet", Box{vec3(0.8F)}, turned({0, 0.4, 0}, 0, {0, 1, 0}), Rgb(0.6F, 0.6F, 0.65F));
    if (box != nullptr) {
        *box = id;
    }
    return scene;
}

} // namespace atrium::ui
