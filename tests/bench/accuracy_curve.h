// Error against time: how long the engine takes to be right within 10, 5 and 2 %.
#pragma once

#include "tests/bench/accuracy_reference.h"

namespace atrium::bench {

/// Solves a scene with a ladder of qualities and target errors, reads first and final pictures at the probes, and prints
/// what each cost against how far it is off, then the least cost at which the error is within 10, 5 and 2 %. The ladder
/// ends at a solve that is not done after `limit` seconds of wall clock (0 = none). `csv` gets a line for each picture.
/// False when the scene cannot be solved.
bool print_curve(const std::string& name, const Scene& scene, const std::vector<Probe>& probes, std::uint32_t seed,
                 double limit, std::string& csv);

/// First line of that CSV.
const char* curve_csv_header();

} // namespace atrium::bench
