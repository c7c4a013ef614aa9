#include "window_fixture.h"

#include <QApplication>
#include <QMouseEvent>
#include <QSettings>

#include <cmath>

namespace atrium::ui {

void WindowTest::SetUp() {
    if (first_window_) {
        QSettings().clear(); // what an earlier test left on, such as false colour, is not remembered
        first_window_ = false;
    }
    window = std::make_unique<MainWindow>(folder.filePath(QStringLiteral("recovery")));
    window->resize(1300, 820);
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    QApplication::setActiveWindow(window.get());
}

void WindowTest::TearDown() { window.reset(); }

void WindowTest::open_sample() {
    window->files().open_sample();
    settle();
}

NodeId WindowTest::named(const std::string& name) {
    NodeId found;
    scene().nodes.for_each([&](NodeId id, const Node& n) {
        if (n.name == name) {
            found = id;
        }
    });
    EXPECT_TRUE(bool(found)) << name;
    return found;
}

NumberField* WindowTest::field(const char* name) {
    settle();
    auto* found = window->findChild<NumberField*>(QLatin1StringView(name));
    EXPECT_NE(found, nullptr) << name;
    EXPECT_TRUE(found != nullptr && found->isVisibleTo(window.get())) << name;
    return found;
}

void WindowTest::type(QWidget* widget, const char* text, Qt::Key end) {
    widget->setFocus();
    QTest::keyClick(widget, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(widget, QLatin1StringView(text));
    QTest::keyClick(widget, end);
    settle();
}

void WindowTest::drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers held) {
    ViewportWidget* view = &window->viewport();
    QTest::mouseMove(view, from);
    settle();
    QTest::mousePress(view, Qt::LeftButton, {}, from);
    constexpr int kSteps = 10;
    for (int i = 1; i <= kSteps; ++i) {
        const QPoint point = from + (to - from) * i / kSteps;
        QMouseEvent move(QEvent::MouseMove, QPointF(point), view->mapToGlobal(QPointF(point)), Qt::NoButton, Qt::LeftButton,
                         held);
        QApplication::sendEvent(view, &move);
        settle();
    }
    QTest::mouseRelease(view, Qt::LeftButton, held, to);
    settle();
}

double WindowTest::pixel_size(const dvec3& world) {
    const ViewCamera camera = window->viewport().camera();
    const dvec4 p = glm::inverse(camera.to_world) * dvec4(world, 1.0);
    return std::tan(0.5 * double(camera.lens.yfov)) * -p.z / (0.5 * window->viewport().height());
}

QPoint WindowTest::at(const dvec3& world) {
    const ViewCamera camera = window->viewport().camera();
    const dvec4 p = glm::inverse(camera.to_world) * dvec4(world, 1.0);
    const double scale = 1.0 / pixel_size(world);
    return QPoint(int(std::lround(0.5 * window->viewport().width() + p.x * scale)),
                  int(std::lround(0.5 * window->viewport().height() - p.y * scale)));
}

} // namespace atrium::ui
