// What the engine decided about caustics, in words and with units: for the table, its details and tool tips.
#pragma once

#include "engine/solver/solution.h"

#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace atrium::ui {

/// One chart of a surface side that caustic light fell on.
struct CausticRow {
    CausticRecord record;
    QString name;                                                ///< of the surface, with part, chart and side where needed
    std::vector<std::shared_ptr<const CausticTexture>> textures; ///< one per box of the record, in its order
    bool paper = false;                                          ///< made by the algorithms of 2001

    [[nodiscard]] bool has_texture() const { return record.decision == CausticRecord::Decision::Texture; }
    [[nodiscard]] double coverage() const; ///< of the chart's rectangle by its boxes, 0 to 1
    [[nodiscard]] double texel() const;    ///< edge, metres; 0 without a texture
    /// Same place, whatever was decided about it.
    [[nodiscard]] bool same_place(const CausticRow& other) const;
    /// Order of places.
    [[nodiscard]] bool before(const CausticRow& other) const;
    friend bool operator==(const CausticRow&, const CausticRow&) = default;
};

/// All that a solution tells about caustics, in the order of places.
std::vector<CausticRow> caustic_rows(const Scene& scene, const Solution& solution);

/// "Texture", "Mesh": where the light is shown.
QString caustic_decision_text(const CausticRow& row);
/// Why: particles, dispersion or contrast against the threshold, and what was set by hand.
QString caustic_reason_text(const CausticRow& row);
/// What the size of the texels follows; empty without a texture.
QString caustic_sizing_text(const CausticRow& row);
/// Form and width of the kernels; empty without a texture.
QString caustic_kernel_text(const CausticRow& row);
/// Why there is nothing to list: what the solution left out and why; empty where there is something.
QString caustic_nothing_text(const Solution* solution);
/// Textures, memory, particles and shares of the light, in one line.
QString caustic_summary_text(const Solution& solution);

QString count_text(std::uint64_t n);
QString length_text(double metres); ///< "3.2 mm", "45 cm", "2.31 m"
QString lumen_text(double lumen);   ///< "0.4 lm", "1 240 lm"
QString memory_text(std::uint64_t bytes);
QString share_text(double share); ///< "4.2 %"

} // namespace atrium::ui
