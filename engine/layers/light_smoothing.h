// What is done to a mesh's light after sampling: covered vertices are filled, noise is averaged.
#pragma once

#include "engine/layers/node_mesh.h"

namespace atrium {

/// Covered vertices take the light of their uncovered neighbours, so that the edge of a foot, a board or a rug is where the
/// object ends and no dark halo runs out from under it. `covered` and `sample` name the side. When stopped, some are left.
void fill_covered(NodeMesh& mesh, bool LightVertex::*covered, DirectSample LightVertex::*sample, StopCheck& stop);

/// Averages each vertex with its neighbours as far as the samples' own noise explains their difference: differences that are
/// larger than noise stay. Covered vertices have been filled before.
void smooth_noise(NodeMesh& mesh, DirectSample LightVertex::*sample, StopCheck& stop);

} // namespace atrium
