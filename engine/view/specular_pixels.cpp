#include "engine/view/specular_pixels.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/view/eye_tracer.h"
#include "engine/view/look_through.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr int kTile = 8; // pixels
constexpr int kSpecularDepth = 12;
constexpr float kContrast = 0.02F; // (a - b) / (a + b) between neighbours, in any channel, that is looked at more closely

/// Rectangle around what is before the eye of a triangle, pixels; none where all of it is behind.
std::optional<std::pair<vec2, vec2>> rectangle_of(const std::array<vec3, 3>& corners, const CameraRays& eye) {
    vec2 low(std::numeric_limits<float>::infinity());
    vec2 high(-low);
    const auto add = [&](const vec3& point) {
        if (const auto at = eye.pixel_of(point)) {
            low = glm::min(low, *at);
            high = glm::max(high, *at);
        }
    };
    constexpr float kNear = 2.0F * CameraRays::kNearest;
    for (int k = 0; k < 3; ++k) {
        const vec3& a = corners[std::size_t(k)];
        const vec3& b = corners[std::size_t((k + 1) % 3)];
        const float before = eye.depth_of(a);
        const float after = eye.depth_of(b);
        add(a);
        if ((before < kNear) != (after < kNear)) { // where the edge passes the eye
            add(a + (b - a) * ((kNear - before) / (after - before)));
        }
    }
    return low.x <= high.x ? std::optional(std::pair(low, high)) : std::nullopt;
}

/// Tiles of the view that specular surfaces may be seen in: those under the rectangles around their triangles.
std::vector<std::uint8_t> find_tiles(const RayScene& rays, const CameraRays& eye, int across, int down) {
    std::vector<std::uint8_t> out(std::size_t(across) * std::size_t(down), 0);
    // A pixel more: what a sample of a pixel meets need not be at its middle.
    const auto first = [](float pixel, int most) {
        return int(std::clamp(std::floor((pixel - 1.0F) / kTile), 0.0F, float(most)));
    };
    const auto last = [](float pixel, int most) {
        return int(std::clamp(std::floor((pixel + 1.0F) / kTile) + 1.0F, 0.0F, float(most)));
    };
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        if (!is_specular(rays.material(s))) {
            continue;
        }
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
            const auto around = rectangle_of(rays.triangle(s, t), eye);
            if (!around) {
                continue;
            }
            const int x0 = first(around->first.x, across);
            const int x1 = last(around->second.x, across);
            for (int y = first(around->first.y, down); y < last(around->second.y, down); ++y) {
                std::fill_n(out.begin() + std::ptrdiff_t(y) * across + x0, std::max(x1 - x0, 0), std::uint8_t(1));
            }
        }
    }
    return out;
}

/// Pixels whose neighbours show something else: edges, and what has detail. A byte each. What is seen over `rough` surfaces
/// has no detail but grain.
std::vector<std::uint8_t> uneven_pixels(const SpecularPixels& seen, const std::vector<std::uint8_t>& rough) {
    std::vector<std::uint8_t> out(seen.pixels.size(), 0);
    const auto differ = [&](std::size_t i, std::size_t k) {
        const vec4& a = seen.pixels[i];
        const vec4& b = seen.pixels[k];
        if (a.w != b.w || rough[i] != rough[k]) {
            return true;
        }
        if (rough[i] != 0) {
            return false;
        }
        const Rgb d = glm::abs(Rgb(a) - Rgb(b));
        const Rgb sum = Rgb(a) + Rgb(b);
        return d.r > kContrast * sum.r || d.g > kContrast * sum.g || d.b > kContrast * sum.b;
    };
    const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(seen.width) + std::size_t(x); };
    parallel_chunks(std::size_t(seen.height), 8, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (int y = int(begin); y < int(end); ++y) {
            for (int x = 0; x < seen.width; ++x) {
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, seen.height - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, seen.width - 1); ++u) {
                        out[at(x, y)] |= differ(at(x, y), at(u, v)) ? 1 : 0;
                    }
                }
            }
        }
    });
    return out;
}

/// Rays of one look, pixel by pixel.
class Tracing {
public:
    Tracing(const CameraRays& eye, const EyeTracer& tracer, std::vector<std::uint8_t> tiles, int width, int height)
        : eye_(eye), tracer_(tracer), tiles_(std::move(tiles)), width_(width), across_((width + kTile - 1) / kTile),
          height_(height) {}

    /// The rectangle that holds all marked tiles; its pixels are empty still.
    [[nodiscard]] SpecularPixels rectangle() const {
        SpecularPixels out;
        int right = 0;
        int bottom = 0;
        out.left = width_;
        out.top = height_;
        for (std::size_t i = 0; i < tiles_.size(); ++i) {
            if (tiles_[i] != 0) {
                const int x = int(i) % across_ * kTile;
                const int y = int(i) / across_ * kTile;
                out.left = std::min(out.left, x);
                out.top = std::min(out.top, y);
                right = std::max(right, std::min(x + kTile, width_));
                bottom = std::max(bottom, std::min(y + kTile, height_));
            }
        }
        if (right <= out.left || bottom <= out.top) {
            return {};
        }
        out.width = right - out.left;
        out.height = bottom - out.top;
        out.pixels.assign(std::size_t(out.width) * std::size_t(out.height), vec4(0.0F));
        return out;
    }

