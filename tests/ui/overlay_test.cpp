// View > Overlays in the whole window: what can be had, what not and why.
#include "engine/solver/insides.h"
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
    // The octree is that around the selection, and needs something that particles pass.
    trigger(ActionId::PassageOctree);
    ASSERT_TRUE(QTest::qWaitFor([&] { return bool(window->engine().solution()->insides); }, 120'000));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->viewport().inspector().busy(); }, 30'000));
    const auto told = [&] { return window->viewport().inspector().words(scene()).join(QLatin1Char(' ')); };
    const bool particles = window->engine().solution()->insides->particles > 0;
    EXPECT_TRUE(told().contains(particles ? QStringLiteral("Select an object") : QStringLiteral("No particles")))
        << told().toStdString();
    select(named("Vase"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window->viewport().inspector().busy(); }, 30'000));
    const auto figures = window->viewport().inspector().figures();
    if (particles) {
        EXPECT_TRUE(told().contains(QStringLiteral("cells around the selection"))) << told().toStdString();
        ASSERT_EQ(figures.size(), 1U);
        EXPECT_EQ(figures[0].set->groups.at(0).lines.size() % 12, 0U) << "edges of boxes";
    }
    trigger(ActionId::PassageOctree);
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
