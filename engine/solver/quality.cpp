#include "engine/solver/quality.h"

#include <algorithm>

namespace atrium {

const char* quality_name(SolverSettings::Quality quality) {
    static constexpr const char* kNames[] = {"draft", "normal", "fine"};
    return kNames[std::size_t(quality)];
}

QualitySettings quality_settings(SolverSettings::Quality quality, float diagonal, double target_error) {
    QualitySettings out;
    const float unit = std::max(diagonal, 1e-6F) / 10.0F; // lengths below are for a room with a diagonal of 10 m
    const auto set = [&](float patch, float group, float threshold, unsigned link_rays, float base, float smallest,
                         float contrast, float tolerance, unsigned cut, unsigned rays, unsigned sun, unsigned sky) {
        out.hierarchy = {patch * unit, group * unit};
        out.refine.flux_threshold = threshold;
        out.refine.rays = link_rays;
        out.layers.base_edge = base * unit;
        out.layers.smallest_edge = smallest * unit;
        out.layers.contrast = contrast;
        out.layers.gather.tolerance = tolerance;
        out.layers.gather.max_cut = cut;
        out.layers.gather.rays = rays;
        out.layers.gather.sun_rays = sun;
        out.layers.gather.sky_rays = sky;
    };
    double usual_error = 0.05;
    switch (quality) {
    case SolverSettings::Quality::Draft:
        set(0.4F, 0.2F, 1e-3F, 4, 1.0F, 0.12F, 0.15F, 0.05F, 96, 24, 16, 36);
        out.refine_rounds = 1;
        out.solver_tolerance = 1e-3;
        usual_error = 0.10;
        break;
    case SolverSettings::Quality::Normal: set(0.2F, 0.12F, 2e-4F, 8, 0.5F, 0.03F, 0.06F, 0.02F, 192, 80, 64, 96); break;
    case SolverSettings::Quality::Fine:
        set(0.1F, 0.06F, 5e-5F, 16, 0.25F, 0.015F, 0.03F, 0.008F, 400, 192, 128, 256);
        out.refine_rounds = 3;
        out.solver_tolerance = 1e-5;
        usual_error = 0.02;
        break;
    }
    if (target_error > 0.0) {
        const double ratio = std::clamp(usual_error / target_error, 0.25, 8.0);
        const auto scaled = [&](unsigned n) { return unsigned(std::clamp(std::lround(n * ratio * ratio), 4L, 4096L)); };
        out.layers.gather.rays = scaled(out.layers.gather.rays);
        out.layers.gather.sky_rays = scaled(out.layers.gather.sky_rays);
        out.layers.gather.sun_rays = scaled(out.layers.gather.sun_rays);
        out.layers.gather.tolerance = float(out.layers.gather.tolerance / ratio);
        out.refine.flux_threshold = float(out.refine.flux_threshold / ratio);
    }
    out.first_layers = out.layers;
    out.first_layers.base_edge = 2.0F * out.layers.base_edge;
    out.first_layers.max_vertices = 20'000;
    out.first_layers.smallest_edge = std::max(out.layers.smallest_edge, 0.25F * unit);
    out.first_layers.gather.tolerance = 0.05F;
    out.first_layers.gather.max_cut = 128;
    out.first_layers.gather.rays = 16;
    out.first_layers.gather.sun_rays = 2;
    out.first_layers.gather.sky_rays = 24;
    return out;
}

} // namespace atrium
