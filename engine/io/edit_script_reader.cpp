#include "engine/io/edit_script_reader.h"

#include "engine/io/file_access.h"
#include "engine/io/json_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace atrium {
namespace {

using gltf::find;
using gltf::Json;
using gltf::refuse;

constexpr std::uint64_t kMaxBytes = std::uint64_t(256) << 20U; // millions of positions; far beyond is another file
constexpr double kMaxInterval = 60'000.0;                      // milliseconds

std::string shown(const Json& value) {
    std::string out = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return out.size() <= 60 ? out : out.substr(0, 57) + "...";
}
std::string listed(std::span<const char* const> names) {
    std::string out;
    for (const char* name : names) {
        out += (out.empty() ? "" : ", ") + std::string(name);
    }
    return out;
}

/// One object of the script; refuses with its place in the file.
class Members {
public:
    Members(const Json& object, std::string where) : object_(object), where_(std::move(where)) {}

    [[noreturn]] void wrong(const char* key, const std::string& what, const std::string& hint = {}) const {
        refuse(where_, std::string("\"") + key + "\" " + what, hint);
    }
    /// Refuses members that nobody would read: most often a misspelt name.
    void only(std::span<const char* const> names) const {
        for (const auto& [key, value] : object_.items()) {
            bool known = key == "kind";
            for (const char* name : names) {
                known = known || key == name;
            }
            if (!known) {
                refuse(where_, "\"" + key + "\" means nothing here",
                       names.empty() ? "This kind of edit has nothing but its kind." : "Known are " + listed(names) + ".");
            }
        }
    }
    /// At least one of these must be there, or the edit would do nothing.
    void any_of(std::span<const char* const> names) const {
        for (const char* name : names) {
            if (find(object_, name) != nullptr) {
                return;
            }
        }
        refuse(where_, "it says nothing to change", "Give at least one of " + listed(names) + ".");
    }

