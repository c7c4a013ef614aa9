// How much of a part's light each of its sources sends: what changes when one of them is dimmed.
#include "engine/base/parallel.h"
#include "engine/layers/light_part.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kSameShare = 0.03F; // of the light: nodes between neighbours that differ by less need no look

} // namespace

// Never more than the node has: what is left when the source goes out must not be negative.
Rgb LightPart::light_of_node(const LightNode& n, const DirectFunction& source, const Rgb& most) const {
    const vec2 step = metres_per_step(n.sheet);
    const auto place = sheets_.locate(n.sheet, vec2(float(n.x), float(n.y)) * step,
                                      glm::length(step) * float(cells_.steps(cells_.first_level())));
    return place ? glm::min(source(place->point, place->normal).irradiance, most) : Rgb(0.0F);
}

// The source's share at a node halfway between coarser ones, where these agree.
bool LightPart::guess_share(const LightNode& n, std::uint32_t step, const std::vector<Rgb>& light, const Rgb& brightness,
                            Rgb& share) const {
    const auto between = [&](std::uint32_t x) { return x % (2 * step) != 0; };
    Rgb sum(0.0F), least(1.0F), most(0.0F);
    int count = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (((k & 1U) != 0 && !between(n.x)) || ((k >> 1U) != 0 && !between(n.y))) {
            continue;
        }
        const std::uint32_t x = between(n.x) ? ((k & 1U) != 0 ? n.x + step : n.x - step) : n.x;
        const std::uint32_t y = between(n.y) ? ((k >> 1U) != 0 ? n.y + step : n.y - step) : n.y;
        const std::uint32_t at = cells_.find(n.sheet, x, y);
        if (at == LightCells::kNone || !cells_.nodes[at].known() || !(max_component(cells_.nodes[at].irradiance) > 0.0F)) {
            continue;
        }
        const Rgb all = per_brightness(cells_.nodes[at].irradiance, brightness);
        const Rgb f = glm::min(light[at] / glm::max(all, Rgb(1e-30F)), Rgb(1.0F));
        sum += f;
        least = glm::min(least, f);
        most = glm::max(most, f);
        ++count;
    }
    share = count > 0 ? sum / float(count) : Rgb(0.0F);
    return count > 0 && max_component(most - least) <= kSameShare;
}

std::vector<Rgb> LightPart::light_of(const DirectFunction& source, const Rgb& brightness, const RunContext& context) {
    std::vector<Rgb> out(cells_.nodes.size(), Rgb(0.0F));
    const auto level_of = [&](const LightNode& n) {
        unsigned level = cells_.first_level();
        while (level < cells_.max_level() && ((n.x | n.y) & (cells_.steps(level) - 1)) != 0) {
            ++level;
        }
        return level;
    };
    std::vector<std::vector<std::uint32_t>> by_level(cells_.max_level() + 1);
    for (std::uint32_t i = 0; i < cells_.nodes.size(); ++i) {
        const LightNode& n = cells_.nodes[i];
        if (n.known() && max_component(n.irradiance) > 0.0F) {
            by_level[level_of(n)].push_back(i);
        }
    }
    for (unsigned level = 0; level < by_level.size(); ++level) {
        const std::vector<std::uint32_t>& nodes = by_level[level];
        parallel_chunks(nodes.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t k = begin; k < end && !context.should_stop(); ++k) {
                const LightNode& n = cells_.nodes[nodes[k]];
                const Rgb all = per_brightness(n.irradiance, brightness);
                Rgb share(1.0F);
                if (!source ||
                    (level > cells_.first_level() && guess_share(n, cells_.steps(level), out, brightness, share))) {
                    out[nodes[k]] = share * all;
                } else {
                    out[nodes[k]] = light_of_node(n, source, all);
                }
            }
        });
    }
    return out;
}

std::vector<Rgb> LightPart::all_light_of(const DirectFunction& source, const RunContext& context) const {
    std::vector<Rgb> out(cells_.nodes.size(), Rgb(0.0F));
    parallel_chunks(out.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const LightNode& n = cells_.nodes[i];
            if (n.known() && max_component(n.irradiance) > 0.0F) {
                out[i] = source ? light_of_node(n, source, n.irradiance) : n.irradiance;
            }
        }
    });
    return out;
}

void LightPart::add_light(const std::vector<Rgb>& of_source, const Rgb& change) {
    const std::uint32_t first = cells_.steps(cells_.first_level());
    for (std::uint32_t sheet = 0; sheet < first_probe_.size(); ++sheet) { // as the node at their cell's corner
        const std::size_t last = sheet + 1 < first_probe_.size() ? first_probe_[sheet + 1] : probes_.size();
        for (std::size_t i = first_probe_[sheet]; i < last; ++i) {
            Probe& p = probes_[i];
            const std::uint32_t corner =
                cells_.find(sheet, std::uint32_t(p.at.x) / first * first, std::uint32_t(p.at.y) / first * first);
            if (p.seen.light > 0.0F && corner != LightCells::kNone) {
                const float before = luminance(cells_.nodes[corner].irradiance);
                const float more = luminance(change * of_source[corner]);
                const float factor = before > 0.0F ? std::max(before + more, 0.0F) / before : 1.0F;
                p.seen.light *= factor;
                p.seen.variance *= factor * factor;
            }
        }
    }
    for (std::size_t i = 0; i < of_source.size(); ++i) {
        LightNode& n = cells_.nodes[i];
        const float before = luminance(n.irradiance);
        n.irradiance = glm::max(n.irradiance + change * of_source[i], Rgb(0.0F));
        const float factor = before > 0.0F ? luminance(n.irradiance) / before : 1.0F;
        n.variance *= factor * factor;
    }
}

} // namespace atrium
