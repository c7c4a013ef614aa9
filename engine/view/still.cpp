#include "engine/view/still.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/view/eye_tracer.h"
#include "engine/view/final_still.h"
#include "engine/view/look_through.h"
#include "engine/view/still_sums.h"

#include <algorithm>

namespace atrium {

Picture StillLayers::beauty() const {
    Picture out = direct;
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        out.pixels[i] += diffuse.pixels[i] + caustic.pixels[i] + specular.pixels[i];
    }
    return out;
}

std::vector<PictureChannel> StillLayers::channels() const {
    std::vector<PictureChannel> out;
    const auto add = [&](const char* layer, const Picture& picture, const char* components) {
        for (int c = 0; c < 3; ++c) {
            PictureChannel channel;
            channel.name = std::string(layer) + "." + components[c];
            channel.values.reserve(picture.pixels.size());
            for (const vec3& pixel : picture.pixels) {
                channel.values.push_back(pixel[c]);
            }
            out.push_back(std::move(channel));
        }
    };
    add("direct", direct, "RGB");
    add("diffuse", diffuse, "RGB");
    add("caustic", caustic, "RGB");
    add("specular", specular, "RGB");
    add("albedo", albedo, "RGB");
    add("normal", normal, "XYZ");
    out.push_back({"depth.Z", depth});
    return out;
}

namespace {

StillLayers from_layers(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                        const RunContext& context) {
    StillSums sums(options.width, options.height);
    const LitScene lit(scene, solution);
    const EyeTracer tracer(lit, scene.environment.sky_radiance, options.max_specular_depth, options.shares);
    const int n = std::max(options.samples_per_axis, 1);
    look_through(camera, lit.rays().origin(), sums.width(), sums.height(), n, context,
                 [&](std::size_t pixel, int s, const Ray& ray) {
                     sums.add(pixel, tracer.look(ray, std::uint32_t(hash64(pixel * 64 + std::size_t(s)))));
                 });
    return sums.mean();
}

} // namespace

StillLayers render_layers(const Scene& scene, const Solution& solution, const ViewCamera& camera,
                          const StillOptions& options, const RunContext& context, const StillWatcher& watcher) {
    return options.final_pass ? render_final(scene, solution, camera, options, context, watcher)
                              : from_layers(scene, solution, camera, options, context);
}

Picture render_still(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                     const RunContext& context) {
    return render_layers(scene, solution, camera, options, context).beauty();
}

} // namespace atrium
