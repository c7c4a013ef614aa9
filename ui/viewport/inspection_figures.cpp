#include "ui/viewport/inspection_figures.h"

#include "ui/viewport/gpu_scene_parts.h"
#include "ui/viewport/legend.h"

#include <QCoreApplication>
#include <QLocale>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace atrium::ui {
namespace {

constexpr double kDecades = 2.0;            ///< between the weakest colour and the strongest
constexpr std::size_t kMostMarks = 150'000; ///< of changed texels: more would be a carpet, and slow
const FigureColor kMeshColor{20, 70, 190, 200};
const FigureColor kTexelColor{225, 60, 20, 230};
const FigureColor kVertexColor{20, 90, 220, 240};
const FigureColor kTextureColor{200, 30, 170, 110};

QString words(const char* text) { return QCoreApplication::translate("Inspection", text); }
QString number(double value, int digits) { return QLocale().toString(value, 'f', digits); }
QString number(std::size_t value) { return QLocale().toString(qulonglong(value)); }

bool is_of(const std::unordered_set<NodeId>& of, NodeId node) { return of.empty() || of.contains(node); }

QString node_name(const Scene& scene, NodeId id) {
    const Node* node = scene.nodes.find(id);
    return node != nullptr && !node->name.empty() ? QString::fromStdString(node->name)
                                                  : words(QT_TRANSLATE_NOOP("Inspection", "an object without a name"));
}

/// "0.25 m2" or "12 cm2", with a raised 2.
QString area_text(double square_metres) {
    return square_metres >= 0.01
               ? words(QT_TRANSLATE_NOOP("Inspection", "%1 m\u00b2")).arg(number(square_metres, 3))
               : words(QT_TRANSLATE_NOOP("Inspection", "%1 cm\u00b2")).arg(amount_text(1e4 * square_metres));
}

float strength(double share, double strongest) {
    return strongest > 0.0 && share > 0.0 ? float(std::clamp(1.0 + std::log10(share / strongest) / kDecades, 0.0, 1.0))
                                          : 0.0F;
}

} // namespace

Rgb strength_color(float place) {
    // Blue over violet to red: dark enough for white, saturated enough for brown and black.
    constexpr std::array<std::array<float, 3>, 4> kStops{
        {{0.20F, 0.38F, 0.92F}, {0.48F, 0.22F, 0.88F}, {0.86F, 0.12F, 0.58F}, {0.96F, 0.22F, 0.06F}}};
    const float at = std::clamp(place, 0.0F, 1.0F) * float(kStops.size() - 1);
    const std::size_t i = std::min(std::size_t(at), kStops.size() - 2);
    const float w = at - float(i);
    const auto mix = [&](std::size_t c) { return kStops[i][c] * (1.0F - w) + kStops[i + 1][c] * w; };
    return {mix(0), mix(1), mix(2)};
}

std::shared_ptr<const FigureSet> element_mesh(const ElementView& view, const std::unordered_set<NodeId>& of) {
    auto out = std::make_shared<FigureSet>();
    for (const SurfaceElements& surface : view.surfaces) {
        if (!is_of(of, surface.node)) {
            continue;
        }
        FigureGroup& group = out->groups.emplace_back();
        group.node = surface.node;
        group.part = surface.part;
        group.lines.reserve(surface.lines.size());
        for (std::size_t i = 0; i < surface.lines.size(); ++i) {
            group.lines.push_back(
                {surface.lines[i][0], surface.lines[i][1], kMeshColor, pack_normal(surface.line_normal[i]), 1.0F});
        }
    }
    return out;
}

std::size_t count_leaves(const ElementView& view, const std::unordered_set<NodeId>& of) {
    std::unordered_set<std::uint32_t> leaves;
    for (const SurfaceElements& surface : view.surfaces) {
        if (is_of(of, surface.node)) {
            leaves.insert(surface.triangle_leaf.begin(), surface.triangle_leaf.end());
        }
    }
    return leaves.size();
}

double element_amount(const LeafFigures& leaf, ElementColors colors) {
    if (colors == ElementColors::Level) {
        return double(leaf.level);
    }
    return leaf.area > 0.0F ? double(leaf.links) / double(leaf.area) : 0.0;
}

