// What the user decided about the caustics on a node's surfaces; all of it is automatic unless said otherwise.
#pragma once

#include <cstdint>

namespace atrium {

/// Part of a node (Node::caustics): for every chart and side of its own shape, not for what is below it. Caustic textures
/// change what is shown, never how much light goes where, so this does not either.
struct CausticWish {
    enum class Show : std::uint8_t {
        Automatic, ///< by the tests of engine/caustics/choice.h
        Mesh,      ///< on the mesh's vertices, whatever detail there is
        Texture    ///< in textures, wherever there are particles enough to fill one
    };
    Show show = Show::Automatic;
    float texel = 0.0F;     ///< edge of a texel, metres; 0 = automatic
    float threshold = 0.0F; ///< standard deviations beyond chance that ask for a texture; 0 = automatic
    [[nodiscard]] bool automatic() const { return *this == CausticWish{}; }
    friend bool operator==(const CausticWish&, const CausticWish&) = default;
};
/// "automatic", "mesh" or "texture": the word in files.
inline const char* caustic_show_name(CausticWish::Show show) {
    static constexpr const char* kNames[] = {"automatic", "mesh", "texture"};
    return kNames[std::uint8_t(show)];
}

} // namespace atrium
