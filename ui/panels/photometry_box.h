// What a lamp's photometric file says, for the properties panel: buttons, name, lumens, beam angle, polar diagram.
#pragma once

#include "engine/scene/light.h"

#include <QWidget>

#include <vector>

class QLabel;
class QPushButton;

namespace atrium::ui {

class PolarDiagram;

/// UI thread only. The buttons are a widget of their own, for a row with a label.
class PhotometryBox : public QWidget {
    Q_OBJECT
public:
    explicit PhotometryBox(QWidget* parent = nullptr);
    [[nodiscard]] QWidget* buttons() const { return buttons_; }
    /// The files of all chosen lamps; none is an empty Photometry.
    void set(const std::vector<Photometry>& of_lamps);

Q_SIGNALS:
    void choose();
    void remove();

private:
    QWidget* buttons_ = nullptr;
    QPushButton* choose_ = nullptr;
    QPushButton* remove_ = nullptr;
    QLabel* words_ = nullptr;
    PolarDiagram* diagram_ = nullptr;
};

/// "Maker, 2438 lm, beam 12°".
QString photometry_summary(const PhotometricWeb& web);

} // namespace atrium::ui