FalseColor element_scale(const ElementView& view, ElementColors colors) {
    FalseColor scale;
    if (colors == ElementColors::Level) {
        double most = 1.0;
        for (const LeafFigures& leaf : view.leaves) {
            most = std::max(most, double(leaf.level));
        }
        scale.minimum = 0.0;
        scale.maximum = most;
        return valid_scale(scale);
    }
    // By area: nine tenths of what is seen lie between the ends.
    std::vector<std::pair<double, double>> amounts;
    double area = 0.0;
    for (const LeafFigures& leaf : view.leaves) {
        if (leaf.links > 0) {
            amounts.emplace_back(element_amount(leaf, colors), leaf.area);
            area += leaf.area;
        }
    }
    std::sort(amounts.begin(), amounts.end());
    const auto at = [&](double share) {
        double sum = 0.0;
        for (const auto& [amount, of] : amounts) {
            sum += of;
            if (sum >= share * area) {
                return amount;
            }
        }
        return 1.0;
    };
    scale.logarithmic = true;
    scale.minimum = round_down(at(0.05));
    scale.maximum = round_up(at(0.95));
    return valid_scale(scale);
}

std::shared_ptr<const FigureSet> element_colors(const ElementView& view, ElementColors colors, const FalseColor& scale) {
    std::vector<FigureColor> color;
    color.reserve(view.leaves.size());
    for (const LeafFigures& leaf : view.leaves) {
        color.push_back(figure_color(false_color(scale, element_amount(leaf, colors))));
    }
    auto out = std::make_shared<FigureSet>();
    for (const SurfaceElements& surface : view.surfaces) {
        FigureGroup& group = out->groups.emplace_back();
        group.node = surface.node;
        group.part = surface.part;
        group.corners.reserve(3 * surface.triangles.size());
        for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
            for (const vec3& corner : surface.triangles[i]) {
                group.corners.push_back({corner, color[surface.triangle_leaf[i]]});
            }
        }
    }
    return out;
}

void draw_links(OverlayBatch& batch, const CameraController& camera, const ElementLinks& links, std::size_t shaft) {
    const double strongest = links.links.empty() ? 0.0 : links.links.front().share;
    const dvec3& from = links.receiver.centre;
    const vec4 dark(0.0F, 0.0F, 0.0F, 0.35F);
    for (std::size_t i = links.links.size(); i-- > 0;) { // the strongest last, on top
        const ElementLink& link = links.links[i];
        const float place = strength(link.share, strongest);
        const Rgb color = strength_color(place);
        batch.line3(camera, from, link.end.centre, 0.8 + 1.2 * double(place), vec4(color, 0.25F + 0.6F * place));
    }
    const auto outline = [&](const LinkEnd& end, const vec4& color, double width) {
        for (const auto& line : end.outline) {
            batch.line3(camera, line[0], line[1], width + 2.0, dark);
        }
        for (const auto& line : end.outline) {
            batch.line3(camera, line[0], line[1], width, color);
        }
    };
    if (shaft < links.links.size()) {
        const LinkEnd& end = links.links[shaft].end;
        const vec4 color(1.0F, 0.85F, 0.2F, 1.0F);
        outline(end, color, 1.5);
        // Corners are joined in the order that makes the four edges shortest: a shaft that is not twisted.
        std::size_t best_start = 0;
        bool best_reversed = false;
        double shortest = std::numeric_limits<double>::infinity();
        const auto corner = [&](std::size_t k, std::size_t start, bool reversed) -> const dvec3& {
            return end.corners[reversed ? (start + 4 - k) % 4 : (start + k) % 4];
        };
        if (end.corners.size() == 4 && links.receiver.corners.size() == 4) {
            for (std::size_t start = 0; start < 4; ++start) {
                for (const bool reversed : {false, true}) {
                    double sum = 0.0;
                    for (std::size_t k = 0; k < 4; ++k) {
                        const dvec3 d = corner(k, start, reversed) - links.receiver.corners[k];
                        sum += glm::dot(d, d);
                    }
                    if (sum < shortest) {
                        shortest = sum;
                        best_start = start;
                        best_reversed = reversed;
                    }
                }
            }
            for (const bool casing : {true, false}) {
                for (std::size_t k = 0; k < 4; ++k) {
                    batch.line3(camera, links.receiver.corners[k], corner(k, best_start, best_reversed), casing ? 3.0 : 1.3,
                                casing ? dark : color);
                }
            }
        }
    }
    outline(links.receiver, vec4(1.0F, 1.0F, 1.0F, 1.0F), 2.0);
}

