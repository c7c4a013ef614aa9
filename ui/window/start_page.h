// What is shown when nothing is open: open, new, the sample room, recent files.
#pragma once

#include <QWidget>

class QListWidget;

namespace atrium::ui {

class Actions;

/// UI thread only.
class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(const Actions& actions, QWidget* parent = nullptr);
    void set_recent(const QStringList& files);

Q_SIGNALS:
    void sample_requested();
    void file_requested(const QString& path);

private:
    QListWidget* recent_ = nullptr;
    QWidget* recent_title_ = nullptr;
};

} // namespace atrium::ui
