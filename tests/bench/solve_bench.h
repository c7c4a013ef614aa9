// Whole solves, each in a process of its own: threads, triangles, qualities.
#pragma once

#include <string>
#include <vector>

namespace atrium::bench {

/// Phases of a solve of the shipped scene and of a room with one thread and with two.
void print_scaling(const std::string& shipped_scene, int repeats);
/// One room in ever more triangles: its cost must follow the light. Rooms of more than `most` triangles are left out.
void print_tessellation(std::size_t most, double limit);
/// Draft, normal and fine for each scene; a solve that takes longer than `limit` seconds of wall clock is stopped.
void print_qualities(const std::vector<std::string>& files, const std::vector<std::string>& quality_names, double limit);

} // namespace atrium::bench
