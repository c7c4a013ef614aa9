// Photometric files on their way to lamps: chosen in a dialog or dropped, read in the background, one undo entry each.
#pragma once

#include "engine/io/ldt_reader.h"
#include "ui/document/document.h"

#include <QObject>

class QWidget;

namespace atrium::ui {

/// UI thread only. A file that cannot be read changes nothing, and says why.
class PhotometryController : public QObject {
    Q_OBJECT
public:
    PhotometryController(Document& document, QWidget* window);

    /// Asks for a file for these lamps.
    void choose(const std::vector<LightId>& lights);
    /// Gives a file to lamps; those that are gone by the time it is read are left out.
    void assign(const QString& path, const std::vector<LightId>& lights);
    /// Asks for a file for a new lamp; `at` is asked for its place once there is one.
    void choose_and_add(const std::function<dvec3()>& at);
    /// Adds a lamp that shines downwards at a place, world metres, and selects it.
    void add(const QString& path, const dvec3& at);
    /// Lamps that a drop on this node means: its own or those of what is below it.
    [[nodiscard]] std::vector<LightId> lamps_of(NodeId node) const;

Q_SIGNALS:
    void message(const QString& text);

private:
    void ask(const QString& title, std::function<void(const QString& path)> then);
    void read(const QString& path, std::function<void(const LoadedPhotometry&)> then);
    void tell(const QString& path, const LoadedPhotometry& loaded);

    Document& document_;
    QWidget* window_;
};

} // namespace atrium::ui
