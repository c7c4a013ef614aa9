#include "engine/radiosity/point_gather.h"

#include "engine/base/rng.h"
#include "engine/geometry/form_factor.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace atrium {
namespace {

using Kind = Element::Kind;

/// One element of the cut.
struct CutNode {
    const GatherNode* node = nullptr;
    Rgb contribution{0.0F}; ///< unoccluded irradiance
    float error = 0.0F;     ///< of its luminance, unoccluded; what refinement goes by
};

// Whether a plane's front faces the point. The surface that the point is on does not shine on it, though rounding may put
// the point before it: at no distance it would fill the whole hemisphere.
bool faces_point(const vec3& on_plane, const vec3& normal, const SurfacePoint& p) {
    const float height = glm::dot(p.position - on_plane, normal);
    const float unevenness = 3e-4F + 1e-6F * max_component(glm::abs(p.position));
    return height > (std::abs(glm::dot(normal, p.normal)) > 0.9F ? unevenness : 0.0F);
}

constexpr std::uint32_t kMostFaces = 512; // of a group that are looked at singly

// Mean form factor, over the stretch that a sample stands for, of a polygon that rises from the receiver's plane beside it:
// in front of a strip of width w the light falls within a few w, however near the next sample is. The stretch runs across
// the line in which the planes meet and ends there; points are dense towards it. Negative where the polygon is none such.
double mean_factor(const SurfacePoint& p, std::span<const vec3> corners, const vec3& normal, float spread) {
    constexpr int kPoints = 12;
    constexpr float kNear = 8.0F; // stretches: beyond, the light is even over one
    const vec3 across = normal - p.normal * glm::dot(normal, p.normal);
    const float slope = glm::length(across); // of the distance from the polygon's plane along the stretch
    const float height = glm::dot(p.position - corners[0], normal);
    if (slope < 0.1F || height > kNear * spread * slope) {
        return -1.0;
    }
    float nearest = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const vec3 edge = corners[(k + 1) % corners.size()] - corners[k], d = p.position - corners[k];
        const float along = std::clamp(glm::dot(d, edge) / std::max(glm::dot(edge, edge), 1e-30F), 0.0F, 1.0F);
        nearest = std::min(nearest, glm::length(d - along * edge));
    }
    if (nearest > 2.0F * kNear * spread) {
        return -1.0;
    }
    const float at = height / slope;
    const float low = at < spread ? 0.0F : at - spread, high = at < spread ? spread : at + spread;
    const float first = std::sqrt(low / high);
    double sum = 0.0, weights = 0.0;
    for (int k = 0; k < kPoints; ++k) {
        const float u = first + (1.0F - first) * (float(k) + 0.5F) / float(kPoints);
        const vec3 there = p.position + across * ((high * u * u - at) / slope);
        sum += double(u) * form_factor_to_polygon(there, p.normal, corners);
        weights += double(u);
    }
    return sum / weights;
}

// Form factor of a convex polygon, or of what can be seen of it over a mirror. `normal` is the polygon's.
double form_factor(const SurfacePoint& p, std::span<const vec3> corners, const vec3& normal, const MirrorSight* over,
                   float spread) {
    if (over == nullptr) {
        const double mean = spread > 0.0F ? mean_factor(p, corners, normal, spread) : -1.0;
        return mean >= 0.0 ? mean : form_factor_to_polygon(p.position, p.normal, corners);
    }
    std::array<vec3, MirrorSight::kMaxCorners> seen;
    const std::size_t count = over->clip(corners, seen);
    return count > 0 ? form_factor_to_polygon(p.position, p.normal, std::span(seen).first(count)) : 0.0;
}

// Form factor of a face that is small beside its distance and wholly above the horizon, by its middle: off by less than
// the square of its angle over ten. Negative where it is none such.
float far_factor(const SurfacePoint& p, const std::array<vec3, 3>& corner, const Face& face) {
    constexpr float kSmall = 0.01F; // squared longest edge over squared distance
    const vec3 d = (corner[0] + corner[1] + corner[2]) * (1.0F / 3.0F) - p.position;
    const auto length2 = [](const vec3& v) { return glm::dot(v, v); };
    const float edge2 =
        std::max({length2(corner[1] - corner[0]), length2(corner[2] - corner[0]), length2(corner[2] - corner[1])});
    const float d2 = length2(d), height = glm::dot(d, p.normal);
    if (edge2 > kSmall * d2 || (height < 0.0F ? -1.0F : height * height) < edge2) {
        return -1.0F;
    }
    return std::max(-height * glm::dot(d, face.normal), 0.0F) * face.area / (kPi * d2 * d2);
}

