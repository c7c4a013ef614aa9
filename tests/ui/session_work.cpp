#include "session_work.h"

#include "ui/panels/library_panel.h"

#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QTabBar>
#include <QTimer>
#include <QWindow>

#include <algorithm>
#include <cmath>
#include <functional>

namespace atrium::ui {
namespace {

constexpr int kLightMs = 400000; // a patience, not a measurement
constexpr int kHandMs = 25;      ///< between two moves of the mouse

QString session_folder() { return QString::fromLocal8Bit(qgetenv("ATRIUM_SESSION_FOLDER")); }

} // namespace

const std::vector<Stage>& session_stages() {
    static const std::vector<Stage> stages = [] {
        Stage room;
        room.name = "sunlit_room";
        room.file = "sunlit_room/sunlit_room.gltf";
        room.camera = 1;
        room.wall = "Wall west";
        Stage cabin;
        cabin.name = "cabin";
        cabin.file = "cabin/cabin.glb";
        cabin.camera = 1;
        cabin.look = {dvec3(2.75, 1.40, 0.75), dvec3(0.95, 0.98, 1.50)}; // the dresser; the mirror throws the sun over it
        cabin.support = "Dresser";
        cabin.from = {1.27, 0.82, 2.02};
        cabin.middle = {1.27, 0.82, 1.20};
        cabin.to = {1.27, 0.82, 0.70};
        for (const double z : {1.40, 1.47, 1.53, 1.60}) {
            for (const double y : {0.89, 0.93, 0.97, 1.01}) {
                cabin.lit.emplace_back(0.95, y, z);
            }
        }
        Stage office;
        office.name = "office";
        office.file = "interiors/office_simple.glb";
        office.shared = true;
        office.daylight = true;
        return std::vector<Stage>{room, cabin, office};
    }();
    return stages;
}

const Stage& session_stage() {
    const QByteArray wanted = qgetenv("ATRIUM_SESSION_STAGE");
    for (const Stage& stage : session_stages()) {
        if (wanted == stage.name) {
            return stage;
        }
    }
    return session_stages().front();
}

void SessionWork::SetUp() {
    if (session_folder().isEmpty()) {
        GTEST_SKIP() << "part of Session.SurvivesAKill";
    }
    window = std::make_unique<MainWindow>(session_folder() + QStringLiteral("/recovery"));
    window->resize(1360, 860);
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    QApplication::setActiveWindow(window.get());
    application().start();
}

void SessionWork::step(const char* what) {
    application().set_activity(what);
    const auto* badge = window->findChild<QLabel*>(QStringLiteral("light_state"));
    std::printf("[ session  ] %s (%s)\n", what, badge == nullptr ? "" : badge->text().toUtf8().constData());
    std::fflush(stdout);
}

void SessionWork::picture(const char* name) {
    if (const QByteArray to = qgetenv("ATRIUM_SCREENSHOTS"); !to.isEmpty()) {
        window->grab().save(QStringLiteral("%1/%2_%3.png")
                                .arg(QString::fromLocal8Bit(to), QLatin1String(session_stage().name), QLatin1String(name)));
    }
}

bool SessionWork::wait_for_light() {
    return QTest::qWaitFor([this] { return !window->engine().stale(); }, kLightMs);
}

bool SessionWork::wait_for_update() {
    settle(); // moves of the mouse that wait for a turn of the event loop become edits
    return QTest::qWaitFor(
        [this] { return window->engine().follows() && window->viewport().shown_solution() == window->engine().solution(); },
        kLightMs);
}

bool SessionWork::wait_for_rest() {
    const bool rest = QTest::qWaitFor(
        [this] {
            const SessionStatus now = window->engine().status();
            return !now.settling && !now.moving && now.shown_revision == now.posted_revision;
        },
        kLightMs);
    return rest && wait_for_update();
}

void SessionWork::keys(Qt::Key key, Qt::KeyboardModifiers held) {
    QApplication::setActiveWindow(window.get()); // after a dialog nobody gives the focus back: no window manager here
    QTest::keyClick(&window->viewport(), key, held);
    settle();
}

void SessionWork::drag_from_library(const char* search, const char* key, const QPoint& to) {
    auto* field = window->findChild<QLineEdit*>(QStringLiteral("library_search"));
    ASSERT_NE(field, nullptr);
    field->setFocus();
    field->clear();
    QTest::keyClicks(field, QLatin1StringView(search));
    settle();
    const QModelIndex index = window->library().view_index(QLatin1StringView(key));
    ASSERT_TRUE(index.isValid()) << key;
    QListView* list = window->library().view();
    list->scrollTo(index);
    settle();
    const auto in_window = [this](const QWidget* widget, const QPoint& point) { return widget->mapTo(window.get(), point); };
    const QPoint from = in_window(list->viewport(), list->visualRect(index).center());
    const QPoint end = in_window(&window->viewport(), to);
    // The drag has an event loop of its own and does not come back before the button is up: the hand goes by a timer.
    QWindow* handle = window->windowHandle();
    constexpr int kSteps = 16;
    int done = 0;
    // A timer of its own for every move: one that is at work in the drag's loop is not woken again.
    std::function<void()> go_on = [&] {
        ++done;
        if (done <= kSteps) {
            QTimer::singleShot(kHandMs, window.get(), go_on);
            QTest::mouseMove(handle, from + (end - from) * done / kSteps);
        } else {
            QTest::mouseRelease(handle, Qt::LeftButton, {}, end);
        }
    };
    QTest::mouseMove(handle, from);
    QTest::mousePress(handle, Qt::LeftButton, {}, from);
    QTimer::singleShot(kHandMs, window.get(), go_on);
    ASSERT_TRUE(QTest::qWaitFor([&] { return done > kSteps; }, 60000));
    settle();
}

QPoint SessionWork::seen(NodeId id, const dvec3& world) {
    const QPoint middle = at(world);
    for (int ring = 0; ring < 40; ++ring) {
        for (int i = 0; i < 12; ++i) {
            const double angle = 2 * kPiD * i / 12;
            const QPoint p = middle + QPoint(int(6 * ring * std::cos(angle)), int(6 * ring * std::sin(angle)));
            if (window->viewport().rect().adjusted(8, 8, -8, -8).contains(p) &&
                window->viewport().drop_place(p).node == id) {
                return p;
            }
        }
    }
    ADD_FAILURE() << node(id).name << " is not in sight";
    return middle;
}

std::optional<double> SessionWork::lux(const dvec3& world) {
    const QPoint point = at(world);
    if (!window->viewport().rect().adjusted(2, 2, -2, -2).contains(point)) {
        return std::nullopt;
    }
    const auto reading = window->viewport().light_at(point);
    const bool there = reading && glm::length(reading->point - world) < 0.06;
    return there ? std::optional(reading->light.illuminance) : std::nullopt;
}

std::vector<double> SessionWork::lux(const std::vector<dvec3>& places) {
    std::vector<double> out;
    for (const dvec3& place : places) {
        out.push_back(lux(place).value_or(-1.0));
    }
    return out;
}

std::unordered_set<NodeId> SessionWork::surfaces(const std::vector<dvec3>& places) {
    std::unordered_set<NodeId> out;
    for (const dvec3& place : places) {
        if (lux(place)) {
            out.insert(window->viewport().light_at(at(place))->node);
        }
    }
    return out;
}

std::optional<std::pair<QPoint, NodeId>> SessionWork::wall_in_view() {
    ViewportWidget& view = window->viewport();
    const auto wall_at = [&](const QPoint& p) -> NodeId {
        const auto reading = view.light_at(p);
        const bool wall = reading && std::abs(reading->normal.y) < 0.05;
        // Not where the light is going to be looked at.
        const bool lit = wall && std::any_of(session_stage().lit.begin(), session_stage().lit.end(),
                                             [&](const dvec3& place) { return glm::length(place - reading->point) < 1.0; });
        return wall && !lit ? reading->node : NodeId{};
    };
    std::optional<std::pair<QPoint, NodeId>> best;
    int widest = 0;
    for (int y = 60; y < view.height() - 60; y += 30) {
        for (int x = 60; x < view.width() - 60; x += 30) {
            const NodeId wall = wall_at({x, y});
            int reach = 0;
            while (wall && reach < 160 && wall_at({x - reach, y}) == wall && wall_at({x + reach, y}) == wall &&
                   wall_at({x, y - reach / 2}) == wall && wall_at({x, y + reach / 2}) == wall) {
                reach += 20;
            }
            if (reach > widest) {
                widest = reach;
                best = {QPoint(x, y), wall};
            }
        }
    }
    return best;
}

std::optional<Crossing> SessionWork::sun_on_floor() {
    ViewportWidget& view = window->viewport();
    constexpr int kStep = 10;
    std::vector<MeterReading> floor;
    double lowest = 1e9;
    double most = 0;
    for (int y = kStep; y < view.height() - kStep; y += kStep) {
        for (int x = kStep; x < view.width() - kStep; x += kStep) {
            if (const auto reading = view.light_at(QPoint(x, y)); reading && reading->normal.y > 0.95) {
                lowest = std::min(lowest, reading->point.y);
                floor.push_back(*reading);
            }
        }
    }
    std::erase_if(floor, [&](const MeterReading& r) { return r.point.y > lowest + 0.03; });
    for (const MeterReading& r : floor) {
        most = std::max(most, r.light.direct);
    }
    // The sunlit place with most sun about it is the middle of the patch.
    const auto sunny = [&](const MeterReading& r) { return r.light.direct > 0.6 * most; };
    std::optional<Crossing> out;
    const MeterReading* middle = nullptr;
    int crowd = 0;
    for (const MeterReading& r : floor) {
        const auto near = std::count_if(floor.begin(), floor.end(), [&](const MeterReading& other) {
            return sunny(other) && glm::length(other.point - r.point) < 0.2;
        });
        if (sunny(r) && int(near) > crowd) {
            crowd = int(near);
            middle = &r;
        }
    }
    if (middle == nullptr) {
        return out;
    }
    // The nearest shade, and the nearest on another side: where the sun lies along a wall there is none across.
    struct Shade {
        dvec3 way{0.0};
        double distance = 0;
    };
    std::vector<Shade> shades;
    for (int k = 0; k < 16; ++k) {
        const double angle = 2 * kPiD * k / 16;
        const dvec3 way(std::cos(angle), 0.0, std::sin(angle));
        int dark = 0;
        for (double d = 0.05; d < 1.8 && dark < 4; d += 0.05) {
            const auto here = lux(middle->point + way * d);
            dark = here && *here < 0.4 * middle->light.illuminance ? dark + 1 : 0;
            if (dark == 4) {
                shades.push_back({way, d});
            }
        }
    }
    std::sort(shades.begin(), shades.end(), [](const Shade& x, const Shade& y) { return x.distance < y.distance; });
    for (const double apart : {-0.9, 0.0, 0.8}) { // cosine of the angle between the two
        const auto other = std::find_if(shades.begin(), shades.end(),
                                        [&](const Shade& one) { return glm::dot(one.way, shades.front().way) < apart; });
        if (!out && other != shades.end()) {
            const Shade& first = shades.front();
            out = Crossing{
                middle->point + first.way * first.distance, middle->point, middle->point + other->way * other->distance, {}};
        }
    }
    if (out) {
        for (const MeterReading& r : floor) {
            if (sunny(r) && glm::length(r.point - middle->point) < 0.35) {
                out->lit.push_back(r.point);
            }
        }
    }
    return out;
}

void SessionWork::hold(const QPoint& point) {
    cursor_ = point;
    QTest::mouseMove(&window->viewport(), point);
    settle();
    QTest::mousePress(&window->viewport(), Qt::LeftButton, {}, point);
}

void SessionWork::carry(NodeId id, const dvec3& to) {
    ViewportWidget* view = &window->viewport();
    constexpr int kSteps = 14;
    for (int i = 0; i < kSteps + 4; ++i) {
        const QPoint gap = at(to) - at(origin(id));
        cursor_ += gap / std::max(1, kSteps - i);
        QMouseEvent move(QEvent::MouseMove, QPointF(cursor_), view->mapToGlobal(QPointF(cursor_)), Qt::NoButton,
                         Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(view, &move);
        QTest::qWait(kHandMs);
    }
}

void SessionWork::let_go() {
    QTest::mouseRelease(&window->viewport(), Qt::LeftButton, {}, cursor_);
    settle();
}

} // namespace atrium::ui
