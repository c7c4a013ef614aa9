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

/// Tiles of the view that specular surfaces may be seen in: those under the rectangles around their triangles.
std::vector<std::uint8_t> find_tiles(const RayScene& rays, const CameraRays& eye, int across, int down) {
    std::vector<std::uint8_t> out(std::size_t(across) * std::size_t(down), 0);
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        if (!is_specular(rays.material(s))) {
            continue;
        }
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
            vec2 low(std::numeric_limits<float>::infinity());
            vec2 high(-low);
            bool before = false;
            bool behind = false;
            for (const vec3& corner : rays.triangle(s, t)) {
                const auto at = eye.pixel_of(corner);
                (at ? before : behind) = true;
                if (at) {
                    low = glm::min(low, *at);
                    high = glm::max(high, *at);
                }
            }
            if (!before && behind) {
                continue;
            }
            if (behind) { // it passes the eye: anywhere
                low = vec2(0.0F);
                high = vec2(float(across * kTile), float(down * kTile));
            }
            // A pixel more: what a sample of a pixel meets need not be at its middle.
            const int x0 = int(std::clamp(std::floor((low.x - 1.0F) / kTile), 0.0F, float(across)));
            const int x1 = int(std::clamp(std::floor((high.x + 1.0F) / kTile) + 1.0F, 0.0F, float(across)));
            const int y0 = int(std::clamp(std::floor((low.y - 1.0F) / kTile), 0.0F, float(down)));
            const int y1 = int(std::clamp(std::floor((high.y + 1.0F) / kTile) + 1.0F, 0.0F, float(down)));
            for (int y = y0; y < y1; ++y) {
                std::fill_n(out.begin() + std::ptrdiff_t(y) * across + x0, std::max(x1 - x0, 0), std::uint8_t(1));
            }
        }
    }
    return out;
}

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
    const int across = (width + kTile - 1) / kTile;
    const int down = (height + kTile - 1) / kTile;
    const std::vector<std::uint8_t> tiles = find_tiles(lit_->rays(), eye, across, down);
    SpecularPixels out;
    int right = 0;
    int bottom = 0;
    out.left = width;
    out.top = height;
    for (int y = 0; y < down; ++y) {
        for (int x = 0; x < across; ++x) {
            if (tiles[std::size_t(y) * std::size_t(across) + std::size_t(x)] != 0) {
                out.left = std::min(out.left, x * kTile);
                out.top = std::min(out.top, y * kTile);
                right = std::max(right, std::min((x + 1) * kTile, width));
                bottom = std::max(bottom, std::min((y + 1) * kTile, height));
            }
        }
    }
    out.width = std::max(right - out.left, 0);
    out.height = std::max(bottom - out.top, 0);
    if (out.width == 0 || out.height == 0) {
        out = {};
        out.samples = 1;
        watcher(std::move(out));
        return;
    }
    const auto columns = std::size_t(out.width);
    for (const int side : {1, std::max(n, 1)}) {
        if (side == 1 && out.samples > 0) {
            return; // one sample is all that is wanted
        }
        out.pixels.assign(columns * std::size_t(out.height), vec4(0.0F));
        parallel_chunks(out.pixels.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
                const int x = out.left + int(i % columns);
                const int y = out.top + int(i / columns);
                if (tiles[std::size_t(y / kTile) * std::size_t(across) + std::size_t(x / kTile)] == 0) {
                    continue;
                }
                vec4 sum(0.0F);
                for (int s = 0; s < side * side; ++s) {
                    const Ray ray = eye.through(float(x) + (float(s % side) + 0.5F) / float(side),
                                                float(y) + (float(s / side) + 0.5F) / float(side));
                    const std::uint64_t pixel = std::uint64_t(y) * std::uint64_t(width) + std::uint64_t(x);
                    const EyeLight light = tracer.look(ray, std::uint32_t(hash64(pixel * 64 + std::uint64_t(s))));
                    sum += light.over ? vec4(light.sum(), 1.0F) : vec4(0.0F);
                }
                out.pixels[i] = sum / float(side * side);
            }
        });
        if (context.should_stop()) {
            return;
        }
        out.samples = side * side;
        watcher(out);
    }
}

} // namespace atrium
