#include "engine/caustics/caustic_builder.h"

#include "engine/base/parallel.h"
#include "engine/caustics/chart_work.h"
#include "engine/caustics/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace atrium {
namespace {

/// Landings on one chart.
struct Landed {
    std::vector<std::uint32_t> index; ///< among all
    std::vector<CausticLanding> landings;
};

// Not one place was lit by particles enough to fill a texture.
void give_up_without_boxes(ChartWork& work) {
    CausticRecord& record = work.record;
    if (record.decision == CausticRecord::Decision::Texture && record.boxes.empty()) {
        record.decision = CausticRecord::Decision::TooFew;
        record.found = work.settings.wish.show == CausticWish::Show::Automatic ? record.decision : record.found;
    }
}

void say_what_is_by_hand(ChartWork& work) {
    CausticRecord& record = work.record;
    const CausticWish& wish = work.settings.wish;
    std::string what;
    const auto add = [&](const std::string& one) { what += (what.empty() ? "" : "; ") + one; };
    if (wish.show != CausticWish::Show::Automatic) {
        add(fmt::format("set by hand to {}, by itself {}", caustic_show_name(wish.show),
                        caustic_decision_name(record.found)));
    }
    if (wish.threshold > 0.0F && !work.settings.paper) {
        add(fmt::format("threshold of {:.3g} set by hand", wish.threshold));
    }
    if (!record.why.empty()) {
        add(record.why);
    }
    record.why = std::move(what);
}

// Power of all landings, lumen: the sum of every one's strongest colour.
double all_power(const std::vector<CausticLanding>& landings) {
    double most = 0.0;
    for (const CausticLanding& l : landings) {
        most = std::max(most, double(max_component(l.power)));
    }
    OrderFreeSum sum(most);
    for (const CausticLanding& l : landings) {
        sum.add(double(max_component(l.power)));
    }
    return sum.value();
}

// Mesh or texture, by the tests.
void decide(ChartWork& work) {
    std::vector<WeightedPoint> points;
    points.reserve(work.landings.size());
    for (std::size_t k = 0; k < work.landings.size(); ++k) {
        points.push_back({work.landings[k].uv, work.weight[k]});
    }
    const Choice choice =
        choose_texture(points, work.domain, work.charts, work.positions, work.triangles, work.settings, work.context);
    work.record.dispersion = float(choice.dispersion);
    work.record.contrast = choice.contrast;
    work.record.decision = work.record.found = choice.decision;
}

/// One chart: decides, fills, and tells `out` what there is. `texels` are what its textures may have.
void build_chart(ChartWork& work, const std::vector<std::uint32_t>& index, double texels, CausticSide& out) {
    using Decision = CausticRecord::Decision;
    const CausticSettings& settings = work.settings;
    CausticRecord& record = work.record;
    record.chart = work.domain.chart;
    record.wish = settings.wish;
    record.particles = index.size();
    record.extent = work.domain.extent;
    record.threshold = settings.paper ? settings.eta : settings.least_dispersion;
    float strongest = 0.0F;
    for (const CausticLanding& l : work.landings) {
        strongest = std::max(strongest, luminance(l.power));
    }
    work.weight.reserve(index.size());
    for (const CausticLanding& l : work.landings) {
        work.weight.push_back(exact_weight(strongest > 0.0F ? double(luminance(l.power)) / double(strongest) : 0.0));
    }
    work.in_textures = OrderFreeSum(double(strongest));
    OrderFreeSum on_mesh = work.in_textures;
    std::vector<std::uint32_t> all(index.size());
    std::iota(all.begin(), all.end(), 0U);
    work.left = all;
    decide(work);
    work.power = all_power(work.landings);
    if (work.power > work.fullest()) {
        record.decision = record.found = Decision::Coarse;
        record.why = "more light than a texture can hold";
    } else if (settings.paper) {
        fill_as_in_2001(work, texels);
    } else {
        obey_wish(work);
        if (record.decision == Decision::Texture) {
            fill_by_footprints(work, texels);
        }
    }
    give_up_without_boxes(work);
    say_what_is_by_hand(work);
    if (record.decision != Decision::Texture) {
        work.left = std::move(all);
        record.sizing = CausticRecord::Sizing::None;
    }
    for (const std::uint32_t k : work.left) {
        on_mesh.add(double(luminance(work.landings[k].power)));
        out.on_mesh.push_back(index[k]);
    }
    record.power_texture = work.in_textures.value();
    record.power_mesh = on_mesh.value();
    out.textures = std::move(work.textures);
    out.records.push_back(std::move(record));
}

} // namespace

CausticSide build_caustics(std::span<const CausticLanding> landings, const SurfaceCharts& charts,
                           std::span<const vec3> positions, std::span<const uvec3> triangles,
                           const CausticSettings& automatic, const RunContext& context) {
    CausticSide out;
    StopCheck stop(context, 4096);
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
        if (stop()) {
            return {};
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
        if (stop()) {
            return {};
        }
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
        if (count[c] > 0 && !context.should_stop()) {
            ChartWork work{domains[c], charts, positions, triangles, settings, context};
            work.landings = std::move(landed[c].landings);
            const double share = double(count[c]) / charted; // of the memory, by particles
            build_chart(work, landed[c].index, share * double(settings.most_texels), parts[c]);
        }
    });
    if (context.should_stop()) {
        return {};
    }
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
