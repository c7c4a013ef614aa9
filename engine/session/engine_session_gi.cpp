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
        return engine->solve(scene, options, context, on_snapshot);
    };
}

Audited audit(const Scene& scene, std::shared_ptr<const Solution> solution, const SolveOptions& options,
              const RunContext& context) {
    AuditSettings settings = audit_settings(options.quality);
    settings.seed = options.seed;
    return audited_with_places(scene, std::move(solution), settings, context);
}

} // namespace

EngineSession::EngineSession(std::function<void()> wake) : EngineSession(std::move(wake), solve_with_gi_engine(), audit) {}

} // namespace atrium