QStringList link_words(const Scene& scene, const ElementLinks& links, std::size_t shaft) {
    const LinkEnd& end = links.receiver;
    const double all = links.over_links + links.direct + links.caustic;
    QStringList out;
    out << (end.figures.faces ? words(QT_TRANSLATE_NOOP("Inspection", "Element of %1: small faces, %2"))
                                    .arg(node_name(scene, end.node), area_text(double(end.figures.area)))
                              : words(QT_TRANSLATE_NOOP("Inspection", "Element of %1: level %2, %3"))
                                    .arg(node_name(scene, end.node))
                                    .arg(end.figures.level)
                                    .arg(area_text(double(end.figures.area))));
    out << words(QT_TRANSLATE_NOOP("Inspection", "%1 links bring %2 lx of %3 lx (%4 %)"))
               .arg(number(links.links.size()), amount_text(links.over_links), amount_text(all),
                    number(all > 0.0 ? 100.0 * links.over_links / all : 0.0, 1));
    out << words(QT_TRANSLATE_NOOP("Inspection", "Straight from lamps, sun and sky %1 lx, over mirrors and glass %2 lx"))
               .arg(amount_text(links.direct), amount_text(links.caustic));
    if (shaft < links.links.size()) {
        const ElementLink& link = links.links[shaft];
        const QString text = shaft == 0
                                 ? words(QT_TRANSLATE_NOOP("Inspection", "Strongest link: %1, %2 lx (%3 % of all links)"))
                                 : words(QT_TRANSLATE_NOOP("Inspection", "Link under the cursor: %1, %2 lx (%3 %)"));
        out << text.arg(node_name(scene, link.end.node), amount_text(link.brings), number(100.0 * link.share, 2));
    }
    return out;
}

ErrorFigures error_colors(const Scene& scene, const Solution& solution, const LocalError& error) {
    struct Side {
        const SurfaceLayer* layer;
        bool back;
        std::vector<double> percent; ///< at the vertices
    };
    std::vector<Side> sides;
    std::vector<double> all;
    for (const auto& layer : solution.surfaces) {
        const Node* node = scene.nodes.find(layer->node);
        const Material* of_node = node != nullptr ? scene.material_of(*node, layer->part) : nullptr;
        const bool matt = classify(of_node != nullptr ? *of_node : default_material()) == MaterialKind::Diffuse;
        const DisplayMesh& mesh = *layer->mesh;
        if (node == nullptr || !matt || layer->irradiance_front.size() < mesh.positions.size()) {
            continue;
        }
        const dmat4 world = scene.world_matrix(layer->node);
        const dmat3 turn = glm::transpose(glm::inverse(dmat3(world)));
        for (const bool back : {false, true}) {
            if (back && !layer->has_back()) {
                continue;
            }
            Side& side = sides.emplace_back(Side{layer.get(), back, {}});
            // Of the triangles around a vertex one will do: light at a corner is that of the surface, wherever it is read.
            std::vector<std::size_t> of(mesh.positions.size(), SIZE_MAX);
            for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
                for (std::size_t k = 0; k < 3; ++k) {
                    of[mesh.indices[t + k]] = t + k;
                }
            }
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                double light = 0.0;
                if (of[i] != SIZE_MAX) {
                    const std::size_t t = of[i] - of[i] % 3;
                    vec3 weight(0.02F);
                    weight[int(of[i] % 3)] = 0.96F;
                    light = double(luminance(
                        irradiance_at(*layer, {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]}, weight, back)));
                }
                const dvec3 normal = glm::normalize(turn * dvec3(mesh.normals[i])) * (back ? -1.0 : 1.0);
                side.percent.push_back(100.0 * error.at(dvec3(world * dvec4(dvec3(mesh.positions[i]), 1.0)), normal, light));
                all.push_back(side.percent.back());
            }
        }
    }
    ErrorFigures out;
    out.places = error.size();
    out.overall = 100.0 * error.overall();
    out.scale.minimum = 0.0;
    out.scale.maximum = 1.0;
    if (!all.empty()) {
        const auto high = all.begin() + std::ptrdiff_t(0.98 * double(all.size() - 1));
        std::nth_element(all.begin(), high, all.end());
        out.scale.maximum = round_up(std::max(*high, 0.1));
        const auto low = all.begin() + std::ptrdiff_t(0.02 * double(all.size() - 1));
        std::nth_element(all.begin(), low, all.end());
        // From the open floor to the edge of a shadow it is often a factor of a hundred.
        out.scale.logarithmic = out.scale.maximum > 5.0 * *low;
        out.scale.minimum = out.scale.logarithmic ? round_down(std::max(*low, 1e-3 * out.scale.maximum)) : 0.0;
    }
    out.scale = valid_scale(out.scale);
    auto set = std::make_shared<FigureSet>();
    for (const Side& side : sides) {
        const DisplayMesh& mesh = *side.layer->mesh;
        FigureGroup& group = set->groups.emplace_back();
        group.node = side.layer->node;
        group.part = side.layer->part;
        const bool turned = side.back != (glm::determinant(dmat3(scene.world_matrix(group.node))) < 0.0);
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            for (const std::size_t k : {std::size_t(0), std::size_t(turned ? 2 : 1), std::size_t(turned ? 1 : 2)}) {
                const std::uint32_t v = mesh.indices[t + k];
                group.corners.push_back({mesh.positions[v], figure_color(false_color(out.scale, side.percent[v]))});
            }
        }
    }
    out.set = std::move(set);
    return out;
}

