#include "engine/debug/element_view.h"

#include "engine/solver/insides.h"

#include <algorithm>
#include <map>

namespace atrium {
namespace {

using Polygon2 = std::vector<vec2>;

/// What of a convex polygon lies on one side of a line along an axis (Sutherland and Hodgman 1974).
Polygon2 cut(const Polygon2& in, int axis, float at, float sign) {
    Polygon2 out;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const vec2& a = in[i];
        const vec2& b = in[(i + 1) % in.size()];
        const float da = sign * (a[axis] - at), db = sign * (b[axis] - at);
        if (da >= 0.0F) {
            out.push_back(a);
        }
        if ((da < 0.0F) != (db < 0.0F)) {
            out.push_back(a + (b - a) * (da / (da - db)));
        }
    }
    return out;
}

/// What of a segment lies in a triangle, if anything.
std::optional<std::array<vec2, 2>> clip_line(vec2 a, vec2 b, const std::array<vec2, 3>& triangle) {
    const auto cross = [](const vec2& u, const vec2& v) { return u.x * v.y - u.y * v.x; };
    const float turn = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0.0F ? -1.0F : 1.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        const vec2 edge = triangle[(k + 1) % 3] - triangle[k];
        // The slack keeps borders that run along an edge.
        const float slack = 1e-5F * glm::dot(edge, edge);
        const float da = turn * cross(edge, a - triangle[k]) + slack, db = turn * cross(edge, b - triangle[k]) + slack;
        if (da < 0.0F && db < 0.0F) {
            return std::nullopt;
        }
        if (da < 0.0F) {
            a += (b - a) * (da / (da - db));
        } else if (db < 0.0F) {
            b += (a - b) * (db / (db - da));
        }
    }
    return std::array{a, b};
}

/// Leaves and how to find their numbers.
struct Leaves {
    explicit Leaves(const Insides& in)
        : insides(in), elements(in.exchange ? in.exchange->leaves() : in.hierarchy.leaves()),
          number(in.hierarchy.elements.size(), Element::kNone) {
        for (std::uint32_t i = 0; i < elements.size(); ++i) {
            number[elements[i]] = i;
        }
    }
    [[nodiscard]] LeafFigures figures(std::uint32_t leaf) const {
        const Element* e = &insides.hierarchy.elements[elements[leaf]];
        LeafFigures out;
        out.area = e->area;
        out.faces = e->kind == Element::Kind::Faces;
        out.links = insides.exchange ? std::uint32_t(insides.exchange->row(leaf).size()) : 0;
        while (e->kind == Element::Kind::Patch && e->parent != Element::kNone &&
               insides.hierarchy.elements[e->parent].kind == Element::Kind::Patch) {
            e = &insides.hierarchy.elements[e->parent];
            ++out.level;
        }
        return out;
    }
    const Insides& insides;
    std::vector<std::uint32_t> elements;
    std::vector<std::uint32_t> number; ///< of elements
};

/// A leaf in pieces, engine coordinates.
struct Pieces {
    struct Piece {
        std::uint32_t surface;
        std::array<vec3, 3> corners; ///< counter-clockwise from its side
    };
    struct Line {
        std::uint32_t surface;
        std::array<vec3, 2> ends;
        vec3 normal;
    };
    std::vector<Piece> triangles;
    std::vector<Line> lines;
};

vec3 corner_of(const Insides& in, std::uint32_t surface, std::uint32_t triangle, int k) {
    const RaySurface& s = in.surfaces[surface];
    return (*s.positions)[s.triangles[triangle][k]];
}

void add_patch(const Insides& in, const Element& e, Pieces& out) {
    const Hierarchy& h = in.hierarchy;
    const PatchCell& cell = h.patches[e.patch];
    const auto triangle = [&](const vec3& a, const vec3& b, const vec3& c) {
        const bool turned = glm::dot(glm::cross(b - a, c - a), e.normal) < 0.0F;
        out.triangles.push_back({e.surface, {a, turned ? c : b, turned ? b : c}});
    };
    const auto line = [&](const vec3& a, const vec3& b) {
        if (a != b) {
            out.lines.push_back({e.surface, {a, b}, e.normal});
        }
    };
    if (cell.shape != PatchCell::Shape::Partial) {
        const auto& c = cell.corner;
        triangle(c[0], c[1], c[2]);
        triangle(c[0], c[2], c[3]);
        for (std::size_t k = 0; k < 4; ++k) {
            line(c[k], c[(k + 1) % 4]);
        }
        return;
    }
    const Sheet& sheet = h.sheets[cell.sheet];
    const auto at = [&](const vec2& p) { return sheet.origin + sheet.axis_u * p.x + sheet.axis_v * p.y; };
    const std::array<vec2, 4> corner{cell.low, vec2(cell.high.x, cell.low.y), cell.high, vec2(cell.low.x, cell.high.y)};
    for (std::uint32_t i = 0; i < cell.part_count; ++i) {
        const auto& uv = h.sheet_triangles[h.cell_parts[cell.first_part + i].triangle].uv;
        Polygon2 polygon(uv.begin(), uv.end());
        for (int axis = 0; axis < 2; ++axis) {
            polygon = cut(polygon, axis, cell.low[axis], 1.0F);
            polygon = cut(polygon, axis, cell.high[axis], -1.0F);
        }
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            triangle(at(polygon[0]), at(polygon[k]), at(polygon[k + 1]));
        }
        for (std::size_t k = 0; k < 4; ++k) {
            if (const auto inside = clip_line(corner[k], corner[(k + 1) % 4], uv)) {
                line(at((*inside)[0]), at((*inside)[1]));
            }
        }
    }
}

