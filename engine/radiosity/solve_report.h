// What a solver of the radiosity equation says about its work.
#pragma once

namespace atrium {

/// Outcome of solve_radiosity().
struct SolveReport {
    int iterations = 0;    ///< applications of the transport
    double residual = 0.0; ///< |M + rho (D + T B) - B| / |B|, area-weighted 2-norm
    bool converged = false;
};

} // namespace atrium
