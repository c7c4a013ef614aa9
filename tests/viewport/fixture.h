// A viewport on a hand-made scene with hand-made light: nothing of the solver takes part.
#pragma once

#include "engine/solver/solution.h"
#include "ui/viewport/viewport_widget.h"

#include <QImage>

#include <gtest/gtest.h>

namespace atrium::ui {

/// Layer on every shown (node, part) of a scene; `light` gives the irradiance at a world point with a world normal.
std::shared_ptr<Solution> light_scene(const Scene& scene,
                                      const std::function<Rgb(const dvec3& point, const dvec3& normal)>& light);

class ViewportFixture : public testing::Test {
protected:
    void TearDown() override;
    /// Opens a scene with its light and shows the view, 640 x 480, from `eye` towards `target`.
    void open(Scene scene, std::shared_ptr<Solution> solution, const dvec3& eye, const dvec3& target);
    void look(const dvec3& eye, const dvec3& target);
    [[nodiscard]] QImage grab();
    /// The view in the screen's own pixels, none left out.
    QImage grab_pixels();
    /// Screen point of a world point, by the camera that the widget reports.
    [[nodiscard]] QPoint at(const dvec3& world) const;
    [[nodiscard]] QPoint pixel_at(const dvec3& world) const;  ///< of grab_pixels()
    [[nodiscard]] QPointF place_of(const dvec3& world) const; ///< logical pixels, not rounded
    void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = Qt::NoModifier, bool release = true);
    void settle(); ///< lets queued events run

    std::unique_ptr<Document> document_;
    std::unique_ptr<EngineLink> engine_;
    std::unique_ptr<ViewportWidget> view_;
};

/// Room 4 x 3 x 5 m of single-sided polygons that face inwards, with a box on the floor in the middle.
Scene small_room(NodeId* box);

} // namespace atrium::ui
