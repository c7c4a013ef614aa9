// The material editor: of one part of one object, or of all materials of several objects.
#pragma once

#include "ui/panels/section.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace atrium::ui {

/// UI thread only. A part without a material shows the default one and gets its own with "Make Unique".
class MaterialSection : public Section {
    Q_OBJECT
public:
    explicit MaterialSection(Document& document);

protected:
    bool has_target() const override;
    void refresh_more() override;

private:
    struct Place {
        NodeId node;
        std::size_t part;
    };
    std::vector<Place> places() const;       ///< parts that are edited: the chosen one, or all of all selected
    std::vector<MaterialId> targets() const; ///< their materials, each once, without "none"
    std::size_t parts_of_active() const;     ///< 0 with several objects selected
    SceneEdit write(const std::function<void(Material&)>& change) const;
    std::vector<double> read(const std::function<double(const Material&)>& get) const;
    void fill_parts();
    void fill_materials(bool all_of_them); ///< otherwise only the current one: cheap at every refresh
    void assign(MaterialId material);
    void make_unique();

    QComboBox* part_ = nullptr;
    QComboBox* material_ = nullptr;
    QLineEdit* name_ = nullptr;
    QLabel* note_ = nullptr;
    QPushButton* unique_ = nullptr;
    NodeId parts_of_; ///< the node that part_ lists
};

} // namespace atrium::ui
