#include "ui/viewport/light_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace atrium::ui {
namespace {

using Textures = std::vector<std::shared_ptr<const CausticTexture>>;

Rgb light_of(const Textures& textures, const vec2& uv) {
    Rgb sum(0.0F);
    for (const auto& texture : textures) {
        sum += texture->irradiance(uv);
    }
    return sum;
}

// ---- one value a face ----

constexpr std::array<std::array<float, 3>, 4> kPlaces{
    {{1 / 3.0F, 1 / 3.0F, 1 / 3.0F}, {0.6F, 0.2F, 0.2F}, {0.2F, 0.6F, 0.2F}, {0.2F, 0.2F, 0.6F}}};

std::shared_ptr<const SurfaceLayer> flat(const SurfaceLayer& layer) {
    const DisplayMesh& mesh = *layer.mesh;
    auto corners = std::make_shared<DisplayMesh>();
    const auto spread = [&](const auto& from, auto& to) {
        if (!from.empty()) {
            to.reserve(mesh.indices.size());
            for (const std::uint32_t i : mesh.indices) {
                to.push_back(from[i]);
            }
        }
    };
    spread(mesh.positions, corners->positions);
    spread(mesh.normals, corners->normals);
    spread(mesh.texcoords0, corners->texcoords0);
    spread(mesh.texcoords1, corners->texcoords1);
    spread(mesh.colors, corners->colors);
    corners->indices.resize(mesh.indices.size());
    for (std::uint32_t i = 0; i < corners->indices.size(); ++i) {
        corners->indices[i] = i;
    }
    SurfaceLayer out;
    out.node = layer.node;
    out.part = layer.part;
    out.mesh = std::move(corners);
    const auto side = [&](bool back, const LightShares& shares) {
        std::vector<Rgb> values;
        values.reserve(mesh.indices.size());
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            const std::array<std::uint32_t, 3> face{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
            Rgb mean(0.0F);
            for (const auto& w : kPlaces) {
                mean += irradiance_at(layer, face, {w[0], w[1], w[2]}, back, shares) / float(kPlaces.size());
            }
            values.insert(values.end(), 3, mean);
        }
        return values;
    };
    for (const bool back : {false, true}) {
        if (back && !layer.has_back()) {
            break;
        }
        (back ? out.irradiance_back : out.irradiance_front) = side(back, {true, false, false});
        (back ? out.direct_back : out.direct_front) = side(back, {false, true, false});
        (back ? out.caustic_back : out.caustic_front) = side(back, {false, false, true});
    }
    return std::make_shared<const SurfaceLayer>(std::move(out));
}

// ---- on the mesh ----

// Half the mean edge at every vertex, tiles: what of the surface around a vertex stands for it.
std::vector<float> reaches(const DisplayMesh& mesh) {
    std::vector<float> sum(mesh.light_uv.size(), 0.0F), count(mesh.light_uv.size(), 0.0F);
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.indices[t + k], b = mesh.indices[t + (k + 1) % 3];
            const float edge = glm::length(mesh.light_uv[a] - mesh.light_uv[b]);
            for (const std::uint32_t v : {a, b}) {
                sum[v] += edge;
                count[v] += 1.0F;
            }
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] = count[i] > 0.0F ? 0.5F * sum[i] / count[i] : 0.0F;
    }
    return sum;
}

std::shared_ptr<const SurfaceLayer> on_mesh(const SurfaceLayer& layer) {
    auto out = std::make_shared<SurfaceLayer>(layer);
    const DisplayMesh& mesh = *layer.mesh;
    const std::vector<float> reach = reaches(mesh);
    for (const bool back : {false, true}) {
        const Textures& textures = back ? layer.caustic_textures_back : layer.caustic_textures_front;
        if (textures.empty()) {
            continue;
        }
        std::vector<Rgb>& values = back ? out->caustic_back : out->caustic_front;
        values.resize(mesh.positions.size(), Rgb(0.0F));
        vec2 low = textures.front()->low, high = textures.front()->high;
        for (const auto& t : textures) {
            low = glm::min(low, t->low);
            high = glm::max(high, t->high);
        }
        for (std::size_t i = 0; i < mesh.light_uv.size(); ++i) {
            const vec2& uv = mesh.light_uv[i];
            const float r = reach[i];
            if (uv.x < 0.0F || uv.x + r < low.x || uv.y + r < low.y || uv.x - r > high.x || uv.y - r > high.y) {
                continue;
            }
            constexpr int kSide = 5;
            Rgb mean(0.0F);
            for (int k = 0; k < kSide * kSide; ++k) {
                const vec2 step((float(k % kSide) + 0.5F) / kSide - 0.5F, (float(k / kSide) + 0.5F) / kSide - 0.5F);
                mean += light_of(textures, uv + 2.0F * r * step) / float(kSide * kSide);
            }
            values[i] += mean;
        }
        (back ? out->caustic_textures_back : out->caustic_textures_front).clear();
    }
    return out;
}

