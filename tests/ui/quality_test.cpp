// The wish for quality and its thresholds in the Light panel.
#include "engine/solver/memory_budget.h"
#include "ui/panels/automatic_text.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/jobs_panel.h"
#include "ui/panels/problems_panel.h"
#include "window_fixture.h"

#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

namespace atrium::ui {
namespace {

class QualityTest : public WindowTest {
protected:
    [[nodiscard]] const SolverSettings& settings() { return scene().settings; }
};

// The least of everything is more than the sample needs, so what the engine would tell is put into its statistics.
TEST_F(QualityTest, WhatMemoryMadeCoarserIsAmongTheProblems) {
    Statistics statistics;
    EXPECT_TRUE(lowered_by_memory_text(statistics).isEmpty());
    tell_lowered(statistics.features, {.texels = true, .particles = true});
    const QString text = lowered_by_memory_text(statistics);
    EXPECT_TRUE(text.contains(QStringLiteral("finer light maps, more particles"))) << text.toStdString();
    open_sample();
    auto* problems = window->findChild<ProblemsPanel*>();
    ASSERT_NE(problems, nullptr);
    int warnings = -1;
    QObject::connect(problems, &ProblemsPanel::count_changed, problems, [&](int, int count) { warnings = count; });
    const auto told = [&] {
        int rows = 0;
        for (int i = 0; i < problems->topLevelItemCount(); ++i) {
            rows += problems->topLevelItem(i)->text(1) == text ? 1 : 0;
        }
        return rows;
    };
    ASSERT_TRUE(QTest::qWaitFor([&] { return warnings >= 0; }));
    const int before = warnings;
    problems->set_light_warning(text);
    EXPECT_EQ(told(), 1);
    EXPECT_EQ(warnings, before + 1);
    trigger(ActionId::AddBox); // the scene is looked at again
    ASSERT_TRUE(QTest::qWaitFor([&] { return warnings == before + 1 && told() == 1; }));
    problems->set_light_warning({});
    EXPECT_EQ(told(), 0);
    EXPECT_EQ(warnings, before);
}

TEST_F(QualityTest, ThresholdsAreToldAndSetByHandWithUndo) {
    open_sample();
    auto* dock = window->findChild<QDockWidget*>(QStringLiteral("dock_jobs"));
    ASSERT_NE(dock, nullptr);
    dock->raise();
    settle();
    auto* opener = window->findChild<QToolButton*>(QStringLiteral("thresholds"));
    ASSERT_NE(opener, nullptr);
    EXPECT_TRUE(opener->text().contains(QStringLiteral("automatic")));
    opener->click();
    NumberField* element = field("Element size");
    EXPECT_TRUE(element->text().isEmpty());
    EXPECT_TRUE(element->placeholderText().startsWith(QStringLiteral("automatic (0.")))
        << element->placeholderText().toStdString();
    const QString normal = element->placeholderText();
    type(element, "12 cm");
    EXPECT_FLOAT_EQ(settings().thresholds.element_edge, 0.12F);
    EXPECT_EQ(entries(), 1);
    EXPECT_TRUE(opener->text().contains(QLatin1Char('1'))) << opener->text().toStdString();
    type(field("Link threshold"), "0.01 %");
    EXPECT_FLOAT_EQ(settings().thresholds.link_share, 1e-4F);
    type(field("Particles"), "2000");
    EXPECT_FLOAT_EQ(settings().thresholds.particles, 2000.0F);
    auto* reset = window->findChild<QPushButton*>(QStringLiteral("thresholds_reset"));
    ASSERT_NE(reset, nullptr);
    reset->click();
    EXPECT_TRUE(settings().thresholds.automatic());
    EXPECT_EQ(element->placeholderText(), normal);
    EXPECT_FALSE(reset->isEnabled());
    trigger(ActionId::Undo);
    EXPECT_FLOAT_EQ(settings().thresholds.element_edge, 0.12F);
    element->setFocus();
    QTest::keyClick(element, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClick(element, Qt::Key_Delete);
    QTest::keyClick(element, Qt::Key_Return);
    EXPECT_EQ(settings().thresholds.element_edge, 0.0F) << "nothing typed is automatic";

    auto* wish = window->findChild<QComboBox*>(QStringLiteral("Light quality"));
    ASSERT_NE(wish, nullptr);
    wish->setFocus();
    QTest::keyClick(wish, Qt::Key_Up);
    EXPECT_EQ(settings().quality, SolverSettings::Quality::Draft);
    settle();
    EXPECT_NE(element->placeholderText(), normal) << "it tells what a draft stands for";
}

TEST_F(QualityTest, WhatIsOutOfRangeIsSaidAtTheField) {
    open_sample();
    window->findChild<QDockWidget*>(QStringLiteral("dock_jobs"))->raise();
    window->findChild<QToolButton*>(QStringLiteral("thresholds"))->click();
    NumberField* particles = field("Particles");
    auto* note = window->findChild<QLabel*>(QStringLiteral("Particles note"));
    ASSERT_NE(note, nullptr);
    type(particles, "0.5k");
    EXPECT_FALSE(note->isVisible()) << "that was no number";
    type(particles, "1");
    EXPECT_FLOAT_EQ(settings().thresholds.particles, 1000.0F);
    EXPECT_EQ(particles->text(), QStringLiteral("1000"));
    EXPECT_TRUE(note->isVisible());
    EXPECT_EQ(note->text(), QStringLiteral("1000 to 16000000 are possible: 1000 is used"));
    EXPECT_EQ(particles->accessibleDescription(), note->text());
    EXPECT_GE(note->mapTo(window.get(), QPoint()).y(), particles->mapTo(window.get(), QPoint(0, particles->height())).y());
    // Outside what any number may be, and of the other side.
    type(particles, "-3");
    EXPECT_FLOAT_EQ(settings().thresholds.particles, 1000.0F);
    EXPECT_TRUE(note->isVisible());
    type(particles, "99999999");
    EXPECT_FLOAT_EQ(settings().thresholds.particles, 16e6F);
    EXPECT_TRUE(note->text().endsWith(QStringLiteral("16000000 is used"))) << note->text().toStdString();
    trigger(ActionId::Undo);
    settle();
    EXPECT_FALSE(note->isVisible()) << "it is about a number that is no longer there";
    EXPECT_TRUE(particles->accessibleDescription().isEmpty());
    type(particles, "0");
    EXPECT_FALSE(note->isVisible()) << "nothing is automatic";
    NumberField* element = field("Element size");
    auto* element_note = window->findChild<QLabel*>(QStringLiteral("Element size note"));
    type(element, "2 mm");
    EXPECT_FALSE(element_note->isVisible()) << "the least itself: " << element_note->text().toStdString();
    EXPECT_FLOAT_EQ(settings().thresholds.element_edge, 0.002F);
    type(element, "1 mm");
    EXPECT_EQ(element_note->text(), QStringLiteral("0.002 m to 100 m are possible: 0.002 m is used"));
    type(field("Link threshold"), "50 %");
    EXPECT_FLOAT_EQ(settings().thresholds.link_share, 0.1F);
}

TEST_F(QualityTest, AutomaticNumbersAreWholeInNarrowFields) {
    NumberField narrow(NumberFormat::plain(0, 10, 2));
    auto* automatic = new AutomaticText(&narrow, 0); // goes with its field
    automatic->set_amount(QStringLiteral("0.42 mm"));
    narrow.setFixedWidth(400);
    narrow.show();
    settle();
    EXPECT_EQ(narrow.placeholderText(), QStringLiteral("automatic (0.42 mm)"));
    EXPECT_EQ(narrow.toolTip(), QString());
    for (const int width : {110, 70}) {
        narrow.setFixedWidth(width);
        settle();
        EXPECT_TRUE(narrow.placeholderText().contains(QStringLiteral("0.42 mm")));
        EXPECT_LE(narrow.fontMetrics().horizontalAdvance(narrow.placeholderText()), width);
        EXPECT_EQ(narrow.toolTip(), QStringLiteral("automatic (0.42 mm)"));
    }
    EXPECT_EQ(narrow.placeholderText(), QStringLiteral("0.42 mm"));
}

TEST_F(QualityTest, WhatTheEngineIsDoingIsNotCut) {
    ElidedLabel label;
    label.set_text(QStringLiteral("Getting ready to follow edits: Painting light onto surfaces"));
    label.resize(900, 20);
    EXPECT_EQ(label.shown_text(), label.text());
    EXPECT_TRUE(label.toolTip().isEmpty());
    label.resize(120, 20);
    label.show();
    settle();
    EXPECT_TRUE(label.shown_text().endsWith(QChar(0x2026)));
    EXPECT_LE(label.fontMetrics().horizontalAdvance(label.shown_text()), 120);
    EXPECT_EQ(label.toolTip(), label.text());
    label.hide();

    open_sample();
    window->findChild<QDockWidget*>(QStringLiteral("dock_jobs"))->raise();
    settle();
    const auto* phase = window->findChild<ElidedLabel*>(QStringLiteral("job_phase"));
    const auto* times = window->findChild<ElidedLabel*>(QStringLiteral("job_times"));
    ASSERT_TRUE(phase != nullptr && times != nullptr);
    EXPECT_FALSE(phase->geometry().intersects(times->geometry()));
    EXPECT_EQ(phase->width(), times->width());
    EXPECT_GT(phase->width(), phase->parentWidget()->width() - 24) << "a line of its own";
    EXPECT_GE(phase->height(), phase->fontMetrics().height());
    // Nor is it in the status bar when the text grows, before anything is laid out again.
    auto* badge = window->findChild<QLabel*>(QStringLiteral("light_state"));
    ASSERT_NE(badge, nullptr);
    for (const char* text : {"Solving 9 %", "Solving 12 %", "Settled, refining 99 %"}) {
        badge->setText(QLatin1StringView(text));
        EXPECT_GE(badge->width(), badge->fontMetrics().horizontalAdvance(badge->text())) << text;
    }
}

} // namespace
} // namespace atrium::ui
