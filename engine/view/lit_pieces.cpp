#include "engine/view/lit_pieces.h"

#include "engine/base/parallel.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

constexpr double kPiecesOverall = 60'000.0; // that the surfaces of a scene are looked at in, about
constexpr int kMostCells = 48;              // that one edge of a triangle is cut in
constexpr float kMostSpread = 0.8F;         // radians between normals, above which pieces are parted by them

/// A triangle is cut in n * n equal ones by lines that part its edges in n. Numbers them so that a place's number follows
/// from its barycentric coordinates.
std::uint32_t cell_of(const vec2& barycentric, int n) {
    const float x = std::clamp(barycentric.x, 0.0F, 1.0F) * float(n);
    const float y = std::clamp(barycentric.y, 0.0F, 1.0F) * float(n);
    const int i = std::min(int(x), n - 1);
    const int j = std::min(int(y), n - 1 - i);
    const bool upper = i + j < n - 1 && x - float(i) + (y - float(j)) > 1.0F;
    return std::uint32_t((i * n + j) * 2 + (upper ? 1 : 0));
}

std::array<vec2, 3> cell_corners(std::uint32_t cell, int n) {
    const bool upper = cell % 2 == 1;
    const auto i = float(cell / 2 / std::uint32_t(n));
    const auto j = float(cell / 2 % std::uint32_t(n));
    const float s = 1.0F / float(n);
    if (upper) {
        return {vec2(i + 1, j) * s, vec2(i + 1, j + 1) * s, vec2(i, j + 1) * s};
    }
    return {vec2(i, j) * s, vec2(i + 1, j) * s, vec2(i, j + 1) * s};
}

} // namespace

LitPieces::LitPieces(const LitScene& lit, const RunContext& context) : lit_(lit) {
    const RayScene& rays = lit.rays();
    const auto& surfaces = rays.surfaces();
    double whole = 0.0;
    const auto area_of = [&](std::uint32_t s, std::uint32_t t) {
        const auto p = rays.triangle(s, t);
        return 0.5F * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    };
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        for (std::uint32_t t = 0; t < surfaces[s].triangles.size(); ++t) {
            whole += double(area_of(s, t));
        }
    }
    const auto size = float(std::sqrt(2.0 * whole / kPiecesOverall));
    if (!(size > 0.0F)) {
        return;
    }
    // Every piece of every triangle with the mean luminance of four of its places.
    std::vector<std::vector<Piece>> found(surfaces.size());
    parallel_chunks(surfaces.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (auto s = std::uint32_t(begin); s < end; ++s) {
            for (std::uint32_t t = 0; t < surfaces[s].triangles.size() && !context.should_stop(); ++t) {
                const auto p = rays.triangle(s, t);
                const float longest =
                    std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
                const int n = std::clamp(int(std::ceil(longest / size)), 1, kMostCells);
                const float area = area_of(s, t) / float(n * n);
                const vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
                for (const bool back : {false, true}) {
                    if (back && !surfaces[s].back_side) {
                        continue;
                    }
                    for (int i = 0; i < n; ++i) {
                        for (int j = 0; j < n - i; ++j) {
                            for (int upper = 0; upper < (i + j < n - 1 ? 2 : 1); ++upper) {
                                const auto cell = std::uint32_t((i * n + j) * 2 + upper);
                                const auto c = cell_corners(cell, n);
                                const vec2 middle = (c[0] + c[1] + c[2]) / 3.0F;
                                float sum = 0.0F;
                                for (const vec2& at :
                                     {middle, 0.5F * (middle + c[0]), 0.5F * (middle + c[1]), 0.5F * (middle + c[2])}) {
                                    const Hit hit{s, t, 0.0F, at, normal, !back};
                                    sum += luminance(lit.radiance(hit));
                                }
                                found[s].push_back(
                                    {s, t, std::uint16_t(cell), std::uint16_t(n), back, area, 0.25F * sum * area, 0});
                            }
                        }
                    }
                }
            }
        }
    });
    if (context.should_stop()) {
        return;
    }
    cuts_.resize(surfaces.size());
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        for (const Piece& p : found[s]) {
            if (!(p.power > 0.0F)) {
                continue;
            }
            if (cuts_[s].empty()) {
                cuts_[s].resize(2 * surfaces[s].triangles.size());
            }
            Cut& cut = cuts_[s][2 * p.triangle + (p.back ? 1 : 0)];
            if (cut.cells == 0) {
                cut = {p.cells, std::uint32_t(cell_pieces_.size())};
                cell_pieces_.resize(cell_pieces_.size() + 2U * p.cells * p.cells, kNone);
            }
            cell_pieces_[cut.first + p.cell] = std::uint32_t(pieces_.size());
            pieces_.push_back(p);
        }
    }
    if (pieces_.empty()) {
        return;
    }
    std::vector<std::uint32_t> order(pieces_.size());
    std::iota(order.begin(), order.end(), 0U);
    nodes_.reserve(2 * pieces_.size());
    nodes_.emplace_back();
    build(order, 0, order.size(), 0);
}

