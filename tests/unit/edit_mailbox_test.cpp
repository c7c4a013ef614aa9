// Traces of what is pending after a sequence of posts; a small text form keeps them readable.
#include "engine/session/edit_mailbox.h"

#include "engine/base/rng.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

const NodeId kA{0, 1};
const NodeId kB{1, 1};
const ShapeId kShape{0, 1};
const MaterialId kPaint{0, 1};

SceneEdit move(NodeId id, double x) {
    Transform t;
    t.translation.x = x;
    return {SetTransform{id, t}};
}
SceneEdit paint(float value) {
    Material m;
    m.base_color = Rgb(value);
    return {SetResource<Material>{kPaint, m}};
}
SceneEdit node(NodeId id, const char* name, std::size_t materials = 0) {
    Node n;
    n.name = name;
    n.shape = kShape;
    n.materials.resize(materials);
    return {SetNode{id, n}};
}
SceneEdit mesh(std::size_t parts) {
    auto data = std::make_shared<MeshData>();
    data->positions.resize(3);
    data->indices = {0, 1, 2};
    data->parts.resize(parts, MeshPart{0, 3});
    return {SetResource<Shape>{kShape, {"mesh", Mesh{data}, {}}}};
}

std::string text(const SceneEdit& edit);

struct ToText {
    static std::string id(NodeId n) { return n == kA ? "A" : n == kB ? "B" : "C"; }
    std::string operator()(const SetTransform& e) const {
        return "move " + id(e.id) + " " + std::to_string(int(e.transform.translation.x));
    }
    std::string operator()(const SetNode& e) const { return "set " + id(e.id) + " " + e.value.name; }
    std::string operator()(const AddNode& e) const { return "add " + id(e.id); }
    std::string operator()(const RemoveNode& e) const { return "remove " + id(e.id); }
    std::string operator()(const SetParent& e) const { return "parent " + id(e.id); }
    std::string operator()(const SetResource<Material>& e) const {
        return "paint " + std::to_string(int(e.value.base_color.r));
    }
    std::string operator()(const SetResource<Shape>& e) const { return "mesh " + std::to_string(part_count(e.value)); }
    std::string operator()(const EditGroup& e) const {
        std::string out = "(";
        for (const SceneEdit& edit : e.edits) {
            out += (out.size() > 1 ? ", " : "") + text(edit);
        }
        return out + ")";
    }
    std::string operator()(const SetEnvironment& e) const { return "sky " + std::to_string(int(e.value.sky_radiance.r)); }
    std::string operator()(const SetSolverSettings& e) const { return "seed " + std::to_string(e.value.seed); }
    template <class T> std::string operator()(const T& /*e*/) const { return "other"; }
};

std::string text(const SceneEdit& edit) { return std::visit(ToText{}, edit.value); }

/// What is pending after posting all of `edits`.
std::vector<std::string> trace(std::vector<SceneEdit> edits) {
    EditMailbox box;
    std::uint64_t revision = 0;
    for (SceneEdit& edit : edits) {
        box.post(std::move(edit), ++revision);
    }
    const EditMailbox::Batch batch = box.take();
    EXPECT_EQ(batch.revision, revision);
    EXPECT_TRUE(box.empty());
    std::vector<std::string> out;
    for (const SceneEdit& edit : batch.edits) {
        out.push_back(text(edit));
    }
    return out;
}
using Trace = std::vector<std::string>;

TEST(EditMailbox, ANewerPlacementReplacesThePendingOneInItsPlace) {
    EXPECT_EQ(trace({move(kA, 1), move(kB, 2), move(kA, 3), move(kA, 4)}), (Trace{"move A 4", "move B 2"}));
    EXPECT_EQ(trace({paint(1), move(kA, 1), {SetEnvironment{{Rgb(5.0F)}}}, paint(2), {SetEnvironment{{Rgb(6.0F)}}}}),
              (Trace{"paint 2", "move A 1", "sky 6"}));
}

TEST(EditMailbox, PlacementAndOtherValuesOfANodeAreSeparate) {
    EXPECT_EQ(trace({move(kA, 1), node(kA, "x"), move(kA, 2), node(kA, "y")}), (Trace{"move A 2", "set A y"}));
}

TEST(EditMailbox, NothingSkipsOverItsOwnRemovalOrReturn) {
    // Undo of a deletion brings the node back where it was; the newer placement must come after that.
    EXPECT_EQ(trace({move(kA, 1), {RemoveNode{kA}}, {AddNode{kA, Node{}}}, move(kA, 2)}),
              (Trace{"move A 1", "remove A", "add A", "move A 2"}));
    EXPECT_EQ(
        trace({move(kA, 1), {RemoveNode{kB}}, {EditGroup{{{AddNode{kB, Node{}}}, {AddNode{kA, Node{}}}}}}, move(kA, 2)}),
        (Trace{"move A 1", "remove B", "(add B, add A)", "move A 2"}));
    EXPECT_EQ(trace({paint(1), {RemoveResource<Material>{kPaint}}, {AddResource<Material>{kPaint, {}}}, paint(2)}),
              (Trace{"paint 1", "other", "other", "paint 2"}));
}

