// What is done to a mesh's light after sampling: noise is averaged.
#pragma once

#include "engine/layers/node_mesh.h"

namespace atrium {

/// Averages each vertex with its neighbours as far as the samples' own noise explains their difference: differences that are
/// larger than noise stay. Covered vertices take no part. `covered` and `sample` name the side.
void smooth_noise(NodeMesh& mesh, bool LightVertex::*covered, DirectSample LightVertex::*sample, StopCheck& stop);

} // namespace atrium