// Faces one by one; of many, evenly chosen ones stand for all.
Rgb faces_one_by_one(const Hierarchy& h, const RayScene& rays, const Element& e, const SurfacePoint& p,
                     const MirrorSight* over, float spread) {
    const std::uint32_t step = (e.face_count + kMostFaces - 1) / kMostFaces;
    float factor = 0.0F;
    float chosen = 0.0F;
    for (std::uint32_t f = e.triangle + step / 2; f < e.triangle + e.face_count; f += step) {
        const Face& face = h.faces[f];
        const auto corner = rays.triangle(face.surface, face.triangle);
        chosen += face.area;
        if (faces_point(corner[0], face.normal, p)) {
            const float far = over == nullptr ? far_factor(p, corner, face) : -1.0F;
            factor += far >= 0.0F ? far : float(form_factor(p, corner, face.normal, over, spread));
        }
    }
    return e.radiosity * std::min(factor * (e.area / chosen), 1.0F);
}

// What can be seen of patches and faces over a mirror is cut out exactly; clusters count as if all of them could be seen.
CutNode evaluate(const Hierarchy& h, const RayScene& rays, const FarFaces* far, const GatherNode& node,
                 const SurfacePoint& p, const MirrorSight* over, float spread) {
    const Element& e = h.elements[node.element];
    CutNode out;
    out.node = &node;
    const vec3 d = node.centre - p.position;
    if (glm::dot(d, p.normal) <= -node.radius) {
        return out; // below the horizon
    }
    if (node.turns_away_from(p.position)) {
        return out;
    }
    if (over != nullptr) {
        if (over->misses(node.centre, node.radius)) {
            return out;
        }
        spread = 0.0F;
        if (e.kind != Kind::Cluster && over->holds(e.centre, e.radius)) {
            over = nullptr; // nothing to cut out
        }
    }
    if (e.kind == Kind::Patch) {
        if (!faces_point(e.centre, e.normal, p)) {
            return out;
        }
        const float coverage = h.coverage(e);
        const auto factor = coverage * float(form_factor(p, h.corners(e), e.normal, over, spread));
        out.contribution = e.radiosity * factor;
        // Where the surface lies within a cell that it does not fill is as uncertain as how bright it is there.
        out.error = e.leaf() ? 0.0F : factor * (e.spread + std::max(1.0F - coverage, 0.0F) * luminance(e.radiosity));
        return out;
    }
    const float r = glm::length(d);
    if (e.kind == Kind::Faces) {
        const float factor = far != nullptr && over == nullptr ? far->factor(h, node.element, p) : -1.0F;
        if (factor >= 0.0F) {
            out.contribution = e.radiosity * factor;
            return out;
        }
        if (r < 4.0F * e.radius || over != nullptr) {
            out.contribution = faces_one_by_one(h, rays, e, p, over, spread);
            return out;
        }
    } else if (r < 1.5F * node.radius) {
        // Inside or beside it no direction describes it: its parts are looked at, the brightest elements first. Should the
        // cut be full before, it counts as a uniform surrounding.
        const float reach2 = std::max(r * r, 0.25F * node.radius * node.radius);
        out.error = e.power / (kPi * reach2);
        out.contribution = e.radiosity * (0.5F * std::min(1.0F, e.area / (4.0F * kPi * node.radius * node.radius)));
        return out;
    }
    const vec3 w = d / r;
    const float cosine = glm::dot(p.normal, w);
    const Rgb towards = glm::max(sh_dot(h.harmonics[e.harmonics].emission, sh_basis(-w)), Rgb(0.0F));
    const float kernel = 1.0F / (kPi * r * r);
    out.contribution = towards * (kernel * std::max(cosine, 0.0F));
    // Cosine and distance vary by about `ratio` over the element, visibility by anything; the harmonics themselves are off
    // by up to a tenth of the peak, which at grazing angles is more than the light itself.
    const float ratio = node.radius / r;
    const float bound =
        std::max(luminance(towards), 0.1F * e.power) * kernel * std::min(std::max(cosine, 0.0F) + ratio, 1.0F);
    out.error = e.leaf() ? 0.1F * e.power * kernel * std::max(cosine, 0.0F) : bound * ratio;
    return out;
}

/// Elements with a single ray each: their hits and misses together tell how uncertain one of them is.
struct SingleRays {
    float light2 = 0.0F; ///< sum of squared luminances
    float clear = 0.0F;
    float rays = 0.0F;

