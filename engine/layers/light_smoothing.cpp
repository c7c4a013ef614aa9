#include "engine/layers/light_smoothing.h"

#include <algorithm>
#include <cmath>

namespace atrium {

void fill_covered(NodeMesh& mesh, bool LightVertex::*covered, DirectSample LightVertex::*sample, StopCheck& stop) {
    std::vector<std::uint32_t> open;
    std::vector<std::uint8_t> empty(mesh.vertices.size(), 0); // still to be filled
    for (std::uint32_t v = 0; v < mesh.vertices.size() && !stop(); ++v) {
        if (mesh.vertices[v].*covered) {
            open.push_back(v);
            empty[v] = 1;
        }
    }
    std::vector<Rgb> sum(open.empty() ? 0 : mesh.vertices.size());
    std::vector<float> count(sum.size());
    while (!open.empty()) {
        std::fill(sum.begin(), sum.end(), Rgb(0.0F));
        std::fill(count.begin(), count.end(), 0.0F);
        for (const MeshTriangle& t : mesh.triangles) {
            if (stop()) {
                return;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t to = t.v[k];
                for (const std::uint32_t from : {t.v[(k + 1) % 3], t.v[(k + 2) % 3]}) {
                    if (empty[to] != 0 && empty[from] == 0) {
                        sum[to] += (mesh.vertices[from].*sample).irradiance;
                        count[to] += 1.0F;
                    }
                }
            }
        }
        std::vector<std::uint32_t> left;
        for (const std::uint32_t v : open) {
            if (count[v] > 0.0F) {
                (mesh.vertices[v].*sample).irradiance = sum[v] / count[v];
                empty[v] = 0;
            } else {
                left.push_back(v);
            }
        }
        if (left.size() == open.size()) {
            break; // wholly enclosed: dark, and nobody sees it
        }
        open.swap(left);
    }
}

void smooth_noise(NodeMesh& mesh, DirectSample LightVertex::*sample, StopCheck& stop) {
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
