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
    /// Means of the samples so far, black where there are none; the grain of gathered light smoothed where that loses
    /// nothing.
    [[nodiscard]] StillLayers mean() const;

private:
    struct Sum {
        EyeLight light;
        float gathered2 = 0.0F; ///< luminance of gathered light, squared; times that of the layers; that squared
        float both = 0.0F;
        float read2 = 0.0F;
        std::uint32_t met = 0; ///< samples that met something
    };
    void smooth_reflected(StillLayers& out) const;

    int width_;
    int height_;
    std::vector<Sum> sums_;
    std::vector<std::uint32_t> counts_;
};

} // namespace atrium