    void add(float light, float seen) {
        light2 += light * light;
        clear += seen;
        rays += 1.0F;
    }
    [[nodiscard]] float variance() const {
        const float p = rays > 0.0F ? clear / rays : 0.0F;
        return light2 * p * (1.0F - p);
    }
};

constexpr unsigned kFewRays = 8;             // that are shot at an element before they may be found to agree
constexpr unsigned kTries = 4;               // sample points for each ray
constexpr unsigned kTriesOverMirror = 32;    // the same where most of them may be out of sight
constexpr std::uint64_t kPickSalt = 0x9E37U; // keeps the picks apart from the elements' sample points

// A point of a convex polygon, uniform by area.
vec3 point_of_polygon(std::span<const vec3> corners, vec2 u) {
    const auto part = [&](std::size_t k) {
        return glm::length(glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]));
    };
    float area = 0.0F;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        area += part(k);
    }
    float at = u.x * area;
    std::size_t k = 1;
    for (; k + 2 < corners.size() && at >= part(k); ++k) {
        at -= part(k);
    }
    const float root = std::sqrt(part(k) > 0.0F ? std::clamp(at / part(k), 0.0F, 1.0F) : 0.0F);
    return corners[0] + root * ((corners[k] - corners[0]) * (1.0F - u.y) + (corners[k + 1] - corners[0]) * u.y);
}

/// Where the rays to an element go that is looked at over a mirror.
struct InMirror {
    std::array<vec3, MirrorSight::kMaxCorners> corners; ///< of the part in sight
    std::size_t count = 0;                              ///< 0: points are looked for all over the element
    bool cut_out = false;                               ///< its light is that of the part in sight alone

    InMirror(const Hierarchy& h, const Element& e, const MirrorSight* over) {
        if (over != nullptr) {
            cut_out = e.kind != Kind::Cluster;
            count = e.kind == Kind::Patch && h.patches[e.patch].shape != PatchCell::Shape::Partial
                        ? over->clip(h.corners(e), corners)
                        : 0;
        }
    }
};

} // namespace

bool too_near(const Element& e, const vec3& point, float radii) {
    const vec3 d = e.centre - point;
    return e.leaf() && glm::dot(d, d) < radii * radii * e.radius * e.radius;
}

PointGather::Visibility PointGather::visibility(std::uint32_t element, const SurfacePoint& receiver, unsigned count,
                                                const MirrorSight* over, bool through_slits) const {
    Visibility out;
    const auto seed = std::uint32_t(hash64(h_.elements[element].path));
    Rgb seen(0.0F);
    float total_weight = 0.0F;
    // The same points for every receiver: shadows get a few fine steps instead of noise. Points that face away are passed
    // over, up to four tries for each ray.
    // A quarter of the rays is enough where all of them agree: they are spread over the whole element.
    const unsigned first = std::max(count / 4, kFewRays);
    const InMirror window(h_, h_.elements[element], over);
    const unsigned tries = over == nullptr ? kTries : kTriesOverMirror;
    for (unsigned i = 0; out.rays < count && i < tries * count; ++i) {
        // Rays that all miss a mirror which is no rectangle, or hide which part of a cluster is in sight, tell nothing.
        if (out.rays == first && ((out.clear == 0.0F && (over == nullptr || (window.cut_out && over->fills()))) ||
                                  (out.clear == float(first) && (over == nullptr || window.cut_out)))) {
            break;
        }
        const vec2 u = sobol_owen2(i, 0, seed);
        const SurfacePoint y = window.count == 0
                                   ? sample_point(h_, rays_, element, u, true)
                                   : SurfacePoint{point_of_polygon(std::span(window.corners).first(window.count), u),
                                                  h_.elements[element].normal};
        const vec3 d = y.position - receiver.position;
        const float d2 = glm::dot(d, d);
        const float cp = glm::dot(d, receiver.normal);
        const float cy = -glm::dot(d, y.normal);
        if (cp <= 0.0F || cy <= 0.0F || d2 <= 0.0F) {
            continue;
        }
        if (window.cut_out && !over->crosses(y.position)) {
            continue;
        }
        ++out.rays;
        // A floor on the distance keeps one near sample from deciding everything.
        const float near2 = std::max(d2, 0.01F * h_.elements[element].area);
        const float weight = cp * cy / d2 / near2; // d2 alone may be tiny, and the product nothing
        const bool by_slit = !through_slits && over == nullptr &&
                             slit_on_way(receiver.position, d / std::sqrt(d2), std::sqrt(d2)) < slits_.size();
        const Rgb through = by_slit           ? Rgb(0.0F) // add_slits() has it
                            : over != nullptr ? over->transmittance(y.position)
                                              : rays_.transmittance(receiver.position, y.position);
        seen += through * weight;
        out.clear += max_component(through) > 0.0F ? 1.0F : 0.0F;
        total_weight += weight;
    }
    out.seen = total_weight > 0.0F ? seen / total_weight : Rgb(0.0F);
    return out;
}

