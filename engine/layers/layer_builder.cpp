#include "engine/layers/layer_builder.h"

#include "engine/base/parallel.h"
#include "engine/layers/cover_border.h"
#include "engine/layers/covered_points.h"
#include "engine/layers/light_smoothing.h"
#include "engine/layers/node_mesh.h"
#include "engine/layers/point_table.h"
#include "engine/optics/specular.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace atrium {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
constexpr float kShortest = 0.5F; // of the smallest edge: shorter edges are not split however much light changes on them
// Of the smallest edge: how far a sample is moved off its vertex towards the triangles' inside, and how far where something
// lies on the surface there.
constexpr float kPullIn = 0.25F;
constexpr float kPullInClose = 0.02F;

class LayerBuild {
public:
    LayerBuild(const RayScene& rays, const LightField& field, const LightMaps& maps, const LayerSettings& settings,
               const std::function<bool(std::uint32_t)>& back_lit, const RunContext& context)
        : rays_(rays), field_(field), maps_(maps), settings_(settings), back_lit_(back_lit), context_(context),
          stop_(context, kMeshStride) {}

    LayerSet run(double from, double to) {
        collect();
        for (NodeMesh& mesh : meshes_) {
            split_long_edges(mesh);
        }
        if (context_.should_stop()) {
            return {};
        }
        std::vector<Request> all;
        for (std::size_t m = 0; m < meshes_.size(); ++m) {
            for (std::uint32_t v = 0; v < meshes_[m].vertices.size(); ++v) {
                all.push_back({&meshes_[m].vertices[v]});
            }
        }
        const double half = settings_.look_between ? from + 0.5 * (to - from) : to;
        bool complete = sample(all, from, half);
        borders_.resize(meshes_.size());
        if (settings_.look_between) {
            complete = complete && look_between(half, to);
        }
        if (!complete || context_.should_stop()) {
            return {};
        }
        LayerSet out = finish();
        if (context_.should_stop()) {
            return {};
        }
        out.limited = added_ >= settings_.max_vertices;
        out.complete = true;
        return out;
    }

private:
    struct Request {
        LightVertex* vertex;
    };

    // More vertices where the light between those of the file is not what they say. False when stopped.
    bool look_between(double from, double to) {
        bool complete = true;
        for (int level = 0; complete && level < 6 && added_ < settings_.max_vertices; ++level) {
            const double step = (to - from) / 6.0;
            if (!split_by_contrast(from + step * level, from + step * (level + 1), complete)) {
                break;
            }
        }
        complete = complete && find_all_borders();
        if (complete && field_.prepare) {
            sample_reflected_anew();
        }
        if (complete) {
            sample_borders();
        }
        return complete;
    }

    void collect() {
        std::map<NodeId, std::size_t> mesh_of;
        const auto& surfaces = rays_.surfaces();
        const auto last = std::min(std::uint32_t(surfaces.size()), settings_.last_surface);
        for (std::uint32_t s = settings_.first_surface; s < last; ++s) {
            const auto [it, fresh] = mesh_of.try_emplace(surfaces[s].node, meshes_.size());
            if (fresh) {
                meshes_.emplace_back();
            }
            meshes_[it->second].surfaces.push_back(s);
        }
        for (NodeMesh& mesh : meshes_) {
            std::size_t corners = 0;
            for (const std::uint32_t s : mesh.surfaces) {
                corners += std::min(rays_.surfaces()[s].mesh->positions.size(), 3 * rays_.surfaces()[s].triangles.size());
            }
            PointTable weld(corners);
            mesh.vertices.reserve(corners); // moving millions of them takes longer than a stop may
            for (const std::uint32_t s : mesh.surfaces) {
                add_surface(mesh, s, weld);
            }
            mesh.welds = std::uint32_t(weld.size());
        }
    }

