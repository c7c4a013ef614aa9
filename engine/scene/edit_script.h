// Edits as a person writes them down: by names, one after the other. What they mean in a scene is found when their turn
// comes.
#pragma once

#include "engine/scene/edit_tools.h"
#include "engine/scene/scene_edit.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace atrium {

/// A node is dragged along positions in its parent's space, one every `interval_ms`.
struct ScriptDrag {
    std::string node; ///< here and below: a node's name, or #N for the N-th of the file (from 0)
    std::vector<dvec3> positions;
    double interval_ms = 16;
    bool settle = true; ///< wait for the complete light after it
};
/// What is absent stays as it is.
struct ScriptMove {
    std::string node;
    std::optional<dvec3> translation;
    std::optional<dquat> rotation;
    std::optional<dvec3> scale;
};
/// Changes a material wherever it is used.
struct ScriptMaterial {
    std::string material; ///< its name, or #N for the N-th of the file
    std::optional<Rgb> base_color;
    std::optional<float> metallic;
    std::optional<float> roughness;
    std::optional<float> transmission;
    std::optional<float> ior;
};
/// Changes a node's light; of a surface that shines itself, what its material emits (intensity in cd/m2).
struct ScriptLight {
    std::string node;
    std::optional<float> intensity;
    std::optional<Rgb> color;
    std::optional<bool> enabled;
};
/// A new object among the roots.
struct ScriptAdd {
    Shape shape;
    Transform transform;
    std::string material; ///< as in ScriptMaterial; empty = a grey of its own
};
struct ScriptDelete {
    std::string node;
};
/// How caustics on a node's own shape are shown, see CausticWish; 0 = automatic.
struct ScriptCaustics {
    std::string node;
    std::optional<CausticWish::Show> show;
    std::optional<float> texel;
    std::optional<float> threshold;
};
struct ScriptUndo {};
struct ScriptRedo {};

struct ScriptEdit {
    std::variant<ScriptDrag, ScriptMove, ScriptMaterial, ScriptLight, ScriptCaustics, ScriptAdd, ScriptDelete, ScriptUndo,
                 ScriptRedo>
        value;

    /// "drag", "move", ...: the word in the file.
    [[nodiscard]] const char* kind() const;
    /// The name that the script gives to what it changes; empty for undo and redo.
    [[nodiscard]] const std::string& target() const;
};

struct EditScript {
    std::string file; ///< for messages
    std::vector<ScriptEdit> edits;

    /// "edits/3 (move Chair)": how messages name an edit.
    [[nodiscard]] std::string place(std::size_t index) const;
};

/// A scene that a script is carried out on, with undo as in the editor: a drag is one entry, and what changes nothing is
/// none.
class ScriptedScene {
public:
    explicit ScriptedScene(Scene scene);
    [[nodiscard]] const Scene& scene() const { return scene_; }

    /// Applies anything but a drag and returns the edit that was applied, for whoever else has this scene; nothing where the
    /// scene stays as it is. Errors say what is wrong; file and place are the caller's to add.
    Result<std::optional<SceneEdit>> apply(const ScriptEdit& edit);
    /// Applies one position of a drag; the drag becomes undoable with end_drag().
    Result<std::optional<SceneEdit>> drag_to(const ScriptDrag& drag, const dvec3& position);
    void end_drag();
    /// The name of what the next undo or redo changes, as its script wrote it; empty when there is nothing.
    [[nodiscard]] std::string undo_target() const { return undo_.empty() ? std::string() : undo_.back().target; }
    [[nodiscard]] std::string redo_target() const { return redo_.empty() ? std::string() : redo_.back().target; }

private:
    struct Done {
        std::string target;
        UndoEntry entry;
    };
    Result<SceneEdit> edit_for(const ScriptMove& e) const;
    Result<SceneEdit> edit_for(const ScriptMaterial& e) const;
    Result<SceneEdit> edit_for(const ScriptLight& e) const;
    Result<SceneEdit> edit_for(const ScriptCaustics& e) const;
    Result<SceneEdit> edit_for(const ScriptAdd& e) const;
    Result<SceneEdit> edit_for(const ScriptDelete& e) const;
    Result<NodeId> node(const std::string& name) const;
    Result<MaterialId> material(const std::string& name) const;
    Result<std::optional<SceneEdit>> step_back(std::vector<Done>& from, std::vector<Done>& to, bool undo);

    Scene scene_;
    std::vector<NodeId> numbered_nodes_; ///< of the file in tree order, then those that the script added
    std::vector<MaterialId> numbered_materials_;
    std::vector<Done> undo_;
    std::vector<Done> redo_;
    GestureEdits gesture_;
    std::string gesture_target_;
};

/// Carries out the whole script on a copy of the scene: finds every wrong name before hours of light.
Result<void> rehearse(const Scene& scene, const EditScript& script);

} // namespace atrium