std::shared_ptr<const FigureSet> particle_ways(const ParticleView& view) {
    auto out = std::make_shared<FigureSet>();
    if (view.ways.empty()) {
        return out;
    }
    std::vector<double> powers;
    for (const ParticlePolyline& way : view.ways) {
        powers.push_back(double(luminance(way.power)));
    }
    const double strongest = *std::max_element(powers.begin(), powers.end());
    const double weakest = std::max(*std::min_element(powers.begin(), powers.end()), strongest * std::pow(10.0, -kDecades));
    const auto place = [&](double power) {
        return strongest > 1.001 * weakest
                   ? float(std::log(std::max(power, weakest) / weakest) / std::log(strongest / weakest))
                   : 0.5F;
    };
    FigureGroup& group = out->groups.emplace_back();
    group.origin = view.ways.front().points.empty() ? dvec3(0.0) : view.ways.front().points.back();
    for (std::size_t i = 0; i < view.ways.size(); ++i) {
        const auto& points = view.ways[i].points;
        const FigureColor color = figure_color(strength_color(place(powers[i])), 0.35F);
        for (std::size_t k = 1; k < points.size(); ++k) {
            group.lines.push_back({vec3(points[k - 1] - group.origin), vec3(points[k] - group.origin), color, 0, 1.0F});
        }
        if (!points.empty()) { // where it landed
            const vec3 end(points.back() - group.origin);
            FigureColor mark = color;
            mark.a = 230;
            group.lines.push_back({end, end, mark, 0, 3.0F});
        }
    }
    return out;
}

QStringList particle_words(const ParticleView& view, bool of_selection) {
    QStringList out;
    if (view.ways.empty()) {
        out << (view.particles == 0
                    ? words(QT_TRANSLATE_NOOP("Inspection",
                                              "No particles: no light that stands out goes over a mirror or glass"))
                    : words(QT_TRANSLATE_NOOP("Inspection", "No particles landed on the selection or went over it")));
        return out;
    }
    out << (of_selection ? words(QT_TRANSLATE_NOOP("Inspection", "Ways of %1 particles of the selection, of %2 in all"))
                         : words(QT_TRANSLATE_NOOP("Inspection", "Ways of %1 particles, of %2 in all")))
               .arg(number(view.ways.size()), number(std::size_t(view.particles)));
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const ParticlePolyline& way : view.ways) {
        low = std::min(low, double(luminance(way.power)));
        high = std::max(high, double(luminance(way.power)));
    }
    out << words(QT_TRANSLATE_NOOP("Inspection", "Blue to red: %1 to %2 lm each"))
               .arg(amount_text(std::max(low, high * std::pow(10.0, -kDecades))), amount_text(high));
    out << (view.passage_cells > 0
                ? words(QT_TRANSLATE_NOOP("Inspection", "Passage octree: %1 cells")).arg(number(view.passage_cells))
                : words(QT_TRANSLATE_NOOP("Inspection", "Passage octree: none, touched particles are found by a scan")));
    return out;
}

