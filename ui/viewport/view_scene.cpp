#include "ui/viewport/view_scene.h"

#include <QThreadPool>

#include <algorithm>

namespace atrium::ui {
namespace {

/// Meshes larger than this get their hierarchy ahead of the first click, off the UI thread.
constexpr std::size_t kBuildAheadIndices = 3 * 2000;

/// How many hidden surfaces of one wall a ray goes through, and how far behind one it goes on, metres.
constexpr int kMostLayers = 16;
constexpr double kNextLayer = 1e-5;

} // namespace

void ViewScene::clear() {
    items_.clear();
    unlit_.clear();
    bvhs_.clear();
    valid_from_.clear();
}

void ViewScene::forget_shape(const Scene& scene, ShapeId shape, std::uint64_t revision) {
    std::erase_if(unlit_, [&](const auto& entry) { return entry.first.first == shape; });
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        if (node.shape == shape) {
            valid_from_[id] = revision;
        }
    });
}

void ViewScene::note_edit(const Scene& scene, const SceneEdit& edit, std::uint64_t revision) {
    if (const auto* group = std::get_if<EditGroup>(&edit.value)) {
        for (const SceneEdit& e : group->edits) {
            note_edit(scene, e, revision);
        }
    } else if (const auto* set_shape = std::get_if<SetResource<Shape>>(&edit.value)) {
        forget_shape(scene, set_shape->id, revision);
    } else if (const auto* add_shape = std::get_if<AddResource<Shape>>(&edit.value)) {
        forget_shape(scene, add_shape->id, revision);
    } else if (const auto* removed = std::get_if<RemoveResource<Shape>>(&edit.value)) {
        forget_shape(scene, removed->id, revision);
    } else if (const auto* add_node = std::get_if<AddNode>(&edit.value)) {
        valid_from_.erase(add_node->id);
    } else if (const auto* set_node = std::get_if<SetNode>(&edit.value)) {
        // The old value is gone, but the items still tell which shape was shown.
        const Node* node = scene.nodes.find(set_node->id);
        const bool other = std::any_of(items_.begin(), items_.end(), [&](const ViewItem& item) {
            return item.node == set_node->id && node != nullptr && item.shape != node->shape;
        });
        if (other) {
            valid_from_[set_node->id] = revision;
        }
    }
}

std::shared_ptr<const MeshBvh> ViewScene::bvh_of(const std::shared_ptr<const DisplayMesh>& mesh) {
    std::shared_ptr<const MeshBvh>& bvh = bvhs_[mesh.get()];
    if (!bvh) {
        bvh = std::make_shared<const MeshBvh>(mesh);
        if (mesh->indices.size() > kBuildAheadIndices) {
            QThreadPool::globalInstance()->start([bvh] { bvh->build(); });
        }
    }
    return bvh;
}

