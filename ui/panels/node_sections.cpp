#include "ui/panels/node_sections.h"

#include "engine/scene/edit_tools.h"
#include "ui/document/scene_commands.h"

#include <QLabel>
#include <QLineEdit>
#include <QLocale>

#include <algorithm>

namespace atrium::ui {

namespace {

/// Value of a field of each target whose geometry is of type G.
template <class G, class Get>
std::vector<double> read_geometry(const Scene& scene, const std::vector<ShapeId>& shapes, Get get) {
    std::vector<double> values;
    for (const ShapeId id : shapes) {
        const auto* geometry = std::get_if<G>(&scene.shapes.find(id)->geometry);
        if (geometry == nullptr) {
            return {}; // shown only when all are of one kind
        }
        values.push_back(double(get(*geometry)));
    }
    return values;
}

template <class G, class Set> SceneEdit write_geometry(const Scene& scene, const std::vector<ShapeId>& shapes, Set set) {
    std::vector<SceneEdit> edits;
    for (const ShapeId id : shapes) {
        Shape shape = *scene.shapes.find(id);
        if (auto* geometry = std::get_if<G>(&shape.geometry)) {
            set(*geometry);
            edits.push_back(SceneEdit{SetResource<Shape>{id, std::move(shape)}});
        }
    }
    return as_one(std::move(edits));
}

Box3 bounds_of(const Polygon& polygon) {
    Box3 box;
    for (const vec2& p : polygon.outer) {
        box.add(vec3(p, 0.0F));
    }
    return box;
}

/// Stretches all rings about the middle of the outer one so that its extent along `axis` becomes `size`.
void resize_polygon(Polygon& polygon, int axis, float size) {
    const Box3 box = bounds_of(polygon);
    const float present = box.size()[axis];
    if (!(present > 0)) {
        return;
    }
    const float middle = box.centre()[axis];
    const auto stretch = [&](std::vector<vec2>& ring) {
        for (vec2& p : ring) {
            p[axis] = middle + (p[axis] - middle) * (size / present);
        }
    };
    stretch(polygon.outer);
    for (auto& hole : polygon.holes) {
        stretch(hole);
    }
}

} // namespace

NodeSection::NodeSection(Document& document) : Section(tr("Object"), document) {
    name_ = new QLineEdit;
    name_->setObjectName(QStringLiteral("node_name"));
    name_->setAccessibleName(tr("Name"));
    add_row(tr("Name"), name_);
    connect(name_, &QLineEdit::editingFinished, this, [this] {
        const NodeId id = Section::document().selection()->active();
        const Node* node = scene().nodes.find(id);
        const QString text = name_->text().trimmed();
        if (!name_->isModified() || node == nullptr || text.isEmpty() ||
            Section::document().selection()->nodes().size() != 1) {
            return;
        }
        name_->setModified(false);
        Node value = *node;
        value.name = text.toStdString();
        apply(SceneEdit{SetNode{id, std::move(value)}}, tr("Rename"));
    });
    count_ = new QLabel;
    add_row(QString(), count_, [this] { return Section::document().selection()->nodes().size() > 1; });
    add_check(
        tr("Visible"),
        [this] {
            std::vector<bool> values;
            for (const NodeId id : Section::document().selection()->nodes()) {
                values.push_back(scene().nodes.find(id)->visible);
            }
            return values;
        },
        [this](bool on) { return set_visible(scene(), Section::document().selection()->nodes(), on); });
    add_check(
        tr("Locked"),
        [this] {
            std::vector<bool> values;
            for (const NodeId id : Section::document().selection()->nodes()) {
                values.push_back(scene().nodes.find(id)->locked);
            }
            return values;
        },
        [this](bool on) { return set_locked(scene(), Section::document().selection()->nodes(), on); });
}

bool NodeSection::has_target() const { return !document().selection()->nodes().empty(); }

void NodeSection::refresh_more() {
    const auto& nodes = document().selection()->nodes();
    count_->setText(tr("%n objects selected", nullptr, int(nodes.size())));
    const QString name = nodes.size() == 1 ? QString::fromStdString(scene().nodes.find(nodes.front())->name) : QString();
    name_->setEnabled(nodes.size() == 1);
    name_->setPlaceholderText(nodes.size() == 1 ? tr("(unnamed)") : tr("mixed"));
    if (!name_->hasFocus() || !name_->isModified()) {
        name_->setText(name);
    }
}

ShapeSection::ShapeSection(Document& document) : Section(tr("Shape"), document) {
    kind_ = new QLabel;
    kind_->setWordWrap(true);
    add_row(QString(), kind_);
    constexpr double kSmallest = 1e-4; // a tenth of a millimetre
    const NumberFormat length = NumberFormat::length(kSmallest);
    const NumberFormat from_zero = NumberFormat::length(0);
    const auto number = [&](const QString& label, const NumberFormat& format, auto get, auto set, auto tag) {
        using G = typename decltype(tag)::type;
        add_number(
            label, format, [this, get] { return read_geometry<G>(scene(), targets(), get); },
            [this, set](double value) {
                return write_geometry<G>(scene(), targets(), [&](G& g) { set(g, float(value)); });
            });
    };
    for (int axis = 0; axis < 3; ++axis) {
        number(
            axis == 0   ? tr("Width (X)")
            : axis == 1 ? tr("Height (Y)")
                        : tr("Depth (Z)"),
            length, [axis](const Box& g) { return g.size[axis]; }, [axis](Box& g, float v) { g.size[axis] = v; },
            std::type_identity<Box>{});
    }
    for (int axis = 0; axis < 2; ++axis) {
        number(
            axis == 0 ? tr("Width") : tr("Depth"), length, [axis](const Polygon& g) { return bounds_of(g).size()[axis]; },
            [axis](Polygon& g, float v) { resize_polygon(g, axis, v); }, std::type_identity<Polygon>{});
    }
    number(
        tr("Radius"), length, [](const Sphere& g) { return g.radius; }, [](Sphere& g, float v) { g.radius = v; },
        std::type_identity<Sphere>{});
    number(
        tr("Disc radius"), length, [](const Disc& g) { return g.radius; }, [](Disc& g, float v) { g.radius = v; },
        std::type_identity<Disc>{});
    number(
        tr("Cylinder radius"), length, [](const Cylinder& g) { return g.radius; },
        [](Cylinder& g, float v) { g.radius = v; }, std::type_identity<Cylinder>{});
    number(
        tr("Cylinder height"), length, [](const Cylinder& g) { return g.height; },
        [](Cylinder& g, float v) { g.height = v; }, std::type_identity<Cylinder>{});
    number(
        tr("Base radius"), length, [](const Cone& g) { return g.base_radius; }, [](Cone& g, float v) { g.base_radius = v; },
        std::type_identity<Cone>{});
    number(
        tr("Top radius"), from_zero, [](const Cone& g) { return g.top_radius; }, [](Cone& g, float v) { g.top_radius = v; },
        std::type_identity<Cone>{});
    number(
        tr("Cone height"), length, [](const Cone& g) { return g.height; }, [](Cone& g, float v) { g.height = v; },
        std::type_identity<Cone>{});
    const auto caps = [this] {
        std::vector<bool> values;
        for (const ShapeId id : targets()) {
            const Geometry& geometry = scene().shapes.find(id)->geometry;
            if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
                values.push_back(cylinder->capped);
            } else if (const auto* cone = std::get_if<Cone>(&geometry)) {
                values.push_back(cone->capped);
            } else {
                return std::vector<bool>{};
            }
        }
        return values;
    };
    add_check(tr("Closed ends"), caps, [this](bool on) {
        std::vector<SceneEdit> edits;
        for (const ShapeId id : targets()) {
            Shape shape = *scene().shapes.find(id);
            if (auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
                cylinder->capped = on;
            } else if (auto* cone = std::get_if<Cone>(&shape.geometry)) {
                cone->capped = on;
            }
            edits.push_back(SceneEdit{SetResource<Shape>{id, std::move(shape)}});
        }
        return as_one(std::move(edits));
    });
}