std::array<vec2, 3> LitPieces::corners_of(const Piece& piece) const { return cell_corners(piece.cell, piece.cells); }

vec3 LitPieces::position(const Piece& piece, const vec2& b) const {
    const auto p = lit_.rays().triangle(piece.surface, piece.triangle);
    return p[0] + (p[1] - p[0]) * b.x + (p[2] - p[0]) * b.y;
}

vec3 LitPieces::side_of(const Piece& piece) const {
    const auto p = lit_.rays().triangle(piece.surface, piece.triangle);
    return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])) * (piece.back ? -1.0F : 1.0F);
}

void LitPieces::build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end, std::uint32_t node) {
    Box3 box;
    Box3 middles;
    Box3 sides;
    vec3 axis(0.0F);
    double power = 0.0;
    const auto middle = [&](std::uint32_t i) {
        const auto c = corners_of(pieces_[i]);
        return position(pieces_[i], (c[0] + c[1] + c[2]) / 3.0F);
    };
    for (std::size_t i = begin; i < end; ++i) {
        const Piece& piece = pieces_[order[i]];
        for (const vec2& corner : corners_of(piece)) {
            box.add(position(piece, corner));
        }
        middles.add(middle(order[i]));
        sides.add(side_of(piece));
        axis += side_of(piece);
        power += double(piece.power);
    }
    Node& own = nodes_[node];
    own.box = box;
    own.power = float(power);
    own.axis = glm::length(axis) > 1e-6F ? glm::normalize(axis) : vec3(0.0F, 0.0F, 1.0F);
    float least = 1.0F;
    for (std::size_t i = begin; i < end; ++i) {
        least = std::min(least, glm::dot(own.axis, side_of(pieces_[order[i]])));
    }
    own.spread = std::acos(std::clamp(least, -1.0F, 1.0F));
    if (end - begin == 1) {
        own.right = order[begin];
        pieces_[order[begin]].leaf = node;
        return;
    }
    // What faces different ways is parted first: of a wall only one side is seen.
    const bool by_side = own.spread > kMostSpread;
    const vec3 size = by_side ? sides.size() : middles.size();
    const int along = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto key = [&](std::uint32_t i) { return by_side ? side_of(pieces_[i])[along] : middle(i)[along]; };
    const auto first = order.begin() + std::ptrdiff_t(begin);
    const auto last = order.begin() + std::ptrdiff_t(end);
    auto half = first;
    if (by_side) {
        const float cut = 0.5F * (sides.min[along] + sides.max[along]);
        half = std::stable_partition(first, last, [&](std::uint32_t i) { return key(i) < cut; });
    }
    if (half == first || half == last) {
        half = first + (last - first) / 2;
        std::nth_element(first, half, last, [&](std::uint32_t a, std::uint32_t b) {
            const float x = key(a);
            const float y = key(b);
            return x != y ? x < y : a < b;
        });
    }
    const auto middle_of_order = std::size_t(half - order.begin());
    const auto left = std::uint32_t(nodes_.size());
    own.left = left;
    own.right = left + 1;
    nodes_.emplace_back(); // `own` is gone from here on
    nodes_.emplace_back();
    nodes_[left].parent = node;
    nodes_[left + 1].parent = node;
    build(order, begin, middle_of_order, left);
    build(order, middle_of_order, end, left + 1);
}

