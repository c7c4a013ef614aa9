#include "engine/scene/edit_script.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace atrium {
namespace {

struct Kind {
    const char* operator()(const ScriptDrag&) const { return "drag"; }
    const char* operator()(const ScriptMove&) const { return "move"; }
    const char* operator()(const ScriptMaterial&) const { return "material"; }
    const char* operator()(const ScriptLight&) const { return "light"; }
    const char* operator()(const ScriptCaustics&) const { return "caustics"; }
    const char* operator()(const ScriptAdd&) const { return "add"; }
    const char* operator()(const ScriptDelete&) const { return "delete"; }
    const char* operator()(const ScriptUndo&) const { return "undo"; }
    const char* operator()(const ScriptRedo&) const { return "redo"; }
};
struct Target {
    static const std::string& none() {
        static const std::string empty;
        return empty;
    }
    const std::string& operator()(const ScriptDrag& e) const { return e.node; }
    const std::string& operator()(const ScriptMove& e) const { return e.node; }
    const std::string& operator()(const ScriptMaterial& e) const { return e.material; }
    const std::string& operator()(const ScriptLight& e) const { return e.node; }
    const std::string& operator()(const ScriptCaustics& e) const { return e.node; }
    const std::string& operator()(const ScriptAdd& e) const { return e.shape.name; }
    const std::string& operator()(const ScriptDelete& e) const { return e.node; }
    const std::string& operator()(const ScriptUndo&) const { return none(); }
    const std::string& operator()(const ScriptRedo&) const { return none(); }
};

/// N of "#N"; nothing for any other text.
std::optional<std::size_t> number_of(const std::string& name) {
    std::size_t out = 0;
    const char* end = name.data() + name.size();
    if (name.size() < 2 || name[0] != '#') {
        return {};
    }
    const auto read = std::from_chars(name.data() + 1, end, out);
    return read.ec == std::errc() && read.ptr == end ? std::optional(out) : std::nullopt;
}

/// The one thing of this name, or of this number in `numbered`. `kind` is "node" or "material".
template <class T>
Result<Id<T>> look_up(const SlotMap<T>& map, const std::vector<Id<T>>& numbered, const std::string& name,
                      const std::string& kind) {
    if (const auto n = number_of(name)) {
        if (*n >= numbered.size()) {
            return fail("", "",
                        "there is no " + kind + " " + name + ", only " + std::to_string(numbered.size()) +
                            ", the first of them #0");
        }
        if (!map.contains(numbered[*n])) {
            return fail("", "", kind + " " + name + " was deleted by an edit before this one");
        }
        return numbered[*n];
    }
    Id<T> found;
    std::string all;
    std::size_t count = 0;
    map.for_each([&](Id<T> id, const T& value) {
        if (value.name == name) {
            found = id;
            const auto at = std::find(numbered.begin(), numbered.end(), id);
            all += (count++ > 0 ? ", #" : "#") + std::to_string(at - numbered.begin());
        }
    });
    if (count == 0) {
        return fail("", "", "there is no " + kind + " named '" + name + "'",
                    "Names are those of the scene at this point of the script, capital letters and all.");
    }
    if (count > 1) {
        return fail("", "", std::to_string(count) + " " + kind + "s are named '" + name + "'",
                    "Write the number of the one that is meant: " + all + ".");
    }
    return found;
}

template <class T> void set_if(T& value, const std::optional<T>& wish) {
    if (wish) {
        value = *wish;
    }
}

} // namespace

const char* ScriptEdit::kind() const { return std::visit(Kind{}, value); }
const std::string& ScriptEdit::target() const { return std::visit(Target{}, value); }

std::string EditScript::place(std::size_t index) const {
    const std::string& target = edits[index].target();
    return "edits/" + std::to_string(index) + " (" + edits[index].kind() + (target.empty() ? "" : " " + target) + ")";
}

ScriptedScene::ScriptedScene(Scene scene)
    : scene_(std::move(scene)), numbered_nodes_(scene_.in_tree_order()), numbered_materials_(scene_.materials.keys()) {}

Result<NodeId> ScriptedScene::node(const std::string& name) const {
    return look_up(scene_.nodes, numbered_nodes_, name, "node");
}
Result<MaterialId> ScriptedScene::material(const std::string& name) const {
    return look_up(scene_.materials, numbered_materials_, name, "material");
}

