// How far a solution is from the truth, by asking brute force at places of its own choosing.
#pragma once

#include "engine/base/result.h"
#include "engine/base/run_context.h"
#include "engine/solver/solution.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// How much an audit may cost. Counts, not seconds: the same solution gets the same figures on any machine.
struct AuditSettings {
    std::size_t points = 512;
    std::uint64_t least_paths = 256; ///< of brute force per point
    std::uint64_t most_paths = 1024;
    /// Beyond the least, as many rays as this share of those that the solution took, or two million where that is more;
    /// seven tenths of them at all places, the rest at the few that are far off.
    double ray_share = 0.1;
    std::uint32_t seed = 1;
};

/// What a quality can afford: some hundredths of what it takes to solve.
AuditSettings audit_settings(SolverSettings::Quality quality);

/// Reads `solution` at random places of the diffuse surfaces of `scene`, gaps that nobody looks into left out, and compares
/// it with the reference there, whose own noise is taken out. As many paths as tell the error from that noise, at most
/// settings.most_paths, and up to eight times as many at the few places that are far off what is usual. The bounds are those
/// of a bootstrap over the places. The same figures for any number of threads. An error where no surface scatters light that
/// light can reach, or when stopped.
Result<ErrorAudit> audit_error(const Scene& scene, const Solution& solution, const AuditSettings& settings,
                               const RunContext& context);

/// A place of an audit: what the solution says there and what the reference does.
struct AuditPlace {
    dvec3 point{0.0};            ///< world
    dvec3 normal{0.0, 1.0, 0.0}; ///< unit, of the side
    double computed = 0;         ///< lux, luminance
    double reference = 0;
    double noise = 0;  ///< standard error of the reference
    double square = 0; ///< of the relative difference, the noise's variance taken out: may be negative by chance
};
/// The places that audit_error() asks at for the same settings, one by one, and the same way of looking.
Result<std::vector<AuditPlace>> audit_places(const Scene& scene, const Solution& solution, const AuditSettings& settings,
                                             const RunContext& context);

/// A solution with its audit, and the places that the figures are made of: none where it could not be made.
struct Audited {
    Audited() = default;
    Audited(std::shared_ptr<const Solution> light) : solution(std::move(light)) {} // NOLINT: of which nothing is known
    Audited(std::shared_ptr<const Solution> light, std::vector<AuditPlace> asked)
        : solution(std::move(light)), places(std::move(asked)) {}
    std::shared_ptr<const Solution> solution;
    std::vector<AuditPlace> places;
};
/// audited(), with its places.
Audited audited_with_places(const Scene& scene, std::shared_ptr<const Solution> solution, const AuditSettings& settings,
                            const RunContext& context);

/// The same solution with an audit in its statistics, which then is its error_estimate too; as it was where the audit could
/// not be made or was stopped.
std::shared_ptr<const Solution> audited(const Scene& scene, std::shared_ptr<const Solution> solution,
                                        const AuditSettings& settings, const RunContext& context);

} // namespace atrium
