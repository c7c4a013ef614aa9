// Default mode: kernels on the particles' footprints, in boxes that hold them whole.
#include "engine/base/parallel.h"
#include "engine/caustics/chart_work.h"
#include "engine/caustics/reconstruction.h"
#include "engine/caustics/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

constexpr std::size_t kMostBoxes = 16;         // of a layer
constexpr double kBoxWaste = 1.2;              // two boxes become one when it is hardly larger than both
constexpr int kMostTexels = 8192;              // a side of a chart's grid
constexpr float kLongestAxis = 0.2F;           // of a kernel, as a share of its texture
constexpr double kManyPerTexel = 8.0;          // landings a texel from which the least kernel may shrink
constexpr float kLeastOfMany = 0.3F;           // texels: what it shrinks to
constexpr float kWidest = 3.0F;                // texels: kernels of a larger half width go to coarser texels
constexpr std::size_t kShared = 200'000;       // landings on a chart that several threads share
constexpr std::size_t kSpareTexels = 1U << 23; // that all threads together may have for themselves
constexpr std::size_t kGrain = 16'384;
constexpr std::uint32_t kStride = 256; // landings between two questions whether to go on

// Light far dimmer than the brightest is laid on texels of its own: what is dim is wide, by and large, and a texture fine
// enough for the focus would be huge all around it.
constexpr std::size_t kLayers = 2;
constexpr double kOfFirstLayer = 0.8; // of the texels
constexpr double kWorthALayer = 1e-3; // of all light: less is left to the mesh
constexpr double kTexelsALanding = 4.0;
constexpr double kDark = 0.25;   // of CausticSettings::restriction: what cells of a box have of the brightest one
constexpr double kSpeck = 0.003; // of a layer's light: boxes around less wait for the next layer

/// Wide kernels are laid on coarser texels: a few dozen texels each, whatever their width.
struct Level {
    TexelGrid grid;
    LitRange range;
    KernelLimits limits;
    CausticAccumulator sums{0};
};

class FootprintTextures {
public:
    explicit FootprintTextures(ChartWork& work) : work_(work) {}

    void run(double texels) {
        double budget = std::max(texels, 256.0);
        for (layer_ = 0; layer_ < kLayers && !work_.stopped(); ++layer_) {
            if (layer_ > 0 && !worth_a_layer()) {
                return;
            }
            const bool last = layer_ + 1 == kLayers;
            if (last) { // streaks that few particles make are narrow and long: no more texels than these can fill
                budget = std::min(budget, std::max(kTexelsALanding * double(work_.left.size()), 64.0));
            }
            budget = std::max(budget - make_layer(last ? budget : kOfFirstLayer * budget), 64.0);
        }
    }

private:
    using Sizing = CausticRecord::Sizing;
    using Lengths = std::vector<std::pair<float, float>>; // with the power that they are of

    [[nodiscard]] bool worth_a_layer() const {
        double rest = 0.0, all = 0.0;
        for (const double w : work_.weight) {
            all += w;
        }
        for (const std::uint32_t k : work_.left) {
            rest += work_.weight[k];
        }
        return work_.left.size() >= work_.settings.least_particles && rest > kWorthALayer * all;
    }

    // Returns how many texels it took.
    double make_layer(double budget) {
        const CausticSettings& settings = work_.settings;
        Lengths minor = narrow_axes();
        const bool known = !minor.empty();
        const float narrow = median(minor);
        const auto most = std::uint32_t(budget);
        float edge = footprint_resolution(std::move(minor), 0.0, most, settings.mesh_edge);
        Sizing sizing = edge < 0.25F * settings.mesh_edge ? Sizing::Footprints : Sizing::Mesh;
        if (const auto each = float(std::sqrt(work_.domain.area / double(work_.left.size()))); !known && each < edge) {
            edge = each;
            sizing = Sizing::Particles;
        }
        if (settings.wish.texel > 0.0F && (layer_ == 0 || edge < settings.wish.texel)) {
            edge = settings.wish.texel;
            sizing = Sizing::ByHand;
        }
        if (const auto least = float(std::sqrt(work_.power / CausticAccumulator::kMost)); edge < least) { // all in one texel
            edge = least;
            sizing = Sizing::Brightness;
        }
        for (int attempt = 0; attempt < 8 && !work_.stopped(); ++attempt) {
            const auto side = [&](float extent) { return std::clamp(int(std::ceil(extent / edge)), 1, kMostTexels); };
            width_ = side(work_.domain.extent.x);
            height_ = side(work_.domain.extent.y);
            const std::vector<CellBox> boxes = boxes_now();
            double texels = 0.0;
            for (const CellBox& box : boxes) {
                texels += box.area();
            }
            if (texels <= budget || attempt == 7) {
                if (layer_ == 0) {
                    tell(edge, attempt > 0 ? Sizing::Memory : sizing, narrow);
                }
                fill(boxes);
                return texels;
            }
            edge *= float(std::sqrt(texels / budget) * 1.02);
        }
        return 0.0;
    }

