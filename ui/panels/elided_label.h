// A line of text that is shortened with an ellipsis where there is no room for all of it.
#pragma once

#include <QLabel>

namespace atrium::ui {

/// UI thread only. Never widens what it stands in. text() is the whole; so is the tool tip where only a part is to be seen.
class ElidedLabel : public QLabel {
    Q_OBJECT
public:
    explicit ElidedLabel(QWidget* parent = nullptr);
    /// setText(), which is not virtual, and the tool tip with it.
    void set_text(const QString& text);
    [[nodiscard]] QString shown_text() const; ///< what there is room for
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void show_tip();
};

} // namespace atrium::ui
