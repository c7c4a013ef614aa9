#include "engine/solver/quality.h"

#include <algorithm>
#include <bit>

namespace atrium {
namespace {

constexpr unsigned kFinestTexels = 12; ///< levels of a tile at most, see DirectMapSettings

float texel_of(const QualitySettings& quality) { return quality.charts.tile_edge / float(1U << quality.maps.max_level); }

/// The level whose texels are no larger than this, as far as there is one.
unsigned level_of(float tile_edge, float texel) {
    unsigned level = 0;
    while (level < kFinestTexels && tile_edge / float(1U << level) > 1.0001F * texel) {
        ++level;
    }
    return level;
}

} // namespace

SolverThresholds thresholds_of(const QualitySettings& quality) {
    SolverThresholds out;
    out.element_edge = quality.hierarchy.smallest_patch;
    out.link_share = quality.refine.flux_threshold;
    out.leaf_contrast = quality.leaf_contrast;
    out.mesh_edge = quality.layers.smallest_edge;
    out.mesh_contrast = quality.layers.contrast;
    out.shadow_texel = texel_of(quality);
    out.reflected_rays = float(quality.field.reflected.rays);
    out.particles = float(quality.particles);
    out.caustic_dispersion = quality.caustics.least_dispersion;
    return out;
}

void set_thresholds(QualitySettings& quality, const SolverThresholds& thresholds) {
    const auto set = [&](float SolverThresholds::*which, const auto& write) {
        const auto info = std::find_if(kThresholds.begin(), kThresholds.end(),
                                       [which](const ThresholdInfo& one) { return one.value == which; });
        if (const float value = thresholds.*which; value > 0.0F) {
            write(std::clamp(value, info->least, info->most));
        }
    };
    using T = SolverThresholds;
    set(&T::element_edge, [&](float v) { quality.hierarchy.smallest_patch = v; });
    set(&T::link_share, [&](float v) { quality.refine.flux_threshold = v; });
    set(&T::leaf_contrast, [&](float v) { quality.leaf_contrast = v; });
    set(&T::mesh_edge, [&](float v) {
        quality.layers.smallest_edge = v;
        quality.layers.base_edge = std::max(quality.layers.base_edge, v);
        quality.first_layers.smallest_edge = std::max(quality.first_layers.smallest_edge, v);
        quality.first_layers.base_edge = std::max(quality.first_layers.base_edge, v);
        quality.caustics.mesh_edge = quality.layers.base_edge;
    });
    set(&T::mesh_contrast, [&](float v) { quality.layers.contrast = quality.first_layers.contrast = v; });
    set(&T::shadow_texel, [&](float v) {
        quality.maps.max_level = level_of(quality.charts.tile_edge, v);
        quality.maps.first_level = std::min(quality.maps.first_level, quality.maps.max_level);
        quality.first_maps.max_level = std::min(quality.first_maps.max_level, quality.maps.max_level);
        quality.field.direct.spread = 0.5F * texel_of(quality);
    });
    set(&T::reflected_rays, [&](float v) {
        quality.field.reflected.rays = std::bit_ceil(unsigned(std::lround(v)));
        quality.field.reflected.max_rays = 4 * quality.field.reflected.rays;
    });
    set(&T::particles, [&](float v) { quality.particles = std::uint32_t(std::lround(v)); });
    set(&T::caustic_dispersion, [&](float v) { quality.caustics.least_dispersion = v; });
}

const char* quality_name(SolverSettings::Quality quality) {
    static constexpr const char* kNames[] = {"draft", "normal", "fine"};
    return kNames[std::size_t(quality)];
}

QualitySettings quality_settings(SolverSettings::Quality quality, float diagonal, double target_error) {
    QualitySettings out;
    const float unit = std::max(diagonal, 1e-6F) / 10.0F; // lengths below are for a room with a diagonal of 10 m
    const auto set = [&](float patch, float group, float threshold, unsigned link_rays, float base, float smallest,
                         float contrast) {
        out.hierarchy = {patch * unit, group * unit};
        out.refine.flux_threshold = threshold;
        out.refine.rays = link_rays;
        out.layers.base_edge = base * unit;
        out.layers.smallest_edge = smallest * unit;
        out.layers.contrast = contrast;
    };
    const auto look = [unit](float tolerance, unsigned cut, unsigned rays, unsigned sun, unsigned sky, unsigned hemisphere) {
        FieldSettings f;
        f.direct = {0.2F * tolerance, 2 * cut, rays, sun, sky}; // clusters of a lamp err alike: many small errors add up
        f.reflected.rays = hemisphere;
        f.reflected.max_rays = 4 * hemisphere;
        f.reflected.tolerance = 2.0F * tolerance;
        f.reflected.near = 1.0F;
        f.reflected.bright = {2.0F * tolerance, 4 * cut, rays, 0, 0, 1.5F};
        f.cache.spacing = std::clamp(4.0F * std::sqrt(tolerance), 0.3F, 0.9F);
        f.cache.smallest_reach = 4.0F * tolerance * unit;
        f.cache.largest_reach = 1.0F * unit;
        f.cache.normal_cosine = 1.0F - 6.0F * tolerance;
        f.cache.contrast = 2.0F * tolerance;
        return f;
    };
    out.charts.tile_edge = 0.32F * unit;
    out.charts.smallest_extent = 0.16F * unit;
    out.charts.flatness = 1e-3F * unit;
    double usual_error = 0.05;
    switch (quality) {
    case SolverSettings::Quality::Draft:
        set(0.5F, 0.2F, 2e-3F, 4, 1.0F, 0.16F, 0.2F);
        out.field = look(0.05F, 96, 24, 16, 36, 64);
        out.maps.first_level = 1;
        out.maps.max_level = 4;
        out.maps.contrast = 0.06F;
        out.refine_rounds = 1;
        out.leaf_rays = 64;
        out.particles = 60'000;
        out.solver_tolerance = 1e-3;
        usual_error = 0.10;
        break;
    case SolverSettings::Quality::Normal:
        set(0.3F, 0.15F, 5e-4F, 8, 0.5F, 0.1F, 0.05F);
        out.field = look(0.02F, 192, 64, 64, 96, 128);
        out.maps.contrast = 0.02F;
        break;
    case SolverSettings::Quality::Fine:
        set(0.15F, 0.08F, 1e-4F, 16, 0.25F, 0.03F, 0.025F);
        out.field = look(0.01F, 400, 192, 128, 256, 512);
        out.maps.first_level = 3;
        out.maps.max_level = 7;
        out.maps.contrast = 0.015F;
        out.refine_rounds = 3;
        out.leaf_rays = 256;
        out.particles = 1'500'000;
        out.solver_tolerance = 1e-5;
        usual_error = 0.02;
        break;
    }
    if (target_error > 0.0) {
        const double ratio = std::clamp(usual_error / target_error, 0.25, 8.0);
        const auto scaled = [&](unsigned n) { return unsigned(std::clamp(std::lround(n * ratio * ratio), 4L, 4096L)); };
        for (GatherSettings* g : {&out.field.direct, &out.field.reflected.bright}) {
            g->rays = scaled(g->rays);
            g->sky_rays = scaled(g->sky_rays);
            g->sun_rays = scaled(g->sun_rays);
            g->tolerance = float(g->tolerance / ratio);
        }
        out.field.reflected.rays = scaled(out.field.reflected.rays);
        out.field.reflected.max_rays = scaled(out.field.reflected.max_rays);
        out.field.reflected.tolerance = float(out.field.reflected.tolerance / ratio);
        out.refine.flux_threshold = float(out.refine.flux_threshold / ratio);
    }
    out.first_field = look(0.1F, 96, 16, 8, 24, 32);
    out.first_field.reflected.max_rays = 32;
    out.first_field.reflected.near = 0.0F;
    out.first_field.reflected.bright.rays = 8;
    out.first_field.cache.smallest_reach = 0.25F * unit;
    out.first_field.cache.spacing = 0.8F;
    out.first_field.cache.to_nearest = 2.0F;
    out.first_field.cache.normal_cosine = 0.7F;
    out.first_field.cache.contrast = 1e6F; // no second look
    out.leaf_field = look(0.05F, 96, 8, 1, std::max(out.field.direct.sky_rays / 8, 16U), 16);
    out.maps.cover_reach = 0.01F * unit; // contact, not a gap: what is dark between books stays dark
    out.layers.cover_reach = out.maps.cover_reach;
    out.first_maps = out.maps;
    out.first_maps.first_level = 0;
    out.first_maps.max_level = 3;
    out.first_maps.contrast = 0.2F;
    const auto half_texel = [&](unsigned level) { return 0.5F * out.charts.tile_edge / float(1U << level); };
    out.field.direct.spread = half_texel(out.maps.max_level);
    out.first_field.direct.spread = half_texel(out.first_maps.max_level);
    out.caustics.mesh_edge = out.layers.base_edge;
    out.first_layers = out.layers;
    out.first_layers.base_edge = 2.0F * out.layers.base_edge;
    out.first_layers.max_vertices = 20'000;
    out.first_layers.smallest_edge = std::max(out.layers.smallest_edge, 0.25F * unit);
    return out;
}

} // namespace atrium