float LitPieces::importance(const Node& node, const vec3& point, const vec3& normal) {
    const vec3 half = 0.5F * (node.box.max - node.box.min);
    const vec3 d = 0.5F * (node.box.max + node.box.min) - point;
    const float height = glm::dot(normal, d) + glm::dot(glm::abs(normal), half);
    if (!(height > 0.0F)) {
        return 0.0F; // below the horizon
    }
    const float radius2 = glm::dot(half, half);
    const float distance2 = std::max(glm::dot(d, d), radius2);
    const float distance = std::sqrt(distance2);
    float facing = 1.0F;
    if (glm::dot(d, d) > radius2) {
        const float within = std::asin(std::min(std::sqrt(radius2) / distance, 1.0F)) + node.spread;
        const float angle = std::acos(std::clamp(-glm::dot(node.axis, d) / distance, -1.0F, 1.0F)) - within;
        if (angle >= 0.5F * kPi + 1e-3F) {
            return 0.0F; // its backs are turned
        }
        facing = angle > 0.0F ? std::max(std::cos(angle), 1e-3F) : 1.0F;
    }
    const float cosine = std::clamp(height / distance, 1e-3F, 1.0F);
    return node.power * cosine * facing / std::max(distance2, 1e-20F);
}

bool LitPieces::pick(const vec3& point, const vec3& normal, float which, const vec2& where, Spot& spot) const {
    if (nodes_.empty() || !(importance(nodes_[0], point, normal) > 0.0F)) {
        return false;
    }
    float chance = 1.0F;
    std::uint32_t at = 0;
    while (nodes_[at].left != kNone) {
        const float left = importance(nodes_[nodes_[at].left], point, normal);
        const float right = importance(nodes_[nodes_[at].right], point, normal);
        if (!(left + right > 0.0F)) {
            return false;
        }
        const float share = left / (left + right);
        if (which < share) {
            which = std::min(which / share, 0x1.fffffep-1F);
            chance *= share;
            at = nodes_[at].left;
        } else {
            which = std::clamp((which - share) / (1.0F - share), 0.0F, 0x1.fffffep-1F);
            chance *= 1.0F - share;
            at = nodes_[at].right;
        }
    }
    const Piece& piece = pieces_[nodes_[at].right];
    const auto c = corners_of(piece);
    const float root = std::sqrt(where.x);
    const vec2 b = c[0] * (1.0F - root) + c[1] * (root * (1.0F - where.y)) + c[2] * (root * where.y);
    const auto p = lit_.rays().triangle(piece.surface, piece.triangle);
    const vec3 d = p[0] + (p[1] - p[0]) * b.x + (p[2] - p[0]) * b.y - point;
    const float distance2 = glm::dot(d, d);
    const float distance = std::sqrt(distance2);
    const vec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    if (!(distance > 0.0F)) {
        return false;
    }
    spot.direction = d / distance;
    const float cosine = -glm::dot(n, spot.direction) * (piece.back ? -1.0F : 1.0F);
    if (!(cosine > 1e-6F) || !(glm::dot(normal, spot.direction) > 0.0F)) {
        return false;
    }
    spot.hit = {piece.surface, piece.triangle, distance, b, n, !piece.back};
    spot.density = chance / piece.area * distance2 / cosine;
    return true;
}

float LitPieces::density(const vec3& point, const vec3& normal, const Hit& hit, const vec3& direction,
                         float distance) const {
    if (nodes_.empty() || hit.surface >= cuts_.size() || cuts_[hit.surface].empty()) {
        return 0.0F;
    }
    const Cut& cut = cuts_[hit.surface][2 * hit.triangle + (hit.front ? 0 : 1)];
    if (cut.cells == 0) {
        return 0.0F;
    }
    const std::uint32_t index = cell_pieces_[cut.first + cell_of(hit.barycentric, cut.cells)];
    if (index == kNone) {
        return 0.0F;
    }
    const float cosine = std::abs(glm::dot(hit.geometric_normal, direction));
    if (!(cosine > 1e-6F)) {
        return 0.0F;
    }
    float chance = 1.0F;
    for (std::uint32_t at = pieces_[index].leaf; nodes_[at].parent != kNone; at = nodes_[at].parent) {
        const Node& parent = nodes_[nodes_[at].parent];
        const float own = importance(nodes_[at], point, normal);
        const float all = importance(nodes_[parent.left], point, normal) + importance(nodes_[parent.right], point, normal);
        if (!(own > 0.0F)) {
            return 0.0F;
        }
        chance *= own / all;
    }
    return chance / pieces_[index].area * distance * distance / cosine;
}

} // namespace atrium
