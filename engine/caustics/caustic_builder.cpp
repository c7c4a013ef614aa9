#include "engine/caustics/caustic_builder.h"

#include "engine/base/parallel.h"
#include "engine/caustics/choice.h"
#include "engine/caustics/reconstruction.h"
#include "engine/caustics/resolution.h"
#include "engine/caustics/restriction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace atrium {
namespace {

constexpr std::size_t kMostBoxes = 16;         // of a chart
constexpr double kBoxWaste = 1.2;              // two boxes become one when it is hardly larger than both
constexpr int kMostTexels = 8192;              // a side of a chart's grid
constexpr double kThinTexel = 0.25;            // paper: texels with less of their surface have no say in the contrast
constexpr double kFullest = 0.01;              // of what a texel may hold: the mean over a chart
constexpr float kLongestAxis = 0.2F;           // of a kernel, as a share of its texture
constexpr double kManyPerTexel = 8.0;          // landings a texel from which the least kernel may shrink
constexpr float kLeastOfMany = 0.3F;           // texels: what it shrinks to
constexpr float kWidest = 3.0F;                // texels: kernels of a larger half width go to coarser texels
constexpr std::size_t kShared = 200'000;       // landings on a chart that several threads share
constexpr std::size_t kSpareTexels = 1U << 23; // that all threads together may have for themselves
constexpr std::size_t kGrain = 16'384;

/// Landings on one chart, side by side in memory, for they are looked at many times.
struct Landed {
    std::vector<std::uint32_t> index; ///< among all
    std::vector<CausticLanding> landings;
};

/// One chart, its landings and what is decided about them.
class ChartBuild {
public:
    ChartBuild(const ChartDomain& domain, Landed landed, const SurfaceCharts& charts, std::span<const vec3> positions,
               std::span<const uvec3> triangles, const CausticSettings& settings, CausticSide& out)
        : domain_(domain), mine_(std::move(landed.index)), own_(std::move(landed.landings)), charts_(charts),
          positions_(positions), triangles_(triangles), settings_(settings), out_(out) {}

    void run(double texel_share) {
        record_.chart = domain_.chart;
        record_.wish = settings_.wish;
        record_.particles = mine_.size();
        record_.extent = domain_.extent;
        record_.threshold = settings_.paper ? settings_.eta : settings_.least_dispersion;
        float strongest = 0.0F;
        for (const CausticLanding& l : own_) {
            strongest = std::max(strongest, luminance(l.power));
        }
        weight_.reserve(mine_.size());
        std::vector<WeightedPoint> points;
        points.reserve(mine_.size());
        in_textures_ = OrderFreeSum(double(strongest));
        OrderFreeSum on_mesh = in_textures_;
        for (const CausticLanding& l : own_) {
            const double w = strongest > 0.0F ? double(luminance(l.power)) / double(strongest) : 0.0;
            weight_.push_back(exact_weight(w));
            points.push_back({l.uv, weight_.back()});
        }
        const Choice choice = choose_texture(points, domain_, charts_, positions_, triangles_, settings_);
        record_.dispersion = float(choice.dispersion);
        record_.contrast = choice.contrast;
        record_.decision = record_.found = choice.decision;
        power_ = all_power();
        if (power_ > kFullest * CausticAccumulator::kMost * domain_.area) {
            record_.decision = record_.found = CausticRecord::Decision::Coarse;
            record_.why = "more light than a texture can hold";
        } else if (settings_.paper) {
            paper(texel_share);
        } else {
            obey_wish();
            if (record_.decision == CausticRecord::Decision::Texture) {
                by_footprints(texel_share);
            }
        }
        say_what_is_by_hand();
        if (record_.decision != CausticRecord::Decision::Texture) {
            left_ = all();
            record_.sizing = CausticRecord::Sizing::None;
        }
        for (const std::uint32_t k : left_) {
            on_mesh.add(double(luminance(own_[k].power)));
            out_.on_mesh.push_back(mine_[k]);
        }
        record_.power_texture = in_textures_.value();
        record_.power_mesh = on_mesh.value();
        out_.records.push_back(std::move(record_));
    }

private:
    // Too few particles to fill a texture stay too few, whatever is wished.
    void obey_wish() {
        using Decision = CausticRecord::Decision;
        record_.found = record_.decision;
        if (settings_.wish.show == CausticWish::Show::Mesh) {
            record_.decision = Decision::SetToMesh;
        } else if (settings_.wish.show == CausticWish::Show::Texture && record_.decision != Decision::TooFew) {
            record_.decision = Decision::Texture;
        }
    }
    // Not one place was lit by particles enough to fill a texture.
    void give_up_without_boxes() {
        if (record_.boxes.empty()) {
            record_.decision = CausticRecord::Decision::TooFew;
            record_.found = settings_.wish.show == CausticWish::Show::Automatic ? record_.decision : record_.found;
        }
    }
    void say_what_is_by_hand() {
        std::string what;
        const auto add = [&](const std::string& one) { what += (what.empty() ? "" : "; ") + one; };
        if (settings_.wish.show != CausticWish::Show::Automatic) {
            add(fmt::format("set by hand to {}, by itself {}", caustic_show_name(settings_.wish.show),
                            caustic_decision_name(record_.found)));
        }
        if (settings_.wish.threshold > 0.0F && !settings_.paper) {
            add(fmt::format("threshold of {:.3g} set by hand", settings_.wish.threshold));
        }
        if (!record_.why.empty()) {
            add(record_.why);
        }
        record_.why = std::move(what);
    }

