// The elements of a solution as figures: where leaves lie, how fine they are and what they exchange light with.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/math.h"
#include "engine/scene/scene.h"
#include "engine/solver/solution.h"

#include <array>
#include <optional>
#include <vector>

namespace atrium {

/// What there is to tell about a leaf of the hierarchy.
struct LeafFigures {
    std::uint32_t level = 0; ///< cuts from a whole planar piece down to it; 0 for groups of small faces
    std::uint32_t links = 0; ///< other leaves that it exchanges light with
    float area = 0.0F;       ///< square metres
    bool faces = false;      ///< a group of small faces, not a cell of a planar piece
};

/// The leaves on one (node, part) in the node's own coordinates. Both sides have leaves of their own.
struct SurfaceElements {
    NodeId node;
    std::uint32_t part = 0;
    std::vector<std::array<vec3, 3>> triangles; ///< counter-clockwise in the world from the leaf's side
    std::vector<std::uint32_t> triangle_leaf;   ///< of each
    std::vector<std::array<vec3, 2>> lines;     ///< borders of leaves
    std::vector<vec3> line_normal;              ///< of each: of the side, unit
    std::vector<std::uint32_t> line_leaf;
};

/// All leaves of a solution.
struct ElementView {
    std::vector<LeafFigures> leaves;
    std::vector<SurfaceElements> surfaces;
};

/// The leaves of all surfaces; null without Solution::insides. Any thread; tens of milliseconds for 100,000 leaves.
std::shared_ptr<const ElementView> view_elements(const Solution& solution);

/// A leaf as the end of a link: world coordinates.
struct LinkEnd {
    std::uint32_t leaf = 0; ///< index into ElementView::leaves
    NodeId node;
    dvec3 centre{0.0};
    dvec3 normal{0.0}; ///< unit
    LeafFigures figures;
    std::vector<std::array<dvec3, 2>> outline;
    std::vector<dvec3> corners; ///< of a shaft: four around it
};
struct ElementLink {
    LinkEnd end;
    double brings = 0; ///< lux
    double share = 0;  ///< of what all links bring together
};
/// A leaf and all that it gets.
struct ElementLinks {
    LinkEnd receiver;
    std::vector<ElementLink> links; ///< the strongest first
    double over_links = 0;          ///< lux, sum of all links: what other surfaces reflect
    double direct = 0;              ///< lux, from lamps, sun and sky
    double caustic = 0;             ///< lux, over mirrors and glass
    double open = 0;                ///< share of what it sends that ends on no element: sky, openings, mirrors
};

/// The leaf at a point of a node's part: node coordinates, on the front or back side. None where no element lies within a
/// thousandth of the surface's size, or without insides. Any thread; below a millisecond for 10,000 triangles.
std::optional<std::uint32_t> leaf_at(const Solution& solution, NodeId node, std::uint32_t part, const vec3& point,
                                     bool back);
/// The links of a leaf; those that bring nothing are left out. Places are where things stood for the solution.
ElementLinks links_of(const Solution& solution, std::uint32_t leaf);

} // namespace atrium
