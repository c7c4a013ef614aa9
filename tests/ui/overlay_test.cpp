// View > Overlays in the whole window: what can be had, what not and why.
#include "window_fixture.h"

#include <QMenu>
#include <QMenuBar>

namespace atrium::ui {
namespace {

using Overlays = WindowTest;

TEST_F(Overlays, AreInTheMenuAndGreyWithAReasonUntilThereIsLight) {
    QAction* mesh = window->action(ActionId::ElementMesh);
    EXPECT_FALSE(mesh->isEnabled());
    EXPECT_TRUE(mesh->toolTip().contains(QLatin1String("No light"))) << mesh->toolTip().toStdString();
    EXPECT_TRUE(window->action(ActionId::LastUpdate)->isEnabled()) << "it needs nothing of the solver";
    bool found = false;
    for (const QAction* top : window->menuBar()->actions()) {
        for (const QAction* entry : top->menu()->actions()) {
            found = found || (entry->menu() != nullptr && entry->menu()->actions().contains(mesh));
        }
    }
    EXPECT_TRUE(found);
}

TEST_F(Overlays, AskTheLightForWhatTheyNeedAndLetItGoAgain) {
    open_sample();
    QAction* mesh = window->action(ActionId::ElementMesh);
    ASSERT_TRUE(QTest::qWaitFor([&] { return mesh->isEnabled(); }, 120'000));
    EXPECT_FALSE(window->engine().solution()->insides);
    mesh->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return bool(window->engine().solution()->insides); }, 120'000));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->viewport().inspector().figures().empty(); }, 30'000));
    mesh->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->engine().solution()->insides; }, 30'000));
    EXPECT_TRUE(window->viewport().inspector().figures().empty());
    // Those that cover surfaces take turns.
    trigger(ActionId::SubdivisionLevel);
    trigger(ActionId::LinkDensity);
    EXPECT_FALSE(window->action(ActionId::SubdivisionLevel)->isChecked());
    EXPECT_EQ(window->viewport().inspector().choice().colors, ElementColors::Links);
}

TEST_F(Overlays, AreRefusedForLightOfAProject) {
    open_sample();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->action(ActionId::ElementMesh)->isEnabled(); }, 120'000));
    auto stored = std::make_shared<Solution>(*window->engine().solution());
    stored->updatable = false; // as decode_solution() gives it
    window->engine().load(stored);
    settle();
    QAction* mesh = window->action(ActionId::ElementMesh);
    EXPECT_FALSE(mesh->isEnabled());
    EXPECT_TRUE(mesh->toolTip().contains(QLatin1String("project"))) << mesh->toolTip().toStdString();
}

} // namespace
} // namespace atrium::ui