    [[nodiscard]] vec2 size() const { return domain_.high - domain_.low; }
    [[nodiscard]] std::vector<std::uint32_t> all() const {
        std::vector<std::uint32_t> out(own_.size());
        std::iota(out.begin(), out.end(), 0U);
        return out;
    }

    // A rectangle of whole texels of the chart's grid in chart space.
    [[nodiscard]] TexelGrid grid_of(const CellBox& box, int width, int height) const {
        const vec2 texel = size() / vec2(float(width), float(height));
        const vec2 low = domain_.low + texel * vec2(float(box.x0), float(box.y0));
        const vec2 high = domain_.low + texel * vec2(float(box.x1), float(box.y1));
        return make_grid(domain_, charts_, positions_, triangles_, low, high, std::uint32_t(box.x1 - box.x0),
                         std::uint32_t(box.y1 - box.y0));
    }

    void keep(const TexelGrid& grid, std::vector<Rgb> image) {
        fill_around(image, grid);
        auto texture = std::make_shared<CausticTexture>();
        texture->low = grid.low;
        texture->high = grid.high;
        texture->width = grid.width;
        texture->height = grid.height;
        texture->image = std::move(image);
        record_.bytes += texture->memory_bytes();
        const vec2 a = (grid.low - domain_.low) / size();
        const vec2 b = (grid.high - domain_.low) / size();
        record_.boxes.emplace_back(a.x, a.y, b.x, b.y);
        out_.textures.push_back(std::move(texture));
    }

    // ---- default: kernels on footprints, boxes around them ----