std::vector<ShapeId> ShapeSection::targets() const {
    std::vector<ShapeId> shapes;
    for (const NodeId id : document().selection()->nodes()) {
        const ShapeId shape = scene().nodes.find(id)->shape;
        if (scene().shapes.contains(shape) && std::find(shapes.begin(), shapes.end(), shape) == shapes.end()) {
            shapes.push_back(shape);
        }
    }
    return shapes;
}

bool ShapeSection::has_target() const { return !targets().empty(); }

void ShapeSection::refresh_more() {
    const std::vector<ShapeId> shapes = targets();
    const Shape& first = *scene().shapes.find(shapes.front());
    const QString kind = QCoreApplication::translate("Shapes", shape_kind(first));
    const bool one_kind = std::all_of(shapes.begin(), shapes.end(), [&](ShapeId id) {
        return scene().shapes.find(id)->geometry.index() == first.geometry.index();
    });
    QString text = one_kind ? kind : tr("Shapes of several kinds");
    const QLocale locale;
    if (const auto* mesh = std::get_if<Mesh>(&first.geometry); mesh != nullptr && shapes.size() == 1) {
        text = tr("Mesh: %1 triangles, %2 part(s)")
                   .arg(locale.toString(qulonglong(mesh->data->indices.size() / 3)))
                   .arg(mesh->data->parts.size());
    }
    if (const auto* polygon = std::get_if<Polygon>(&first.geometry); polygon != nullptr && shapes.size() == 1) {
        text = tr("Polygon: %1 corners, %2 hole(s)").arg(polygon->outer.size()).arg(polygon->holes.size());
    }
    if (shapes.size() == 1) {
        std::size_t users = 0;
        scene().nodes.for_each([&](NodeId, const Node& node) { users += node.shape == shapes.front() ? 1U : 0U; });
        if (users > 1) {
            text += tr(", shared by %1 objects").arg(users);
        }
    }
    kind_->setText(text);
}