TEST(EditMailbox, OtherStructuralEditsAreSkipped) {
    EXPECT_EQ(trace({move(kA, 1), {AddNode{kB, Node{}}}, {SetParent{kA, kB}}, move(kA, 2)}),
              (Trace{"move A 2", "add B", "parent A"}));
}

TEST(EditMailbox, AGroupOfPlacementsReplacesTheSameGroupOnly) {
    const auto both = [](double x) { return SceneEdit{EditGroup{{move(kA, x), move(kB, x)}}}; };
    EXPECT_EQ(trace({both(1), paint(1), both(2), both(3)}), (Trace{"(move A 3, move B 3)", "paint 1"}));
    EXPECT_EQ(trace({both(1), move(kA, 2), both(3)}), (Trace{"(move A 1, move B 1)", "move A 2", "(move A 3, move B 3)"}));
    EXPECT_EQ(trace({move(kA, 1), both(2), move(kA, 3)}), (Trace{"move A 1", "(move A 2, move B 2)", "move A 3"}));
}

TEST(EditMailbox, MaterialsPerPartKeepTheirOrderWhereItMatters) {
    // Two materials fit only after the shape has two parts.
    EXPECT_EQ(trace({node(kA, "one", 1), mesh(2), node(kA, "two", 2)}), (Trace{"set A one", "mesh 2", "set A two"}));
    // One part fits only after the node has let go of its second material.
    EXPECT_EQ(trace({mesh(2), node(kA, "one", 1), mesh(1)}), (Trace{"mesh 2", "set A one", "mesh 1"}));
    // Neither matters while the counts stay.
    EXPECT_EQ(trace({mesh(2), node(kA, "x", 2), mesh(2), node(kA, "y", 2), mesh(3)}), (Trace{"mesh 3", "set A y"}));
    // The last one pending is replaced whatever the counts.
    EXPECT_EQ(trace({node(kA, "x", 2), mesh(2), mesh(1)}), (Trace{"set A x", "mesh 1"}));
}

TEST(EditMailbox, StaysBoundedHoweverLongADragLasts) {
    EditMailbox box;
    for (int i = 0; i < 10000; ++i) {
        box.post(move(i % 2 == 0 ? kA : kB, i), std::uint64_t(i));
        box.post(paint(float(i)), std::uint64_t(i));
        box.post(node(kA, "slider", 1), std::uint64_t(i));
        box.post(mesh(1), std::uint64_t(i));
    }
    EXPECT_EQ(box.size(), 5U);
    box.clear();
    EXPECT_TRUE(box.empty());
}

TEST(EditMailbox, EndsInTheSameSceneAsTheEditsOneByOne) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Scene document;
        document.shapes.insert({"mesh", Box{}, {}});
        document.materials.insert({});
        std::uint64_t state = seed;
        const auto below = [&](std::uint32_t n) {
            state = hash64(state);
            return std::uint32_t(state >> 33) % n;
        };
        Scene engine = document;
        EditMailbox box;
        std::size_t posted = 0;
        std::size_t carried = 0;
        std::vector<std::pair<SceneEdit, Scene>> undo;
        for (int i = 0; i < 3000; ++i) {
            const auto keys = document.nodes.keys();
            const NodeId any = keys.empty() ? NodeId{} : keys[below(std::uint32_t(keys.size()))];
            SceneEdit edit;
            switch (below(12)) {
            case 0: edit = {AddNode{document.nodes.next_key(), Node{}, below(3)}}; break;
            case 1:
                edit = below(4) == 0 ? SceneEdit{RemoveNode{any}} : SceneEdit{SetParent{any, keys.empty() ? any : keys[0]}};
                break;
            case 2: edit = mesh(1 + below(3)); break;
            case 3: edit = paint(float(below(100))); break;
            case 4:
            case 5: edit = node(any, "n", below(4)); break;
            case 6: edit = {EditGroup{{move(any, below(50)), node(any, "g", below(3)), mesh(1 + below(2))}}}; break;
            case 7: edit = undo.empty() ? move(any, 1) : undo.back().first; break;
            default: edit = move(any, below(50)); break;
            }
            const Scene before = document;
            auto inverse = apply(document, edit);
            if (inverse) {
                box.post(edit, std::uint64_t(i));
                undo.assign(1, {*inverse, before});
                ++posted;
            }
            if (below(40) == 0) {
                const auto batch = box.take();
                carried += batch.edits.size();
                for (const SceneEdit& e : batch.edits) {
                    const auto done = apply(engine, e);
                    ASSERT_TRUE(done) << done.error().message();
                }
                ASSERT_EQ(engine, document) << "seed " << seed << " step " << i;
            }
        }
        EXPECT_LT(carried, posted) << "nothing was merged: this test proves nothing";
    }
}

} // namespace
} // namespace atrium