DirectSample PointGather::irradiance(const vec3& point, const vec3& normal, const GatherSettings& settings) const {
    DirectSample out;
    if (direct_ != nullptr && !direct_->empty()) {
        out = direct_->irradiance(point, normal, settings.sun_rays, settings.sky_rays);
    }
    const SurfacePoint p{point, normal};
    DirectSample through;
    add_slits(p, through);
    if (!(max_component(through.irradiance) > 0.0F)) {
        add_surfaces(p, settings, nullptr, true, out);
        return out;
    }
    // Where the lamps are seen well enough past the slits these add nothing of note.
    DirectSample past = out;
    add_surfaces(p, settings, nullptr, true, past);
    const float light = luminance(past.irradiance - out.irradiance);
    if (light * light > past.variance - out.variance) {
        return past;
    }
    out.irradiance += through.irradiance;
    out.variance += through.variance;
    add_surfaces(p, settings, nullptr, false, out);
    return out;
}

DirectSample PointGather::irradiance(const MirrorSight& over, const GatherSettings& settings) const {
    DirectSample out;
    add_surfaces({over.image(), over.image_normal()}, settings, &over, true, out);
    return out;
}

// The slit that a way belongs to; as many as there are where it crosses none.
std::size_t PointGather::slit_on_way(const vec3& from, const vec3& direction, float distance) const {
    std::size_t i = 0;
    for (; i < slits_.size() && !(slits_[i].crossing(from, direction) < distance); ++i) {
    }
    return i;
}

// Radiosity of the lamps that are seen in a direction.
Rgb PointGather::light_from(const vec3& from, const vec3& direction) const {
    constexpr int kMostPanes = 32;
    Rgb out(0.0F), through(1.0F);
    vec3 at = from + shadow_offset(from) * direction;
    for (int i = 0; i < kMostPanes && max_component(through) > 0.0F; ++i) {
        const Hit hit = rays_.nearest({at, direction});
        if (!hit) {
            break;
        }
        const std::uint32_t leaf = h_.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
        out += leaf != Element::kNone ? through * h_.elements[leaf].radiosity : Rgb(0.0F);
        through *= rays_.straight_through(hit, direction);
        at += (hit.t + shadow_offset(at)) * direction;
    }
    return out;
}

// Light through slits, which the rays spread over lamps would miss: by rays spread over the slits.
void PointGather::add_slits(const SurfacePoint& p, DirectSample& out) const {
    constexpr std::uint32_t kRays = 16, kScouts = 8; // of which none sees a lamp: the others would not either
    for (std::size_t i = 0; i < slits_.size(); ++i) {
        const float factor = slits_[i].form_factor(p.position, p.normal);
        if (!(factor > 0.0F)) {
            continue;
        }
        const WindowPoints points(slits_[i], p.position, p.normal);
        Rgb sum(0.0F);
        float weights = 0.0F, squares = 0.0F;
        std::uint32_t k = 0;
        for (; k < kRays && (k != kScouts || max_component(sum) > 0.0F); ++k) {
            const WindowPoints::Place place = points.at(sobol_owen2(k, 0, 0x5117U));
            if (!(place.weight > 0.0F)) {
                continue;
            }
            weights += place.weight;
            if (slit_on_way(p.position, place.direction, 1.001F * place.distance) < i) {
                continue; // the other slit's
            }
            const Rgb light = light_from(p.position, place.direction);
            sum += place.weight * light;
            squares += place.weight * luminance(light) * luminance(light);
        }
        if (weights > 0.0F) {
            const Rgb mean = sum / weights;
            out.irradiance += factor * mean;
            out.variance +=
                factor * factor * std::max(squares / weights - luminance(mean) * luminance(mean), 0.0F) / float(k);
        }
    }
}