    void tell(float edge, Sizing sizing, float narrow) {
        work_.record.width = std::uint32_t(width_);
        work_.record.height = std::uint32_t(height_);
        work_.record.sizing = sizing;
        work_.record.why = fmt::format("texels of {:.1f} mm: {}", 1000.0 * double(edge), words(sizing));
        work_.record.kernel = 2.0F * std::hypot(narrow, KernelLimits{}.least * edge);
    }

    // Narrow half axes of the footprints that are known, metres.
    [[nodiscard]] Lengths narrow_axes() const {
        Lengths out;
        out.reserve(work_.left.size());
        const vec2 metres = work_.domain.extent / work_.size();
        for (const std::uint32_t k : work_.left) {
            const CausticLanding& l = work_.landings[k];
            const vec2 a = l.axis_a * metres, b = l.axis_b * metres;
            const float xx = a.x * a.x + b.x * b.x, xy = a.x * a.y + b.x * b.y, yy = a.y * a.y + b.y * b.y;
            const float low = 0.5F * (xx + yy) - std::sqrt(std::max(0.25F * (xx - yy) * (xx - yy) + xy * xy, 0.0F));
            if (low > 0.0F && std::isfinite(low)) {
                out.emplace_back(std::sqrt(low), luminance(l.power));
            }
        }
        return out;
    }

    // By power; sorts them. 0 of none.
    static float median(Lengths& lengths) {
        std::sort(lengths.begin(), lengths.end());
        double all = 0.0, below = 0.0;
        for (const auto& [length, power] : lengths) {
            all += power;
        }
        for (const auto& [length, power] : lengths) {
            below += power;
            if (below >= 0.5 * all) {
                return length;
            }
        }
        return 0.0F;
    }
    static const char* words(Sizing sizing) {
        switch (sizing) {
        case Sizing::Footprints: return "half the width of the narrow ones among the particles' footprints";
        case Sizing::Mesh: return "a quarter of what the mesh shows, for the particles' footprints are wide";
        case Sizing::Particles: return "one particle each, for their footprints are not known";
        case Sizing::Brightness: return "what a texel can hold";
        case Sizing::Memory: return "what the memory for textures allows";
        case Sizing::ByHand: return "set by hand";
        case Sizing::Equation7: return "equation 7";
        case Sizing::None: break;
        }
        return "";
    }

    [[nodiscard]] vec2 per_tile() const { return vec2(float(width_), float(height_)) / work_.size(); }

    // Kernel of a landing on the chart's grid: bounds, texels.
    [[nodiscard]] CellBox reach(const CausticLanding& l, float unknown) const {
        const vec2 at = (l.uv - work_.domain.low) * per_tile();
        const vec2 a = l.axis_a * per_tile(), b = l.axis_b * per_tile();
        vec2 r(std::sqrt(a.x * a.x + b.x * b.x + 1.0F), std::sqrt(a.y * a.y + b.y * b.y + 1.0F));
        if (!is_finite(r) || !(glm::dot(a, a) + glm::dot(b, b) > 0.0F)) {
            r = vec2(unknown + 1.0F);
        }
        r = glm::min(r, vec2(kLongestAxis * float(width_) + 1.0F, kLongestAxis * float(height_) + 1.0F));
        return {std::max(int(std::floor(at.x - r.x)), 0), std::max(int(std::floor(at.y - r.y)), 0),
                std::min(int(std::ceil(at.x + r.x)), width_), std::min(int(std::ceil(at.y + r.y)), height_)};
    }