    [[nodiscard]] std::optional<std::string> text(const char* key) const {
        const Json* value = find(object_, key);
        if (value == nullptr) {
            return {};
        }
        if (!value->is_string() || value->get_ref<const std::string&>().empty()) {
            wrong(key, "is " + shown(*value) + " but must be a text that is not empty");
        }
        return value->get<std::string>();
    }
    [[nodiscard]] std::string needed_text(const char* key, const std::string& hint) const {
        const auto value = text(key);
        if (!value) {
            refuse(where_, std::string("\"") + key + "\" is missing", hint);
        }
        return *value;
    }
    [[nodiscard]] std::string node() const {
        return needed_text("node", "Name the node, or write #N for the N-th of the file.");
    }
    [[nodiscard]] std::optional<bool> boolean(const char* key) const {
        const Json* value = find(object_, key);
        if (value == nullptr) {
            return {};
        }
        if (!value->is_boolean()) {
            wrong(key, "is " + shown(*value) + " but must be true or false");
        }
        return value->get<bool>();
    }
    [[nodiscard]] std::optional<double> number(const char* key, double least, double most) const {
        const Json* value = find(object_, key);
        if (value == nullptr) {
            return {};
        }
        const double out = value->is_number() ? value->get<double>() : kNone;
        if (out < least || out > most) {
            wrong(key, "is " + shown(*value) + " but must be " + range(least, most));
        }
        return out;
    }
    [[nodiscard]] std::optional<float> real(const char* key, double least, double most) const {
        const auto out = number(key, least, most);
        return out ? std::optional(float(*out)) : std::nullopt;
    }
    [[nodiscard]] std::optional<dvec3> vector(const char* key) const {
        const auto v = numbers<3>(find(object_, key), key, -kHuge, kHuge);
        return v ? std::optional(dvec3((*v)[0], (*v)[1], (*v)[2])) : std::nullopt;
    }
    [[nodiscard]] std::optional<Rgb> color(const char* key, double most) const {
        const auto v = numbers<3>(find(object_, key), key, 0.0, most);
        return v ? std::optional(Rgb(dvec3((*v)[0], (*v)[1], (*v)[2]))) : std::nullopt;
    }
    [[nodiscard]] std::optional<dquat> rotation(const char* key) const {
        const auto v = numbers<4>(find(object_, key), key, -kHuge, kHuge);
        if (!v) {
            return {};
        }
        if ((*v)[0] == 0.0 && (*v)[1] == 0.0 && (*v)[2] == 0.0 && (*v)[3] == 0.0) {
            wrong(key, "is no rotation: all of it is zero", "Write [0, 0, 0, 1] for none.");
        }
        return dquat((*v)[3], (*v)[0], (*v)[1], (*v)[2]);
    }
    [[nodiscard]] std::vector<dvec3> positions() const {
        constexpr const char* kKey = "positions";
        const Json* list = find(object_, kKey);
        if (list == nullptr || !list->is_array() || list->empty()) {
            wrong(kKey, list == nullptr ? "is missing" : "is not a list of places",
                  "Write at least one, as [[x, y, z], [x, y, z]].");
        }
        std::vector<dvec3> out;
        for (std::size_t i = 0; i < list->size(); ++i) {
            const std::string name = std::string(kKey) + "/" + std::to_string(i);
            const auto v = numbers<3>(&(*list)[i], name.c_str(), -kHuge, kHuge);
            out.emplace_back((*v)[0], (*v)[1], (*v)[2]);
        }
        return out;
    }
    /// One to three lengths above zero.
    [[nodiscard]] std::vector<float> size() const {
        const Json* list = find(object_, "size");
        std::vector<float> out;
        if (list == nullptr) {
            return out;
        }
        const bool fits = list->is_array() && !list->empty() && list->size() <= 3;
        for (std::size_t i = 0; fits && i < list->size(); ++i) {
            const Json& value = (*list)[i];
            if (const auto length = gltf::float_of(value); length && *length > 0.0F) {
                out.push_back(*length);
            }
        }
        if (!fits || out.size() != list->size()) {
            wrong("size", "is " + shown(*list) + " but must be one to three lengths above zero", "Lengths are in metres.");
        }
        return out;
    }

private:
    static constexpr double kHuge = double(std::numeric_limits<float>::max()); // what a scene can hold
    static constexpr double kNone = std::numeric_limits<double>::infinity();   // of what is no number: in no range

    static std::string range(double least, double most) {
        if (most >= kHuge) {
            return least > -kHuge ? "a number of at least " + shown(least) : "a finite number";
        }
        return "a number from " + shown(least) + " to " + shown(most);
    }
    template <std::size_t N>
    std::optional<std::array<double, N>> numbers(const Json* value, const char* key, double least, double most) const {
        if (value == nullptr) {
            return {};
        }
        std::array<double, N> out{};
        bool good = value->is_array() && value->size() == N;
        for (std::size_t i = 0; good && i < N; ++i) {
            const Json& component = (*value)[i];
            out[i] = component.is_number() ? component.get<double>() : kNone;
            good = out[i] >= least && out[i] <= most;
        }
        if (!good) {
            wrong(key, "is " + shown(*value) + " but must be a list of " + std::to_string(N) + " numbers, each " +
                           range(least, most));
        }
        return out;
    }

