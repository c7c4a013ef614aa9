#include "engine/radiosity/mirror_light.h"

namespace atrium {

DirectSample MirrorLight::irradiance(const vec3& point, const vec3& normal, const GatherSettings& settings,
                                     const DirectLight* lamps, const PointGather* surfaces) const {
    DirectSample out;
    for (std::uint32_t k = 0; k < mirrors_.mirrors().size(); ++k) {
        const MirrorSight sight(rays_, mirrors_, k, point, normal);
        if (!sight.sees()) {
            continue;
        }
        for (const DirectSample& part :
             {lamps != nullptr ? lamps->lamps_irradiance(sight, settings.sun_rays) : DirectSample{},
              surfaces != nullptr ? surfaces->irradiance(sight, settings) : DirectSample{}}) {
            out.irradiance += part.irradiance;
            out.variance += part.variance;
        }
    }
    return out;
}

} // namespace atrium