void ViewScene::sync(const Scene& scene, const std::shared_ptr<const Solution>& solution) {
    std::map<std::pair<NodeId, std::uint32_t>, const std::shared_ptr<const SurfaceLayer>*> layers;
    // Without any light the truth is black, in which nobody finds a wall to put a lamp on: shown as not lit yet, also while
    // the first light is on its way.
    const bool black = solution && !(solution->mean_radiance > 0.0);
    if (solution && !black) {
        for (const auto& layer : solution->surfaces) {
            const auto barrier = valid_from_.find(layer->node);
            if (barrier == valid_from_.end() || solution->revision >= barrier->second) {
                layers.emplace(std::pair(layer->node, layer->part), &layer);
            }
        }
    }
    items_.clear();
    struct Visit {
        NodeId id;
        dmat4 parent;
    };
    std::vector<Visit> stack;
    for (auto root = scene.roots.rbegin(); root != scene.roots.rend(); ++root) {
        stack.push_back({*root, dmat4(1.0)});
    }
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const Node* node = scene.nodes.find(visit.id);
        if (node == nullptr || !node->visible) {
            continue;
        }
        const dmat4 world = visit.parent * node->transform.matrix();
        for (auto child = node->children.rbegin(); child != node->children.rend(); ++child) {
            stack.push_back({*child, world});
        }
        const Shape* shape = scene.shapes.find(node->shape);
        if (shape == nullptr || (isolated_ && !isolated_->contains(visit.id))) {
            continue;
        }
        const double determinant = glm::determinant(dmat3(world));
        for (std::uint32_t part = 0; part < part_count(*shape); ++part) {
            ViewItem item;
            item.node = visit.id;
            item.part = part;
            item.shape = node->shape;
            item.world = world;
            item.mirrored = determinant < 0;
            item.flattened = !(std::abs(determinant) > 0.0);
            const Material* material = scene.material_of(*node, part);
            item.material = material != nullptr ? material : &default_material();
            const auto layer = layers.find({visit.id, part});
            if (layer != layers.end() && (*layer->second)->mesh) {
                item.layer = *layer->second;
                item.mesh = item.layer->mesh;
                item.bvh = bvh_of(item.mesh);
            } else {
                CachedMesh& cached = unlit_[{node->shape, part}];
                if (!cached.mesh) {
                    cached.mesh = std::make_shared<const DisplayMesh>(make_display_mesh(*shape, part));
                    cached.bvh = bvh_of(cached.mesh);
                }
                item.mesh = cached.mesh;
                item.bvh = cached.bvh;
            }
            if (!item.mesh->indices.empty()) {
                const Box3& local = item.bvh->bounds();
                for (int corner = 0; corner < 8; ++corner) {
                    const dvec3 p((corner & 1) != 0 ? local.max.x : local.min.x,
                                  (corner & 2) != 0 ? local.max.y : local.min.y,
                                  (corner & 4) != 0 ? local.max.z : local.min.z);
                    item.bounds.add(dvec3(world * dvec4(p, 1.0)));
                }
                items_.push_back(std::move(item));
            }
        }
    }
    std::unordered_map<const DisplayMesh*, std::shared_ptr<const MeshBvh>> kept;
    for (const ViewItem& item : items_) {
        kept.emplace(item.mesh.get(), item.bvh);
    }
    for (const auto& [key, cached] : unlit_) {
        kept.emplace(cached.mesh.get(), cached.bvh);
    }
    bvhs_ = std::move(kept);
}

std::optional<PickHit> ViewScene::pick(const Ray& ray, double max_distance, const PickRules& rules) const {
    std::optional<PickHit> best;
    double nearest = max_distance;
    for (const ViewItem& item : items_) {
        if (rules.skip != nullptr && rules.skip->contains(item.node)) {
            continue;
        }
        const Cutaway::Part cut = rules.through_cutaway ? Cutaway::Part::None : cutaway_.part_of(item.bounds);
        if (item.flattened || cut == Cutaway::Part::All) {
            continue;
        }
        const dmat4 inverse = glm::inverse(item.world);
        const dvec3 origin(inverse * dvec4(ray.origin, 1.0));
        const dvec3 direction(inverse * dvec4(ray.direction, 0.0));
        const RaySides sides = item.material->double_sided ? RaySides::Both : RaySides::Front;
        // The direction is mapped without renormalising, so t is in world metres along the ray.
        double from = 0.0;
        for (int layer = 0; layer < kMostLayers; ++layer) {
            const auto hit = item.bvh->nearest(origin + direction * from, direction, nearest - from, sides);
            if (!hit) {
                break;
            }
            const double distance = from + hit->t;
            const std::uint32_t* t = &item.mesh->indices[std::size_t(hit->triangle) * 3];
            const dvec3 p(item.mesh->positions[t[0]]);
            const dvec3 local_normal =
                glm::cross(dvec3(item.mesh->positions[t[1]]) - p, dvec3(item.mesh->positions[t[2]]) - p);
            dvec3 normal = glm::transpose(dmat3(inverse)) * local_normal;
            const double length = glm::length(normal);
            normal = length > 0 ? normal / length : -ray.direction;
            if (cut == Cutaway::Part::Some && cutaway_.hides(ray.at(distance), normal)) {
                from = distance + kNextLayer;
                continue;
            }
            if (glm::dot(normal, ray.direction) > 0) {
                normal = -normal;
            }
            nearest = distance;
            best = PickHit{item.node, item.part, distance, ray.at(distance), normal, hit->triangle, hit->front};
            break;
        }
    }
    return best;
}

} // namespace atrium::ui
