// What is the user's taste and not the document's.
#pragma once

#include <QDialog>

class QComboBox;

namespace atrium::ui {

/// Changes are stored when it is accepted. UI thread only.
class PreferencesDialog : public QDialog {
    Q_OBJECT
public:
    explicit PreferencesDialog(QWidget* parent);

Q_SIGNALS:
    void stored();

private:
    void store();
    QComboBox* language_;
    QComboBox* appearance_;
    QComboBox* autosave_;
    QComboBox* memory_;
};

} // namespace atrium::ui
