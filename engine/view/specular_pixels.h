// What a view shows over mirrors, metals and glass, pixel by pixel: to be laid over a picture that cannot trace rays.
#pragma once

#include "engine/view/still.h"

#include <functional>

namespace atrium {

class LitScene;

/// A rectangle of a view. Pixels hold radiance times the share of the pixel that mirrors, metals and glass cover, cd/m2, and
/// that share in w: 0 where the view shows none.
struct SpecularPixels {
    int left = 0; ///< of the rectangle in the view, pixels from its upper left corner
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<vec4> pixels; ///< rows from the top
    int samples = 0;          ///< a pixel, of those traced last
    bool complete = false;    ///< all have as many: nothing better follows
};

/// A scene with its light, ready to be looked at from any place. Immutable; safe from any thread.
class SpecularView {
public:
    SpecularView(const Scene& scene, const Solution& solution);
    ~SpecularView();
    SpecularView(const SpecularView&) = delete;
    SpecularView& operator=(const SpecularView&) = delete;

    /// A shown surface of the scene mirrors or refracts; without any there is nothing to do and nothing is built.
    static bool any(const Scene& scene);
    /// Traces only pixels near such surfaces: one sample each, then n x n where neighbours differ, then n x n in the others.
    /// `watcher` is called on the calling thread with each of the three. Mirrors and glass show all light; of what lies
    /// straight behind clear panes `shares`. Stops within some milliseconds when the context says so; what was not handed to
    /// the watcher is then lost.
    void look(const ViewCamera& camera, int width, int height, int n, const LightShares& shares, const RunContext& context,
              const std::function<void(SpecularPixels)>& watcher) const;

private:
    std::unique_ptr<const LitScene> lit_;
    Rgb sky_{0.0F};
};

} // namespace atrium
