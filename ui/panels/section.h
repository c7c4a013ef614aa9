// One titled block of the properties panel: rows bound to the document by a reader and a writer each.
#pragma once

#include "ui/document/document.h"
#include "ui/document/gesture.h"
#include "ui/panels/number_field.h"

#include <QWidget>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QGridLayout;

namespace atrium::ui {

class ColorButton;

/// UI thread only. A reader returns the values of all targets (none = the row is hidden, different = "mixed"); a writer
/// returns the edit that gives all targets the value.
class Section : public QWidget {
    Q_OBJECT
public:
    Section(const QString& title, Document& document, QWidget* parent = nullptr);
    ~Section() override;

    void refresh(); ///< reads everything again; hides the section when it has no target

Q_SIGNALS:
    void message(const QString& text);

protected:
    using Numbers = std::function<std::vector<double>()>;
    using WriteNumber = std::function<SceneEdit(double)>;
    using Colors = std::function<std::vector<Rgb>()>;
    using WriteColor = std::function<SceneEdit(Rgb)>;

    [[nodiscard]] virtual bool has_target() const = 0;
    virtual void refresh_more() {} ///< after the rows

    Document& document() const { return document_; }
    const Scene& scene() const { return document_.scene(); }

    NumberField* add_number(const QString& label, const NumberFormat& format, Numbers read, WriteNumber write);
    /// Three fields in one row, for x, y and z; they share the whole width of the panel with their label.
    std::array<NumberField*, 3> add_vector(const QString& label, const NumberFormat& format,
                                           std::function<std::vector<dvec3>()> read,
                                           std::function<SceneEdit(int axis, double value)> write);
    ColorButton* add_color(const QString& label, Colors read, WriteColor write);
    QCheckBox* add_check(const QString& label, std::function<std::vector<bool>()> read,
                         std::function<SceneEdit(bool)> write);
    /// Combo box whose entries stay; a read value is an index into them, -1 = mixed or none.
    QComboBox* add_choice(const QString& label, const QStringList& entries, std::function<std::vector<int>()> read,
                          std::function<SceneEdit(int)> write);
    void add_row(const QString& label, QWidget* widget, std::function<bool()> shown = {});
    bool apply(const SceneEdit& edit, const QString& text);

private:
    QLabel* place(const QString& label, QWidget* widget); ///< appends a row; returns its label
    void bind(NumberField* field, const QString& label, std::function<SceneEdit(double)> write);
    void begin(const QString& label);
    void end(bool keep);

    Document& document_;
    QGridLayout* grid_ = nullptr;
    std::unique_ptr<Gesture> gesture_;
    std::vector<std::function<void()>> refreshers_;
};

} // namespace atrium::ui
