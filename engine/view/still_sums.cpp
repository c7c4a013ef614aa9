#include "engine/view/still_sums.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr int kReach = 5;            // pixels that a pixel is smoothed over, each way
constexpr float kWidth = 2.5F;       // standard deviation of the weights over distance, pixels
constexpr float kSignificant = 1.5F; // standard deviations by which neighbours differ that are kept apart

} // namespace

StillSums::StillSums(int width, int height)
    : width_(std::max(width, 1)), height_(std::max(height, 1)), sums_(std::size_t(width_) * std::size_t(height_)),
      counts_(sums_.size(), 0) {}

void StillSums::add(std::size_t pixel, const EyeLight& light) {
    Sum& sum = sums_[pixel];
    sum.light.direct += light.direct;
    sum.light.diffuse += light.diffuse;
    sum.light.caustic += light.caustic;
    sum.light.specular += light.specular;
    sum.light.albedo += light.albedo;
    sum.light.normal += light.normal;
    sum.light.read += light.read;
    const float gathered = luminance(light.diffuse);
    const float read = luminance(light.read);
    sum.gathered2 += gathered * gathered;
    sum.both += gathered * read;
    sum.read2 += read * read;
    if (light.depth > 0.0F) {
        sum.light.depth += light.depth;
        ++sum.met;
    }
    ++counts_[pixel];
}

StillLayers StillSums::mean() const {
    StillLayers out;
    for (Picture* picture : {&out.direct, &out.diffuse, &out.caustic, &out.specular, &out.albedo, &out.normal}) {
        picture->width = width_;
        picture->height = height_;
        picture->pixels.assign(sums_.size(), vec3(0.0F));
    }
    out.depth.assign(sums_.size(), 0.0F);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const float share = counts_[i] > 0 ? 1.0F / float(counts_[i]) : 0.0F;
        const EyeLight& light = sums_[i].light;
        out.direct.pixels[i] = light.direct * share;
        out.diffuse.pixels[i] = light.diffuse * share;
        out.caustic.pixels[i] = light.caustic * share;
        out.specular.pixels[i] = light.specular * share;
        out.albedo.pixels[i] = light.albedo * share;
        const float length = glm::length(light.normal);
        out.normal.pixels[i] = length > 0.0F ? light.normal / length : vec3(0.0F);
        out.depth[i] = sums_[i].met > 0 ? light.depth / float(sums_[i].met) : 0.0F;
    }
    smooth_reflected(out);
    return out;
}

// Light that is gathered has grain; light that is read from the layers has none, but lacks what is finer than their mesh.
// Their ratio is one nearly everywhere, so it may be averaged over neighbours as long as these agree within the grain: then
// the detail of textures, edges and the layers stays, and so do contacts, where the ratio differs by more than chance.
void StillSums::smooth_reflected(StillLayers& out) const {
    struct Ratio {
        float value = 0.0F;
        float variance = 0.0F;
        bool known = false;
    };
    std::vector<Ratio> own(sums_.size());
    bool any = false;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const Sum& s = sums_[i];
        const auto n = float(counts_[i]);
        const float read = luminance(s.light.read);
        if (!(read > 0.0F) || !(n > 0.0F)) {
            continue;
        }
        any = true;
        const float r = luminance(s.light.diffuse) / read;
        const float residual = std::max(s.gathered2 - 2.0F * r * s.both + r * r * s.read2, 0.0F);
        const float variance = n > 1.0F ? residual * n / ((n - 1.0F) * read * read) : 1.0F;
        own[i] = {r, variance, true};
    }
    if (!any) {
        return;
    }
    const auto neighbours = [&](std::size_t i, int reach, auto&& visit) {
        const int x = int(i % std::size_t(width_));
        const int y = int(i / std::size_t(width_));
        for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height_ - 1); ++v) {
            for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width_ - 1); ++u) {
                const std::size_t j = std::size_t(v) * std::size_t(width_) + std::size_t(u);
                const float facing = glm::dot(out.normal.pixels[i], out.normal.pixels[j]);
                const float step = std::abs(out.depth[i] - out.depth[j]);
                if (own[j].known && facing > 0.95F && step <= 0.1F * out.depth[i]) {
                    visit(j, float((u - x) * (u - x) + (v - y) * (v - y)));
                }
            }
        }
    };
    std::vector<Ratio> around(sums_.size()); // means over 3 x 3: what is told apart must be seen above the grain
    parallel_chunks(sums_.size(), 1024, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!own[i].known) {
                continue;
            }
            float count = 0.0F;
            neighbours(i, 1, [&](std::size_t j, float) {
                around[i].value += own[j].value;
                around[i].variance += own[j].variance;
                count += 1.0F;
            });
            around[i] = {around[i].value / count, around[i].variance / (count * count), true};
        }
    });
    const Picture gathered = out.diffuse;
    parallel_chunks(sums_.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!own[i].known) {
                continue;
            }
            Rgb light(0.0F);
            Rgb read(0.0F);
            neighbours(i, kReach, [&](std::size_t j, float distance2) {
                const float apart = around[i].value - around[j].value;
                const float grain = kSignificant * kSignificant * (around[i].variance + around[j].variance) + 1e-8F;
                const float weight = std::exp(-0.5F * (distance2 / (kWidth * kWidth) + apart * apart / grain));
                light += weight * gathered.pixels[j];
                read += weight * sums_[j].light.read / float(counts_[j]);
            });
            for (int c = 0; c < 3; ++c) {
                if (read[c] > 0.0F) {
                    out.diffuse.pixels[i][c] = sums_[i].light.read[c] / float(counts_[i]) * light[c] / read[c];
                }
            }
        }
    });
}

} // namespace atrium
