// Every action of the editor in one table: text, key, icon, help. Menus, tool bar and the list of keys are made from it.
#pragma once

#include <QAction>
#include <QObject>

#include <cstdint>
#include <span>
#include <vector>

namespace atrium::ui {

enum class ActionId : std::uint8_t {
    New,
    Open,
    Import,
    Save,
    SaveAs,
    Revert,
    RecoveredWork,
    FindImages,
    Preferences,
    ExportGltf,
    ExportPicture,
    Quit,
    Undo,
    Redo,
    Cut,
    Copy,
    Paste,
    PasteInPlace,
    CopyMaterial,
    PasteMaterial,
    Duplicate,
    Delete,
    Rename,
    Hide,
    ShowAll,
    Isolate,
    Lock,
    Group,
    SelectAll,
    SelectNone,
    AddPolygon,
    AddBox,
    AddSphere,
    AddCylinder,
    AddCone,
    AddDisc,
    AddPointLight,
    AddSpotLight,
    AddSun,
    AddDaylight,
    AddAreaLight,
    AddLuminaire,
    AddCamera,
    ToolSelect,
    ToolMove,
    ToolRotate,
    ToolScale,
    Snap,
    SlideOnSurfaces,
    TurnToSurface,
    OwnAxes,
    DropToSurface,
    ToolMeasure,
    CopyPoints,
    RemovePoints,
    FrameSelection,
    FrameAll,
    WalkMode,
    OrbitSelection,
    NextCamera,
    PreviousCamera,
    ExposureUp,
    ExposureDown,
    ExposureReset,
    Wireframe,
    CausticBoxes,
    TexelGrid,
    ParticleLandings,
    CausticsFlat,
    CausticsOnMesh,
    CausticsInTextures,
    CausticsWhole,
    ElementMesh,
    ElementLinks,
    SubdivisionLevel,
    LinkDensity,
    ParticleWays,
    PassageOctree,
    LastUpdate,
    ErrorEstimate,
    Histogram,
    InspectCaustics,
    Convergence,
    CutWalls,
    ShowPicture,
    ShowIlluminance,
    ShowLuminance,
    Contours,
    ShowDirect,
    ShowDiffuse,
    ShowCaustic,
    Library,
    StopLight,
    ResumeLight,
    Commands,
    Shortcuts,
    About,
    Count
};

/// One row of the table; the texts are source texts for tr() in the context "Actions".
struct ActionInfo {
    ActionId id;
    const char* key;  ///< object name, stable, for tests and settings
    const char* text; ///< with mnemonic
    const char* shortcut;
    const char* icon; ///< file name below :/icons without .svg; empty = none
    const char* tip;  ///< one sentence: tool tip and status tip
    bool checkable = false;
};
std::span<const ActionInfo> action_table();

/// Owns the QActions. UI thread only.
class Actions : public QObject {
    Q_OBJECT
public:
    explicit Actions(QObject* parent = nullptr);
    [[nodiscard]] QAction* operator[](ActionId id) const { return actions_[std::size_t(id)]; }
    void refresh_icons(); ///< after the palette changed

private:
    std::vector<QAction*> actions_;
};

} // namespace atrium::ui
