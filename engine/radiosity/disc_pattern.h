// Points on a disc for rays towards the sun: even for the whole set, and even for its beginning.
#pragma once

#include "engine/base/math.h"

#include <vector>

namespace atrium {

/// `count` points of a Fermat spiral on the unit disc, all of one weight, in an order in which each is as far from all
/// before it as can be: the first few lie around the rim and in the middle. The same for every call; any thread. Valid until
/// the calling thread asks for another count.
const std::vector<vec2>& disc_pattern(unsigned count);

} // namespace atrium
