// Direct light as changes of brightness make it.
#include "engine/base/parallel.h"
#include "engine/solver/gi_engine_impl.h"
#include "engine/solver/relight.h"

#include <algorithm>

namespace atrium {

bool CommonFactor::agrees(const Rgb& was, const Rgb& is) {
    constexpr float kRounding = 1e-6F;
    for (int c = 0; c < 3; ++c) {
        if (was[c] > 0.0F && !set_[std::size_t(c)]) {
            set_[std::size_t(c)] = true;
            factor_[c] = is[c] / was[c];
        }
        if (std::abs(is[c] - factor_[c] * was[c]) > kRounding * std::max(is[c], was[c])) {
            return false;
        }
    }
    return true;
}

bool GiEngine::Relight::sources_alike(Rgb& factor) const {
    CommonFactor common;
    const bool alike =
        std::all_of(sources.begin(), sources.end(), [&](const Source& x) { return common.agrees(x.base, x.now); });
    factor = alike ? common.factor() : Rgb(1.0F);
    return alike;
}

// light + changes of brightness times what the sources send; never less than nothing. Or all of it times one factor.
class GiEngine::Relight::Sum {
public:
    explicit Sum(const Relight& relight) : alike_(relight.sources_alike(factor_)) {
        for (const auto& source : relight.sources) {
            if (!alike_ && source.known && source.now != source.base) {
                terms_.push_back({&source, source.now - source.base});
            }
        }
    }
    /// `of(source)`: pointer to what it sends there, null where that is nothing. False where nothing changes.
    template <class Of> bool add(std::vector<Rgb>& light, const Of& of) const {
        bool any = false;
        for (std::size_t i = 0; alike_ && factor_ != Rgb(1.0F) && i < light.size(); ++i) {
            light[i] *= factor_;
            any = true;
        }
        for (const auto& [source, change] : terms_) {
            const std::vector<Rgb>* sent = of(*source);
            if (sent == nullptr || sent->empty()) {
                continue;
            }
            any = true;
            for (std::size_t i = 0; i < light.size(); ++i) {
                light[i] += change * (*sent)[i];
            }
        }
        for (std::size_t i = 0; any && i < light.size(); ++i) {
            light[i] = glm::max(light[i], Rgb(0.0F));
        }
        return any;
    }
    [[nodiscard]] Rgb at(const Rgb& light, std::size_t i, std::vector<Rgb> Source::*sent) const {
        Rgb out = alike_ ? light * factor_ : light;
        for (const auto& [source, change] : terms_) {
            if (!((*source).*sent).empty()) {
                out += change * ((*source).*sent)[i];
            }
        }
        return glm::max(out, Rgb(0.0F));
    }

private:
    Rgb factor_{1.0F};
    bool alike_ = false;
    std::vector<std::pair<const Source*, Rgb>> terms_;
};

// Light maps, and direct light on vertices.
void GiEngine::Relight::show_direct(Impl& s) const {
    const Sum sum(*this);
    const auto surfaces = s.rays->surfaces().size();
    parallel_chunks(2 * surfaces, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const bool back = i >= surfaces;
            const std::size_t k = i % surfaces;
            const auto& base = (back ? maps.back : maps.front)[k];
            auto& shown = (back ? s.maps.back : s.maps.front)[k];
            shown = base;
            if (base) {
                std::vector<Rgb> image = base->image;
                const bool changed = sum.add(image, [&](const Source& source) -> const std::vector<Rgb>* {
                    const auto& side = back ? source.maps.back : source.maps.front;
                    return k < side.size() && side[k] ? &side[k]->image : nullptr;
                });
                if (changed) {
                    auto map = std::make_shared<LightMap>();
                    map->width = base->width;
                    map->height = base->height;
                    map->tiles = base->tiles;
                    map->image_width = base->image_width;
                    map->image_height = base->image_height;
                    map->image = std::move(image);
                    shown = std::move(map);
                }
            }
        }
    });
    parallel_chunks(layers.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const SurfaceLayer& base = *layers[i];
            auto& shown = s.live->layers.surfaces[i];
            std::vector<Rgb> front = base.direct_front, back = base.direct_back;
            const auto vertices = [&](bool of_back) {
                return [i, of_back](const Source& source) -> const std::vector<Rgb>* {
                    return i < source.vertices.size() ? &(of_back ? source.vertices[i].back : source.vertices[i].front)
                                                      : nullptr;
                };
            };
            (void)sum.add(front, vertices(false));
            (void)sum.add(back, vertices(true));
            const std::uint32_t surface = s.live->layers.places[i].surface;
            const bool charted = !s.charts[surface].empty();
            if (front == shown->direct_front && back == shown->direct_back &&
                (!charted ||
                 (shown->direct_map_front == s.maps.front[surface] && shown->direct_map_back == s.maps.back[surface]))) {
                continue;
            }
            auto layer = std::make_shared<SurfaceLayer>(*shown);
            layer->direct_front = std::move(front);
            layer->direct_back = std::move(back);
            if (charted) {
                layer->direct_map_front = s.maps.front[surface];
                layer->direct_map_back = s.maps.back[surface];
            }
            shown = std::move(layer);
        }
    });
}

void GiEngine::Relight::light_leaves(Impl& s) const {
    const Sum sum(*this);
    parallel_chunks(leaves.size(), 1024, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            Element& e = s.hierarchy.elements[leaves[i].element];
            e.direct = sum.at(leaves[i].direct, i, &Source::direct);
            e.caustic = sum.at(leaves[i].caustic, i, &Source::caustic);
        }
    });
}

} // namespace atrium