    // Boxes of whole texels around the kernels of what is bright. Cells of a few texels decide.
    [[nodiscard]] std::vector<CellBox> boxes_now() {
        cell_ = std::max({4, (width_ + 511) / 512, (height_ + 511) / 512});
        const int cw = (width_ + cell_ - 1) / cell_, ch = (height_ + cell_ - 1) / cell_;
        std::vector<double> power(std::size_t(cw) * std::size_t(ch), 0.0);
        const vec2 cells = per_tile() / float(cell_);
        const auto cell_of = [&](const CausticLanding& l) {
            const vec2 at = (l.uv - work_.domain.low) * cells;
            const int x = std::clamp(int(at.x), 0, cw - 1), y = std::clamp(int(at.y), 0, ch - 1);
            return std::size_t(y) * std::size_t(cw) + std::size_t(x);
        };
        StopCheck stop(work_.context, 16 * kStride);
        for (const std::uint32_t k : work_.left) {
            power[cell_of(work_.landings[k])] += work_.weight[k];
            if (stop()) {
                return {};
            }
        }
        const double dark = kDark * double(work_.settings.restriction) * *std::max_element(power.begin(), power.end());
        std::vector<std::uint8_t> lit(power.size(), 0);
        for (const std::uint32_t k : work_.left) {
            const CausticLanding& l = work_.landings[k];
            if (stop()) {
                return {};
            }
            if (power[cell_of(l)] < dark) {
                continue;
            }
            const CellBox r = reach(l, float(cell_));
            for (int y = r.y0 / cell_; y < std::min((r.y1 + cell_ - 1) / cell_, ch); ++y) {
                for (int x = r.x0 / cell_; x < std::min((r.x1 + cell_ - 1) / cell_, cw); ++x) {
                    lit[std::size_t(y) * std::size_t(cw) + std::size_t(x)] = 1;
                }
            }
        }
        std::vector<CellBox> boxes = without_specks(component_boxes(lit, cw, ch), power, cw);
        constexpr std::size_t kTooMany = 128; // merging pairs of thousands of specks would take long
        if (boxes.size() > kTooMany) {
            std::nth_element(boxes.begin(), boxes.begin() + kTooMany, boxes.end(),
                             [](const CellBox& a, const CellBox& b) { return a.area() > b.area(); });
            CellBox rest = boxes[kTooMany];
            for (std::size_t i = kTooMany; i < boxes.size(); ++i) {
                rest = united(rest, boxes[i]);
            }
            boxes.resize(kTooMany);
            boxes.push_back(rest);
        }
        boxes = merge_boxes(std::move(boxes), kBoxWaste, kMostBoxes);
        for (CellBox& b : boxes) { // a ring of texels that stays black
            b = {std::max(b.x0 * cell_ - 1, 0), std::max(b.y0 * cell_ - 1, 0), std::min(b.x1 * cell_ + 1, width_),
                 std::min(b.y1 * cell_ + 1, height_)};
        }
        return merge_boxes(std::move(boxes), 0.0, kMostBoxes); // rings may have met
    }

    // Where light is about as bright as what counts as dark, chance cuts it up into specks. All are kept in the last layer.
    [[nodiscard]] std::vector<CellBox> without_specks(std::vector<CellBox> boxes, const std::vector<double>& power,
                                                      int width) const {
        if (layer_ + 1 == kLayers) {
            return boxes;
        }
        const double all = std::accumulate(power.begin(), power.end(), 0.0);
        std::erase_if(boxes, [&](const CellBox& b) {
            double own = 0.0;
            for (int y = b.y0; y < b.y1; ++y) {
                for (int x = b.x0; x < b.x1; ++x) {
                    own += power[std::size_t(y) * std::size_t(width) + std::size_t(x)];
                }
            }
            return own < kSpeck * all;
        });
        return boxes;
    }

    // The box that holds a landing's kernel, so that its light fades to nothing within; boxes.size() where none does. A
    // kernel that a box cut off would end in a bright edge.
    [[nodiscard]] std::uint32_t box_of(const CausticLanding& l, const std::vector<CellBox>& boxes) const {
        const CellBox r = reach(l, float(cell_));
        for (std::uint32_t b = 0; b < boxes.size(); ++b) {
            const CellBox& box = boxes[b];
            const bool held = (r.x0 > box.x0 || box.x0 == 0) && (r.y0 > box.y0 || box.y0 == 0) &&
                              (r.x1 < box.x1 || box.x1 == width_) && (r.y1 < box.y1 || box.y1 == height_);
            const vec2 at = (l.uv - work_.domain.low) * per_tile();
            if (held && box.contains(std::clamp(int(at.x), 0, width_ - 1), std::clamp(int(at.y), 0, height_ - 1))) {
                return b;
            }
        }
        return std::uint32_t(boxes.size());
    }

    std::vector<Level> make_levels(const TexelGrid& grid, const CellBox& box, const KernelLimits& limits) const {
        std::vector<Level> out;
        const vec2 high(float(grid.width), float(grid.height));
        LitRange range;
        range.first = {box.x0 > 0 ? 1 : 0, box.y0 > 0 ? 1 : 0};
        range.last = {int(grid.width) - (box.x1 < width_ ? 1 : 0), int(grid.height) - (box.y1 < height_ ? 1 : 0)};
        range.edge_low = {box.x0 > 0 ? -1.0F : 0.0F, box.y0 > 0 ? -1.0F : 0.0F};
        range.edge_high = {box.x1 < width_ ? -1.0F : high.x, box.y1 < height_ ? -1.0F : high.y};
        out.push_back({grid, range, limits, CausticAccumulator(grid.size())});
        for (float factor = 2.0F; std::min(out.back().grid.width, out.back().grid.height) >= 16; factor *= 2.0F) {
            Level level{coarser(out.back().grid), range, limits, CausticAccumulator(0)};
            level.range.first = {0, 0};
            level.range.last = {int(level.grid.width), int(level.grid.height)};
            for (vec2* edge : {&level.range.edge_low, &level.range.edge_high}) {
                *edge = {edge->x < 0.0F ? -1.0F : edge->x / factor, edge->y < 0.0F ? -1.0F : edge->y / factor};
            }
            level.limits = {limits.unknown / factor, limits.least / factor, limits.most / factor};
            level.sums = CausticAccumulator(level.grid.size());
            out.push_back(std::move(level));
        }
        return out;
    }