    void by_footprints(double texel_share) {
        std::vector<std::pair<float, float>> minor;
        const vec2 metres = domain_.extent / size();
        for (const CausticLanding& l : own_) {
            const vec2 a = l.axis_a * metres, b = l.axis_b * metres;
            const float xx = a.x * a.x + b.x * b.x, xy = a.x * a.y + b.x * b.y, yy = a.y * a.y + b.y * b.y;
            const float low = 0.5F * (xx + yy) - std::sqrt(std::max(0.25F * (xx - yy) * (xx - yy) + xy * xy, 0.0F));
            if (low > 0.0F && std::isfinite(low)) {
                minor.emplace_back(std::sqrt(low), luminance(l.power));
            }
        }
        const auto budget = std::uint32_t(std::max(texel_share * double(settings_.most_texels), 256.0));
        const bool known = !minor.empty();
        const float narrow = median(minor);
        using Sizing = CausticRecord::Sizing;
        float edge = footprint_resolution(std::move(minor), 0.0, budget, settings_.mesh_edge);
        record_.sizing = edge < 0.25F * settings_.mesh_edge ? Sizing::Footprints : Sizing::Mesh;
        if (const auto each = float(std::sqrt(domain_.area / double(mine_.size()))); !known && each < edge) {
            edge = each;
            record_.sizing = Sizing::Particles;
        }
        if (settings_.wish.texel > 0.0F) {
            edge = settings_.wish.texel;
            record_.sizing = Sizing::ByHand;
        }
        if (const auto least = float(std::sqrt(power_ / CausticAccumulator::kMost)); edge < least) { // all in one texel
            edge = least;
            record_.sizing = Sizing::Brightness;
        }
        for (int attempt = 0; attempt < 8; ++attempt) {
            const auto side = [&](float extent) { return std::clamp(int(std::ceil(extent / edge)), 1, kMostTexels); };
            const int width = side(domain_.extent.x), height = side(domain_.extent.y);
            const std::vector<CellBox> boxes = boxes_at(width, height);
            double texels = 0.0;
            for (const CellBox& box : boxes) {
                texels += box.area();
            }
            if (texels <= double(budget) || attempt == 7) {
                record_.width = std::uint32_t(width);
                record_.height = std::uint32_t(height);
                record_.sizing = attempt > 0 ? Sizing::Memory : record_.sizing;
                record_.why = fmt::format("texels of {:.1f} mm: {}", 1000.0 * double(edge), sizing_words(record_.sizing));
                record_.kernel = 2.0F * std::hypot(narrow, KernelLimits{}.least * edge);
                fill(boxes, width, height);
                return;
            }
            edge *= float(std::sqrt(texels / double(budget)) * 1.02);
        }
    }

    // Of lengths, by power; sorts them. 0 of none.
    static float median(std::vector<std::pair<float, float>>& length_and_power) {
        std::sort(length_and_power.begin(), length_and_power.end());
        double all = 0.0, below = 0.0;
        for (const auto& [length, power] : length_and_power) {
            all += power;
        }
        for (const auto& [length, power] : length_and_power) {
            below += power;
            if (below >= 0.5 * all) {
                return length;
            }
        }
        return 0.0F;
    }
    static const char* sizing_words(CausticRecord::Sizing sizing) {
        switch (sizing) {
        case CausticRecord::Sizing::Footprints: return "half the width of the narrow ones among the particles' footprints";
        case CausticRecord::Sizing::Mesh: return "a quarter of what the mesh shows, for the particles' footprints are wide";
        case CausticRecord::Sizing::Particles: return "one particle each, for their footprints are not known";
        case CausticRecord::Sizing::Brightness: return "what a texel can hold";
        case CausticRecord::Sizing::Memory: return "what the memory for textures allows";
        case CausticRecord::Sizing::ByHand: return "set by hand";
        case CausticRecord::Sizing::Equation7: return "equation 7";
        case CausticRecord::Sizing::None: break;
        }
        return "";
    }

    // Power of all landings, lumen: the sum of every one's strongest colour.
    [[nodiscard]] double all_power() const {
        double most = 0.0;
        for (const CausticLanding& l : own_) {
            most = std::max(most, double(max_component(l.power)));
        }
        OrderFreeSum sum(most);
        for (const CausticLanding& l : own_) {
            sum.add(double(max_component(l.power)));
        }
        return sum.value();
    }

    // Kernel of a landing on the chart's grid: bounds, texels.
    [[nodiscard]] CellBox reach(const CausticLanding& l, int width, int height, float unknown) const {
        const vec2 per_tile = vec2(float(width), float(height)) / size();
        const vec2 at = (l.uv - domain_.low) * per_tile;
        const vec2 a = l.axis_a * per_tile, b = l.axis_b * per_tile;
        vec2 r(std::sqrt(a.x * a.x + b.x * b.x + 1.0F), std::sqrt(a.y * a.y + b.y * b.y + 1.0F));
        if (!is_finite(r) || !(glm::dot(a, a) + glm::dot(b, b) > 0.0F)) {
            r = vec2(unknown + 1.0F);
        }
        r = glm::min(r, vec2(kLongestAxis * float(width) + 1.0F, kLongestAxis * float(height) + 1.0F));
        return {std::max(int(std::floor(at.x - r.x)), 0), std::max(int(std::floor(at.y - r.y)), 0),
                std::min(int(std::ceil(at.x + r.x)), width), std::min(int(std::ceil(at.y + r.y)), height)};
    }