    void add_surface(NodeMesh& mesh, std::uint32_t s, PointTable& weld) {
        const RaySurface& surface = rays_.surfaces()[s];
        const MeshData& data = *surface.mesh;
        const bool back = surface.back_side && back_lit_(s);
        const bool unlit = shows_no_irradiance(rays_.material(s));
        // Flat-shaded files: triangles of one plane share their vertices all the same, so each is lit once.
        CopyTable copied(std::min(data.positions.size(), 3 * surface.triangles.size()));
        const auto first_vertex = std::uint32_t(mesh.vertices.size()); // copies are numbered from there
        const auto copy_key = [&](std::uint32_t v, const vec3& face_normal, std::uint32_t chart) -> CopyKey {
            if (!data.normals.empty()) {
                return {v, 0, 0, 0, chart};
            }
            const ivec3 q(glm::round(face_normal * 2000.0F));
            return {v, std::uint32_t(q.x), std::uint32_t(q.y), std::uint32_t(q.z), chart};
        };
        const SurfaceCharts* charts = maps_.charts.empty() || maps_.charts[s].empty() ? nullptr : &maps_.charts[s];
        for (std::size_t index = 0; index < surface.triangles.size() && !stop_(); ++index) {
            const uvec3& t = surface.triangles[index];
            const std::uint32_t chart = charts != nullptr ? charts->chart_of_triangle[index] : SurfaceCharts::kNone;
            const auto& p = *surface.positions;
            const vec3 face_normal = glm::normalize(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
            MeshTriangle out;
            out.surface = s;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t v = t[k];
                const auto [copy, fresh] = copied.insert(copy_key(v, face_normal, chart));
                out.v[std::size_t(k)] = first_vertex + copy;
                if (!fresh) {
                    continue;
                }
                LightVertex vertex;
                vertex.local = data.positions[v];
                vertex.position = p[v];
                vertex.wants_back = back;
                vertex.unlit = unlit;
                if (chart != SurfaceCharts::kNone) {
                    vertex.light_uv = charts->uv[index][std::size_t(k)];
                }
                if (data.normals.empty()) {
                    vertex.normal = face_normal;
                    const dvec3 local = glm::transpose(dmat3(surface.to_engine)) * dvec3(face_normal);
                    // A scale of zero in one axis leaves faces that the way back makes nothing of.
                    const double length = glm::length(local);
                    vertex.local_normal = length > 0.0 ? vec3(local / length) : face_normal;
                } else {
                    vertex.local_normal = data.normals[v];
                    const dvec3 n = surface.normal_matrix * dvec3(data.normals[v]);
                    const double length = glm::length(n);
                    vertex.normal = length > 0.0 ? vec3(n / length) : face_normal;
                    // Files with normals on the wrong side are drawn and lit by the side that the winding says.
                    if (glm::dot(vertex.normal, face_normal) < 0.0F) {
                        vertex.normal = -vertex.normal;
                    }
                }
                vertex.uv0 = data.texcoords0.empty() ? vec2(0.0F) : data.texcoords0[v];
                vertex.uv1 = data.texcoords1.empty() ? vec2(0.0F) : data.texcoords1[v];
                vertex.color = data.colors.empty() ? vec3(1.0F) : data.colors[v];
                vertex.weld = weld.insert(vertex.local + vec3(0.0F)).first; // -0 becomes 0
                mesh.vertices.push_back(vertex);
            }
            add_triangle(mesh, out);
        }
    }

    void split_long_edges(NodeMesh& mesh) {
        for (int level = 0; level < 16 && added_ < settings_.max_vertices; ++level) {
            SplitSet split;
            for (const MeshTriangle& t : mesh.triangles) {
                if (stop_()) {
                    return;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t a = t.v[k], b = t.v[(k + 1) % 3];
                    if (edge_length(mesh, a, b) > settings_.base_edge) {
                        const auto [it, fresh] =
                            split.try_emplace(edge_key(mesh.vertices[a].weld, mesh.vertices[b].weld), mesh.welds);
                        mesh.welds += fresh ? 1 : 0;
                    }
                }
            }
            if (split.empty()) {
                break;
            }
            close_split(mesh, split, stop_);
            Middles middles;
            added_ += cut(mesh, split, middles, stop_);
        }
        for (MeshTriangle& t : mesh.triangles) {
            t.open = true;
        }
    }

