// One part of the direct light on all sheets: where it is sampled, and how closely.
#pragma once

#include "engine/base/run_context.h"
#include "engine/layers/direct_map_builder.h"
#include "engine/layers/light_cells.h"
#include "engine/layers/light_sheets.h"
#include "engine/layers/tile_budget.h"
#include "engine/radiosity/box_sight.h"

#include <array>
#include <span>
#include <vector>

namespace atrium {

/// Cells divided as the light asks for. Engine thread; parallel inside.
class LightPart {
public:
    enum class Effort : std::uint8_t {
        Build,  ///< on a grid all over, or as soft parts start
        Anew,   ///< the same light where the part shines; elsewhere tiles stay whole
        Hurried ///< likewise, two levels coarser, and streaks between the samples are not looked for
    };
    /// All arguments must outlive it. `before` are parts that are done: errors are judged against their light too. `near`
    /// are the cells that are divided at once where tiles start whole: see cells_near_things() and cells_within_reach().
    LightPart(const LightSheets& sheets, const DirectPart& part, std::vector<const LightPart*> before,
              const std::vector<LightCell>& near, const DirectMapSettings& settings, TileBudget& budget,
              const RunContext& context, Effort effort = Effort::Build);

    /// Samples and divides until all is smooth, as fine as allowed, or the budget is spent; false when asked to stop.
    bool run(double progress_from, double progress_to);

    /// Looks again where a change may have changed the light, and divides cells where its edges lie now. Marks sheets whose
    /// light is new. False when asked to stop. In a hurry errors are judged against the light of `all` parts.
    /// `sight`: of the boxes of the change.
    bool repair(const LightChange& change, BoxSight& sight, std::span<const LightPart* const> all, const RunContext& context,
                std::vector<std::uint8_t>& changed_sheets);

    /// What one source of this part sends to every node, over its brightness. `source`: that source alone, over its
    /// brightness; where it is empty the part has no other. Looked at on the coarsest grid, and closer where the source's
    /// share of the light differs there. Not to be used when `context` asked to stop.
    [[nodiscard]] std::vector<Rgb> light_of(const DirectFunction& source, const Rgb& brightness, const RunContext& context);
    /// The same with its brightness and for every node, however long it takes: what add_light() can take away again.
    [[nodiscard]] std::vector<Rgb> all_light_of(const DirectFunction& source, const RunContext& context) const;
    /// Makes that source brighter by `change`, for good: what repairs start from.
    void add_light(const std::vector<Rgb>& of_source, const Rgb& change);

    [[nodiscard]] LightCells& cells() { return cells_; }
    [[nodiscard]] const LightCells& cells() const { return cells_; }
    /// Calls of the direct function.
    [[nodiscard]] std::size_t evaluations() const;
    /// The same over all runs and repairs.
    [[nodiscard]] std::size_t samples_taken() const { return taken_; }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    /// A sample to take.
    struct Request {
        std::uint32_t sheet = 0;
        std::uint32_t index = 0; ///< of its node, or of its probe
        bool probe = false;
        vec2 at{0.0F};      ///< metres along the chart
        float reach = 0.0F; ///< metres: with no triangle within them the place is away from the surface
    };
    /// A sample inside a cell that starts out undivided, at a scattered place: what lies between the nodes.
    struct Probe {
        vec2 at{0.0F}; ///< steps
        LightGuess seen;
        bool covered = false;
    };
    /// A cell that ought to be divided, and how far it is off.
    struct Rough {
        LightCell cell;
        float error = 0.0F;
    };

    [[nodiscard]] Rgb light_of_node(const LightNode& node, const DirectFunction& source, const Rgb& most) const;
    [[nodiscard]] bool guess_share(const LightNode& node, std::uint32_t step, const std::vector<Rgb>& light,
                                   const Rgb& brightness, Rgb& share) const;
    std::vector<LightCell> first_cells();
    [[nodiscard]] bool probes(const LightCell& cell) const;
    void divide_near_things(std::vector<LightCell>& fresh);
    void leave_out_dark_sheets(std::vector<LightCell>& fresh) const;
    void ask_for_nodes(unsigned level);
    void ask_for_probe(const LightCell& cell);
    bool sample(double from, double to);
    void take(const Request& request);
    [[nodiscard]] LightNode::State state_of_other_parts(const Request& request) const;