SceneSection::SceneSection(Document& document) : Section(tr("Scene"), document) {
    connect(&document, &Document::reset_done, this, [this] { measure_ = true; });
    connect(document.selection(), &Selection::changed, this, [this] { measure_ = true; });
    summary_ = new QLabel;
    summary_->setWordWrap(true);
    add_row(QString(), summary_);
    add_color(
        tr("Sky colour"),
        [this] {
            const Rgb sky = scene().environment.sky_radiance;
            const float top = max_component(sky);
            return std::vector<Rgb>{top > 0 ? sky / top : Rgb(1.0F)};
        },
        [this](const Rgb& color) {
            const float present = luminance(scene().environment.sky_radiance);
            const float own = luminance(color);
            Environment sky = scene().environment;
            // A colour alone does not switch the sky on; it takes the brightness that is there.
            sky.sky_radiance = own > 0 ? color * ((present > 0 ? present : 1.0F) / own) : Rgb(0.0F);
            return SceneEdit{SetEnvironment{sky}};
        });
    NumberFormat format = NumberFormat::plain(0, 1e6, 2, tr(" cd/m\u00b2"));
    format.proportional = true;
    format.units = plain_units("cd/m2");
    add_number(
        tr("Sky luminance"), format,
        [this] { return std::vector<double>{double(luminance(scene().environment.sky_radiance))}; },
        [this](double value) {
            const float present = luminance(scene().environment.sky_radiance);
            Environment sky = scene().environment;
            sky.sky_radiance = present > 0 ? sky.sky_radiance * (float(value) / present) : Rgb(float(value));
            return SceneEdit{SetEnvironment{sky}};
        });
    add_choice(
        tr("Light quality"), {tr("Draft"), tr("Normal"), tr("Fine")},
        [this] { return std::vector<int>{int(scene().settings.quality)}; },
        [this](int index) {
            SolverSettings settings = scene().settings;
            settings.quality = SolverSettings::Quality(index);
            return SceneEdit{SetSolverSettings{settings}};
        });
}

bool SceneSection::has_target() const { return document().selection()->nodes().empty(); }

void SceneSection::refresh_more() {
    if (scene().nodes.empty()) {
        summary_->setText(tr("The scene is empty. The Add menu puts in shapes, lamps and cameras."));
        return;
    }
    const QLocale locale;
    QString text =
        tr("%1 objects, %2 materials")
            .arg(locale.toString(qulonglong(scene().nodes.size())), locale.toString(qulonglong(scene().materials.size())));
    if (measure_) {
        measure_ = false;
        const dvec3 size = scene().bounds().size();
        size_ = tr(", %1 x %2 x %3 m")
                    .arg(QString::fromStdString(format_number(size.x, 2)), QString::fromStdString(format_number(size.y, 2)),
                         QString::fromStdString(format_number(size.z, 2)));
    }
    text += size_;
    summary_->setText(text);
}

} // namespace atrium::ui
