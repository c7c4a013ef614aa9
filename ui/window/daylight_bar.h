// The bar above the view that offers daylight for a file without any light; it never acts by itself.
#pragma once

#include "ui/document/document.h"

#include <QFrame>

namespace atrium::ui {

/// Shows itself after a scene without light was opened and goes as soon as there is some. UI thread only.
class DaylightBar : public QFrame {
    Q_OBJECT
public:
    explicit DaylightBar(Document& document, QWidget* parent = nullptr);

Q_SIGNALS:
    void accepted(); ///< the user wants a sun and a sky

private:
    void update_offer();
    Document& document_;
    bool declined_ = false;
};

} // namespace atrium::ui
