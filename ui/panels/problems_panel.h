// The list of what is wrong with the scene: of the file as it was read, and of the scene as it is now.
#pragma once

#include "ui/document/document.h"

#include <QTimer>
#include <QTreeWidget>

namespace atrium::ui {

/// UI thread only; the checking itself runs in the background shortly after the last edit.
class ProblemsPanel : public QTreeWidget {
    Q_OBJECT
public:
    explicit ProblemsPanel(Document& document, QWidget* parent = nullptr);
    /// What is to be said about the light that is shown; empty: nothing.
    void set_light_warning(const QString& text);

Q_SIGNALS:
    void activated_node(atrium::NodeId id);
    void count_changed(int errors, int warnings);

private:
    void check();
    void fill(const std::vector<Problem>& found);

    Document& document_;
    QTimer delay_;
    std::vector<Problem> found_;
    QString light_warning_;
    bool checking_ = false;
};

} // namespace atrium::ui
