// The session with the real engine, apart from engine_session.cpp so that its tests need no solver.
#include "engine/session/engine_session.h"

#include "engine/measure/error_audit.h"
#include "engine/solver/gi_engine.h"

#include <utility>

namespace atrium {
namespace {

EngineSession::SolveFunction solve_with_gi_engine() {
    return [engine = std::make_shared<GiEngine>()](const Scene& scene, const SolveOptions& options,
                                                   const RunContext& context, const auto& on_snapshot) {
        auto solution = engine->solve(scene, options, context, on_snapshot);
        if (!solution || !(*solution)->final || (*solution)->statistics.audit.points > 0) {
            return solution;
        }
        // The picture is complete and on show; what is still to come is the number beside it.
        context.progress("audit", 1.0);
        AuditSettings settings = audit_settings(options.quality);
        settings.seed = options.seed;
        RunContext quiet; // its steps are not those of the light
        quiet.stop = context.stop;
        return Result<std::shared_ptr<const Solution>>(audited(scene, *solution, settings, quiet));
    };
}

} // namespace

EngineSession::EngineSession(std::function<void()> wake) : EngineSession(std::move(wake), solve_with_gi_engine()) {}

} // namespace atrium
