// The whole editor window on the screen, driven by real mouse and key events.
#pragma once

#include "ui/actions/actions.h"
#include "ui/panels/number_field.h"
#include "ui/panels/scene_tree_panel.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/file_controller.h"
#include "ui/window/main_window.h"
#include "watchdog.h"

#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <QTest>

namespace atrium::ui {

class WindowTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    void open_sample();
    [[nodiscard]] const Scene& scene() { return window->document().scene(); }
    [[nodiscard]] NodeId named(const std::string& name);
    [[nodiscard]] const Node& node(NodeId id) { return *scene().nodes.find(id); }
    [[nodiscard]] int entries() { return window->document().undo_stack()->count(); }
    void trigger(ActionId id) { window->action(id)->trigger(); }
    void select(NodeId id) { window->document().selection()->set({id}); }
    [[nodiscard]] NumberField* field(const char* name);
    void type(QWidget* widget, const char* text, Qt::Key end = Qt::Key_Return);
    void settle() { QTest::qWait(30); }
    void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers held = Qt::NoModifier);
    /// Screen point of a world point in the view.
    [[nodiscard]] QPoint at(const dvec3& world);
    [[nodiscard]] double pixel_size(const dvec3& world); ///< metres per pixel there
    template <class T> T* dialog(const char* name = nullptr) {
        T* found = nullptr;
        (void)QTest::qWaitFor([&] {
            found = name == nullptr ? window->findChild<T*>() : window->findChild<T*>(QLatin1StringView(name));
            return found != nullptr && found->isVisible();
        });
        return found;
    }

    QTemporaryDir folder;
    std::unique_ptr<MainWindow> window;

private:
    bool first_window_ = true; ///< of the test: TearDown() and SetUp() within one are another run of the program
};

} // namespace atrium::ui
