#include "engine/layers/light_smoothing.h"

#include <algorithm>
#include <cmath>

namespace atrium {

void smooth_noise(NodeMesh& mesh, bool LightVertex::*covered, DirectSample LightVertex::*sample, StopCheck& stop) {
    constexpr int kRounds = 4;
    std::vector<Rgb> sum(mesh.vertices.size());
    std::vector<float> weight(mesh.vertices.size());
    std::vector<float> variance(mesh.vertices.size());
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t v = 0; v < mesh.vertices.size() && !stop(); ++v) {
            sum[v] = (mesh.vertices[v].*sample).irradiance;
            weight[v] = 1.0F;
            variance[v] = (mesh.vertices[v].*sample).variance;
        }
        for (const MeshTriangle& t : mesh.triangles) {
            if (stop()) {
                return;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = t.v[k], b = t.v[(k + 1) % 3];
                if (mesh.vertices[a].*covered || mesh.vertices[b].*covered) {
                    continue;
                }
                const DirectSample& x = mesh.vertices[a].*sample;
                const DirectSample& y = mesh.vertices[b].*sample;
                const float noise = x.variance + y.variance;
                const float d = luminance(x.irradiance) - luminance(y.irradiance);
                if (!(noise > 0.0F) || d * d > 6.0F * noise) {
                    continue;
                }
                // Inner edges are met twice, border edges once: half weights from each triangle.
                const float w = 0.5F * std::exp(-d * d / (2.0F * noise));
                // The noisier end learns more from the other.
                const float to_a = w * 2.0F * x.variance / noise, to_b = w * 2.0F * y.variance / noise;
                sum[a] += to_a * y.irradiance;
                sum[b] += to_b * x.irradiance;
                weight[a] += to_a;
                weight[b] += to_b;
                variance[a] += to_a * to_a * y.variance;
                variance[b] += to_b * to_b * x.variance;
            }
        }
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            DirectSample& s = mesh.vertices[v].*sample;
            s.irradiance = sum[v] / weight[v];
            s.variance = variance[v] / (weight[v] * weight[v]);
        }
    }
}

} // namespace atrium