    // Charts are built side by side; only the landings of a large one are worth sharing out, each part with sums of its own.
    // Whole numbers add up to the same whatever the parts.
    template <class F> void fill_side_by_side(std::size_t count, std::vector<Level>& levels, const F& some) const {
        const std::size_t most = std::clamp<std::size_t>(kSpareTexels / levels[0].grid.size(), 1, thread_limit());
        const std::size_t parts = count > kShared ? most : 1;
        std::vector<std::vector<Level>> more(parts - 1, levels);
        const std::size_t grain = chunk_count(count, parts);
        parallel_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t part) {
            some(begin, end, part == 0 ? levels : more[part - 1]);
        });
        for (std::size_t level = 0; level < levels.size(); ++level) {
            parallel_chunks(levels[level].grid.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (const std::vector<Level>& part : more) {
                    levels[level].sums.add(part[level].sums, begin, end);
                }
            });
        }
    }

    void fill(const std::vector<CellBox>& boxes) {
        std::vector<std::vector<std::uint32_t>> held(boxes.size());
        std::vector<std::uint32_t> left;
        StopCheck stop(work_.context, 16 * kStride);
        for (const std::uint32_t k : work_.left) {
            const std::uint32_t b = box_of(work_.landings[k], boxes);
            (b < boxes.size() ? held[b] : left).push_back(k);
            if (stop()) {
                return;
            }
        }
        for (std::size_t b = 0; b < boxes.size() && !work_.stopped(); ++b) {
            if (held[b].size() < work_.settings.least_particles) {
                left.insert(left.end(), held[b].begin(), held[b].end());
            } else {
                fill_box(boxes[b], held[b], left);
            }
        }
        std::sort(left.begin(), left.end());
        work_.left = std::move(left);
    }

    void fill_box(const CellBox& box, const std::vector<std::uint32_t>& held, std::vector<std::uint32_t>& left) {
        const TexelGrid grid = work_.grid_of(box, width_, height_);
        KernelLimits limits;
        const double per_texel = double(held.size()) / double(grid.size());
        limits.least = per_texel > kManyPerTexel ? kLeastOfMany : limits.least;
        limits.unknown = std::max(1.5F * float(std::sqrt(1.0 / per_texel)), limits.least);
        limits.most = std::max(kLongestAxis * float(std::max(width_, height_)), 2.0F);
        std::vector<Level> levels = make_levels(grid, box, limits);
        std::vector<std::uint8_t> lost(held.size(), 0);
        fill_side_by_side(held.size(), levels, [&](std::size_t begin, std::size_t end, std::vector<Level>& to) {
            StopCheck stop(work_.context, kStride);
            for (std::size_t i = begin; i < end && !stop(); ++i) {
                const CausticLanding& l = work_.landings[held[i]];
                std::size_t level = 0;
                for (float w = kernel_width(l, grid, limits); w > kWidest && level + 1 < to.size(); w *= 0.5F) {
                    ++level;
                }
                lost[i] = splat(l, to[level].grid, to[level].range, to[level].limits, to[level].sums) ? 0 : 1;
            }
        });
        for (std::size_t i = 0; i < held.size(); ++i) {
            if (lost[i] == 0) {
                work_.in_textures.add(double(luminance(work_.landings[held[i]].power)));
            } else {
                left.push_back(held[i]);
            }
        }
        std::vector<Rgb> image = levels[0].sums.image();
        for (std::size_t level = 1; level < levels.size() && !work_.stopped(); ++level) {
            add_coarser(levels[level].sums.image(), levels[level].grid, 1 << level, grid, levels[0].range, image);
        }
        work_.keep(grid, std::move(image));
    }

    ChartWork& work_;
    std::size_t layer_ = 0;
    int width_ = 0; ///< of the chart's grid, texels
    int height_ = 0;
    int cell_ = 4; ///< texels a cell that boxes are made of
};

} // namespace

void fill_by_footprints(ChartWork& work, double texels) { FootprintTextures(work).run(texels); }

} // namespace atrium