    const Json& object_;
    std::string where_;
};

constexpr double kUnbounded = double(std::numeric_limits<float>::max());

// ---- one function per kind ----

ScriptEdit read_drag(const Members& m) {
    constexpr std::array kNames = {"node", "positions", "interval_ms", "settle"};
    m.only(kNames);
    ScriptDrag out;
    out.node = m.node();
    out.positions = m.positions();
    out.interval_ms = m.number("interval_ms", 0.0, kMaxInterval).value_or(out.interval_ms);
    out.settle = m.boolean("settle").value_or(true);
    return {out};
}

ScriptEdit read_move(const Members& m) {
    constexpr std::array kNames = {"node", "translation", "rotation", "scale"};
    m.only(kNames);
    ScriptMove out{m.node(), m.vector("translation"), m.rotation("rotation"), m.vector("scale")};
    m.any_of(std::span(kNames).subspan(1));
    return {out};
}

ScriptEdit read_material(const Members& m) {
    constexpr std::array kNames = {"material", "baseColor", "metallic", "roughness", "transmission", "ior"};
    m.only(kNames);
    ScriptMaterial out;
    out.material = m.needed_text("material", "Name the material, or write #N for the N-th of the file.");
    out.base_color = m.color("baseColor", 1.0);
    out.metallic = m.real("metallic", 0.0, 1.0);
    out.roughness = m.real("roughness", 0.0, 1.0);
    out.transmission = m.real("transmission", 0.0, 1.0);
    out.ior = m.real("ior", 1.0, kUnbounded);
    m.any_of(std::span(kNames).subspan(1));
    return {out};
}

ScriptEdit read_light(const Members& m) {
    constexpr std::array kNames = {"node", "intensity", "color", "enabled"};
    m.only(kNames);
    ScriptLight out{m.node(), m.real("intensity", 0.0, kUnbounded), m.color("color", kUnbounded), m.boolean("enabled")};
    m.any_of(std::span(kNames).subspan(1));
    return {out};
}

ScriptEdit read_caustics(const Members& m) {
    constexpr std::array kNames = {"node", "show", "texel", "threshold"};
    m.only(kNames);
    ScriptCaustics out;
    out.node = m.node();
    if (const auto show = m.text("show")) {
        using Show = CausticWish::Show;
        for (const Show one : {Show::Automatic, Show::Mesh, Show::Texture}) {
            if (*show == caustic_show_name(one)) {
                out.show = one;
            }
        }
        if (!out.show) {
            m.wrong("show", "is \"" + *show + "\", which is no way to show caustics", "Write automatic, mesh or texture.");
        }
    }
    out.texel = m.real("texel", 0.0, kUnbounded);
    out.threshold = m.real("threshold", 0.0, kUnbounded);
    m.any_of(std::span(kNames).subspan(1));
    return {out};
}

/// The shape that fills a box of this size; an empty size is the editor's for a new object.
Geometry shape_of(const Members& m, const std::string& kind, std::vector<float> size) {
    const auto need = [&](bool good, const char* what) {
        if (!good) {
            m.wrong("size", std::string("does not fit a ") + kind + ": " + what);
        }
    };
    const std::size_t given = size.size();
    const auto side = [&](std::size_t axis, float otherwise) { // one length stands for all
        return given == 0 ? otherwise : size[given == 1 ? 0 : axis];
    };
    if (kind == "box") {
        need(given != 2, "write [width, height, depth]");
        return Box{{side(0, 0.5F), side(1, 0.5F), side(2, 0.5F)}};
    }
    if (kind == "sphere") {
        need(given != 2 && (given != 3 || (size[0] == size[1] && size[1] == size[2])),
             "write its diameter, [d]; \"scale\" makes an ellipsoid of it");
        return Sphere{side(0, 0.5F) / 2.0F};
    }
    if (kind == "cylinder" || kind == "cone") {
        need(given != 3 || size[0] == size[2], "write [diameter, height]; \"scale\" makes it elliptical");
        const float radius = side(0, 0.5F) / 2.0F;
        const float height = side(1, 0.75F);
        return kind == "cylinder" ? Geometry(Cylinder{radius, height, true}) : Geometry(Cone{radius, 0.0F, height, true});
    }
    if (kind == "disc") {
        need(given <= 2 && (given != 2 || size[0] == size[1]), "write its diameter, [d]");
        return Disc{side(0, 1.0F) / 2.0F};
    }
    if (kind == "rectangle" || kind == "polygon") {
        need(given <= 2, "write [width, height]");
        const float x = side(0, 2.0F) / 2.0F;
        const float y = side(1, 2.0F) / 2.0F;
        return Polygon{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {}};
    }
    m.wrong("shape", "is \"" + kind + "\", which is no shape", "Write box, sphere, cylinder, cone, disc or rectangle.");
}

ScriptEdit read_add(const Members& m) {
    constexpr std::array kNames = {"shape", "name", "translation", "rotation", "scale", "size", "material"};
    m.only(kNames);
    ScriptAdd out;
    const std::string kind = m.needed_text("shape", "Write box, sphere, cylinder, cone, disc or rectangle.");
    out.shape.geometry = shape_of(m, kind, m.size());
    out.shape.name = m.text("name").value_or(kind);
    out.transform.translation = m.vector("translation").value_or(out.transform.translation);
    out.transform.rotation = m.rotation("rotation").value_or(out.transform.rotation);
    out.transform.scale = m.vector("scale").value_or(out.transform.scale);
    out.material = m.text("material").value_or("");
    return {out};
}

ScriptEdit read_delete(const Members& m) {
    constexpr std::array kNames = {"node"};
    m.only(kNames);
    return {ScriptDelete{m.node()}};
}

ScriptEdit read_one(const Json& json, std::size_t index) {
    const std::string place = "edits/" + std::to_string(index);
    const std::string kinds = "Write drag, move, material, light, caustics, add, delete, undo or redo.";
    if (!json.is_object()) {
        refuse(place, "is " + shown(json) + " but must be an object", "Write it as {\"kind\": \"undo\"}.");
    }
    const std::string kind = Members(json, place).needed_text("kind", kinds);
    const Members m(json, place + " (" + kind + ")");
    if (kind == "drag") {
        return read_drag(m);
    }
    if (kind == "move") {
        return read_move(m);
    }
    if (kind == "material") {
        return read_material(m);
    }
    if (kind == "light") {
        return read_light(m);
    }
    if (kind == "caustics") {
        return read_caustics(m);
    }
    if (kind == "add") {
        return read_add(m);
    }
    if (kind == "delete") {
        return read_delete(m);
    }
    if (kind == "undo" || kind == "redo") {
        m.only({});
        return kind == "undo" ? ScriptEdit{ScriptUndo{}} : ScriptEdit{ScriptRedo{}};
    }
    refuse(place, "\"kind\" is \"" + kind + "\", which is no kind of edit", kinds);
}

EditScript read_all(const Json& root) {
    const std::string form = R"(Write {"edits": [{"kind": "move", "node": "Chair", "translation": [0, 0, 1]}]}.)";
    if (!root.is_object()) {
        refuse("", "is not a JSON object", form);
    }
    const Json* edits = find(root, "edits");
    if (edits == nullptr || !edits->is_array()) {
        refuse("", edits == nullptr ? "has no list \"edits\"" : "\"edits\" is not a list", form);
    }
    for (const auto& [key, value] : root.items()) {
        if (key != "edits") {
            refuse("", "\"" + key + "\" means nothing here", "The only member of a script is \"edits\".");
        }
    }
    EditScript out;
    for (std::size_t i = 0; i < edits->size(); ++i) {
        out.edits.push_back(read_one((*edits)[i], i));
    }
    return out;
}

} // namespace

Result<EditScript> parse_edit_script(const std::string& text, const std::string& file) {
    try {
        EditScript script = read_all(gltf::parse_json(text));
        script.file = file;
        return script;
    } catch (const Json::exception& e) {
        // "[json.exception.parse_error.101] parse error at line 1, column 5: ..." without the number of the exception.
        std::string what = e.what();
        what = what.substr(std::min(what.find("] ") + 2, what.size()));
        return fail(file, "", "is not JSON: " + what, "Mind commas, quotes and brackets.");
    } catch (const gltf::Refusal& refusal) {
        Error error = refusal.error;
        error.file = file;
        return tl::unexpected(std::move(error));
    }
}

Result<EditScript> read_edit_script(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMaxBytes);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    return parse_edit_script(std::string(bytes->begin(), bytes->end()), path.string());
}

} // namespace atrium
