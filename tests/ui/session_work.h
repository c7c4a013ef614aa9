// What the scripted session needs of a hand and an eye: drags as the window system makes them, places found by their light.
#pragma once

#include "timed_application.h"
#include "window_fixture.h"

#include <optional>
#include <unordered_set>
#include <vector>

namespace atrium::ui {

/// Where the session plays. The folder is prepared by the process that starts it.
struct Stage {
    const char* name = nullptr;
    const char* file = nullptr; ///< of scenes/, or of the shared scenes
    bool shared = false;        ///< skipped where there are none
    int camera = 0;             ///< presses of Ctrl+PgDown for the view in which the room is furnished
    std::optional<std::pair<dvec3, dvec3>>
        look;                   ///< eye and target of the view in which the vase is dragged; null: as before
    bool daylight = false;      ///< there is no sun in it: the session adds one
    const char* wall = nullptr; ///< painted, and gets the mirror; null: the widest one in view
    /// Where the vase is dragged; without a support the sunlit place on the floor is looked for.
    const char* support = nullptr;
    dvec3 from{0.0}, middle{0.0}, to{0.0};
    std::vector<dvec3> lit; ///< places whose light the vase crosses, on matt surfaces
};
/// The stage that ATRIUM_SESSION_STAGE names, or the first.
const Stage& session_stage();
const std::vector<Stage>& session_stages();

/// A way that leads from shade through the sun into shade, and places on it that are sunlit.
struct Crossing {
    dvec3 from{0.0}, middle{0.0}, to{0.0};
    std::vector<dvec3> lit;
};

class SessionWork : public WindowTest {
protected:
    void SetUp() override;
    static TimedApplication& application() { return *static_cast<TimedApplication*>(QCoreApplication::instance()); }
    void step(const char* what);
    void picture(const char* name);
    /// Complete light of the present scene.
    bool wait_for_light();
    /// The light in the picture is of the scene as it is now, made in a hurry or not.
    bool wait_for_update();
    void keys(Qt::Key key, Qt::KeyboardModifiers held = {});
    /// Finds an entry in the library by its name and drags it over the view, press to release, by Qt's own drag and drop.
    void drag_from_library(const char* search, const char* key, const QPoint& to);
    /// A point of the view where this object is in front, near the projection of `world`.
    QPoint seen(NodeId id, const dvec3& world);
    /// Lux on the matt surface that is seen at a world point; none where something else is in front of it.
    std::optional<double> lux(const dvec3& world);
    std::vector<double> lux(const std::vector<dvec3>& places); ///< -1 where nothing can be read
    /// What these places are on.
    std::unordered_set<NodeId> surfaces(const std::vector<dvec3>& places);
    /// Light that has followed and settled after a gesture.
    bool wait_for_rest();
    /// A point in the middle of a wall in view, and the wall.
    std::optional<std::pair<QPoint, NodeId>> wall_in_view();
    /// Across the brightest sunlit place of the floor in view.
    std::optional<Crossing> sun_on_floor();

    [[nodiscard]] dvec3 origin(NodeId id) { return dvec3(scene().world_matrix(id)[3]); }
    /// The left button goes down on an object, the hand carries it to a place and looks where it is on the way.
    void hold(const QPoint& point);
    void carry(NodeId id, const dvec3& to);
    void let_go();

    QPoint cursor_;
};

} // namespace atrium::ui