    [[nodiscard]] std::optional<vec3> place_of(std::uint32_t sheet, const vec2& steps) const;
    [[nodiscard]] bool may_change(const LightChange& change, std::uint32_t sheet, const vec2& steps, float radius) const;
    [[nodiscard]] bool may_change_at(const LightChange& change, const vec3& point, float radius) const;
    bool node_may_change(const LightChange& change, std::uint32_t node);
    [[nodiscard]] bool meets_moved(const LightChange& change, std::uint32_t sheet, const vec3& point) const;
    [[nodiscard]] bool may_change_round(const LightChange& change, std::uint32_t surface) const;
    [[nodiscard]] bool tile_sees(BoxSight& sight, std::uint32_t sheet, std::uint32_t u, std::uint32_t v) const;
    std::vector<std::uint16_t> blocks_to_look_at(const LightChange& change, BoxSight& sight);
    void divide_around(const LightChange& change);
    std::array<LightCell, 4> divide_smoothly(const LightCell& cell);
    void keep_most_seen(const LightChange& change, std::size_t most, std::vector<std::uint32_t>& nodes) const;
    std::vector<std::uint32_t> ask_again(const LightChange& change, BoxSight& sight);
    void spread_change(const std::vector<std::uint32_t>& asked, const std::vector<LightNode>& before);
    [[nodiscard]] std::vector<LightCell> cells_around(const std::vector<std::uint32_t>& changed) const;
    void find_floors();
    [[nodiscard]] float allowed(const LightCell& cell) const;
    [[nodiscard]] float relative(const LightCell& cell, float difference, float variance, float light) const;
    [[nodiscard]] float bend(const LightCell& cell, const LightGuess& a, const LightGuess& b, const LightNode& start,
                             bool along_u, float light) const;
    [[nodiscard]] bool lit_around(const LightCell& cell) const;
    [[nodiscard]] float change_at_cover(const LightCell& cell, std::uint32_t known, std::uint32_t covered,
                                        float light) const;
    [[nodiscard]] float off(const LightCell& cell, const LightGuess& seen, float dx, float dy) const;
    [[nodiscard]] float error(const LightCell& cell) const;
    [[nodiscard]] float other_light(const LightCell& cell) const;
    [[nodiscard]] Rough beside(const LightNode& node, std::size_t quadrant) const;
    void examine(const std::vector<LightCell>& fresh, std::vector<Rough>& rough) const;
    void look_beside(std::size_t first_new, std::vector<Rough>& rough) const;
    std::vector<LightCell> divide(std::vector<Rough>& rough);

    [[nodiscard]] vec2 metres_per_step(std::uint32_t sheet) const;
    [[nodiscard]] float edge_metres(const LightCell& cell) const;
    [[nodiscard]] std::size_t probe_index(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) const;
    /// Calls visit(probe, place in steps from the cell's corner) for what was probed in a cell.
    template <class Visit> void for_probes(const LightCell& cell, const Visit& visit) const;

    const LightSheets& sheets_;
    const DirectPart& part_;
    std::vector<const LightPart*> before_;
    std::span<const LightPart* const> judged_by_; ///< beside it
    const std::vector<LightCell>& near_;
    const DirectMapSettings& settings_;
    TileBudget& budget_;
    const RunContext* context_; ///< of the call at hand
    Effort effort_;
    std::vector<float> floor_; ///< lux, per sheet: errors are judged against at least this
    unsigned finest_;          ///< level below which this part's cells are not divided
    unsigned probe_level_;     ///< a probe for each cell of this level at most; soft parts have coarser cells too
    LightCells cells_;
    std::vector<std::size_t> first_probe_; ///< per sheet; a place for a probe per cell of probe_level_, row by row
    std::vector<Probe> probes_;
    std::vector<Request> requests_;
    bool repairing_ = false;
    bool coarse_repair_ = false; ///< the repair at hand looks at the nodes of repair_level_ only
    unsigned repair_level_ = 0;
    std::vector<vec3> round_places_;  ///< per node, of round charts, as far as repairs asked; empty without any
    std::vector<std::uint8_t> stale_; ///< per node (those beyond its end: 0): left out or guessed by a repair in a hurry
    std::unique_ptr<BoxSight> over_sight_; ///< of part_.over, once a repair asked
    /// Per node and per probe: its light may not be that of when all was built. Nodes beyond the end: 1.
    std::vector<std::uint8_t> differs_, probe_differs_;
    std::size_t asked_ = 0;   ///< nodes that were asked for
    std::size_t taken_ = 0;   ///< samples
    std::size_t sampled_ = 0; ///< nodes that were sampled
};

template <class Visit> void LightPart::for_probes(const LightCell& c, const Visit& visit) const {
    const std::uint32_t s = cells_.steps(c.level), edge = cells_.steps(probe_level_);
    for (std::uint32_t y = c.y; y < c.y + s; y += edge) {
        for (std::uint32_t x = c.x; x < c.x + s; x += edge) {
            const Probe& probe = probes_[probe_index(c.sheet, x, y)];
            const vec2 at = probe.at - vec2(float(c.x), float(c.y));
            if (at.x >= 0.0F && at.y >= 0.0F && at.x < float(s) && at.y < float(s)) {
                visit(probe, at);
            }
        }
    }
}

} // namespace atrium
