#include "engine/radiosity/patch_cells.h"

#include "engine/base/checks.h"
#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kWhole = 1e-4F;   // missing share of its bounds below which a cell counts as covered all over
constexpr float kNothing = 1e-6F; // share of a cell below which what it covers is nothing
constexpr float kLong = 1.5F;     // sides' ratio from which a cell is halved and not quartered

float cross(const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; }

/// Convex polygon: a triangle cut by up to four lines.
struct Outline {
    std::array<vec2, 8> point;
    std::size_t count = 0;

    [[nodiscard]] float area() const {
        float sum = 0.0F;
        for (std::size_t i = 1; i + 1 < count; ++i) {
            sum += cross(point[i] - point[0], point[i + 1] - point[0]);
        }
        return 0.5F * std::abs(sum);
    }
};

// Keeps what lies on the side of `limit` along axis that `sign` says.
void cut(Outline& outline, int axis, float limit, float sign) {
    Outline out;
    for (std::size_t i = 0; i < outline.count; ++i) {
        const vec2& a = outline.point[i];
        const vec2& b = outline.point[(i + 1) % outline.count];
        const float da = sign * (a[axis] - limit);
        const float db = sign * (b[axis] - limit);
        if (da >= 0.0F && out.count < out.point.size()) {
            out.point[out.count++] = a;
        }
        if (((da > 0.0F && db < 0.0F) || (da < 0.0F && db > 0.0F)) && out.count < out.point.size()) {
            vec2 p = a + (b - a) * (da / (da - db));
            p[axis] = limit;
            out.point[out.count++] = p;
        }
    }
    outline = out;
}

Outline clip(const std::array<vec2, 3>& triangle, const vec2& low, const vec2& high) {
    Outline out;
    const vec2 least = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
    const vec2 most = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
    if (least.x >= high.x || least.y >= high.y || most.x <= low.x || most.y <= low.y) {
        return out;
    }
    std::copy(triangle.begin(), triangle.end(), out.point.begin());
    out.count = 3;
    for (int axis = 0; axis < 2; ++axis) {
        if (least[axis] < low[axis]) {
            cut(out, axis, low[axis], 1.0F);
        }
        if (most[axis] > high[axis]) {
            cut(out, axis, high[axis], -1.0F);
        }
    }
    return out;
}

/// What of a list of triangles lies in a rectangle.
struct Cover {
    double area = 0.0;
    dvec2 centroid{0.0};
    vec2 low{std::numeric_limits<float>::infinity()};
    vec2 high{-std::numeric_limits<float>::infinity()};
    std::vector<CellPart> parts;
    std::vector<vec2> points; ///< corners of all clipped parts
};

Cover cover(const Hierarchy& h, std::span<const CellPart> parts, const vec2& low, const vec2& high) {
    Cover out;
    const vec2 size = high - low;
    const float least = 1e-7F * size.x * size.y;
    for (const CellPart& part : parts) {
        const Outline outline = clip(h.sheet_triangles[part.triangle].uv, low, high);
        const float area = outline.area();
        if (outline.count < 3 || !(area > least)) {
            continue;
        }
        for (std::size_t i = 1; i + 1 < outline.count; ++i) {
            const vec2& a = outline.point[0];
            const vec2& b = outline.point[i];
            const vec2& c = outline.point[i + 1];
            out.centroid += double(0.5F * std::abs(cross(b - a, c - a))) * dvec2(a + b + c) / 3.0;
        }
        for (std::size_t i = 0; i < outline.count; ++i) {
            out.low = glm::min(out.low, outline.point[i]);
            out.high = glm::max(out.high, outline.point[i]);
            out.points.push_back(outline.point[i]);
        }
        out.area += area;
        out.parts.push_back({part.triangle, float(out.area)});
    }
    out.centroid /= std::max(out.area, 1e-300);
    return out;
}

