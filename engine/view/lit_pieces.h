// All that shines or is lit, cut in small pieces, as a tree to pick from: lamps' surfaces, patches in the sun, walls.
#pragma once

#include "engine/base/run_context.h"
#include "engine/view/lit_scene.h"

#include <functional>
#include <vector>

namespace atrium {

/// Pieces of triangles, picked by how much of their light may reach a point. A way to place rays: what
/// is picked, and with what density, is known for any point, so that it can be weighed against other ways. Immutable; safe
/// from any thread. The scene must outlive it.
class LitPieces {
public:
    /// Stops early, with no pieces, when the context says so.
    LitPieces(const LitScene& lit, const RunContext& context);

    struct Spot {
        Hit hit;              ///< as a ray from the point would meet it; t is the distance
        vec3 direction{0.0F}; ///< unit, from the point
        float density = 0.0F; ///< per solid angle with which it was picked
    };
    /// Picks a place that a point with unit `normal` may see. False where there is none, or the number falls on one whose
    /// back is turned.
    [[nodiscard]] bool pick(const vec3& point, const vec3& normal, float which, const vec2& where, Spot& spot) const;
    /// Density per solid angle with which pick() would come to a hit of a ray of that unit direction; 0 where never.
    [[nodiscard]] float density(const vec3& point, const vec3& normal, const Hit& hit, const vec3& direction,
                                float distance) const;
    [[nodiscard]] std::size_t size() const { return pieces_.size(); }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    struct Piece {
        std::uint32_t surface = 0;
        std::uint32_t triangle = 0;
        std::uint16_t cell = 0;  ///< see cell_of()
        std::uint16_t cells = 1; ///< the triangle's edges are cut in so many
        bool back = false;
        float area = 0.0F;
        float power = 0.0F; ///< mean luminance times area
        std::uint32_t leaf = 0;
    };
    struct Node {
        Box3 box;
        float power = 0.0F;
        vec3 axis{0.0F};     ///< unit: the sides of all pieces face within `spread` of it
        float spread = 0.0F; ///< radians
        std::uint32_t parent = kNone;
        std::uint32_t left = kNone;  ///< leaves: kNone
        std::uint32_t right = kNone; ///< leaves: the piece
    };
    /// Pieces of one triangle side: cell -> piece.
    struct Cut {
        std::uint16_t cells = 0; ///< 0: none of it is lit
        std::uint32_t first = 0; ///< into cell_pieces_
    };
    void build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end, std::uint32_t node);
    [[nodiscard]] static float importance(const Node& node, const vec3& point, const vec3& normal);
    [[nodiscard]] std::array<vec2, 3> corners_of(const Piece& piece) const;
    [[nodiscard]] vec3 side_of(const Piece& piece) const; ///< unit normal
    [[nodiscard]] vec3 position(const Piece& piece, const vec2& barycentric) const;

    const LitScene& lit_;
    std::vector<Piece> pieces_;
    std::vector<Node> nodes_;
    std::vector<std::vector<Cut>> cuts_; ///< per surface (empty = none), two per triangle: front, back
    std::vector<std::uint32_t> cell_pieces_;
};

} // namespace atrium
