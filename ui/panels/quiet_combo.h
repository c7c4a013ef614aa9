// A combo box that leaves the wheel to the panel around it unless it has the focus, and can fill itself when it is used.
#pragma once

#include <QComboBox>
#include <QFocusEvent>
#include <QWheelEvent>

namespace atrium::ui {

class QuietCombo : public QComboBox {
    Q_OBJECT
public:
    explicit QuietCombo(QWidget* parent = nullptr) : QComboBox(parent) {
        setFocusPolicy(Qt::StrongFocus);
        setSizeAdjustPolicy(AdjustToMinimumContentsLengthWithIcon); // long names must not widen the panel
        setMinimumContentsLength(8);
    }

    void showPopup() override {
        Q_EMIT about_to_be_used();
        QComboBox::showPopup();
    }

Q_SIGNALS:
    void about_to_be_used(); ///< got the focus or opens: long lists are filled now, not at every refresh

protected:
    void focusInEvent(QFocusEvent* event) override {
        Q_EMIT about_to_be_used();
        QComboBox::focusInEvent(event);
    }
    void wheelEvent(QWheelEvent* event) override {
        if (hasFocus()) {
            QComboBox::wheelEvent(event);
        } else {
            event->ignore();
        }
    }
};

} // namespace atrium::ui