// Convex hull, counter-clockwise, without points on its edges (within `tolerance`). Andrew's monotone chain.
std::vector<vec2> hull(std::vector<vec2> points, float tolerance) {
    std::sort(points.begin(), points.end(), [](const vec2& a, const vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<vec2> out;
    const auto add = [&](const vec2& p, std::size_t fixed) {
        while (out.size() >= fixed + 2) {
            const vec2& b = out.back();
            const vec2& a = out[out.size() - 2];
            if (cross(b - a, p - b) > tolerance * glm::length(p - a)) {
                break;
            }
            out.pop_back();
        }
        out.push_back(p);
    };
    for (const vec2& p : points) {
        add(p, 0);
    }
    const std::size_t lower = out.size() - 1;
    for (auto p = points.rbegin() + 1; p != points.rend(); ++p) {
        add(*p, lower);
    }
    out.pop_back();
    return out;
}

void set_corners(Hierarchy& h, Element& e, PatchCell& cell, std::array<vec2, 4> quad) {
    const Sheet& sheet = h.sheets[cell.sheet];
    const auto at = [&](const vec2& p) { return sheet.origin + sheet.axis_u * p.x + sheet.axis_v * p.y; };
    if (e.back) {
        std::reverse(quad.begin(), quad.end());
    }
    for (std::size_t i = 0; i < 4; ++i) {
        cell.corner[i] = at(quad[i]);
        if (cell.shape != PatchCell::Shape::Partial) {
            e.radius = std::max(e.radius, glm::length(cell.corner[i] - e.centre));
        }
    }
}

// Element and cell of what a rectangle of the sheet covers. `whole`: it is known to be covered all over.
void make_cell(Hierarchy& h, const RayScene& rays, Element& e, PatchCell cell, Cover&& found, bool whole) {
    const Sheet& sheet = h.sheets[cell.sheet];
    e.kind = Element::Kind::Patch;
    e.surface = sheet.surface;
    e.normal = e.back ? -sheet.normal : sheet.normal;
    e.patch = std::uint32_t(h.patches.size());
    const vec2 size = found.high - found.low;
    cell.low = found.low;
    cell.high = found.high;
    std::array<vec2, 4> quad{found.low, vec2(found.high.x, found.low.y), found.high, vec2(found.low.x, found.high.y)};
    const double bounds = double(size.x) * size.y;
    const auto about = [](double a, double b) { return std::abs(a - b) <= double(kWhole) * b; };
    vec2 centre(found.centroid);
    if (whole || about(found.area, bounds)) {
        cell.shape = PatchCell::Shape::Rectangle;
        centre = 0.5F * (found.low + found.high);
    } else {
        const std::vector<vec2> around = hull(std::move(found.points), 1e-5F * std::max(size.x, size.y));
        double area = 0.0;
        for (std::size_t i = 1; i + 1 < around.size(); ++i) {
            area += 0.5 * double(cross(around[i] - around[0], around[i + 1] - around[0]));
        }
        if ((around.size() == 3 || around.size() == 4) && about(found.area, area)) {
            cell.shape = PatchCell::Shape::Polygon;
            quad = {around[0], around[1], around[2], around.back()};
        } else {
            cell.shape = PatchCell::Shape::Partial;
            cell.coverage = float(found.area / bounds);
            for (const vec2& p : around) {
                e.radius = std::max(e.radius, glm::length(p - centre)); // of the surface: the corners may lie outside
            }
        }
    }
    e.centre = sheet.origin + sheet.axis_u * centre.x + sheet.axis_v * centre.y;
    e.area = float(found.area);
    set_corners(h, e, cell, quad);
    if (cell.shape != PatchCell::Shape::Rectangle || sheet.varies) {
        cell.first_part = std::uint32_t(h.cell_parts.size());
        cell.part_count = std::uint32_t(found.parts.size());
        h.cell_parts.insert(h.cell_parts.end(), found.parts.begin(), found.parts.end());
    }
    h.patches.push_back(cell);
    h.steps.emplace_back();
    if (!sheet.varies) {
        return;
    }
    const SurfaceColor color = mean_color(h, rays, e);
    e.rho = color.rho;
    e.emitted = color.emitted;
}

vec2 fold(vec2 u) { return u.x + u.y > 1.0F ? vec2(1.0F) - u : u; }
// Pulled in a little, so that no sample lies on an edge shared with a neighbour.
vec2 inside(vec2 u) { return vec2(0.002F) + fold(u) * 0.994F; }

} // namespace

void make_sheet_patch(Hierarchy& h, const RayScene& rays, std::uint32_t index, std::uint32_t sheet_index, bool back) {
    const Sheet& sheet = h.sheets[sheet_index];
    std::vector<CellPart> all(sheet.count);
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
        all[i].triangle = sheet.first + i;
    }
    const float infinite = std::numeric_limits<float>::infinity();
    vec2 low(infinite), high(-infinite);
    for (const CellPart& part : all) {
        for (const vec2& p : h.sheet_triangles[part.triangle].uv) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    Element& e = h.elements[index];
    e.back = back;
    PatchCell cell;
    cell.sheet = sheet_index;
    if (!sheet.varies) {
        const SurfaceColor color =
            color_at(rays, sheet.surface, h.sheet_triangles[sheet.first].triangle, back, vec2(1.0F / 3.0F));
        e.rho = color.rho;
        e.emitted = color.emitted;
    }
    make_cell(h, rays, e, cell, cover(h, all, low, high), false);
}

bool Hierarchy::can_split(std::uint32_t index) const {
    const Element& e = elements[index];
    if (e.kind != Element::Kind::Patch || !e.leaf()) {
        return false;
    }
    const vec2 size = patches[e.patch].high - patches[e.patch].low;
    return std::max(size.x, size.y) > 2.0F * settings.smallest_patch;
}

void Hierarchy::split(std::uint32_t index, const RayScene& rays) {
    ATRIUM_CHECK(elements[index].kind == Element::Kind::Patch && elements[index].leaf());
    const PatchCell cell = patches[elements[index].patch];
    const vec2 size = cell.high - cell.low;
    const vec2 middle = 0.5F * (cell.low + cell.high);
    const std::array<bool, 2> cut_along{size.x * kLong >= size.y, size.y * kLong >= size.x};
    const bool whole = cell.shape == PatchCell::Shape::Rectangle;
    const std::vector<CellPart> parts(cell_parts.begin() + cell.first_part,
                                      cell_parts.begin() + cell.first_part + cell.part_count);
    const auto first = std::uint32_t(elements.size());
    CellStep step;
    step.middle = middle;
    step.first_child = first;
    step.first_cell = std::uint32_t(patches.size());
    step.cut = std::uint8_t((cut_along[0] ? 1U : 0U) | (cut_along[1] ? 2U : 0U));
    double sum = 0.0;
    for (unsigned quadrant = 0; quadrant < 4; ++quadrant) {
        const std::array<bool, 2> upper{(quadrant & 1U) != 0, (quadrant & 2U) != 0};
        if ((upper[0] && !cut_along[0]) || (upper[1] && !cut_along[1])) {
            continue;
        }
        vec2 low = cell.low, high = cell.high;
        for (int axis = 0; axis < 2; ++axis) {
            if (cut_along[std::size_t(axis)]) {
                (upper[std::size_t(axis)] ? low : high)[axis] = middle[axis];
            }
        }
        Cover found = cover(*this, parts, low, high);
        const double bounds = double(high.x - low.x) * (high.y - low.y);
        if (whole) {
            found.low = low;
            found.high = high;
            found.area = bounds;
        } else if (!(found.area > double(kNothing) * bounds)) {
            continue;
        }
        Element child;
        const Element& parent = elements[index];
        child.back = parent.back;
        child.parent = index;
        child.path = hash_combine(parent.path, quadrant + 1);
        child.rho = parent.rho;
        child.emitted = parent.emitted;
        child.direct = parent.direct;
        child.caustic = parent.caustic;
        child.irradiance = parent.irradiance;
        child.radiosity = parent.radiosity;
        PatchCell part;
        part.sheet = cell.sheet;
        part.quadrant = std::uint8_t(quadrant);
        make_cell(*this, rays, child, part, std::move(found), whole);
        sum += double(child.area);
        elements.push_back(child);
        if (!room.empty()) {
            room.push_back(room[index]);
        }
        step.present = std::uint8_t(step.present | 1U << quadrant);
    }
    steps[elements[index].patch] = step;
    Element& parent = elements[index];
    parent.first_child = first;
    parent.child_count = std::uint16_t(elements.size() - first);
    // Crumbs that no child took are shared out: areas add up.
    for (std::uint32_t c = first; c < elements.size(); ++c) {
        elements[c].area = float(double(elements[c].area) * (double(parent.area) / sum));
    }
}

CellPoint point_in_parts(const Hierarchy& h, const PatchCell& cell, vec2 u) {
    CellPoint out;
    const auto begin = h.cell_parts.begin() + cell.first_part;
    const auto end = begin + cell.part_count;
    const float at = u.x * (end - 1)->upto;
    const auto chosen = std::min(
        std::upper_bound(begin, end, at, [](float value, const CellPart& part) { return value < part.upto; }), end - 1);
    const float before = chosen == begin ? 0.0F : (chosen - 1)->upto;
    const SheetTriangle& triangle = h.sheet_triangles[chosen->triangle];
    const Outline outline = clip(triangle.uv, cell.low, cell.high);
    float rest = std::clamp((at - before) / (chosen->upto - before), 0.0F, 0.99999994F) * outline.area();
    vec2 p = outline.point[0];
    for (std::size_t i = 1; i + 1 < outline.count; ++i) {
        const vec2 b = outline.point[i] - outline.point[0], c = outline.point[i + 1] - outline.point[0];
        const float area = 0.5F * std::abs(cross(b, c));
        if (rest < area || i + 2 == outline.count) {
            const vec2 v = inside({area > 0.0F ? std::min(rest / area, 1.0F) : 0.0F, u.y});
            p = outline.point[0] + b * v.x + c * v.y;
            break;
        }
        rest -= area;
    }
    const vec2 e1 = triangle.uv[1] - triangle.uv[0], e2 = triangle.uv[2] - triangle.uv[0], d = p - triangle.uv[0];
    const float determinant = cross(e1, e2);
    out.triangle = triangle.triangle;
    out.barycentric = determinant != 0.0F ? vec2(cross(d, e2), cross(e1, d)) / determinant : vec2(1.0F / 3.0F);
    const Sheet& sheet = h.sheets[cell.sheet];
    out.position = sheet.origin + sheet.axis_u * p.x + sheet.axis_v * p.y;
    return out;
}

CellPoint point_in_cell(const Hierarchy& h, const PatchCell& cell, vec2 u) {
    CellPoint out;
    const std::array<vec3, 4>& p = cell.corner;
    if (cell.shape == PatchCell::Shape::Rectangle) {
        const vec2 v = vec2(0.002F) + u * 0.996F;
        out.position = p[0] + (p[1] - p[0]) * v.x + (p[3] - p[0]) * v.y;
        return out;
    }
    if (cell.shape == PatchCell::Shape::Partial) {
        return point_in_parts(h, cell, u);
    }
    const float first = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    const float second = glm::length(glm::cross(p[2] - p[0], p[3] - p[0]));
    const float at = u.x * (first + second);
    const bool in_first = at < first;
    const vec2 v = inside({in_first ? at / first : std::min((at - first) / std::max(second, 1e-30F), 1.0F), u.y});
    const std::size_t k = in_first ? 1 : 2;
    out.position = p[0] + (p[k] - p[0]) * v.x + (p[k + 1] - p[0]) * v.y;
    return out;
}

} // namespace atrium
