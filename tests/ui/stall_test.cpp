// What holds the UI thread while real scenes open and are lit.
#include "timed_application.h"
#include "window_fixture.h"

#include <QFileInfo>
#include <QSignalSpy>

namespace atrium::ui {
namespace {

class Stalls : public WindowTest, public testing::WithParamInterface<const char*> {};

TEST_P(Stalls, AreNamedWhileASceneOpensAndIsLit) {
    const QString path = QStringLiteral(ATRIUM_SHARED_DIR "/scenes/interiors/") + QLatin1StringView(GetParam());
    if (!QFileInfo::exists(path)) {
        GTEST_SKIP() << "no " << path.toStdString();
    }
    auto* application = static_cast<TimedApplication*>(QCoreApplication::instance());
    application->start();
    QSignalSpy opened(&window->files(), &FileController::opened);
    window->files().open(path);
    ASSERT_TRUE(opened.wait(20000));
    const bool lit = QTest::qWaitFor([&] { return bool(window->engine().solution()); }, 15000);
    QTest::qWait(3000); // more of its pictures
    std::printf("[ stall    ] %s%s: %.0f ms at worst that is not painting\n", GetParam(), lit ? "" : " (no picture yet)",
                application->worst_but_painting());
    for (const auto& [what, ms] : application->worst()) {
        if (ms > 20.0) {
            std::printf("[ stall    ]   %6.0f ms  %s\n", ms, what.c_str());
        }
    }
    EXPECT_FALSE(scene().nodes.empty());
}
INSTANTIATE_TEST_SUITE_P(Interiors, Stalls, testing::Values("office_simple.glb", "small_house.glb", "wooden_staircase.glb"),
                         [](const auto& scene) {
                             return QFileInfo(QLatin1StringView(scene.param)).baseName().toStdString();
                         });

} // namespace
} // namespace atrium::ui
