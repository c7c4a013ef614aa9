// What can be set by hand about the caustics of the rows chosen in the inspector: edits of their nodes.
#pragma once

#include "ui/panels/caustic_words.h"
#include "ui/panels/section.h"

class QPushButton;

namespace atrium::ui {

class AutomaticText;

/// UI thread only.
class CausticSection : public Section {
    Q_OBJECT
public:
    explicit CausticSection(Document& document);
    /// The nodes to change, and the row whose automatic values are shown beside (may be null).
    void set_targets(std::vector<NodeId> nodes, const CausticRow* current);

protected:
    [[nodiscard]] bool has_target() const override;
    void refresh_more() override;

private:
    [[nodiscard]] std::vector<NodeId> targets() const; ///< those that still exist
    [[nodiscard]] SceneEdit write(const std::function<void(CausticWish&)>& change) const;

    std::vector<NodeId> nodes_;
    AutomaticText* texel_ = nullptr;
    AutomaticText* threshold_ = nullptr;
    QPushButton* reset_ = nullptr;
};

} // namespace atrium::ui