    /// `side` x `side` samples for pixels in marked tiles that `wanted` names.
    template <class Wanted> void trace(SpecularPixels& out, int side, const RunContext& context, const Wanted& wanted) {
        rough_.resize(out.pixels.size(), 0);
        const auto columns = std::size_t(out.width);
        parallel_chunks(out.pixels.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
                const int x = out.left + int(i % columns);
                const int y = out.top + int(i / columns);
                if (tiles_[std::size_t(y / kTile) * std::size_t(across_) + std::size_t(x / kTile)] != 0 && wanted(i)) {
                    out.pixels[i] = pixel(x, y, side, rough_[i]);
                }
            }
        });
        out.samples = side * side;
    }

    /// Leaves only tiles within reach of a pixel that shows something specular. A thing smaller than a pixel may be lost:
    /// the rasteriser's stays there.
    void keep_seen(const SpecularPixels& seen) {
        std::vector<std::uint8_t> kept(tiles_.size(), 0);
        const int down = int(tiles_.size()) / across_;
        for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
            if (seen.pixels[i].w > 0.0F) {
                const int x = (seen.left + int(i % std::size_t(seen.width))) / kTile;
                const int y = (seen.top + int(i / std::size_t(seen.width))) / kTile;
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across_ - 1); ++u) {
                        const std::size_t tile = std::size_t(v) * std::size_t(across_) + std::size_t(u);
                        kept[tile] = tiles_[tile];
                    }
                }
            }
        }
        tiles_ = std::move(kept);
    }
    [[nodiscard]] const std::vector<std::uint8_t>& rough() const { return rough_; }

private:
    [[nodiscard]] vec4 pixel(int x, int y, int side, std::uint8_t& rough) const {
        vec4 sum(0.0F);
        for (int s = 0; s < side * side; ++s) {
            const Ray ray = eye_.through(float(x) + (float(s % side) + 0.5F) / float(side),
                                         float(y) + (float(s / side) + 0.5F) / float(side));
            const std::uint64_t number = std::uint64_t(y) * std::uint64_t(width_) + std::uint64_t(x);
            const EyeLight light = tracer_.look(ray, std::uint32_t(hash64(number * 64 + std::uint64_t(s))));
            sum += light.over ? vec4(light.sum(), 1.0F) : vec4(0.0F);
            rough = light.rough ? 1 : 0;
        }
        return sum / float(side * side);
    }

    const CameraRays& eye_;
    const EyeTracer& tracer_;
    std::vector<std::uint8_t> tiles_;
    int width_;
    int across_;
    int height_;
    std::vector<std::uint8_t> rough_; ///< per pixel of the rectangle: the last sample was of a rough surface
};

} // namespace

SpecularView::SpecularView(const Scene& scene, const Solution& solution)
    : lit_(std::make_unique<const LitScene>(scene, solution)), sky_(scene.environment.sky_radiance) {}

SpecularView::~SpecularView() = default;

bool SpecularView::any(const Scene& scene) {
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        if (!scene.shapes.contains(node.shape) || !scene.shown(id)) {
            continue;
        }
        for (const MaterialId material : node.materials) {
            const Material* m = scene.materials.find(material);
            if (m != nullptr && is_specular(*m)) {
                return true;
            }
        }
    }
    return false;
}

void SpecularView::look(const ViewCamera& camera, int width, int height, int n, const LightShares& shares,
                        const RunContext& context, const std::function<void(SpecularPixels)>& watcher) const {
    const CameraRays eye(camera, lit_->rays().origin(), width, height);
    const EyeTracer tracer(*lit_, sky_, kSpecularDepth, shares);
    Tracing tracing(eye, tracer, find_tiles(lit_->rays(), eye, (width + kTile - 1) / kTile, (height + kTile - 1) / kTile),
                    width, height);
    SpecularPixels out = tracing.rectangle();
    const auto hand_over = [&](bool complete) {
        out.complete = complete;
        if (!context.should_stop()) {
            watcher(out);
        }
        return !context.should_stop();
    };
    tracing.trace(out, 1, context, [](std::size_t) { return true; });
    if (!hand_over(n <= 1 || out.pixels.empty()) || out.complete) {
        return;
    }
    // Edges and detail first: what is even looks the same with one sample.
    tracing.keep_seen(out);
    const std::vector<std::uint8_t> uneven = uneven_pixels(out, tracing.rough());
    tracing.trace(out, n, context, [&](std::size_t i) { return uneven[i] != 0; });
    if (!hand_over(false)) {
        return;
    }
    tracing.trace(out, n, context, [&](std::size_t i) { return uneven[i] == 0; });
    hand_over(true);
}

} // namespace atrium
