// The room that the start page offers: something to move light about in without any file.
#pragma once

#include "engine/scene/scene.h"

namespace atrium::ui {

/// A furnished room of 5 x 4 x 2.7 m with two lamps and a camera; metres, photometric values of real lamps.
Scene sample_room();

} // namespace atrium::ui