    // Boxes of whole texels around what is lit. Cells of a few texels decide; what lies in cells darker than a share of the
    // brightest is left to the mesh unless a box holds it anyway.
    [[nodiscard]] std::vector<CellBox> boxes_at(int width, int height) const {
        const int cell = std::max({4, (width + 511) / 512, (height + 511) / 512});
        const int cw = (width + cell - 1) / cell, ch = (height + cell - 1) / cell;
        std::vector<double> power(std::size_t(cw) * std::size_t(ch), 0.0);
        const vec2 per_tile = vec2(float(width), float(height)) / size() / float(cell);
        const auto cell_of = [&](const CausticLanding& l) {
            const vec2 at = (l.uv - domain_.low) * per_tile;
            const int x = std::clamp(int(at.x), 0, cw - 1), y = std::clamp(int(at.y), 0, ch - 1);
            return std::size_t(y) * std::size_t(cw) + std::size_t(x);
        };
        for (std::size_t k = 0; k < mine_.size(); ++k) {
            power[cell_of(own_[k])] += weight_[k];
        }
        const double dark = 0.25 * double(settings_.restriction) * *std::max_element(power.begin(), power.end());
        std::vector<std::uint8_t> lit(power.size(), 0);
        for (const CausticLanding& l : own_) {
            if (power[cell_of(l)] < dark) {
                continue;
            }
            const CellBox r = reach(l, width, height, float(cell));
            for (int y = r.y0 / cell; y < std::min((r.y1 + cell - 1) / cell, ch); ++y) {
                for (int x = r.x0 / cell; x < std::min((r.x1 + cell - 1) / cell, cw); ++x) {
                    lit[std::size_t(y) * std::size_t(cw) + std::size_t(x)] = 1;
                }
            }
        }
        std::vector<CellBox> boxes = component_boxes(lit, cw, ch);
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
            b = {std::max(b.x0 * cell - 1, 0), std::max(b.y0 * cell - 1, 0), std::min(b.x1 * cell + 1, width),
                 std::min(b.y1 * cell + 1, height)};
        }
        return merge_boxes(std::move(boxes), 0.0, kMostBoxes); // rings may have met
    }

