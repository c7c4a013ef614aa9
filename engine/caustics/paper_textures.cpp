// Paper mode: the algorithms of 2001.
#include "engine/caustics/chart_work.h"
#include "engine/caustics/choice.h"
#include "engine/caustics/reconstruction.h"
#include "engine/caustics/resolution.h"

#include <fmt/format.h>

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kMostBoxes = 16; // of a chart
constexpr double kThinTexel = 0.25;    // texels with less of their surface have no say in the contrast

class PaperTextures {
public:
    explicit PaperTextures(ChartWork& work) : work_(work) {}

    void run(double texels) {
        budget_ = std::max(texels, 256.0);
        CausticRecord& record = work_.record;
        record.sizing = CausticRecord::Sizing::Equation7;
        const std::size_t particles = work_.landings.size();
        level_ = caustic_level(double(particles), double(work_.settings.epsilon));
        record.why =
            fmt::format("equation 7: 2^{} a side for {} particles at epsilon {}", level_, particles, work_.settings.epsilon);
        const TexelCount count = within(1);
        record.width = count.width;
        record.height = count.height;
        const TexelGrid grid =
            work_.grid_of({0, 0, int(count.width), int(count.height)}, int(count.width), int(count.height));
        const std::vector<Rgb> whole = histogram(grid, work_.left);
        const float most = peak(whole, grid);
        float least = most;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            if (grid.area[i] > kThinTexel * grid.largest) {
                least = std::min(least, luminance(whole[i]) * float(grid.largest / grid.area[i]));
            }
        }
        record.contrast = caustic_contrast(least, most);
        // The contrast of a few particles a texel is near 1 by chance alone: what chance explains is no caustic.
        if (record.decision == CausticRecord::Decision::Coarse) {
            record.decision = CausticRecord::Decision::Texture;
        }
        if (record.decision == CausticRecord::Decision::Texture && record.contrast < work_.settings.eta) {
            record.decision = CausticRecord::Decision::Uniform;
        }
        obey_wish(work_);
        if (record.decision == CausticRecord::Decision::Texture) {
            restrict_to_boxes(grid, whole, most);
        }
    }

private:
    // As many texels as the memory for so many textures allows.
    TexelCount within(std::size_t textures) {
        double most = budget_ / double(textures);
        if (work_.power > 0.0) {
            most = std::min(most, work_.fullest() / work_.power);
        }
        while (level_ > 0 && std::ldexp(1.0, 2 * level_) > most) {
            --level_;
            work_.record.sizing = CausticRecord::Sizing::Memory;
            work_.record.why = fmt::format("2^{} a side: what the memory for textures allows", level_);
        }
        return paper_resolution(level_, work_.domain.extent);
    }

    // Equation 1 with the area of a full texel for all, see peak().
    [[nodiscard]] std::vector<Rgb> histogram(const TexelGrid& grid, const std::vector<std::uint32_t>& which) const {
        CausticAccumulator sums(grid.size());
        StopCheck stop(work_.context, 4096);
        for (std::size_t i = 0; i < which.size() && !stop(); ++i) {
            const CausticLanding& l = work_.landings[which[i]];
            sums.add(grid.texel_at(l.uv), dvec3(l.power) / grid.largest);
        }
        return sums.image();
    }

    // Boxes around texels above a share of the peak; each gets as many texels as the whole had.
    void restrict_to_boxes(const TexelGrid& grid, const std::vector<Rgb>& whole, float most) {
        std::vector<std::uint8_t> marked(whole.size());
        for (std::size_t i = 0; i < whole.size(); ++i) {
            marked[i] = luminance(whole[i]) > work_.settings.restriction * most ? 1 : 0;
        }
        std::vector<CellBox> boxes = component_boxes(marked, int(grid.width), int(grid.height));
        std::stable_sort(boxes.begin(), boxes.end(), [](const CellBox& a, const CellBox& b) { return a.area() > b.area(); });
        boxes.resize(std::min(boxes.size(), kMostBoxes));
        boxes = merge_boxes(std::move(boxes), 0.0, kMostBoxes);
        if (boxes.empty()) { // dark all over
            return;
        }
        const vec2 texel = work_.size() / vec2(float(grid.width), float(grid.height));
        const TexelCount count = within(boxes.size());
        for (const CellBox& box : boxes) {
            std::vector<std::uint32_t> inside, outside;
            for (const std::uint32_t k : work_.left) {
                const vec2 at = grid.to_texels(work_.landings[k].uv);
                (box.contains(std::clamp(int(at.x), 0, int(grid.width) - 1), std::clamp(int(at.y), 0, int(grid.height) - 1))
                     ? inside
                     : outside)
                    .push_back(k);
            }
            if (inside.size() < work_.settings.least_particles) {
                continue;
            }
            const TexelGrid own =
                make_grid(work_.domain, work_.charts, work_.positions, work_.triangles,
                          work_.domain.low + texel * vec2(float(box.x0), float(box.y0)),
                          work_.domain.low + texel * vec2(float(box.x1), float(box.y1)), count.width, count.height);
            const std::vector<Rgb> image = spiral_means(histogram(own, inside), own, work_.settings.spiral_radius);
            if (work_.stopped()) {
                return;
            }
            for (const std::uint32_t k : inside) {
                work_.in_textures.add(double(luminance(work_.landings[k].power)));
            }
            add_ring(own, image);
            work_.left = std::move(outside);
        }
    }

    // A ring of black texels where the box ends within the chart.
    void add_ring(const TexelGrid& own, const std::vector<Rgb>& image) {
        const ChartDomain& domain = work_.domain;
        const vec2 texel = (own.high - own.low) / vec2(float(own.width), float(own.height));
        const auto inside = [&](float a, float b) { return std::abs(a - b) > 1e-4F * std::abs(b) + 1e-6F ? 1U : 0U; };
        const std::uint32_t left = inside(own.low.x, domain.low.x), right = inside(own.high.x, domain.high.x);
        const std::uint32_t below = inside(own.low.y, domain.low.y), above = inside(own.high.y, domain.high.y);
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
        work_.keep(grid, std::move(ringed));
    }

    ChartWork& work_;
    double budget_ = 0.0; ///< texels
    int level_ = 0;
};

} // namespace

void fill_as_in_2001(ChartWork& work, double texels) { PaperTextures(work).run(texels); }

} // namespace atrium
