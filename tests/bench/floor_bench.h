// How close each step of diffuse light comes to what it stands on: Embree's rays, the memory's bandwidth.
#pragma once

#include <string>

namespace atrium::bench {

/// Queries of RayScene against Embree alone on the same rays, one thread, for each room; prints a table.
void print_ray_floor(const std::string& shipped_scene);
/// Links, gather, hemisphere rays and direct light, one thread, as shares of bare rays or of a copy; prints a table.
void print_step_floor(const std::string& shipped_scene);

} // namespace atrium::bench
