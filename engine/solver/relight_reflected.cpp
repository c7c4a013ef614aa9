// What leaves reflect of light that was dimmed, coloured or met new paint.
#include "engine/solver/gi_engine_impl.h"
#include "engine/solver/relight.h"

#include <algorithm>

namespace atrium {

// Whether all light is what it was times one factor per channel, and every surface reflects as it did.
bool GiEngine::Relight::common_factor(const Impl& s, Rgb& factor) const {
    CommonFactor common;
    const bool alike =
        std::all_of(sources.begin(), sources.end(), [&](const Source& x) { return common.agrees(x.base, x.now); }) &&
        std::all_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
            const Element& e = s.hierarchy.elements[leaf.element];
            return e.rho == leaf.rho && common.agrees(leaf.emitted, e.emitted);
        });
    factor = common.factor();
    return alike;
}

void GiEngine::Relight::reflect(Impl& s, const RunContext& context) const {
    Impl::Live& live = *s.live;
    std::vector<Element>& elements = s.hierarchy.elements;
    const auto put_back = [&](const Rgb& factor) {
        for (const Leaf& leaf : leaves) {
            elements[leaf.element].irradiance = leaf.irradiance * factor;
        }
    };
    Rgb factor(1.0F);
    if (common_factor(s, factor)) {
        put_back(factor);
        for (const Leaf& leaf : leaves) {
            Element& e = elements[leaf.element];
            e.radiosity = factor == Rgb(1.0F) ? leaf.radiosity : e.first_radiosity() + e.rho * e.irradiance;
        }
        s.hierarchy.pull_radiosity();
        (void)s.brighten_images(0.0);
        parallel_chunks(layers.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                std::vector<Rgb> front = layers[i]->irradiance_front, back = layers[i]->irradiance_back;
                for (auto* side : {&front, &back}) {
                    for (Rgb& light : *side) {
                        light *= factor;
                    }
                }
                auto& shown = live.layers.surfaces[i];
                if (front != shown->irradiance_front || back != shown->irradiance_back) {
                    auto layer = std::make_shared<SurfaceLayer>(*shown);
                    layer->irradiance_front = std::move(front);
                    layer->irradiance_back = std::move(back);
                    shown = std::move(layer);
                }
            }
        });
        return;
    }
    put_back(Rgb(1.0F)); // always from the base: what is shown does not depend on the way that a slider took
    if (!live.reflected) {
        LayerSet base = live.layers;
        base.surfaces = layers;
        live.reflected = std::make_unique<ReflectedChange>(s.hierarchy, *s.rays, base);
    }
    dvec3 was(0.0), is(0.0);
    for (const Leaf& leaf : leaves) {
        const Element& e = elements[leaf.element];
        was += dvec3(leaf.emitted + leaf.rho * (leaf.direct + leaf.caustic)) * double(e.area);
        is += dvec3(e.first_radiosity()) * double(e.area);
    }
    put_back(Rgb(is / glm::max(was, dvec3(1e-30))));
    constexpr double kTolerance = 0.003;
    constexpr int kMostSweeps = 12;
    solve_radiosity(s.hierarchy, *live.exchange, kTolerance, kMostSweeps, context);
    live.reflected->add_to(s.hierarchy, {}, {}, live.layers.surfaces, s.brighten_images(0.0));
}

void GiEngine::Relight::settle(Impl& s) const {
    for (const Source& source : sources) {
        if (source.known && source.now != source.base && s.live->maps) {
            s.live->maps->add_light(source.maps, source.now - source.base);
        }
    }
    if (s.particles) {
        s.particles->settle_emission(s.particle_scene(*s.punctual));
    }
    s.live->mean_radiance = mean_radiance * brightening(s);
}

double GiEngine::Relight::brightening(const Impl& s) const {
    double sum = 0.0, area = 0.0;
    bool any = false;
    for (const Leaf& leaf : leaves) {
        const Element& e = s.hierarchy.elements[leaf.element];
        const double was = luminance(leaf.rho * (leaf.direct + leaf.caustic + leaf.irradiance));
        const double is = luminance(e.rho * (e.direct + e.caustic + e.irradiance));
        any = any || is > 0.0 || max_component(e.emitted) > 0.0F;
        if (was > 0.0 && is > 0.0) {
            sum += double(e.area) * std::log(is / was);
            area += e.area;
        }
    }
    return !any ? 0.0 : area > 0.0 ? std::exp(sum / area) : 1.0;
}

} // namespace atrium
