#include "ui/panels/material_section.h"

#include "engine/scene/edit_tools.h"
#include "ui/document/scene_commands.h"
#include "ui/panels/color_button.h"
#include "ui/panels/quiet_combo.h"

#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>

#include <algorithm>

namespace atrium::ui {

namespace {

QIcon swatch(const Rgb& color) {
    QPixmap picture(14, 14);
    picture.fill(display_swatch(color));
    return QIcon(picture);
}

QString material_name(const Material& material) {
    return material.name.empty() ? MaterialSection::tr("(unnamed material)") : QString::fromStdString(material.name);
}

/// Colour with the largest channel 1; white when there is none.
Rgb hue(const Rgb& color) {
    const float top = max_component(color);
    return top > 0 ? color / top : Rgb(1.0F);
}

void set_luminance(Material& material, double value) {
    const Rgb color = hue(material.emitted_radiance());
    material.emissive_color = value > 0 ? color : Rgb(0.0F);
    material.emissive_strength = value > 0 ? float(value / double(luminance(color))) : 1.0F;
}

} // namespace

MaterialSection::MaterialSection(Document& document) : Section(tr("Material"), document) {
    part_ = new QuietCombo;
    part_->setObjectName(QStringLiteral("material_part"));
    add_row(tr("Part"), part_, [this] { return parts_of_active() > 1; });
    connect(part_, &QComboBox::activated, this, [this] { refresh(); });
    auto* choice = new QuietCombo;
    connect(choice, &QuietCombo::about_to_be_used, this, [this] { fill_materials(true); });
    material_ = choice;
    material_->setObjectName(QStringLiteral("material_choice"));
    material_->setToolTip(tr("Give the selected objects another material of this scene"));
    add_row(tr("Material"), material_);
    connect(material_, &QComboBox::activated, this, [this](int index) {
        const QList<QVariant> id = material_->itemData(index).toList();
        assign(id.size() == 2 ? MaterialId{id[0].toUInt(), id[1].toUInt()} : MaterialId{});
    });
    name_ = new QLineEdit;
    name_->setObjectName(QStringLiteral("material_name"));
    add_row(tr("Name"), name_, [this] { return targets().size() == 1; });
    connect(name_, &QLineEdit::editingFinished, this, [this] {
        const QString text = name_->text().trimmed();
        if (name_->isModified() && !text.isEmpty() && targets().size() == 1) {
            name_->setModified(false);
            apply(write([&](Material& m) { m.name = text.toStdString(); }), tr("Rename material"));
        }
    });
    note_ = new QLabel;
    note_->setWordWrap(true);
    note_->setEnabled(false);
    add_row(QString(), note_, [this] {
        const auto ids = targets();
        return ids.size() != 1 || material_users(scene(), ids.front()) > 1;
    });
    unique_ = new QPushButton(tr("Make Unique"));
    unique_->setObjectName(QStringLiteral("material_unique"));
    unique_->setToolTip(tr("Give this part a material of its own, so that changes do not reach other objects"));
    add_row(QString(), unique_, [this] {
        const auto all = places();
        const auto ids = targets();
        return all.size() == 1 && (ids.empty() || material_users(scene(), ids.front()) > 1);
    });
    connect(unique_, &QPushButton::clicked, this, &MaterialSection::make_unique);

    add_color(
        tr("Base colour"),
        [this] {
            std::vector<Rgb> values;
            for (const MaterialId id : targets()) {
                values.push_back(scene().materials.find(id)->base_color);
            }
            return values;
        },
        [this](const Rgb& color) { return write([&](Material& m) { m.base_color = color; }); });
    NumberFormat percent = NumberFormat::plain(0, double(kMaxReflectance), 1, tr(" %"));
    percent.display_factor = 100;
    percent.step = 0.02;
    add_number(
        tr("Reflectance"), percent,
        [this] { return read([](const Material& m) { return double(luminance(m.base_color)); }); },
        [this](double value) {
            return write([value](Material& m) {
                const float present = luminance(m.base_color);
                Rgb color = present > 0 ? m.base_color * (float(value) / present) : Rgb(float(value));
                // A saturated colour cannot be that bright: what is over goes evenly into the other channels.
                for (int i = 0; i < 8 && max_component(color) > 1.0F; ++i) {
                    color = glm::min(color, Rgb(1.0F));
                    color += Rgb(float(value) - luminance(color));
                }
                m.base_color = glm::clamp(color, Rgb(0.0F), Rgb(1.0F));
            });
        });
    const auto share = [this](const QString& label, float Material::*member) {
        add_number(
            label, NumberFormat::share(),
            [this, member] { return read([member](const Material& m) { return double(m.*member); }); },
            [this, member](double value) { return write([=](Material& m) { m.*member = float(value); }); });
    };
    share(tr("Metallic"), &Material::metallic);
    share(tr("Roughness"), &Material::roughness);
    share(tr("Transmission"), &Material::transmission);
    NumberFormat index = NumberFormat::plain(1.0, 4.0, 3);
    index.step = 0.01;
    add_number(
        tr("Refractive index"), index, [this] { return read([](const Material& m) { return double(m.ior); }); },
        [this](double value) { return write([value](Material& m) { m.ior = float(value); }); });
    add_check(
        tr("Double sided"),
        [this] {
            std::vector<bool> values;
            for (const MaterialId id : targets()) {
                values.push_back(scene().materials.find(id)->double_sided);
            }
            return values;
        },
        [this](bool on) { return write([on](Material& m) { m.double_sided = on; }); });
    add_color(
        tr("Light colour"),
        [this] {
            std::vector<Rgb> values;
            for (const MaterialId id : targets()) {
                values.push_back(hue(scene().materials.find(id)->emitted_radiance()));
            }
            return values;
        },
        [this](const Rgb& color) {
            return write([&](Material& m) {
                const double level = double(luminance(m.emitted_radiance()));
                m.emissive_color = color;
                m.emissive_strength = 1;
                set_luminance(m, level);
            });
        });
    NumberFormat level = NumberFormat::plain(0, 1e9, 1, tr(" cd/m\u00b2"));
    level.units = plain_units("cd/m2");
    level.units.units.push_back({"nit", 1.0});
    level.units.units.push_back({"kcd/m2", 1000.0});
    level.proportional = true;
    level.step = 10;
    add_number(
        tr("Luminance"), level,
        [this] { return read([](const Material& m) { return double(luminance(m.emitted_radiance())); }); },
        [this](double value) { return write([value](Material& m) { set_luminance(m, value); }); });
}

std::size_t MaterialSection::parts_of_active() const {
    const auto& nodes = document().selection()->nodes();
    if (nodes.size() != 1) {
        return 0;
    }
    const Shape* shape = scene().shapes.find(scene().nodes.find(nodes.front())->shape);
    return shape == nullptr ? 0 : part_count(*shape);
}

std::vector<MaterialSection::Place> MaterialSection::places() const {
    std::vector<Place> out;
    if (parts_of_active() > 0) {
        const bool listed = parts_of_ == document().selection()->active() && parts_of_active() > 1;
        out.push_back({document().selection()->active(), listed ? std::size_t(std::max(part_->currentIndex(), 0)) : 0});
        return out;
    }
    for (const NodeId id : document().selection()->nodes()) {
        if (const Shape* shape = scene().shapes.find(scene().nodes.find(id)->shape)) {
            for (std::size_t part = 0; part < part_count(*shape); ++part) {
                out.push_back({id, part});
            }
        }
    }
    return out;
}

std::vector<MaterialId> MaterialSection::targets() const {
    std::vector<MaterialId> out;
    for (const Place& place : places()) {
        const Node& node = *scene().nodes.find(place.node);
        const MaterialId id = place.part < node.materials.size() ? node.materials[place.part] : MaterialId{};
        if (scene().materials.contains(id) && std::find(out.begin(), out.end(), id) == out.end()) {
            out.push_back(id);
        }
    }
    return out;
}

bool MaterialSection::has_target() const { return !places().empty(); }

std::vector<double> MaterialSection::read(const std::function<double(const Material&)>& get) const {
    std::vector<double> values;
    for (const MaterialId id : targets()) {
        values.push_back(get(*scene().materials.find(id)));
    }
    return values;
}

SceneEdit MaterialSection::write(const std::function<void(Material&)>& change) const {
    std::vector<SceneEdit> edits;
    for (const MaterialId id : targets()) {
        Material material = *scene().materials.find(id);
        change(material);
        edits.push_back(SceneEdit{SetResource<Material>{id, std::move(material)}});
    }
    return as_one(std::move(edits));
}

void MaterialSection::fill_parts() {
    const NodeId active = document().selection()->active();
    const int keep = parts_of_ == active ? part_->currentIndex() : 0;
    parts_of_ = active;
    const QSignalBlocker quiet(part_);
    part_->clear();
    const std::size_t count = parts_of_active();
    for (std::size_t i = 0; i < count; ++i) {
        const Material* material = scene().material_of(*scene().nodes.find(active), i);
        part_->addItem(tr("%1: %2").arg(i + 1).arg(material == nullptr ? tr("default") : material_name(*material)));
    }
    part_->setCurrentIndex(keep < int(count) ? std::max(keep, 0) : 0);
}

void MaterialSection::fill_materials(bool all_of_them) {
    const QSignalBlocker quiet(material_);
    material_->clear();
    material_->addItem(swatch(default_material().base_color), tr("Default"), QVariant(QVariantList{}));
    const std::vector<MaterialId> ids = targets();
    const std::vector<Place> all = places();
    int current = ids.empty() ? 0 : -1;
    bool some_without = false;
    for (const Place& place : all) {
        some_without = some_without || scene().material_of(*scene().nodes.find(place.node), place.part) == nullptr;
    }
    scene().materials.for_each([&](MaterialId id, const Material& material) {
        const bool is_current = ids.size() == 1 && ids.front() == id && !some_without;
        if (!is_current && !all_of_them) {
            return;
        }
        if (is_current) {
            current = material_->count();
        }
        material_->addItem(swatch(material.emits() ? hue(material.emitted_radiance()) : material.base_color),
                           material_name(material), QVariant(QVariantList{id.slot, id.generation}));
    });
    material_->setPlaceholderText(tr("mixed"));
    material_->setCurrentIndex(current);
}

void MaterialSection::refresh_more() {
    fill_parts();
    fill_materials(material_->hasFocus());
    const std::vector<MaterialId> ids = targets();
    if (ids.empty()) {
        note_->setText(tr("No material of its own: white, reflectance 80 %."));
    } else if (ids.size() == 1) {
        const std::size_t users = material_users(scene(), ids.front());
        note_->setText(users > 1 ? tr("Shared by %1 parts; changes reach all of them.").arg(users) : QString());
        if (!name_->hasFocus() || !name_->isModified()) {
            name_->setText(QString::fromStdString(scene().materials.find(ids.front())->name));
        }
    } else {
        note_->setText(tr("%1 materials are changed together.").arg(ids.size()));
    }
}

void MaterialSection::assign(MaterialId material) {
    std::vector<SceneEdit> edits;
    for (const NodeId id : document().selection()->nodes()) {
        Node value = *scene().nodes.find(id);
        bool changed = false;
        for (const Place& place : places()) {
            if (place.node == id) {
                value.materials.resize(std::max(value.materials.size(), place.part + 1));
                value.materials[place.part] = material;
                changed = true;
            }
        }
        if (changed) {
            edits.push_back(SceneEdit{SetNode{id, std::move(value)}});
        }
    }
    apply(as_one(std::move(edits)), tr("Assign material"));
}

void MaterialSection::make_unique() {
    const std::vector<Place> all = places();
    if (all.size() != 1) {
        return;
    }
    const Node& node = *scene().nodes.find(all.front().node);
    apply(make_material_unique(scene(), all.front().node, all.front().part, node.name), tr("Make material unique"));
}

} // namespace atrium::ui