    // Finds what is covered and tells the field of the points that are not.
    bool prepare(const std::vector<Request>& requests) const {
        parallel_chunks(requests.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context_.should_stop(); ++i) {
                LightVertex& v = *requests[i].vertex;
                if (v.unlit) {
                    continue;
                }
                find_cover(v);
            }
        });
        if (!field_.prepare || context_.should_stop()) {
            return !context_.should_stop();
        }
        std::vector<SurfacePoint> points;
        points.reserve(requests.size());
        for (const Request& r : requests) {
            const LightVertex& v = *r.vertex;
            if (v.unlit) {
                continue;
            }
            if (!v.front_covered) {
                points.push_back({sample_position(v, v.normal), v.normal});
            }
            if (v.wants_back && !v.back_covered) {
                points.push_back({sample_position(v, -v.normal), -v.normal});
            }
        }
        return field_.prepare(points);
    }

    // What is open may be narrower than samples are moved: what is covered there may be open close to the vertex.
    void find_cover(LightVertex& v) const {
        const auto covered = [&](const vec3& n) {
            return is_out_of_sight(rays_, sample_position(v, n), n, settings_.cover_reach);
        };
        v.front_covered = covered(v.normal);
        v.back_covered = v.wants_back && covered(-v.normal);
        if (v.front_covered || v.back_covered) {
            v.close = true;
            const bool front = covered(v.normal), back = v.wants_back && covered(-v.normal);
            // Neither side may lose by it.
            v.close =
                front <= v.front_covered && back <= v.back_covered && (front != v.front_covered || back != v.back_covered);
            v.front_covered = v.close ? front : v.front_covered;
            v.back_covered = v.close ? back : v.back_covered;
        }
    }

    // The field may have got finer since a vertex was sampled.
    void sample_reflected_anew() {
        for (NodeMesh& mesh : meshes_) {
            parallel_chunks(mesh.vertices.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t i = begin; i < end && !context_.should_stop(); ++i) {
                    LightVertex& v = mesh.vertices[i];
                    if (v.unlit) {
                        continue;
                    }
                    if (!v.front_covered) {
                        v.front = field_.reflected(sample_position(v, v.normal), v.normal);
                    }
                    if (v.wants_back && !v.back_covered) {
                        v.back = field_.reflected(sample_position(v, -v.normal), -v.normal);
                    }
                }
            });
        }
    }

    // Where something rests on a surface, edges that run under it are followed to its border; the field is told of that.
    bool find_all_borders() {
        std::vector<SurfacePoint> points;
        const auto place = [&](const LightVertex& v, const vec3& n) { return sample_position(v, n); };
        const auto covered_at = [&](const vec3& p, const vec3& n) {
            return is_out_of_sight(rays_, p, n, settings_.cover_reach);
        };
        for (std::size_t m = 0; m < meshes_.size(); ++m) {
            for (const bool back : {false, true}) {
                borders_[m][back ? 1 : 0] = find_borders(meshes_[m], {back}, place, covered_at, context_);
                for (const BorderEdge& e : borders_[m][back ? 1 : 0]) {
                    points.push_back({e.position, e.normal});
                }
            }
        }
        return !context_.should_stop() && (!field_.prepare || field_.prepare(points));
    }

    void sample_borders() {
        for (std::size_t m = 0; m < meshes_.size(); ++m) {
            for (std::vector<BorderEdge>& borders : borders_[m]) {
                parallel_chunks(borders.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
                    for (std::size_t i = begin; i < end && !context_.should_stop(); ++i) {
                        BorderEdge& e = borders[i];
                        e.reflected = field_.reflected(e.position, e.normal);
                        if (!meshes_[m].vertices[e.open].charted()) {
                            e.direct = field_.direct(e.position, e.normal);
                        }
                    }
                });
            }
        }
    }

    bool sample(const std::vector<Request>& requests, double from, double to) {
        if (!prepare(requests)) {
            return false;
        }
        // In slices, so that progress can be told between parallel loops.
        const std::size_t slice = std::max<std::size_t>(requests.size() / 20 + 1, 256);
        for (std::size_t start = 0; start < requests.size(); start += slice) {
            if (context_.should_stop()) {
                return false;
            }
            const std::size_t end = std::min(start + slice, requests.size());
            parallel_chunks(end - start, 32, [&](std::size_t b, std::size_t e, std::size_t) {
                if (context_.should_stop()) {
                    return;
                }
                for (std::size_t i = start + b; i < start + e; ++i) {
                    sample_vertex(*requests[i].vertex);
                }
            });
            context_.progress("layers", from + (to - from) * double(end) / double(requests.size()));
        }
        return !context_.should_stop();
    }

    // Where the light of a vertex is sampled: moved a little into its triangles, so that walls meeting there do not hide it,
    // but never behind the side's own surface (on a ball the triangles' middles lie below the vertex).
    // What shines through the crack of a door is seen at its edge only: samples stand for as much as the mesh resolves.
    [[nodiscard]] vec3 sample_position(const LightVertex& v, const vec3& n) const {
        vec3 inwards = v.triangles > 0.0F ? v.towards / v.triangles : vec3(0.0F);
        inwards -= n * std::min(glm::dot(inwards, n), 0.0F);
        const float length = glm::length(inwards);
        const float pull = (v.close ? kPullInClose : kPullIn) * settings_.smallest_edge;
        return length > 0.0F ? v.position + inwards * std::min(0.35F, pull / length) : v.position;
    }

    void sample_vertex(LightVertex& v) const {
        sample_side(v, v.normal, v.front, v.front_direct, v.front_covered);
        if (v.wants_back) {
            sample_side(v, -v.normal, v.back, v.back_direct, v.back_covered);
        }
    }

    void sample_side(const LightVertex& v, const vec3& n, DirectSample& reflected, DirectSample& direct, bool hidden) const {
        if (hidden || v.unlit) {
            return;
        }
        const vec3 p = sample_position(v, n);
        reflected = field_.reflected(p, n);
        if (!v.charted()) {
            direct = field_.direct(p, n);
        }
    }

    /// Light of a side that vertices interpolate: what decides where more of them are needed.
    static DirectSample shown(const DirectSample& reflected, const DirectSample& direct) {
        return {reflected.irradiance + direct.irradiance, reflected.variance + direct.variance};
    }
    static DirectSample front(const LightVertex& v) { return shown(v.front, v.front_direct); }
    static DirectSample back(const LightVertex& v) { return shown(v.back, v.back_direct); }

    static float deviation(const DirectSample& a, const DirectSample& m, const DirectSample& b, float floor) {
        const float la = luminance(a.irradiance), lm = luminance(m.irradiance), lb = luminance(b.irradiance);
        const float mean = 0.5F * (la + lb);
        const float difference = std::max(std::abs(lm - mean), 0.2F * std::abs(la - lb));
        // A difference that the samples' own noise explains is no reason to look closer: it would be noise again.
        const float noise = std::sqrt(m.variance + 0.25F * (a.variance + b.variance));
        return difference > 1.5F * noise ? difference / std::max({mean, lm, floor}) : 0.0F;
    }

    /// Deviation that asks for a split of an edge: short ones have little area to err on, and what counts is the squared
    /// error times the area.
    [[nodiscard]] float wanted(float length) const {
        return settings_.contrast * std::max(2.0F * settings_.smallest_edge / length, 1.0F);
    }
    [[nodiscard]] bool alike(const LightVertex& a, const LightVertex& b, float contrast) const {
        const auto close = [&](const DirectSample& p, const DirectSample& q) {
            const float x = luminance(p.irradiance), y = luminance(q.irradiance);
            return std::abs(x - y) <= contrast * std::max({x, y, settings_.light_floor});
        };
        return a.front_covered == b.front_covered && close(front(a), front(b)) && (!a.wants_back || close(back(a), back(b)));
    }

    // One level: samples the midpoints of all open edges, splits those that deviate. False when nothing was split.
    bool split_by_contrast(double from, double to, bool& complete) {
        struct Candidate {
            std::size_t mesh;
            std::uint32_t a, b; // vertex pair
            LightVertex middle;
        };
        std::vector<Candidate> candidates;
        for (std::size_t m = 0; m < meshes_.size(); ++m) {
            NodeMesh& mesh = meshes_[m];
            std::unordered_map<std::uint64_t, std::size_t, EdgeHash> seen;
            for (const MeshTriangle& t : mesh.triangles) {
                if (stop_()) {
                    complete = false;
                    return false;
                }
                if (!t.open) {
                    continue;
                }
                const vec3 centroid =
                    (mesh.vertices[t.v[0]].position + mesh.vertices[t.v[1]].position + mesh.vertices[t.v[2]].position) /
                    3.0F;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t a = std::min(t.v[k], t.v[(k + 1) % 3]), b = std::max(t.v[k], t.v[(k + 1) % 3]);
                    const float length = edge_length(mesh, a, b);
                    if (length <= kShortest * settings_.smallest_edge) {
                        continue;
                    }
                    // Short edges are looked at only where their ends already differ: fine meshes have far more edges than
                    // light has detail, and a look takes records of its own.
                    const bool is_short = length <= std::max(0.25F * settings_.base_edge, 2.0F * settings_.smallest_edge);
                    if (is_short && alike(mesh.vertices[a], mesh.vertices[b], wanted(length))) {
                        continue;
                    }
                    const auto [it, fresh] = seen.try_emplace(edge_key(a, b), candidates.size());
                    if (fresh) {
                        candidates.push_back({m, a, b, midpoint(mesh.vertices[a], mesh.vertices[b])});
                    }
                    LightVertex& middle = candidates[it->second].middle;
                    middle.towards += centroid - middle.position;
                    middle.triangles += 1.0F;
                }
            }
        }
        std::vector<Request> requests;
        requests.reserve(candidates.size());
        for (Candidate& c : candidates) {
            requests.push_back({&c.middle});
        }
        complete = sample(requests, from, to);
        if (!complete) {
            return false;
        }
        std::vector<std::pair<float, std::size_t>> strong;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const Candidate& c = candidates[i];
            const LightVertex& a = meshes_[c.mesh].vertices[c.a];
            const LightVertex& b = meshes_[c.mesh].vertices[c.b];
            // Between covered points there is nothing to see; the border itself is the object's and needs no finer mesh.
            const float contrast = wanted(edge_length(meshes_[c.mesh], c.a, c.b));
            float d = 0.0F;
            if (int(a.front_covered) + int(b.front_covered) + int(c.middle.front_covered) == 0) {
                d = deviation(front(a), front(c.middle), front(b), settings_.light_floor);
            } else if (a.front_covered != b.front_covered) {
                d = 2.0F * settings_.contrast; // look where the cover ends
            }
            if (a.wants_back && int(a.back_covered) + int(b.back_covered) + int(c.middle.back_covered) == 0) {
                d = std::max(d, deviation(back(a), back(c.middle), back(b), settings_.light_floor));
            }
            if (d > contrast) {
                strong.emplace_back(d / contrast, i);
            }
        }
        if (strong.empty()) {
            return false;
        }
        std::stable_sort(strong.begin(), strong.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
        strong.resize(std::min(strong.size(), settings_.max_vertices - std::min(settings_.max_vertices, added_)));
        std::vector<SplitSet> split(meshes_.size());
        std::vector<Middles> middles(meshes_.size());
        for (const auto& [d, i] : strong) {
            const Candidate& c = candidates[i];
            NodeMesh& mesh = meshes_[c.mesh];
            const auto [it, fresh] =
                split[c.mesh].try_emplace(edge_key(mesh.vertices[c.a].weld, mesh.vertices[c.b].weld), mesh.welds);
            mesh.welds += fresh ? 1 : 0;
        }
        for (std::size_t m = 0; m < meshes_.size(); ++m) {
            close_split(meshes_[m], split[m], stop_);
        }
        // Sampled midpoints of every split edge are kept, also those of a coincident edge that asked for nothing itself.
        for (const Candidate& c : candidates) {
            NodeMesh& mesh = meshes_[c.mesh];
            if (split[c.mesh].contains(edge_key(mesh.vertices[c.a].weld, mesh.vertices[c.b].weld))) {
                middles[c.mesh][edge_key(c.a, c.b)] = std::uint32_t(mesh.vertices.size());
                mesh.vertices.push_back(c.middle);
                ++added_;
            }
        }
        std::vector<Request> missing;
        for (std::size_t m = 0; m < meshes_.size(); ++m) {
            if (split[m].empty()) {
                for (MeshTriangle& t : meshes_[m].triangles) {
                    t.open = false;
                }
                continue;
            }
            NodeMesh& mesh = meshes_[m];
            const std::size_t before = mesh.vertices.size();
            added_ += cut(mesh, split[m], middles[m], stop_);
            for (std::size_t v = before; v < mesh.vertices.size(); ++v) {
                missing.push_back({&mesh.vertices[v]});
            }
        }
        complete = sample(missing, to, to);
        return complete;
    }

    LayerSet finish() {
        LayerSet out;
        double error = 0.0, area_sum = 0.0, log_sum = 0.0, log_area = 0.0;
        out.surfaces.resize(rays_.surfaces().size());
        out.places.resize(settings_.keep_places ? out.surfaces.size() : 0);
        for (NodeMesh& mesh : meshes_) {
            smooth_and_fill(mesh);
            if (context_.should_stop()) {
                return {};
            }
            std::map<std::uint32_t, std::vector<const MeshTriangle*>> by_surface;
            for (const MeshTriangle& t : mesh.triangles) {
                by_surface[t.surface].push_back(&t);
            }
            std::vector<std::uint32_t> index(mesh.vertices.size(), kNone); // in the display mesh
            for (const auto& [s, triangles] : by_surface) {
                const RaySurface& surface = rays_.surfaces()[s];
                const MeshData& data = *surface.mesh;
                auto layer = std::make_shared<SurfaceLayer>();
                auto display = std::make_shared<DisplayMesh>();
                layer->node = surface.node;
                layer->part = surface.part;
                const auto map_of = [s = s](const auto& maps) { return maps.empty() ? nullptr : maps[s]; };
                const bool charted = !maps_.charts.empty() && !maps_.charts[s].empty();
                if (charted) {
                    layer->direct_map_front = map_of(maps_.front);
                    layer->direct_map_back = map_of(maps_.back);
                }
                const Rgb rho = diffuse_reflectance(rays_.material(s));
                for (const MeshTriangle* t : triangles) {
                    if (stop_()) {
                        return {};
                    }
                    const auto& v = mesh.vertices;
                    const float area = 0.5F * glm::length(glm::cross(v[t->v[1]].position - v[t->v[0]].position,
                                                                     v[t->v[2]].position - v[t->v[0]].position));
                    for (std::size_t k = 0; k < 3; ++k) {
                        // Mirrored nodes were turned round for the rays; the display mesh keeps the file's winding.
                        const LightVertex& vertex = v[t->v[surface.mirrored ? (3 - k) % 3 : k]];
                        const std::uint32_t key = t->v[surface.mirrored ? (3 - k) % 3 : k];
                        if (index[key] == kNone) { // a vertex is one surface's
                            index[key] = std::uint32_t(display->positions.size());
                            add_output(*display, *layer, data, vertex, charted);
                            if (settings_.keep_places) {
                                add_places(out.places[s], vertex);
                            }
                        }
                        display->indices.push_back(index[key]);
                        const double w = area / 3.0;
                        const DirectSample light = front(vertex);
                        const Rgb mapped = vertex.charted() && layer->direct_map_front
                                               ? layer->direct_map_front->irradiance(vertex.light_uv)
                                               : Rgb(0.0F);
                        const double e = luminance(light.irradiance + mapped);
                        const double level = e + settings_.light_floor;
                        error += level > 0.0 ? w * light.variance / (level * level) : 0.0;
                        area_sum += w;
                        const double radiance = luminance(rho * (light.irradiance + mapped)) / kPiD;
                        // Outer sides and closed cupboards are dark and not what anyone looks at.
                        if (radiance > 0.0 && e > settings_.light_floor) {
                            log_sum += w * std::log(radiance);
                            log_area += w;
                        }
                    }
                }
                for (auto* direct : {&layer->direct_front, &layer->direct_back}) {
                    const bool dark =
                        std::all_of(direct->begin(), direct->end(), [](const Rgb& e) { return e == Rgb(0.0F); });
                    if (dark) {
                        direct->clear();
                        direct->shrink_to_fit();
                    }
                }
                out.vertices += display->positions.size();
                if (settings_.keep_places) {
                    out.places[s].surface = s;
                }
                layer->mesh = std::move(display);
                out.surfaces[s] = std::move(layer);
            }
        }
        std::size_t kept = 0;
        for (std::size_t s = 0; s < out.places.size(); ++s) {
            if (out.surfaces[s]) {
                std::swap(out.places[kept++], out.places[s]);
            }
        }
        out.places.resize(kept);
        std::erase(out.surfaces, nullptr);
        out.error_estimate = area_sum > 0.0 ? std::sqrt(error / area_sum) : 0.0;
        out.mean_radiance = log_area > 0.0 ? std::exp(log_sum / log_area) : 0.0;
        return out;
    }

    void smooth_and_fill(NodeMesh& mesh) {
        const auto& borders = borders_[std::size_t(&mesh - meshes_.data())];
        for (DirectSample LightVertex::*sample : {&LightVertex::front, &LightVertex::front_direct}) {
            smooth_noise(mesh, &LightVertex::front_covered, sample, stop_);
        }
        for (DirectSample LightVertex::*sample : {&LightVertex::back, &LightVertex::back_direct}) {
            smooth_noise(mesh, &LightVertex::back_covered, sample, stop_);
        }
        fill_covered(mesh, {false}, &LightVertex::front, borders[0], &BorderEdge::reflected, stop_);
        fill_covered(mesh, {false}, &LightVertex::front_direct, borders[0], &BorderEdge::direct, stop_);
        fill_covered(mesh, {true}, &LightVertex::back, borders[1], &BorderEdge::reflected, stop_);
        fill_covered(mesh, {true}, &LightVertex::back_direct, borders[1], &BorderEdge::direct, stop_);
    }

    void add_places(VertexPlaces& places, const LightVertex& v) const {
        const auto place = [&](const vec3& n) { return v.unlit ? SurfacePoint{} : SurfacePoint{sample_position(v, n), n}; };
        const unsigned covered = (v.front_covered ? 1U : 0U) | (v.back_covered ? 2U : 0U);
        places.state.push_back(std::uint8_t((v.charted() ? VertexPlaces::kCharted : 0U) | covered * VertexPlaces::kCovered |
                                            covered * VertexPlaces::kWasCovered));
        places.front.push_back(place(v.normal));
        if (v.wants_back) {
            places.back.push_back(place(-v.normal));
        }
    }

    static void add_output(DisplayMesh& display, SurfaceLayer& layer, const MeshData& data, const LightVertex& v,
                           bool charted) {
        display.positions.push_back(v.local);
        display.normals.push_back(v.local_normal);
        if (!data.texcoords0.empty()) {
            display.texcoords0.push_back(v.uv0);
        }
        if (!data.texcoords1.empty()) {
            display.texcoords1.push_back(v.uv1);
        }
        if (!data.colors.empty()) {
            display.colors.push_back(v.color);
        }
        if (charted) {
            display.light_uv.push_back(v.light_uv);
        }
        layer.irradiance_front.push_back(v.front.irradiance);
        layer.direct_front.push_back(v.front_direct.irradiance);
        if (v.wants_back) {
            layer.irradiance_back.push_back(v.back.irradiance);
            layer.direct_back.push_back(v.back_direct.irradiance);
        }
    }

    const RayScene& rays_;
    const LightField& field_;
    const LightMaps& maps_;
    const LayerSettings& settings_;
    const std::function<bool(std::uint32_t)>& back_lit_;
    const RunContext& context_;
    StopCheck stop_; ///< for loops of the engine thread
    std::vector<NodeMesh> meshes_;
    std::vector<std::array<std::vector<BorderEdge>, 2>> borders_; ///< of the meshes, front and back
    std::size_t added_ = 0;
};

} // namespace

std::size_t LayerSet::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& s : surfaces) {
        bytes += s->mesh->positions.size() * (2 * sizeof(vec3) + 3 * sizeof(vec2)) +
                 s->mesh->indices.size() * sizeof(std::uint32_t) +
                 (s->irradiance_front.size() + s->irradiance_back.size() + s->direct_front.size() + s->direct_back.size()) *
                     sizeof(Rgb) +
                 (s->direct_map_front ? s->direct_map_front->memory_bytes() : 0) +
                 (s->direct_map_back ? s->direct_map_back->memory_bytes() : 0);
    }
    return bytes;
}

LayerSet build_layers(const RayScene& rays, const LightField& field, const LightMaps& maps, const LayerSettings& settings,
                      const std::function<bool(std::uint32_t)>& back_lit, const RunContext& context, double progress_from,
                      double progress_to) {
    return LayerBuild(rays, field, maps, settings, back_lit, context).run(progress_from, progress_to);
}

} // namespace atrium
