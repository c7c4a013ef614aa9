// A luminaire's light over directions as catalogues draw it: intensity from the middle outwards, straight down is down.
#pragma once

#include "engine/scene/light.h"

#include <QWidget>

namespace atrium::ui {

/// UI thread only. Planes C0 to C180 (drawn through) and C90 to C270 (dashed where it differs).
class PolarDiagram : public QWidget {
    Q_OBJECT
public:
    explicit PolarDiagram(QWidget* parent = nullptr);
    void set_photometry(const Photometry& photometry); ///< none: the widget is empty

    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Photometry photometry_;
};

} // namespace atrium::ui