/// Faces of a group; edges between two of them that go round are no border.
void add_faces(const Insides& in, const Element& e, Pieces& out) {
    struct Edge {
        std::uint32_t surface;
        std::array<vec3, 2> ends;
        vec3 normal;
        int count;
    };
    const auto key = [](const vec3& p) { return std::array{p.x, p.y, p.z}; };
    std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, Edge> edges;
    for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
        const Face& face = in.hierarchy.faces[f];
        std::array<vec3, 3> c{corner_of(in, face.surface, face.triangle, 0), corner_of(in, face.surface, face.triangle, 1),
                              corner_of(in, face.surface, face.triangle, 2)};
        if (glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), face.normal) < 0.0F) {
            std::swap(c[1], c[2]);
        }
        out.triangles.push_back({face.surface, c});
        for (std::size_t k = 0; k < 3; ++k) {
            const vec3 &a = c[k], &b = c[(k + 1) % 3];
            const auto ends = std::minmax(key(a), key(b));
            ++edges.try_emplace({ends.first, ends.second}, Edge{face.surface, {a, b}, face.normal, 0}).first->second.count;
        }
    }
    for (const auto& [ends, edge] : edges) {
        if (edge.count == 1) {
            out.lines.push_back({edge.surface, edge.ends, edge.normal});
        }
    }
}

Pieces pieces_of(const Insides& in, std::uint32_t element) {
    Pieces out;
    const Element& e = in.hierarchy.elements[element];
    if (e.kind == Element::Kind::Patch) {
        add_patch(in, e, out);
    } else if (e.kind == Element::Kind::Faces) {
        add_faces(in, e, out);
    }
    return out;
}

LinkEnd end_of(const Leaves& leaves, std::uint32_t leaf) {
    const Insides& in = leaves.insides;
    const Element& e = in.hierarchy.elements[leaves.elements[leaf]];
    LinkEnd out;
    out.leaf = leaf;
    out.figures = leaves.figures(leaf);
    out.centre = dvec3(e.centre) + in.origin;
    out.normal = dvec3(e.normal);
    const auto surface = e.kind == Element::Kind::Patch ? e.surface : in.hierarchy.faces[e.triangle].surface;
    out.node = in.surfaces[surface].node;
    const Pieces pieces = pieces_of(in, leaves.elements[leaf]);
    for (const Pieces::Line& line : pieces.lines) {
        out.outline.push_back({dvec3(line.ends[0]) + in.origin, dvec3(line.ends[1]) + in.origin});
    }
    if (e.kind == Element::Kind::Patch) {
        for (const vec3& c : in.hierarchy.corners(e)) {
            out.corners.push_back(dvec3(c) + in.origin);
        }
        return out;
    }
    vec3 normal(0.0F);
    for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
        normal += in.hierarchy.faces[f].area * in.hierarchy.faces[f].normal;
    }
    out.normal = glm::length(normal) > 0.0F ? dvec3(glm::normalize(normal)) : dvec3(0.0, 1.0, 0.0);
    const dvec3 u = glm::normalize(glm::cross(out.normal, std::abs(out.normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
    const dvec3 v = glm::cross(out.normal, u);
    const double r = double(e.radius) * std::sqrt(0.5);
    for (const auto& [a, b] : {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)}) {
        out.corners.push_back(out.centre + u * a + v * b);
    }
    return out;
}

} // namespace

