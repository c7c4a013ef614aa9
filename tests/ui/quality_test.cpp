// The wish for quality and its thresholds in the Light panel.
#include "window_fixture.h"

#include <QComboBox>
#include <QDockWidget>
#include <QPushButton>
#include <QToolButton>

namespace atrium::ui {
namespace {

class QualityTest : public WindowTest {
protected:
    [[nodiscard]] const SolverSettings& settings() { return scene().settings; }
};

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
    type(field("Particles"), "1");
    EXPECT_FLOAT_EQ(settings().thresholds.particles, 1000.0F) << "the least";
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

} // namespace
} // namespace atrium::ui