// ---- without restriction ----

/// Texels of `factor` times the edge: means of those that they cover, whole texels or parts of them.
std::shared_ptr<const CausticTexture> coarser(const CausticTexture& t, double factor) {
    auto out = std::make_shared<CausticTexture>();
    out->low = t.low;
    out->high = t.high;
    out->width = std::max(std::uint32_t(std::lround(double(t.width) / factor)), 1U);
    out->height = std::max(std::uint32_t(std::lround(double(t.height) / factor)), 1U);
    out->image.assign(std::size_t(out->width) * out->height, Rgb(0.0F));
    const auto cover = [](std::uint32_t from, std::uint32_t to, std::uint32_t at) {
        // First and last texel under a coarse one, and how much of each.
        struct Run {
            std::uint32_t first, last;
            double begin, end;
        };
        const double begin = double(at) * from / to, end = double(at + 1) * from / to;
        return Run{std::uint32_t(begin), std::min(std::uint32_t(std::ceil(end)), from), begin, end};
    };
    for (std::uint32_t y = 0; y < out->height; ++y) {
        const auto rows = cover(t.height, out->height, y);
        for (std::uint32_t x = 0; x < out->width; ++x) {
            const auto columns = cover(t.width, out->width, x);
            dvec3 sum(0.0);
            double area = 0.0;
            for (std::uint32_t j = rows.first; j < rows.last; ++j) {
                const double h = std::min(rows.end, j + 1.0) - std::max(rows.begin, double(j));
                for (std::uint32_t i = columns.first; i < columns.last; ++i) {
                    const double w = h * (std::min(columns.end, i + 1.0) - std::max(columns.begin, double(i)));
                    sum += w * dvec3(t.image[std::size_t(j) * t.width + i]);
                    area += w;
                }
            }
            out->image[std::size_t(y) * out->width + x] = area > 0.0 ? Rgb(sum / area) : Rgb(0.0F);
        }
    }
    return out;
}

/// How much coarser the textures of every side are without restriction, in their order.
using Factors = std::map<std::tuple<NodeId, std::uint32_t, bool>, std::vector<double>>;
Factors factors_of(const Solution& solution) {
    Factors out;
    for (const CausticRecord& r : solution.caustic_records) {
        double covered = 0.0;
        for (const vec4& b : r.boxes) {
            covered += double(b.z - b.x) * double(b.w - b.y);
        }
        const double factor = covered > 0.0 ? std::max(1.0 / std::sqrt(covered), 1.0) : 1.0;
        std::vector<double>& side = out[{r.node, r.part, r.back}];
        side.insert(side.end(), r.boxes.size(), factor);
    }
    return out;
}

std::shared_ptr<const SurfaceLayer> unrestricted(const SurfaceLayer& layer, const Factors& factors) {
    auto out = std::make_shared<SurfaceLayer>(layer);
    for (const bool back : {false, true}) {
        Textures& textures = back ? out->caustic_textures_back : out->caustic_textures_front;
        const auto side = factors.find({layer.node, layer.part, back});
        for (std::size_t i = 0; i < textures.size() && side != factors.end() && i < side->second.size(); ++i) {
            textures[i] = coarser(*textures[i], side->second[i]);
        }
    }
    return out;
}

} // namespace

std::shared_ptr<const Solution> shown_as(const Solution& solution, CausticView view) {
    auto out = std::make_shared<Solution>(solution);
    const Factors factors = view == CausticView::Whole ? factors_of(solution) : Factors();
    for (auto& layer : out->surfaces) {
        const bool textured = !layer->caustic_textures_front.empty() || !layer->caustic_textures_back.empty();
        switch (view) {
        case CausticView::Flat: layer = flat(*layer); break;
        case CausticView::Mesh: layer = textured ? on_mesh(*layer) : layer; break;
        case CausticView::Whole: layer = textured ? unrestricted(*layer, factors) : layer; break;
        case CausticView::Texture: break;
        }
    }
    return out;
}

} // namespace atrium::ui
