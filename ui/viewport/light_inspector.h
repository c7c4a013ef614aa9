// Looks into the light: what overlays are on, the figures that they draw and the words that go with them.
#pragma once

#include "engine/base/run_context.h"
#include "ui/viewport/inspection_figures.h"
#include "ui/viewport/legend.h"
#include "ui/viewport/view_scene.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <functional>
#include <optional>

namespace atrium::ui {

/// Which overlays are on.
struct InspectionChoice {
    bool elements = false;    ///< borders of the elements
    bool links = false;       ///< of the element that was clicked
    bool ways = false;        ///< of particles
    bool octree = false;      ///< of passing particles, around the selection
    bool last_update = false; ///< what it changed
    bool histogram = false;   ///< of the amounts in false colour, beside the legend
    ElementColors colors = ElementColors::None;
    friend bool operator==(const InspectionChoice&, const InspectionChoice&) = default;
    /// Solution::insides must be asked for.
    [[nodiscard]] bool needs_insides() const { return elements || links || ways || octree || of_elements(colors); }
};

/// UI thread only; figures are made on pool threads, and nothing is kept of what is off.
class LightInspector : public QObject {
    Q_OBJECT
public:
    /// `scene` gives the one that is shown, `known_error` what is known of the error of its light; null for nothing.
    LightInspector(std::function<const Scene&()> scene, std::function<std::shared_ptr<const LocalError>()> known_error,
                   QObject* parent);
    ~LightInspector() override { stop_error_.request_stop(); }

    void set_choice(const InspectionChoice& choice);
    [[nodiscard]] const InspectionChoice& choice() const { return choice_; }
    /// The light that is shown now; may be null.
    void take(const std::shared_ptr<const Solution>& solution);
    /// Of which nodes meshes, ways and octrees are drawn; of all (octrees: none) where nothing is selected.
    void select(const std::unordered_set<NodeId>& nodes);
    /// What false colour shows, for the histogram; none: the picture.
    void measure(const std::optional<FalseColor>& scale, const LightShares& shares);
    [[nodiscard]] std::vector<float> bars() const;
    /// Another document.
    void clear();

    /// Chooses the element whose links are drawn; none: draws no links any more. True when that changed something.
    bool choose(const Scene& scene, const std::optional<PickHit>& hit);
    /// The link to the element there gets the shaft; none: the strongest one. True when that changed something.
    bool point_at(const Scene& scene, const std::optional<PickHit>& hit);
    [[nodiscard]] const std::optional<ElementLinks>& links() const { return links_; }
    /// Something that is on is still to come.
    [[nodiscard]] bool busy() const {
        return working_ || measuring_error_ || counting_ ||
               (choice_.needs_insides() && solution_ && solution_->updatable && !solution_->insides);
    }

    [[nodiscard]] std::vector<ShownFigures> figures() const;
    void draw(OverlayBatch& batch, const CameraController& camera) const;
    [[nodiscard]] QStringList words(const Scene& scene) const;
    /// The scale of the element colours, where these are on and there.
    struct Scale {
        FalseColor scale;
        QString title;
    };
    [[nodiscard]] std::optional<Scale> scale() const;

Q_SIGNALS:
    void changed();         ///< words, links: the picture stays
    void figures_changed(); ///< the picture is to be drawn anew

private:
    void make();
    void make_update(const std::shared_ptr<const Solution>& before, const std::shared_ptr<const Solution>& after);
    void follow_element();
    void make_error();
    void make_histogram();

    std::function<const Scene&()> scene_;
    std::function<std::shared_ptr<const LocalError>()> known_error_;
    InspectionChoice choice_;
    std::shared_ptr<const Solution> solution_;
    std::unordered_set<NodeId> of_;
    int number_ = 0; ///< rises with whatever makes a work that is under way useless
    bool working_ = false;

    /// What a work on a pool thread comes back with.
    struct Made {
        std::shared_ptr<const Insides> from; ///< that `view` is of
        std::shared_ptr<const ElementView> view;
        std::shared_ptr<const FigureSet> mesh, colors, ways, octree;
        FalseColor scale;
        std::size_t leaves = 0;
        QStringList way_words, octree_words;
    };
    Made made_;
    ElementColors made_colors_ = ElementColors::None;

    /// The place that was clicked, so that another solution's element is found there.
    struct Place {
        NodeId node;
        std::uint32_t part = 0;
        vec3 point{0.0F}; ///< in the node's own coordinates
        bool back = false;
    };
    std::optional<Place> place_;
    std::optional<ElementLinks> links_;
    std::size_t shaft_ = 0;

    /// Measured for the solution with these surfaces.
    ErrorFigures error_;
    std::vector<std::shared_ptr<const SurfaceLayer>> error_surfaces_;
    QString error_failure_;
    bool measuring_error_ = false;
    StopFlag stop_error_;

    std::optional<FalseColor> measured_;
    LightShares shares_;
    std::vector<double> amounts_; ///< ascending
    bool counting_ = false;
    int count_number_ = 0;

    std::shared_ptr<const FigureSet> update_;
    QStringList update_words_;
    QElapsedTimer update_age_;
    QTimer fade_;
};

} // namespace atrium::ui