void PointGather::add_surfaces(const SurfacePoint& p, const GatherSettings& settings, const MirrorSight* over,
                               bool through_slits, DirectSample& out) const {
    if (tree_.empty()) {
        return;
    }
    const auto smaller_error = [](const CutNode& a, const CutNode& b) {
        return a.error < b.error || (a.error == b.error && a.node > b.node);
    };
    // Whatever may hold leaves that are too near is opened first.
    const auto look = [&](const GatherNode& node) {
        CutNode seen = evaluate(h_, rays_, far_, node, p, over, settings.spread);
        if (settings.nearest > 0.0F && over == nullptr && luminance(seen.contribution) + seen.error > 0.0F) {
            if (too_near(h_.elements[node.element], p.position, settings.nearest)) {
                return CutNode{&node};
            }
            if (node.child_count > 0 && node.may_be_near(p.position, settings.nearest)) {
                seen.error = std::numeric_limits<float>::max();
            }
        }
        return seen;
    };
    std::vector<CutNode> cut{look(tree_.root())};
    std::vector<CutNode> done; // nothing below them would change the result
    float total = luminance(cut[0].contribution + out.irradiance);
    while (!cut.empty() && cut.size() + done.size() < settings.max_cut) {
        const CutNode top = cut.front();
        if (top.error <= settings.tolerance * total) {
            break;
        }
        std::pop_heap(cut.begin(), cut.end(), smaller_error);
        cut.pop_back();
        total -= luminance(top.contribution);
        const Element& e = h_.elements[top.node->element];
        if (e.kind == Kind::Faces) {
            const CutNode exact{top.node, faces_one_by_one(h_, rays_, e, p, over, settings.spread), 0.0F};
            total += luminance(exact.contribution);
            done.push_back(exact);
            continue;
        }
        for (const GatherNode& below : tree_.children(*top.node)) {
            const CutNode child = look(below);
            const float light = luminance(child.contribution);
            total += light;
            if (child.error > 0.0F) {
                cut.push_back(child);
                std::push_heap(cut.begin(), cut.end(), smaller_error);
            } else if (light > 0.0F) {
                done.push_back(child);
            }
        }
    }
    done.insert(done.end(), cut.begin(), cut.end());
    float unoccluded = 0.0F;
    for (const CutNode& node : done) {
        unoccluded += luminance(node.contribution);
    }
    if (!(unoccluded > 0.0F)) {
        return;
    }
    // Strong elements get rays of their own; the many weak ones share theirs: stratified picks along their summed light.
    std::sort(done.begin(), done.end(), [](const CutNode& a, const CutNode& b) { return a.node < b.node; });
    const float own_ray = 0.5F * unoccluded / float(settings.rays);
    float weak = 0.0F;
    SingleRays single;
    for (const CutNode& node : done) {
        const float light = luminance(node.contribution);
        if (light < own_ray) {
            weak += light;
            continue;
        }
        // Powers of two: the samples are stratified best, and neighbouring points use the very same ones.
        const float wanted = light / unoccluded * float(settings.rays);
        const auto count = unsigned(std::exp2(std::round(std::log2(std::max(wanted, 1.0F)))));
        const Visibility v = visibility(node.node->element, p, count, over, through_slits);
        out.irradiance += node.contribution * v.seen;
        const auto n = float(v.rays);
        if (n > 1.0F && v.clear > 0.0F && v.clear < n) {
            out.variance += light * light * (v.clear + 1.0F) * (n - v.clear + 1.0F) / ((n + 2.0F) * (n + 2.0F) * n);
        } else if (n == 1.0F) {
            single.add(light, v.clear);
        }
    }
    const auto picks = unsigned(std::ceil(weak / unoccluded * float(settings.rays)));
    const float stride = weak / float(std::max(picks, 1U));
    Rgb sum(0.0F);
    float picked = 0.0F;
    for (const CutNode& node : done) {
        const float light = luminance(node.contribution);
        // Every element has its own fixed number: neighbouring points pick the same ones, and their error is the same too.
        const float chance = unit_float(std::uint32_t(hash64(h_.elements[node.node->element].path ^ kPickSalt) >> 32));
        if (light >= own_ray || !(light > chance * stride)) {
            continue;
        }
        const float weight = std::max(light, stride);
        const Visibility v = visibility(node.node->element, p, 1, over, through_slits);
        sum += node.contribution * (weight / light) * v.seen;
        picked += weight;
        single.add(weight, v.clear);
    }
    if (picked > 0.0F) { // chance decides how many are picked, not how much light they stand for
        out.irradiance += sum * (weak / picked);
    }
    out.variance += single.variance();
}

} // namespace atrium
