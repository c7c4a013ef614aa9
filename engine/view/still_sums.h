// A still in the making: what the samples of its pixels have shown so far.
#pragma once

#include "engine/view/eye_tracer.h"
#include "engine/view/still.h"

namespace atrium {

/// Pixels may be added to from different threads, one thread to a pixel.
class StillSums {
public:
    StillSums(int width, int height);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    void add(std::size_t pixel, const EyeLight& light);
    /// Means of the samples so far, black where there are none.
    [[nodiscard]] StillLayers mean() const;

private:
    struct Sum {
        EyeLight light;
        std::uint32_t met = 0; ///< samples that met something
    };
    int width_;
    int height_;
    std::vector<Sum> sums_;
    std::vector<std::uint32_t> counts_;
};

} // namespace atrium
