// What inspecting the light draws, made from values: no GL, any thread.
#pragma once

#include "engine/debug/element_view.h"
#include "engine/debug/octree_view.h"
#include "engine/debug/particle_view.h"
#include "engine/debug/update_view.h"
#include "engine/measure/local_error.h"
#include "engine/view/false_color.h"
#include "ui/viewport/overlay_batch.h"
#include "ui/viewport/scene_figures.h"

#include <QStringList>

#include <unordered_set>

namespace atrium::ui {

/// What of an element its colour tells.
enum class ElementColors : std::uint8_t {
    None,
    Level, ///< how often its planar piece was cut
    Links, ///< links in each square metre
    Error  ///< how far off the light is likely to be, per cent
};
/// What Solution::insides is needed for.
inline bool of_elements(ElementColors colors) { return colors == ElementColors::Level || colors == ElementColors::Links; }

/// Borders of the leaves on some nodes, of all where `of` is empty.
std::shared_ptr<const FigureSet> element_mesh(const ElementView& view, const std::unordered_set<NodeId>& of);
/// How many leaves these are.
std::size_t count_leaves(const ElementView& view, const std::unordered_set<NodeId>& of);

/// The amount that a colour stands for.
double element_amount(const LeafFigures& leaf, ElementColors colors);
/// A scale that fits all leaves; its quantity means nothing.
FalseColor element_scale(const ElementView& view, ElementColors colors);
/// Every leaf in its colour.
std::shared_ptr<const FigureSet> element_colors(const ElementView& view, ElementColors colors, const FalseColor& scale);

/// Links from the middle of an element to those of the others, the strongest on top, and the shaft to one of them.
void draw_links(OverlayBatch& batch, const CameraController& camera, const ElementLinks& links, std::size_t shaft);
/// "Element of Floor: ..." and what it gets.
QStringList link_words(const Scene& scene, const ElementLinks& links, std::size_t shaft);

/// Every surface in the colour of the error that is likely there: the relative one in per cent.
struct ErrorFigures {
    std::shared_ptr<const FigureSet> set;
    FalseColor scale;
    std::size_t places = 0; ///< that were measured
    double overall = 0;     ///< per cent
};
ErrorFigures error_colors(const Scene& scene, const Solution& solution, const LocalError& error);

/// Ways of particles, coloured by power.
std::shared_ptr<const FigureSet> particle_ways(const ParticleView& view);
QStringList particle_words(const ParticleView& view, bool of_selection);

/// Cells of the octree as boxes, coloured by the particles that cross them.
std::shared_ptr<const FigureSet> octree_cells(const OctreeView& view);
QStringList octree_words(const OctreeView& view, bool of_selection);

/// What changed, as marks of their own colours. Of very many texels some.
std::shared_ptr<const FigureSet> update_marks(const UpdateView& view);
QStringList update_words(const UpdateView& view, double milliseconds);

/// From weak to strong, 0 to 1: readable on white walls and on dark floors alike.
Rgb strength_color(float place);

} // namespace atrium::ui
