#include "engine/solver/statistics_figures.h"

namespace atrium {

double StatisticsFigure::number() const {
    return std::visit([](auto v) { return double(v); }, value);
}

std::vector<StatisticsFigure> statistics_figures(const Statistics& s) {
    using Unit = StatisticsFigure::Unit;
    return {{"iterations", std::int64_t(s.iterations)},
            {"converged", s.converged},
            {"residual", s.residual},
            {"error_estimate", s.error_estimate, Unit::Share},
            {"error_audit.rms", s.audit.rms, Unit::Share},
            {"error_audit.low", s.audit.low, Unit::Share},
            {"error_audit.high", s.audit.high, Unit::Share},
            {"error_audit.typical", s.audit.typical, Unit::Share},
            {"error_audit.bias", s.audit.bias, Unit::Share},
            {"error_audit.bias_error", s.audit.bias_error, Unit::Share},
            {"error_audit.points", std::uint64_t(s.audit.points)},
            {"error_audit.paths", s.audit.paths},
            {"error_audit.rays", s.audit.rays},
            {"error_audit.seconds", s.audit.seconds, Unit::Seconds},
            {"elements", s.elements},
            {"clusters", s.clusters},
            {"links", s.links},
            {"rays", s.rays},
            {"particles_emitted", s.particles_emitted},
            {"particles_stored", s.particles_stored},
            {"memory.elements", s.memory.elements, Unit::Bytes},
            {"memory.links", s.memory.links, Unit::Bytes},
            {"memory.particles", s.memory.particles, Unit::Bytes},
            {"memory.octree", s.memory.octree, Unit::Bytes},
            {"memory.caustic_textures", s.memory.caustic_textures, Unit::Bytes},
            {"memory.layers", s.memory.layers, Unit::Bytes},
            {"memory.ray_scene", s.memory.ray_scene, Unit::Bytes},
            {"memory.peak_rss", s.memory.peak_rss, Unit::Bytes},
            {"energy.emitted", s.energy.emitted, Unit::Lumen},
            {"energy.absorbed", s.energy.absorbed, Unit::Lumen},
            {"energy.escaped", s.energy.escaped, Unit::Lumen},
            {"energy.defect", s.energy.defect, Unit::Share}};
}

} // namespace atrium
