// Light that follows lamps that move, turn or shine otherwise than before; for gi_engine*.cpp, relight*.cpp and
// lamp_moves.cpp.
#pragma once

#include "engine/solver/gi_engine.h"

#include <memory>
#include <vector>

namespace atrium {

class DirectLight;
struct Element;
struct PlacedLight;

/// Lamps (point, spot and photometric lights, the sun) that moved since the last complete solution. What they send leaves
/// the light that stays, once, and is found anew after every move: in the light maps it is a part of its own, on vertices
/// and leaves it is a share that is known. So all other light is not looked at again, and no move leaves anything behind.
/// Made by the first such move; the complete solution that follows knows nothing of it.
struct GiEngine::LampMoves {
    std::vector<std::uint32_t> lights;            ///< that moved; into DirectLight::lights(), ascending
    std::unique_ptr<DirectLight> moving, staying; ///< these, and all others, as they are now
    std::size_t part;                             ///< of LiveDirectMaps: direct light of these, over mirrors too
    bool owed = false;                            ///< they moved, and no update since then was finished
    bool exact = false;                           ///< their part is as exact as that of a new solution
    std::size_t first_new = SIZE_MAX;             ///< of DirectLight::lights(): from here on they were not there, or off

    LampMoves();
    ~LampMoves();

    /// Finds lamps that are elsewhere or of another shape in `scene`, takes what they sent out of the light that stays, and
    /// places them; those that are new are among them, and sent nothing. Before anything else follows the scene. Returns how
    /// many moved. An error when asked to stop: nothing has changed then.
    static Result<std::size_t> follow(Impl& s, const Scene& scene, const RunContext& context);
    /// Lamps moved, or the light of those that did is to be made exact.
    static bool needed(const Impl& s, bool settle);
    /// Direct light of the lamps on vertices without a map.
    void light_vertices(Impl& s, const RunContext& context);
    /// Likewise on leaves.
    void light_leaves(Impl& s, bool settle, const RunContext& context);
    /// All direct light of a vertex or of a leaf was sampled again: its share is what the lamps send there now.
    void sampled_vertex(const Impl& s, std::uint32_t layer, std::uint32_t vertex, bool back);
    void sampled_leaf(const Impl& s, std::uint32_t element);
    /// Takes over intensities and colours from all lamps, in the order of DirectLight::lights().
    void take_brightness(const DirectLight& all);
    /// What stays changed its brightness too: shares and the mean light are to be found again.
    void forget() { known_ = false; }
    /// The part that the lamp shines in by itself.
    [[nodiscard]] bool has(std::uint32_t light) const;
    /// Log-average of reflected radiance that is shown.
    [[nodiscard]] double mean_radiance(const Impl& s) const;

private:
    struct Shares {
        std::vector<Rgb> front, back; ///< per vertex; empty: none
    };
    static Rgb light_at(const Impl& s, const DirectLight& lamps, const vec3& point, const vec3& normal);
    static Rgb light_of_leaf(const Impl& s, const DirectLight& lamps, std::uint32_t element, unsigned most);
    static std::vector<Shares> on_vertices(const Impl& s, const DirectLight& lamps, const RunContext& context);
    static std::vector<Rgb> on_leaves(const Impl& s, const DirectLight& lamps, const RunContext& context);
    static bool take_out(Impl& s, const std::vector<std::uint32_t>& lights, const RunContext& context);

    bool known_ = false;         ///< the following
    std::vector<Shares> shares_; ///< per layer
    std::vector<Rgb> of_leaves_; ///< per element
    std::vector<double> bright_; ///< per leaf of the exchange: luminance that it reflected
    double mean_radiance_ = 0.0; ///< shown then
};

} // namespace atrium
