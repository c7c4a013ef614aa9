// What "draft", "normal" and "fine" mean: every number of the solver that depends on the wish for quality, in one place.
#pragma once

#include "engine/caustics/caustic_builder.h"
#include "engine/geometry/surface_charts.h"
#include "engine/layers/direct_map_builder.h"
#include "engine/layers/layer_builder.h"
#include "engine/radiosity/indirect_gather.h"
#include "engine/radiosity/links.h"
#include "engine/scene/scene.h"

namespace atrium {

/// How closely the light at one point is looked at.
struct FieldSettings {
    GatherSettings direct; ///< named emitters, sun, sky and lamps
    IndirectSettings reflected;
    CacheSettings cache; ///< of reflected light
};

struct QualitySettings {
    HierarchySettings hierarchy;
    RefineSettings refine;
    LayerSettings first_layers; ///< of the first picture
    LayerSettings layers;
    ChartSettings charts;
    DirectMapSettings first_maps;
    DirectMapSettings maps;
    FieldSettings first_field;
    FieldSettings field;
    FieldSettings leaf_field;       ///< of the means on leaves
    float emitter_contrast = 4.0F;  ///< exitance over its room's mean that makes an emitter a named one
    float bright_contrast = 4.0F;   ///< radiosity over its room's mean that makes a leaf stand out
    float image_contrast = 3.0F;    ///< the same that makes particles bring images of it over mirrors and through glass
    int refine_rounds = 2;          ///< refinements, each followed by a solve
    double solver_tolerance = 1e-4; ///< relative residual
    int max_iterations = 400;
    unsigned leaf_rays = 128;                   ///< over the hemisphere of every leaf, a power of two
    int leaf_levels = 4;                        ///< rounds of splitting leaves on which reflected light is uneven
    float leaf_contrast = 0.2F;                 ///< what counts as uneven, relative
    unsigned leaf_samples = 4;                  ///< direct-light samples on a leaf
    std::uint32_t particles = 250'000;          ///< emitted at most, by what stands out; by matt surfaces as many again
    std::uint32_t most_particles = 0xFFFFFFFFU; ///< of both together
    CausticSettings caustics;
};

/// Settings for a scene whose bounds have the given diagonal (metres). Lengths follow the scene within the limits of rooms:
/// a model of 0.5 m and a hall of 50 m get elements in proportion. `target_error` (relative, 0 = none) tightens or relaxes
/// the sampling of the quality by the square of the ratio.
QualitySettings quality_settings(SolverSettings::Quality quality, float diagonal, double target_error);

/// Those of its numbers that can be set by hand.
SolverThresholds thresholds_of(const QualitySettings& quality);
/// Sets those that are not automatic, and what goes with them. Others stay as the quality has them.
void set_thresholds(QualitySettings& quality, const SolverThresholds& thresholds);

const char* quality_name(SolverSettings::Quality quality);

} // namespace atrium