Result<SceneEdit> ScriptedScene::edit_for(const ScriptMove& e) const {
    return node(e.node).map([&](NodeId id) {
        Transform t = scene_.nodes.find(id)->transform;
        set_if(t.translation, e.translation);
        set_if(t.rotation, e.rotation);
        set_if(t.scale, e.scale);
        return SceneEdit{SetTransform{id, t}};
    });
}

Result<SceneEdit> ScriptedScene::edit_for(const ScriptMaterial& e) const {
    return material(e.material).map([&](MaterialId id) {
        Material m = *scene_.materials.find(id);
        set_if(m.base_color, e.base_color);
        set_if(m.metallic, e.metallic);
        set_if(m.roughness, e.roughness);
        set_if(m.transmission, e.transmission);
        set_if(m.ior, e.ior);
        return SceneEdit{SetResource<Material>{id, std::move(m)}};
    });
}

Result<SceneEdit> ScriptedScene::edit_for(const ScriptLight& e) const {
    const auto id = node(e.node);
    if (!id) {
        return tl::unexpected(id.error());
    }
    const Node& lamp = *scene_.nodes.find(*id);
    if (const Light* found = scene_.lights.find(lamp.light)) {
        Light light = *found;
        set_if(light.intensity, e.intensity);
        set_if(light.color, e.color);
        set_if(light.enabled, e.enabled);
        return SceneEdit{SetResource<Light>{lamp.light, std::move(light)}};
    }
    // A surface that shines: its colour times its strength is what it emits. One that was switched off has strength 0.
    std::vector<MaterialId> shining;
    for (const MaterialId m : lamp.materials) {
        const Material* found = scene_.materials.find(m);
        if (found != nullptr && max_component(found->emissive_color) > 0.0F &&
            std::find(shining.begin(), shining.end(), m) == shining.end()) {
            shining.push_back(m);
        }
    }
    if (shining.empty()) {
        return fail("", "", "the node has no light, and no material of it emits any", "Name the node that the light is on.");
    }
    std::vector<SceneEdit> edits;
    for (const MaterialId m : shining) {
        Material material = *scene_.materials.find(m);
        set_if(material.emissive_strength, e.intensity);
        set_if(material.emissive_color, e.color);
        if (e.enabled == false) {
            material.emissive_strength = 0.0F;
        } else if (e.enabled == true && !material.emits()) {
            return fail("", "", "its surface was switched off, and how bright it was is not known any more",
                        "Give its intensity in cd/m2 too, or use undo.");
        }
        edits.push_back(SceneEdit{SetResource<Material>{m, std::move(material)}});
    }
    return as_one(std::move(edits));
}

Result<SceneEdit> ScriptedScene::edit_for(const ScriptCaustics& e) const {
    const auto id = node(e.node);
    if (!id) {
        return tl::unexpected(id.error());
    }
    Node value = *scene_.nodes.find(*id);
    if (!value.shape) {
        return fail("", "", "the node shows no shape that caustics could fall on", "Name the node that has the surface.");
    }
    set_if(value.caustics.show, e.show);
    set_if(value.caustics.texel, e.texel);
    set_if(value.caustics.threshold, e.threshold);
    return SceneEdit{SetNode{*id, std::move(value)}};
}

Result<SceneEdit> ScriptedScene::edit_for(const ScriptAdd& e) const {
    std::vector<SceneEdit> edits;
    Node node;
    node.name = e.shape.name;
    node.transform = e.transform;
    node.shape = scene_.shapes.next_key();
    edits.push_back(SceneEdit{AddResource<Shape>{node.shape, e.shape}});
    if (e.material.empty()) {
        Material plain;
        plain.name = e.shape.name;
        plain.base_color = Rgb(0.7F);
        plain.double_sided =
            std::holds_alternative<Polygon>(e.shape.geometry) || std::holds_alternative<Disc>(e.shape.geometry);
        node.materials.push_back(scene_.materials.next_key());
        edits.push_back(SceneEdit{AddResource<Material>{node.materials[0], std::move(plain)}});
    } else {
        const auto found = material(e.material);
        if (!found) {
            return tl::unexpected(found.error());
        }
        node.materials.push_back(*found);
    }
    edits.push_back(SceneEdit{AddNode{scene_.nodes.next_key(), std::move(node)}});
    return as_one(std::move(edits));
}

