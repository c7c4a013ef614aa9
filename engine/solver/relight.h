// Light that follows when lamps are dimmed or coloured and walls painted; for gi_engine*.cpp and relight*.cpp only.
#pragma once

#include "engine/layers/direct_map_builder.h"
#include "engine/layers/layer_builder.h"
#include "engine/solver/gi_engine.h"

#include <array>
#include <memory>
#include <vector>

namespace atrium {

/// One factor per channel by which all of something changed.
class CommonFactor {
public:
    /// False where `is` is not `was` times the factor of all before.
    bool agrees(const Rgb& was, const Rgb& is);
    [[nodiscard]] Rgb factor() const {
        return {set_[0] ? factor_.r : 1.0F, set_[1] ? factor_.g : 1.0F, set_[2] ? factor_.b : 1.0F};
    }

private:
    Rgb factor_{0.0F};
    std::array<bool, 3> set_{};
};

/// Direct light is linear in the brightness of its sources, and who sees whom stays. So what a source sends to samples,
/// vertices and leaves is found once, when it first changes; from then on light is the base plus changes of brightness times
/// that: no rays, no drift however long a slider is dragged, and back where it was the light is the old one to the bit. What
/// leaves reflect is solved anew between the same leaves. Made by the first such change and dropped by the next move.
struct GiEngine::Relight {
    /// Lamps, a material that shines, or the sky: what changes its brightness at once.
    struct Source {
        enum class Kind : std::uint8_t { Lamps, Emitter, Sky };
        Kind kind = Kind::Sky;
        std::vector<std::uint32_t> lights; ///< Lamps: into DirectLight::lights()
        bool moved = false;                ///< Lamps: their direct light is in the part of LampMoves
        MaterialId material;               ///< Emitter
        Rgb base{0.0F};                    ///< candela, lux or cd/m2
        Rgb now{0.0F};

        // What it sends, over its brightness; once `known`.
        struct Vertices {
            std::vector<Rgb> front, back; ///< empty: none
        };
        bool known = false;
        SourceLight maps;
        std::vector<Vertices> vertices; ///< per layer: direct light on vertices
        std::vector<Rgb> direct;        ///< per leaf
        std::vector<Rgb> caustic;       ///< per leaf
    };
    /// A leaf as it was.
    struct Leaf {
        std::uint32_t element = 0;
        Rgb rho{0.0F}, emitted{0.0F}, direct{0.0F}, caustic{0.0F}, irradiance{0.0F}, radiosity{0.0F};
    };
    /// A leaf of the tree of named emitters that shines there, not in the hierarchy.
    struct Lamp {
        std::uint32_t element = 0;
        std::vector<MaterialId> materials; ///< of its faces that emit
    };
    /// What an update found.
    struct Change {
        bool any = false; ///< since the last update
        std::size_t sources = 0, materials = 0;
    };

    std::vector<Source> sources;
    std::vector<Leaf> leaves;
    std::vector<Lamp> lamps;
    DirectMaps maps; ///< base
    std::vector<std::shared_ptr<const SurfaceLayer>> layers;
    bool lamps_part = false, emitters_part = false, mirrors_part = false, sky_part = false;
    double mean_radiance = 0.0;

    explicit Relight(Impl& s, const Scene& scene);

    /// Brings lamps, colours and all light that comes straight from sources up to date with `scene`; where everything was
    /// placed stays. An error where the change is none that can be followed, or the context asked to stop.
    static Result<Change> follow(Impl& s, const Scene& scene, const RunContext& context);
    /// Anything shines or is painted otherwise than the light that is kept knows: a quick look.
    [[nodiscard]] static bool changed(const Impl& s, const Scene& scene);
    /// Light that leaves reflect, and vertices where all light changed alike. After follow(), where nothing moved.
    void reflect(Impl& s, const RunContext& context) const;
    /// The light that is shown becomes the base: something is about to move, and repairs go on from there.
    void settle(Impl& s) const;
    /// Log-average of reflected radiance now over what it was.
    [[nodiscard]] double brightening(const Impl& s) const;

private:
    class Sum;
    [[nodiscard]] std::string find_change(const Impl& s, const Scene& scene, std::vector<PlacedLight>& lights);
    bool learn(Impl& s, Source& source, const RunContext& context) const;
    void learn_vertices(Impl& s, Source& source, const DirectFunction& light, bool alone) const;
    void learn_leaves(Impl& s, Source& source, const DirectFunction& light, bool alone) const;
    void learn_caustics(const Impl& s, Source& source) const;
    void recolor(Impl& s, const std::vector<MaterialId>& materials) const;
    void show_direct(Impl& s) const;
    void light_leaves(Impl& s) const;
    [[nodiscard]] bool sources_alike(Rgb& factor) const;
    [[nodiscard]] bool common_factor(const Impl& s, Rgb& factor) const;
};

} // namespace atrium