std::shared_ptr<const ElementView> view_elements(const Solution& solution) {
    if (!solution.insides) {
        return nullptr;
    }
    const Insides& in = *solution.insides;
    const Leaves leaves(in);
    auto out = std::make_shared<ElementView>();
    out->surfaces.resize(in.surfaces.size());
    std::vector<dmat4> to_node;
    for (std::size_t i = 0; i < in.surfaces.size(); ++i) {
        out->surfaces[i].node = in.surfaces[i].node;
        out->surfaces[i].part = in.surfaces[i].part;
        to_node.push_back(glm::inverse(in.surfaces[i].to_engine));
    }
    const auto local = [&](std::uint32_t surface, const vec3& p) {
        return vec3(dvec3(to_node[surface] * dvec4(dvec3(p), 1.0)));
    };
    for (std::uint32_t leaf = 0; leaf < leaves.elements.size(); ++leaf) {
        out->leaves.push_back(leaves.figures(leaf));
        const Pieces pieces = pieces_of(in, leaves.elements[leaf]);
        for (const Pieces::Piece& piece : pieces.triangles) {
            SurfaceElements& to = out->surfaces[piece.surface];
            to.triangles.push_back({local(piece.surface, piece.corners[0]), local(piece.surface, piece.corners[1]),
                                    local(piece.surface, piece.corners[2])});
            to.triangle_leaf.push_back(leaf);
        }
        for (const Pieces::Line& line : pieces.lines) {
            SurfaceElements& to = out->surfaces[line.surface];
            const dmat4& m = in.surfaces[line.surface].to_engine;
            to.lines.push_back({local(line.surface, line.ends[0]), local(line.surface, line.ends[1])});
            to.line_normal.push_back(vec3(glm::normalize(glm::transpose(dmat3(m)) * dvec3(line.normal))));
            to.line_leaf.push_back(leaf);
        }
    }
    std::erase_if(out->surfaces, [](const SurfaceElements& s) { return s.triangles.empty(); });
    return out;
}

std::optional<std::uint32_t> leaf_at(const Solution& solution, NodeId node, std::uint32_t part, const vec3& point,
                                     bool back) {
    if (!solution.insides) {
        return std::nullopt;
    }
    const Insides& in = *solution.insides;
    for (std::uint32_t i = 0; i < in.surfaces.size(); ++i) {
        const RaySurface& surface = in.surfaces[i];
        if (surface.node != node || surface.part != part) {
            continue;
        }
        const vec3 p(dvec3(surface.to_engine * dvec4(dvec3(point), 1.0)));
        Box3 bounds;
        for (const uvec3& t : surface.triangles) {
            for (int k = 0; k < 3; ++k) {
                bounds.add((*surface.positions)[t[k]]);
            }
        }
        float best = 1e-3F * bounds.diagonal() + 1e-4F; // how far from a triangle, in its plane and off it
        std::uint32_t found = Element::kNone;
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
            const vec3 a = corner_of(in, i, t, 0), u = corner_of(in, i, t, 1) - a, v = corner_of(in, i, t, 2) - a;
            const vec3 n = glm::cross(u, v);
            const float area2 = glm::dot(n, n);
            if (!(area2 > 0.0F)) {
                continue;
            }
            const float off = std::abs(glm::dot(p - a, n)) / std::sqrt(area2);
            if (off >= best) {
                continue;
            }
            vec2 w(glm::dot(glm::cross(p - a, v), n) / area2, glm::dot(glm::cross(u, p - a), n) / area2);
            const vec2 inside = glm::max(w, vec2(0.0F));
            const float sum = inside.x + inside.y;
            const vec2 nearest = sum > 1.0F ? inside / sum : inside;
            const float away = glm::length(a + u * nearest.x + v * nearest.y - p);
            if (away < best) {
                const std::uint32_t element = in.hierarchy.leaf_at(i, t, back, nearest);
                if (element != Element::kNone) {
                    best = away;
                    found = element;
                }
            }
        }
        if (found != Element::kNone) {
            const Leaves leaves(in);
            return leaves.number[found] != Element::kNone ? std::optional(leaves.number[found]) : std::nullopt;
        }
    }
    return std::nullopt;
}

ElementLinks links_of(const Solution& solution, std::uint32_t leaf) {
    ElementLinks out;
    if (!solution.insides) {
        return out;
    }
    const Insides& in = *solution.insides;
    const Leaves leaves(in);
    out.receiver = end_of(leaves, leaf);
    const Element& e = in.hierarchy.elements[leaves.elements[leaf]];
    out.direct = double(luminance(e.direct));
    out.caustic = double(luminance(e.caustic));
    if (!in.exchange) {
        return out;
    }
    out.open = std::max(1.0 - double(in.exchange->row_sums()[leaf]), 0.0);
    std::vector<std::pair<double, std::uint32_t>> found;
    for (const LeafExchange::Entry& entry : in.exchange->row(leaf)) {
        const Element& other = in.hierarchy.elements[leaves.elements[entry.other]];
        const double brings = double(luminance(other.radiosity)) * double(entry.k) / double(in.exchange->area()[leaf]);
        if (brings > 0.0) {
            found.emplace_back(brings, entry.other);
            out.over_links += brings;
        }
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
    for (const auto& [brings, other] : found) {
        out.links.push_back({end_of(leaves, other), brings, brings / out.over_links});
    }
    return out;
}

} // namespace atrium