Result<SceneEdit> ScriptedScene::edit_for(const ScriptDelete& e) const {
    return node(e.node).map([](NodeId id) { return SceneEdit{RemoveNode{id}}; });
}

Result<std::optional<SceneEdit>> ScriptedScene::step_back(std::vector<Done>& from, std::vector<Done>& to, bool undo) {
    if (from.empty()) {
        return undo ? fail("", "", "there is nothing to undo", "Edits that change nothing do not count.")
                    : fail("", "", "there is nothing to redo", "Any edit after an undo ends what can be redone.");
    }
    const SceneEdit edit = undo ? from.back().entry.inverse : from.back().entry.forward;
    if (const auto done = atrium::apply(scene_, edit); !done) {
        return tl::unexpected(done.error());
    }
    to.push_back(std::move(from.back()));
    from.pop_back();
    return edit;
}

Result<std::optional<SceneEdit>> ScriptedScene::apply(const ScriptEdit& edit) {
    if (std::holds_alternative<ScriptUndo>(edit.value)) {
        return step_back(undo_, redo_, true);
    }
    if (std::holds_alternative<ScriptRedo>(edit.value)) {
        return step_back(redo_, undo_, false);
    }
    const NodeId next_node = scene_.nodes.next_key();
    const MaterialId next_material = scene_.materials.next_key();
    auto wanted = std::visit(
        [&](const auto& e) -> Result<SceneEdit> {
            if constexpr (requires { edit_for(e); }) {
                return edit_for(e);
            } else {
                return fail("", "", "a drag is carried out position by position");
            }
        },
        edit.value);
    if (!wanted) {
        return tl::unexpected(wanted.error());
    }
    if (changes_nothing(scene_, *wanted)) {
        return std::optional<SceneEdit>();
    }
    auto inverse = atrium::apply(scene_, *wanted);
    if (!inverse) {
        return tl::unexpected(inverse.error());
    }
    if (const auto* add = std::get_if<ScriptAdd>(&edit.value)) {
        numbered_nodes_.push_back(next_node);
        if (add->material.empty()) {
            numbered_materials_.push_back(next_material);
        }
    }
    redo_.clear();
    undo_.push_back({edit.target(), {*wanted, std::move(*inverse)}});
    return std::optional(std::move(*wanted));
}

Result<std::optional<SceneEdit>> ScriptedScene::drag_to(const ScriptDrag& drag, const dvec3& position) {
    auto wanted = edit_for(ScriptMove{drag.node, position, {}, {}});
    if (!wanted) {
        return tl::unexpected(wanted.error());
    }
    if (changes_nothing(scene_, *wanted)) {
        return std::optional<SceneEdit>();
    }
    auto inverse = atrium::apply(scene_, *wanted);
    if (!inverse) {
        return tl::unexpected(inverse.error());
    }
    gesture_.absorb(*wanted, *inverse);
    gesture_target_ = drag.node;
    return std::optional(std::move(*wanted));
}

void ScriptedScene::end_drag() {
    UndoEntry entry = gesture_.take();
    if (!changes_nothing(scene_, entry.inverse)) { // else it ended where it began
        redo_.clear();
        undo_.push_back({gesture_target_, std::move(entry)});
    }
}

Result<void> rehearse(const Scene& scene, const EditScript& script) {
    ScriptedScene stage(scene);
    for (std::size_t i = 0; i < script.edits.size(); ++i) {
        Result<std::optional<SceneEdit>> done;
        if (const auto* drag = std::get_if<ScriptDrag>(&script.edits[i].value)) {
            for (std::size_t k = 0; k < drag->positions.size() && done; ++k) {
                done = stage.drag_to(*drag, drag->positions[k]);
            }
            stage.end_drag();
        } else {
            done = stage.apply(script.edits[i]);
        }
        if (!done) {
            const Error& e = done.error();
            return fail(script.file, script.place(i) + (e.where.empty() ? "" : ": " + e.where), e.what, e.hint);
        }
    }
    return {};
}

} // namespace atrium