    // Wide kernels are laid on coarser texels: a few dozen texels each, whatever their width.
    struct Level {
        TexelGrid grid;
        LitRange range;
        KernelLimits limits;
        CausticAccumulator sums{0};
    };
    static std::vector<Level> make_levels(const TexelGrid& grid, const CellBox& box, int width, int height,
                                          const KernelLimits& limits) {
        std::vector<Level> out;
        const vec2 high(float(grid.width), float(grid.height));
        LitRange range;
        range.first = {box.x0 > 0 ? 1 : 0, box.y0 > 0 ? 1 : 0};
        range.last = {int(grid.width) - (box.x1 < width ? 1 : 0), int(grid.height) - (box.y1 < height ? 1 : 0)};
        range.edge_low = {box.x0 > 0 ? -1.0F : 0.0F, box.y0 > 0 ? -1.0F : 0.0F};
        range.edge_high = {box.x1 < width ? -1.0F : high.x, box.y1 < height ? -1.0F : high.y};
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
    template <class F> void fill_side_by_side(std::vector<Level>& levels, const F& some) const {
        const std::size_t most = std::clamp<std::size_t>(kSpareTexels / levels[0].grid.size(), 1, thread_limit());
        const std::size_t parts = mine_.size() > kShared ? most : 1;
        std::vector<std::vector<Level>> more(parts - 1, levels);
        const std::size_t grain = chunk_count(mine_.size(), parts);
        parallel_chunks(mine_.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t part) {
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

    void fill(const std::vector<CellBox>& boxes, int width, int height) {
        std::vector<std::uint32_t> of_box(mine_.size(), std::uint32_t(boxes.size()));
        std::vector<std::size_t> count(boxes.size() + 1, 0);
        const vec2 per_tile = vec2(float(width), float(height)) / size();
        for (std::size_t k = 0; k < mine_.size(); ++k) {
            const vec2 at = (own_[k].uv - domain_.low) * per_tile;
            const int x = std::clamp(int(at.x), 0, width - 1), y = std::clamp(int(at.y), 0, height - 1);
            for (std::uint32_t b = 0; b < boxes.size(); ++b) {
                if (boxes[b].contains(x, y)) {
                    of_box[k] = b;
                    break;
                }
            }
            ++count[of_box[k]];
        }
        for (std::uint32_t b = 0; b < boxes.size(); ++b) {
            if (count[b] < settings_.least_particles) {
                std::replace(of_box.begin(), of_box.end(), b, std::uint32_t(boxes.size()));
                continue;
            }
            const CellBox& box = boxes[b];
            const TexelGrid grid = grid_of(box, width, height);
            KernelLimits limits;
            const double per_texel = double(count[b]) / double(grid.size());
            limits.least = per_texel > kManyPerTexel ? kLeastOfMany : limits.least;
            limits.unknown = std::max(1.5F * float(std::sqrt(1.0 / per_texel)), limits.least);
            limits.most = std::max(kLongestAxis * float(std::max(width, height)), 2.0F);
            std::vector<Level> levels = make_levels(grid, box, width, height, limits);
            std::vector<std::uint8_t> lost(mine_.size(), 0);
            const auto some = [&](std::size_t begin, std::size_t end, std::vector<Level>& to) {
                for (std::size_t k = begin; k < end; ++k) {
                    if (of_box[k] != b) {
                        continue;
                    }
                    const CausticLanding& l = own_[k];
                    std::size_t level = 0;
                    for (float w = kernel_width(l, grid, limits); w > kWidest && level + 1 < to.size(); w *= 0.5F) {
                        ++level;
                    }
                    lost[k] = splat(l, to[level].grid, to[level].range, to[level].limits, to[level].sums) ? 0 : 1;
                }
            };
            fill_side_by_side(levels, some);
            for (std::size_t k = 0; k < mine_.size(); ++k) {
                if (of_box[k] == b && lost[k] == 0) {
                    in_textures_.add(double(luminance(own_[k].power)));
                } else if (of_box[k] == b) {
                    of_box[k] = std::uint32_t(boxes.size());
                }
            }
            std::vector<Rgb> image = levels[0].sums.image();
            for (std::size_t level = 1; level < levels.size(); ++level) {
                add_coarser(levels[level].sums.image(), levels[level].grid, 1 << level, grid, levels[0].range, image);
            }
            keep(grid, std::move(image));
        }
        for (std::size_t k = 0; k < mine_.size(); ++k) {
            if (of_box[k] == boxes.size()) {
                left_.push_back(std::uint32_t(k));
            }
        }
        give_up_without_boxes();
    }

    // ---- the algorithms of 2001 ----

    // Equation 1 with the area of a full texel for all, see peak().
    [[nodiscard]] std::vector<Rgb> histogram(const TexelGrid& grid, const std::vector<std::uint32_t>& which) const {
        CausticAccumulator sums(grid.size());
        for (const std::uint32_t k : which) {
            sums.add(grid.texel_at(own_[k].uv), dvec3(own_[k].power) / grid.largest);
        }
        return sums.image();
    }

    void paper(double texel_share) {
        const double budget = std::max(texel_share * double(settings_.most_texels), 256.0);
        record_.sizing = CausticRecord::Sizing::Equation7;
        int level = caustic_level(double(mine_.size()), double(settings_.epsilon));
        record_.why =
            fmt::format("equation 7: 2^{} a side for {} particles at epsilon {}", level, mine_.size(), settings_.epsilon);
        const auto within = [&](std::size_t textures) { // the memory for textures
            const double most =
                std::min(budget / double(textures), kFullest * CausticAccumulator::kMost * domain_.area / power_);
            while (level > 0 && std::ldexp(1.0, 2 * level) > most) {
                --level;
                record_.sizing = CausticRecord::Sizing::Memory;
                record_.why = fmt::format("2^{} a side: what the memory for textures allows", level);
            }
            return paper_resolution(level, domain_.extent);
        };
        TexelCount count = within(1);
        record_.width = count.width;
        record_.height = count.height;
        TexelGrid grid = grid_of({0, 0, int(count.width), int(count.height)}, int(count.width), int(count.height));
        const std::vector<Rgb> whole = histogram(grid, all());
        const float most = peak(whole, grid);
        float least = most;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            if (grid.area[i] > kThinTexel * grid.largest) {
                least = std::min(least, luminance(whole[i]) * float(grid.largest / grid.area[i]));
            }
        }
        record_.contrast = caustic_contrast(least, most);
        // The contrast of a few particles a texel is near 1 by chance alone: what chance explains is no caustic.
        if (record_.decision == CausticRecord::Decision::Coarse) {
            record_.decision = CausticRecord::Decision::Texture;
        }
        if (record_.decision == CausticRecord::Decision::Texture && record_.contrast < settings_.eta) {
            record_.decision = CausticRecord::Decision::Uniform;
        }
        obey_wish();
        if (record_.decision != CausticRecord::Decision::Texture) {
            return;
        }
        // Boxes around texels above a share of the peak; each gets as many texels as the whole had.
        std::vector<std::uint8_t> marked(whole.size());
        for (std::size_t i = 0; i < whole.size(); ++i) {
            marked[i] = luminance(whole[i]) > settings_.restriction * most ? 1 : 0;
        }
        std::vector<CellBox> boxes = component_boxes(marked, int(count.width), int(count.height));
        std::stable_sort(boxes.begin(), boxes.end(), [](const CellBox& a, const CellBox& b) { return a.area() > b.area(); });
        boxes.resize(std::min(boxes.size(), kMostBoxes));
        boxes = merge_boxes(std::move(boxes), 0.0, kMostBoxes);
        const vec2 texel = size() / vec2(float(count.width), float(count.height));
        count = within(boxes.size());
        left_ = all();
        for (const CellBox& box : boxes) {
            std::vector<std::uint32_t> inside, outside;
            for (const std::uint32_t k : left_) {
                const vec2 at = grid.to_texels(own_[k].uv);
                (box.contains(std::clamp(int(at.x), 0, int(grid.width) - 1), std::clamp(int(at.y), 0, int(grid.height) - 1))
                     ? inside
                     : outside)
                    .push_back(k);
            }
            if (inside.size() < settings_.least_particles) {
                continue;
            }
            const TexelGrid own =
                make_grid(domain_, charts_, positions_, triangles_, domain_.low + texel * vec2(float(box.x0), float(box.y0)),
                          domain_.low + texel * vec2(float(box.x1), float(box.y1)), count.width, count.height);
            const std::vector<Rgb> image = spiral_means(histogram(own, inside), own, settings_.spiral_radius);
            for (const std::uint32_t k : inside) {
                in_textures_.add(double(luminance(own_[k].power)));
            }
            add_ring(own, image);
            left_ = std::move(outside);
        }
        give_up_without_boxes();
    }

    // A ring of black texels where the box ends within the chart.
    void add_ring(const TexelGrid& own, const std::vector<Rgb>& image) {
        const vec2 texel = (own.high - own.low) / vec2(float(own.width), float(own.height));
        const auto inside = [&](float a, float b) { return std::abs(a - b) > 1e-4F * std::abs(b) + 1e-6F ? 1U : 0U; };
        const std::uint32_t left = inside(own.low.x, domain_.low.x), right = inside(own.high.x, domain_.high.x);
        const std::uint32_t below = inside(own.low.y, domain_.low.y), above = inside(own.high.y, domain_.high.y);
        TexelGrid grid = own;
        grid.width += left + right;
        grid.height += below + above;
        grid.low -= texel * vec2(float(left), float(below));
        grid.high += texel * vec2(float(right), float(above));
        grid.area.assign(grid.size(), own.largest); // rings are black all over
        std::vector<Rgb> ringed(grid.size(), Rgb(0.0F));
        for (std::uint32_t y = 0; y < own.height; ++y) {
            for (std::uint32_t x = 0; x < own.width; ++x) {
                const std::size_t to = std::size_t(y + below) * grid.width + x + left;
                ringed[to] = image[std::size_t(y) * own.width + x];
                grid.area[to] = own.area[std::size_t(y) * own.width + x];
            }
        }
        keep(grid, std::move(ringed));
    }

    const ChartDomain& domain_;
    std::vector<std::uint32_t> mine_; ///< the chart's landings among all
    std::vector<CausticLanding> own_; ///< the same as they are
    const SurfaceCharts& charts_;
    std::span<const vec3> positions_;
    std::span<const uvec3> triangles_;
    const CausticSettings& settings_;
    CausticSide& out_;
    CausticRecord record_;
    std::vector<double> weight_; ///< luminance of each of own_ over that of the strongest, see exact_weight()
    double power_ = 0.0;         ///< see all_power()
    OrderFreeSum in_textures_{0.0};
    std::vector<std::uint32_t> left_; ///< for the mesh; into own_
};

} // namespace

CausticSide build_caustics(std::span<const CausticLanding> landings, const SurfaceCharts& charts,
                           std::span<const vec3> positions, std::span<const uvec3> triangles,
                           const CausticSettings& automatic) {
    CausticSide out;
    CausticSettings settings = automatic;
    if (settings.wish.threshold > 0.0F) {
        settings.least_dispersion = settings.wish.threshold;
    }
    const std::vector<ChartDomain> domains = chart_domains(charts, positions, triangles);
    const auto chart_of = [&](const CausticLanding& l) {
        const std::uint32_t chart = charts.chart_of_triangle[l.triangle];
        const bool usable =
            chart != SurfaceCharts::kNone && domains[chart].area > 0.0 && is_finite(l.uv) && is_finite(l.power);
        return usable ? chart : SurfaceCharts::kNone;
    };
    std::vector<std::size_t> count(domains.size(), 0);
    for (const CausticLanding& l : landings) {
        const std::uint32_t chart = chart_of(l);
        if (chart != SurfaceCharts::kNone) {
            ++count[chart];
        }
    }
    std::vector<Landed> landed(domains.size());
    for (std::size_t c = 0; c < domains.size(); ++c) {
        landed[c].index.reserve(count[c]);
        landed[c].landings.reserve(count[c]);
    }
    float strongest = 0.0F; // off the charts
    std::optional<CausticRecord> uncharted;
    for (std::uint32_t i = 0; i < landings.size(); ++i) {
        const std::uint32_t chart = chart_of(landings[i]);
        if (chart != SurfaceCharts::kNone) {
            landed[chart].index.push_back(i);
            landed[chart].landings.push_back(landings[i]);
            continue;
        }
        out.on_mesh.push_back(i);
        strongest = is_finite(landings[i].power) ? std::max(strongest, luminance(landings[i].power)) : strongest;
    }
    const double charted = double(landings.size() - out.on_mesh.size());
    if (!out.on_mesh.empty()) {
        CausticRecord record;
        record.chart = SurfaceCharts::kNone;
        record.decision = record.found = CausticRecord::Decision::Uncharted;
        record.wish = settings.wish;
        record.particles = out.on_mesh.size();
        record.why = "pieces too small for a chart";
        OrderFreeSum power{double(strongest)};
        for (const std::uint32_t i : out.on_mesh) {
            if (is_finite(landings[i].power)) {
                power.add(double(luminance(landings[i].power)));
            }
        }
        record.power_mesh = power.value();
        uncharted = std::move(record);
    }
    std::vector<CausticSide> parts(domains.size());
    parallel_chunks(domains.size(), 1, [&](std::size_t c, std::size_t, std::size_t) {
        if (count[c] > 0) {
            const double share = double(count[c]) / charted; // of the memory, by particles
            ChartBuild(domains[c], std::move(landed[c]), charts, positions, triangles, settings, parts[c]).run(share);
        }
    });
    for (CausticSide& part : parts) {
        out.textures.insert(out.textures.end(), part.textures.begin(), part.textures.end());
        out.records.insert(out.records.end(), part.records.begin(), part.records.end());
        out.on_mesh.insert(out.on_mesh.end(), part.on_mesh.begin(), part.on_mesh.end());
    }
    if (uncharted) {
        out.records.push_back(std::move(*uncharted));
    }
    std::sort(out.on_mesh.begin(), out.on_mesh.end());
    return out;
}

} // namespace atrium