std::shared_ptr<const FigureSet> octree_cells(const OctreeView& view) {
    auto out = std::make_shared<FigureSet>();
    if (view.cells.empty()) {
        return out;
    }
    std::size_t most = 1;
    for (const OctreeCell& cell : view.cells) {
        most = std::max(most, cell.particles);
    }
    FigureGroup& group = out->groups.emplace_back();
    group.origin = view.cells.front().box.min;
    for (const OctreeCell& cell : view.cells) {
        // By the logarithm: cells differ by orders of magnitude. What nothing crosses is pale.
        const float place = float(std::log1p(double(cell.particles)) / std::log1p(double(most)));
        const FigureColor color = figure_color(strength_color(place), cell.particles > 0 ? 0.8F : 0.3F);
        const auto corner = [&](unsigned k) {
            const dvec3 p((k & 1U) != 0 ? cell.box.max.x : cell.box.min.x, (k & 2U) != 0 ? cell.box.max.y : cell.box.min.y,
                          (k & 4U) != 0 ? cell.box.max.z : cell.box.min.z);
            return vec3(p - group.origin);
        };
        for (unsigned k = 0; k < 8; ++k) {
            for (const unsigned axis : {1U, 2U, 4U}) {
                if ((k & axis) == 0) {
                    group.lines.push_back({corner(k), corner(k | axis), color, 0, 1.0F});
                }
            }
        }
    }
    return out;
}

QStringList octree_words(const OctreeView& view, bool of_selection) {
    QStringList out;
    if (view.particles == 0) {
        out << words(QT_TRANSLATE_NOOP("Inspection", "No particles: no light that stands out goes over a mirror or glass"));
    } else if (!of_selection) {
        out << words(QT_TRANSLATE_NOOP("Inspection", "Select an object to see the octree around it"));
    } else if (view.cells.empty()) {
        out << words(QT_TRANSLATE_NOOP("Inspection", "Octree: the selection has no surfaces in the light"));
    } else {
        out << words(QT_TRANSLATE_NOOP("Inspection", "Octree: %1 cells around the selection, blue to red by particles"))
                   .arg(number(view.cells.size()));
        out << words(QT_TRANSLATE_NOOP("Inspection", "%1 of %2 particles cross its bounds and would be sent anew by a move"))
                   .arg(number(view.touched), number(view.particles));
    }
    return out;
}

std::shared_ptr<const FigureSet> update_marks(const UpdateView& view) {
    const std::size_t stride = view.texels / kMostMarks + 1;
    auto out = std::make_shared<FigureSet>();
    for (const ChangedSurface& surface : view.surfaces) {
        FigureGroup& group = out->groups.emplace_back();
        group.node = surface.node;
        group.part = surface.part;
        for (std::size_t i = 0; i < surface.textures.size(); ++i) {
            const auto& t = surface.textures[i];
            const bool back = surface.texture_back[i] != 0;
            for (const std::size_t k : {std::size_t(0), std::size_t(back ? 2 : 1), std::size_t(back ? 1 : 2)}) {
                group.corners.push_back({t[k], kTextureColor});
            }
        }
        for (std::size_t i = 0; i < surface.texels.size(); i += stride) {
            group.lines.push_back(
                {surface.texels[i], surface.texels[i], kTexelColor, pack_normal(surface.texel_normals[i]), 1.5F});
        }
        for (const vec3& p : surface.vertices) {
            group.lines.push_back({p, p, kVertexColor, 0, 3.0F});
        }
    }
    return out;
}

QStringList update_words(const UpdateView& view, double milliseconds) {
    QStringList out;
    out << words(QT_TRANSLATE_NOOP("Inspection", "Last update, %1 ms, changed:")).arg(number(milliseconds, 0));
    out << words(QT_TRANSLATE_NOOP("Inspection", "%1 of %2 texels (red)")).arg(number(view.texels), number(view.all_texels));
    out << words(QT_TRANSLATE_NOOP("Inspection", "%1 of %2 vertices (blue)"))
               .arg(number(view.vertices), number(view.all_vertices));
    if (view.all_textures > 0) {
        out << words(QT_TRANSLATE_NOOP("Inspection", "%1 of %2 caustic textures (pink)"))
                   .arg(number(view.textures), number(view.all_textures));
    }
    return out;
}

} // namespace atrium::ui
