// A line above the view that stays until something is done about it: what a message in the status bar is too short for.
#pragma once

#include <QFrame>

class QHBoxLayout;
class QLabel;
class QPushButton;

namespace atrium::ui {

/// Hidden at first. UI thread only.
class NoticeBar : public QFrame {
    Q_OBJECT
public:
    explicit NoticeBar(const char* name, QWidget* parent = nullptr);
    /// A button; connect to its clicked().
    QPushButton* add_button(const QString& text);
    void show_text(const QString& text);
    [[nodiscard]] QString text() const;

private:
    QHBoxLayout* layout_;
    QLabel* icon_;
    QLabel* text_;
};

} // namespace atrium::ui
