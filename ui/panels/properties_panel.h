// The dock that shows and changes what is selected; with nothing selected, the scene as a whole.
#pragma once

#include "ui/document/document.h"

#include <QScrollArea>

#include <vector>

class QLabel;

namespace atrium::ui {

class Section;

/// UI thread only. Follows selection and edits; refreshed at most once per turn of the event loop.
class PropertiesPanel : public QScrollArea {
    Q_OBJECT
public:
    explicit PropertiesPanel(Document& document, QWidget* parent = nullptr);
    void refresh();

Q_SIGNALS:
    void message(const QString& text);
    void look_through(atrium::NodeId camera);
    void choose_photometry(const std::vector<atrium::LightId>& lights);

private:
    void refresh_soon();
    Document& document_;
    std::vector<Section*> sections_;
    bool queued_ = false;
};

} // namespace atrium::ui
