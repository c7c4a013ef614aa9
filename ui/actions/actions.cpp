#include "ui/actions/actions.h"

#include "ui/actions/icons.h"

#include <QCoreApplication>
#include <QKeySequence>

#include <array>

namespace atrium::ui {

namespace {

#define ATRIUM_TEXT(text) QT_TRANSLATE_NOOP("Actions", text)

// clang-format off
const std::array kTable = {
    ActionInfo{ActionId::New, "new", ATRIUM_TEXT("&New"), "Ctrl+N", "new", ATRIUM_TEXT("Start an empty scene")},
    ActionInfo{ActionId::Open, "open", ATRIUM_TEXT("&Open..."), "Ctrl+O", "open", ATRIUM_TEXT("Open a glTF file or an Atrium project")},
    ActionInfo{ActionId::Import, "import", ATRIUM_TEXT("&Import..."), "Ctrl+I", "import", ATRIUM_TEXT("Add the objects of another file to this scene, in a group of their own")},
    ActionInfo{ActionId::Save, "save", ATRIUM_TEXT("&Save"), "Ctrl+S", "save", ATRIUM_TEXT("Save the project with its light")},
    ActionInfo{ActionId::SaveAs, "save_as", ATRIUM_TEXT("Save &As..."), "Ctrl+Shift+S", "", ATRIUM_TEXT("Save the project under another name")},
    ActionInfo{ActionId::Revert, "revert", ATRIUM_TEXT("Re&vert..."), "", "", ATRIUM_TEXT("Go back to the file as it was saved; what was changed since is put aside")},
    ActionInfo{ActionId::RecoveredWork, "recovered_work", ATRIUM_TEXT("Recovered &Work..."), "", "", ATRIUM_TEXT("Look at work that was not saved: kept after a crash, reverted or discarded")},
    ActionInfo{ActionId::FindImages, "find_images", ATRIUM_TEXT("&Find Missing Images..."), "", "", ATRIUM_TEXT("Look for the images of materials that were not where the file says")},
    ActionInfo{ActionId::Preferences, "preferences", ATRIUM_TEXT("Prefere&nces..."), "Ctrl+,", "", ATRIUM_TEXT("Language, colours, memory for light, and how often unsaved work is kept")},
    ActionInfo{ActionId::ExportGltf, "export_gltf", ATRIUM_TEXT("Export &glTF..."), "Ctrl+E", "", ATRIUM_TEXT("Write the scene as a glTF file for other programs")},
    ActionInfo{ActionId::ExportPicture, "export_picture", ATRIUM_TEXT("Export &Picture..."), "Ctrl+P", "picture", ATRIUM_TEXT("Render the present view to a PNG or EXR file")},
    ActionInfo{ActionId::Quit, "quit", ATRIUM_TEXT("&Quit"), "Ctrl+Q", "", ATRIUM_TEXT("Close Atrium")},
    ActionInfo{ActionId::Undo, "undo", ATRIUM_TEXT("&Undo"), "Ctrl+Z", "undo", ATRIUM_TEXT("Take back the last change")},
    ActionInfo{ActionId::Redo, "redo", ATRIUM_TEXT("&Redo"), "Ctrl+Shift+Z", "redo", ATRIUM_TEXT("Do again what was taken back")},
    ActionInfo{ActionId::Cut, "cut", ATRIUM_TEXT("Cu&t"), "Ctrl+X", "cut", ATRIUM_TEXT("Take the selected objects out of the scene, to be pasted elsewhere")},
    ActionInfo{ActionId::Copy, "copy", ATRIUM_TEXT("&Copy"), "Ctrl+C", "copy", ATRIUM_TEXT("Copy the selected objects, for this window or another one")},
    ActionInfo{ActionId::Paste, "paste", ATRIUM_TEXT("&Paste"), "Ctrl+V", "paste", ATRIUM_TEXT("Put the copied objects on the surface in the middle of the view")},
    ActionInfo{ActionId::PasteInPlace, "paste_in_place", ATRIUM_TEXT("Paste in P&lace"), "Ctrl+Shift+V", "", ATRIUM_TEXT("Put the copied objects where they were copied from")},
    ActionInfo{ActionId::CopyMaterial, "copy_material", ATRIUM_TEXT("Copy &Material"), "Ctrl+Alt+C", "", ATRIUM_TEXT("Copy the material of the active object")},
    ActionInfo{ActionId::PasteMaterial, "paste_material", ATRIUM_TEXT("Paste M&aterial"), "Ctrl+Alt+V", "", ATRIUM_TEXT("Give the copied material to the selected objects")},
    ActionInfo{ActionId::Duplicate, "duplicate", ATRIUM_TEXT("&Duplicate"), "Ctrl+D", "duplicate", ATRIUM_TEXT("Copy the selected objects in place")},
    ActionInfo{ActionId::Delete, "delete", ATRIUM_TEXT("De&lete"), "Del", "delete", ATRIUM_TEXT("Remove the selected objects")},
    ActionInfo{ActionId::Rename, "rename", ATRIUM_TEXT("Re&name"), "F2", "", ATRIUM_TEXT("Rename the active object in the scene tree")},
    ActionInfo{ActionId::Hide, "hide", ATRIUM_TEXT("&Hide"), "H", "eye_off", ATRIUM_TEXT("Hide the selected objects; hidden objects take no part in the light")},
    ActionInfo{ActionId::ShowAll, "show_all", ATRIUM_TEXT("Sho&w All"), "Alt+H", "eye", ATRIUM_TEXT("Show every hidden object")},
    ActionInfo{ActionId::Isolate, "isolate", ATRIUM_TEXT("&Isolate"), "/", "isolate", ATRIUM_TEXT("Show only the selected objects, in the light of the whole scene; again to show everything"), true},
    ActionInfo{ActionId::Lock, "lock", ATRIUM_TEXT("Loc&k"), "Ctrl+L", "lock", ATRIUM_TEXT("Lock the selected objects in place, or unlock them")},
    ActionInfo{ActionId::Group, "group", ATRIUM_TEXT("&Group"), "Ctrl+G", "group", ATRIUM_TEXT("Put the selected objects into a new group")},
    ActionInfo{ActionId::SelectAll, "select_all", ATRIUM_TEXT("Select &All"), "Ctrl+A", "", ATRIUM_TEXT("Select every object that is shown and not locked")},
    ActionInfo{ActionId::SelectNone, "select_none", ATRIUM_TEXT("Select N&one"), "Ctrl+Shift+A", "", ATRIUM_TEXT("Select nothing")},
    ActionInfo{ActionId::AddPolygon, "add_polygon", ATRIUM_TEXT("&Polygon"), "", "polygon", ATRIUM_TEXT("Add a flat rectangle")},
    ActionInfo{ActionId::AddBox, "add_box", ATRIUM_TEXT("&Box"), "", "box", ATRIUM_TEXT("Add a box")},
    ActionInfo{ActionId::AddSphere, "add_sphere", ATRIUM_TEXT("&Sphere"), "", "sphere", ATRIUM_TEXT("Add a sphere")},
    ActionInfo{ActionId::AddCylinder, "add_cylinder", ATRIUM_TEXT("C&ylinder"), "", "cylinder", ATRIUM_TEXT("Add a cylinder")},
    ActionInfo{ActionId::AddCone, "add_cone", ATRIUM_TEXT("&Cone"), "", "cone", ATRIUM_TEXT("Add a cone")},
    ActionInfo{ActionId::AddDisc, "add_disc", ATRIUM_TEXT("&Disc"), "", "disc", ATRIUM_TEXT("Add a disc")},
    ActionInfo{ActionId::AddPointLight, "add_point_light", ATRIUM_TEXT("P&oint Light"), "", "point_light", ATRIUM_TEXT("Add a lamp that shines in all directions")},
    ActionInfo{ActionId::AddSpotLight, "add_spot_light", ATRIUM_TEXT("Spo&t Light"), "", "spot_light", ATRIUM_TEXT("Add a lamp with a cone of light")},
    ActionInfo{ActionId::AddSun, "add_sun", ATRIUM_TEXT("S&un"), "", "sun", ATRIUM_TEXT("Add sunlight")},
    ActionInfo{ActionId::AddDaylight, "add_daylight", ATRIUM_TEXT("Day&light"), "", "sun", ATRIUM_TEXT("Add a sun and a sky in one step")},
    ActionInfo{ActionId::AddAreaLight, "add_area_light", ATRIUM_TEXT("&Area Light"), "", "area_light", ATRIUM_TEXT("Add a luminous disc")},
    ActionInfo{ActionId::AddLuminaire, "add_luminaire", ATRIUM_TEXT("&IES Luminaire..."), "", "spot_light", ATRIUM_TEXT("Add a lamp that shines as a maker's photometric file (IES, EULUMDAT) says")},
    ActionInfo{ActionId::AddCamera, "add_camera", ATRIUM_TEXT("Ca&mera"), "", "camera", ATRIUM_TEXT("Add a camera that sees the present view")},
    ActionInfo{ActionId::ToolSelect, "tool_select", ATRIUM_TEXT("&Select"), "Q", "select", ATRIUM_TEXT("Select objects by clicking or with a box; drag what is selected to move it"), true},
    ActionInfo{ActionId::ToolMove, "tool_move", ATRIUM_TEXT("&Move"), "W", "move", ATRIUM_TEXT("Move the selected objects"), true},
    ActionInfo{ActionId::ToolRotate, "tool_rotate", ATRIUM_TEXT("&Rotate"), "E", "rotate", ATRIUM_TEXT("Turn the selected objects"), true},
    ActionInfo{ActionId::ToolScale, "tool_scale", ATRIUM_TEXT("S&cale"), "R", "scale", ATRIUM_TEXT("Scale the selected objects"), true},
    ActionInfo{ActionId::Snap, "snap", ATRIUM_TEXT("S&nap"), "Y", "snap", ATRIUM_TEXT("Move, turn and scale in steps and onto faces of other objects; Ctrl turns this round while dragging"), true},
    ActionInfo{ActionId::SlideOnSurfaces, "slide_on_surfaces", ATRIUM_TEXT("Slide on S&urfaces"), "U", "slide", ATRIUM_TEXT("An object that is dragged goes on the floor, table or wall under the cursor"), true},
    ActionInfo{ActionId::TurnToSurface, "turn_to_surface", ATRIUM_TEXT("Turn &with Surfaces"), "Shift+U", "", ATRIUM_TEXT("An object that slides onto another surface turns with it, as pictures and wall lights do"), true},
    ActionInfo{ActionId::OwnAxes, "own_axes", ATRIUM_TEXT("&Own Axes"), "T", "", ATRIUM_TEXT("Move and turn along the axes of the object instead of those of the world"), true},
    ActionInfo{ActionId::DropToSurface, "drop_to_surface", ATRIUM_TEXT("Drop to Sur&face"), "End", "drop", ATRIUM_TEXT("Lower the selected objects until they rest on what is below")},
    ActionInfo{ActionId::ToolMeasure, "tool_measure", ATRIUM_TEXT("M&easure Light"), "M", "measure", ATRIUM_TEXT("Read the light under the cursor; a click leaves a measuring point, a click on one removes it"), true},
    ActionInfo{ActionId::CopyPoints, "copy_points", ATRIUM_TEXT("Cop&y Measuring Points"), "Ctrl+Shift+M", "", ATRIUM_TEXT("Copy all measuring points with their light to the clipboard, as CSV")},
    ActionInfo{ActionId::RemovePoints, "remove_points", ATRIUM_TEXT("Rem&ove Measuring Points"), "", "", ATRIUM_TEXT("Take all measuring points away")},
    ActionInfo{ActionId::FrameSelection, "frame_selection", ATRIUM_TEXT("&Frame Selection"), "F", "frame", ATRIUM_TEXT("Bring the selected objects into view")},
    ActionInfo{ActionId::FrameAll, "frame_all", ATRIUM_TEXT("Frame &All"), "Home", "frame_all", ATRIUM_TEXT("Bring the whole scene into view")},
    ActionInfo{ActionId::WalkMode, "walk_mode", ATRIUM_TEXT("&Walk"), "Ctrl+W", "walk", ATRIUM_TEXT("Walk through the room: W A S D to go, mouse to look, Esc to leave"), true},
    ActionInfo{ActionId::OrbitSelection, "orbit_selection", ATRIUM_TEXT("&Orbit about Selection"), "Shift+O", "", ATRIUM_TEXT("Turn the view about what is selected instead of about the point under the cursor"), true},
    ActionInfo{ActionId::NextCamera, "next_camera", ATRIUM_TEXT("&Next Camera"), "Ctrl+PgDown", "", ATRIUM_TEXT("Look through the next camera of the scene")},
    ActionInfo{ActionId::PreviousCamera, "previous_camera", ATRIUM_TEXT("&Previous Camera"), "Ctrl+PgUp", "", ATRIUM_TEXT("Look through the camera before")},
    ActionInfo{ActionId::ExposureUp, "exposure_up", ATRIUM_TEXT("&Brighter"), "Ctrl++", "brighter", ATRIUM_TEXT("Raise the exposure by a third of a stop")},
    ActionInfo{ActionId::ExposureDown, "exposure_down", ATRIUM_TEXT("&Darker"), "Ctrl+-", "darker", ATRIUM_TEXT("Lower the exposure by a third of a stop")},
    ActionInfo{ActionId::ExposureReset, "exposure_reset", ATRIUM_TEXT("Automatic &Exposure"), "Ctrl+0", "", ATRIUM_TEXT("Go back to automatic exposure")},
    ActionInfo{ActionId::Wireframe, "wireframe", ATRIUM_TEXT("Wire&frame"), "Z", "wireframe", ATRIUM_TEXT("Draw the edges of the light mesh over the picture"), true},
    ActionInfo{ActionId::CausticBoxes, "caustic_boxes", ATRIUM_TEXT("Caustic Bo&xes"), "Shift+B", "", ATRIUM_TEXT("Outline the textures that hold light bundled by mirrors and glass"), true},
    ActionInfo{ActionId::TexelGrid, "texel_grid", ATRIUM_TEXT("Te&xel Grid"), "Shift+G", "", ATRIUM_TEXT("Draw lines between the texels of the selected objects' caustics, where these are large enough to be seen"), true},
    ActionInfo{ActionId::ParticleLandings, "particle_landings", ATRIUM_TEXT("&Particle Landings"), "Shift+P", "", ATRIUM_TEXT("Draw every particle where it landed on the selected objects; takes memory while it is on"), true},
    ActionInfo{ActionId::CausticsFlat, "caustics_flat", ATRIUM_TEXT("&Flat: One Value per Face"), "Alt+1", "", ATRIUM_TEXT("Show every face of the mesh in the mean of its light"), true},
    ActionInfo{ActionId::CausticsOnMesh, "caustics_on_mesh", ATRIUM_TEXT("Caustics on the &Mesh"), "Alt+2", "", ATRIUM_TEXT("Show caustics at the corners of the mesh, without textures"), true},
    ActionInfo{ActionId::CausticsInTextures, "caustics_in_textures", ATRIUM_TEXT("Caustics in &Textures"), "Alt+3", "", ATRIUM_TEXT("Show the light as it is computed"), true},
    ActionInfo{ActionId::CausticsWhole, "caustics_whole", ATRIUM_TEXT("Textures without &Restriction"), "Alt+4", "", ATRIUM_TEXT("Show caustics as if the same number of texels covered whole surfaces"), true},
    ActionInfo{ActionId::ElementMesh, "element_mesh", ATRIUM_TEXT("&Element Mesh"), "Shift+E", "", ATRIUM_TEXT("Draw the borders of the elements that light is computed with: of the selection, or of everything where nothing is selected"), true},
    ActionInfo{ActionId::ElementLinks, "element_links", ATRIUM_TEXT("&Links of an Element"), "Shift+L", "", ATRIUM_TEXT("Click a surface to see which other elements light its element, and how much each of them brings"), true},
    ActionInfo{ActionId::SubdivisionLevel, "subdivision_level", ATRIUM_TEXT("&Subdivision Level"), "Shift+D", "", ATRIUM_TEXT("Show in false colour how often surfaces were divided into elements"), true},
    ActionInfo{ActionId::LinkDensity, "link_density", ATRIUM_TEXT("Link &Density"), "Shift+K", "", ATRIUM_TEXT("Show in false colour how many links elements have in each square metre"), true},
    ActionInfo{ActionId::ParticleWays, "particle_ways", ATRIUM_TEXT("&Ways of Particles"), "Shift+W", "", ATRIUM_TEXT("Draw some hundred particles of the selection on their way over mirrors and glass; of everything where nothing is selected"), true},
    ActionInfo{ActionId::PassageOctree, "passage_octree", ATRIUM_TEXT("&Octree of Particles"), "Shift+Q", "", ATRIUM_TEXT("Draw the cells of the octree that finds the particles near the selected object when it moves"), true},
    ActionInfo{ActionId::LastUpdate, "last_update", ATRIUM_TEXT("Last &Update"), "Shift+C", "", ATRIUM_TEXT("Mark for some seconds the texels, vertices and caustic textures that the last update of the light changed"), true},
    ActionInfo{ActionId::ErrorEstimate, "error_estimate", ATRIUM_TEXT("E&rror Estimate"), "Shift+R", "", ATRIUM_TEXT("Measure how far off the light is at some hundred places, and show in false colour what follows for all others"), true},
    ActionInfo{ActionId::Histogram, "histogram", ATRIUM_TEXT("&Histogram"), "Shift+H", "", ATRIUM_TEXT("Show beside the legend in false colour how often amounts occur: on the selection, or on everything where nothing is selected"), true},
    ActionInfo{ActionId::InspectCaustics, "inspect_caustics", ATRIUM_TEXT("Inspect Caus&tics"), "Ctrl+Shift+C", "", ATRIUM_TEXT("List every surface that caustics fall on: what was decided, why, and what can be set by hand")},
    ActionInfo{ActionId::Convergence, "convergence", ATRIUM_TEXT("C&onvergence"), "Ctrl+Shift+E", "", ATRIUM_TEXT("Plot the estimated error against run time, with every figure of the solution")},
    ActionInfo{ActionId::CutWalls, "cut_walls", ATRIUM_TEXT("&Look through Near Walls"), "", "", ATRIUM_TEXT("From outside, leave out the walls and the ceiling that hide the room"), true},
    ActionInfo{ActionId::ShowPicture, "show_picture", ATRIUM_TEXT("&Picture"), "F5", "", ATRIUM_TEXT("Show the room as the eye sees it"), true},
    ActionInfo{ActionId::ShowIlluminance, "show_illuminance", ATRIUM_TEXT("&Illuminance"), "F6", "", ATRIUM_TEXT("Show in false colour how much light arrives on surfaces, in lux"), true},
    ActionInfo{ActionId::ShowLuminance, "show_luminance", ATRIUM_TEXT("&Luminance"), "F7", "", ATRIUM_TEXT("Show in false colour how bright surfaces look, in cd/m\u00b2"), true},
    ActionInfo{ActionId::Contours, "contours", ATRIUM_TEXT("&Contour Lines"), "C", "", ATRIUM_TEXT("Draw lines of equal light at the round values of the legend, in false colour"), true},
    ActionInfo{ActionId::ShowDirect, "show_direct", ATRIUM_TEXT("D&irect Light"), "Ctrl+1", "", ATRIUM_TEXT("Show the light that comes straight from lamps, sun and sky"), true},
    ActionInfo{ActionId::ShowDiffuse, "show_diffuse", ATRIUM_TEXT("Diff&use Light"), "Ctrl+2", "", ATRIUM_TEXT("Show the light that other surfaces reflect"), true},
    ActionInfo{ActionId::ShowCaustic, "show_caustic", ATRIUM_TEXT("&Caustics"), "Ctrl+3", "", ATRIUM_TEXT("Show the light that mirrors and glass throw onto surfaces"), true},
    ActionInfo{ActionId::Library, "library", ATRIUM_TEXT("&Library"), "Ctrl+B", "library", ATRIUM_TEXT("Shapes, materials, lamps and furniture to drag into the room"), true},
    ActionInfo{ActionId::StopLight, "stop_light", ATRIUM_TEXT("&Stop"), "Ctrl+.", "stop", ATRIUM_TEXT("Stop computing light; the last picture stays")},
    ActionInfo{ActionId::ResumeLight, "resume_light", ATRIUM_TEXT("&Resume"), "Ctrl+R", "resume", ATRIUM_TEXT("Compute the light of the present scene")},
    ActionInfo{ActionId::Commands, "commands", ATRIUM_TEXT("&Find Command..."), "Ctrl+K", "search", ATRIUM_TEXT("Find a command by typing its name")},
    ActionInfo{ActionId::Shortcuts, "shortcuts", ATRIUM_TEXT("&Keyboard Shortcuts"), "F1", "", ATRIUM_TEXT("List every key and what it does")},
    ActionInfo{ActionId::About, "about", ATRIUM_TEXT("&About Atrium"), "", "", ATRIUM_TEXT("Version and licence")},
};
// clang-format on
static_assert(kTable.size() == std::size_t(ActionId::Count));

#undef ATRIUM_TEXT

QString translated(const char* text) { return QCoreApplication::translate("Actions", text); }

} // namespace

std::span<const ActionInfo> action_table() { return kTable; }

Actions::Actions(QObject* parent) : QObject(parent) {
    actions_.resize(kTable.size());
    for (const ActionInfo& info : kTable) {
        auto* action = new QAction(translated(info.text), this);
        action->setObjectName(QLatin1StringView(info.key));
        action->setShortcut(QKeySequence(QLatin1StringView(info.shortcut), QKeySequence::PortableText));
        action->setCheckable(info.checkable);
        action->setStatusTip(translated(info.tip));
        const QString key = action->shortcut().toString(QKeySequence::NativeText);
        action->setToolTip(key.isEmpty() ? translated(info.tip) : QStringLiteral("%1 (%2)").arg(translated(info.tip), key));
        actions_[std::size_t(info.id)] = action;
    }
    actions_[std::size_t(ActionId::Quit)]->setMenuRole(QAction::QuitRole);
    actions_[std::size_t(ActionId::About)]->setMenuRole(QAction::AboutRole);
    refresh_icons();
}

void Actions::refresh_icons() {
    for (const ActionInfo& info : kTable) {
        actions_[std::size_t(info.id)]->setIcon(tinted_icon(QLatin1StringView(info.icon)));
    }
}

} // namespace atrium::ui
