#include "ui/panels/caustic_section.h"

#include "engine/scene/edit_tools.h"
#include "ui/panels/automatic_text.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>

#include <algorithm>

namespace atrium::ui {

namespace {

NumberFormat texel_format() {
    NumberFormat format = NumberFormat::plain(0, 10, 2, QStringLiteral(" mm"));
    format.units.units = {{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"in", 25.4}, {"\"", 25.4}};
    format.display_factor = 1000.0; // kept in metres
    format.step = 0.0005;
    format.proportional = true;
    return format;
}

} // namespace

CausticSection::CausticSection(Document& document) : Section(tr("Set by hand"), document) {
    const auto each = [this](auto get) {
        std::vector<decltype(get(CausticWish{}))> values;
        for (const NodeId id : targets()) {
            values.push_back(get(scene().nodes.find(id)->caustics));
        }
        return values;
    };
    QComboBox* show = add_choice(
        tr("Show caustics"), {tr("Automatically"), tr("On the mesh only"), tr("In textures")},
        [each] { return each([](const CausticWish& w) { return int(w.show); }); },
        [this](int index) { return write([index](CausticWish& w) { w.show = CausticWish::Show(index); }); });
    show->setObjectName(QStringLiteral("caustic_show"));
    NumberField* texel = add_number(
        tr("Texel size"), texel_format(), [each] { return each([](const CausticWish& w) { return double(w.texel); }); },
        [this](double value) { return write([value](CausticWish& w) { w.texel = float(value); }); });
    texel_ = new AutomaticText(texel, 0);
    NumberField* threshold = add_number(
        tr("Threshold"), NumberFormat::plain(0, 1e6, 2),
        [each] { return each([](const CausticWish& w) { return double(w.threshold); }); },
        [this](double value) { return write([value](CausticWish& w) { w.threshold = float(value); }); });
    threshold_ = new AutomaticText(
        threshold, 0, tr("Standard deviations by which light must be more uneven than chance to get a texture"));
    reset_ = new QPushButton(tr("Reset to Automatic"));
    reset_->setObjectName(QStringLiteral("caustic_reset"));
    connect(reset_, &QPushButton::clicked, this,
            [this] { apply(write([](CausticWish& w) { w = {}; }), tr("Reset caustics to automatic")); });
    add_row(QString(), reset_);
}

void CausticSection::set_targets(std::vector<NodeId> nodes, const CausticRow* current) {
    nodes_ = std::move(nodes);
    // What is automatic is told, so that one knows what to start from.
    const bool texel_known = current != nullptr && current->has_texture() && !(current->record.wish.texel > 0.0F);
    texel_->set_amount(texel_known ? length_text(current->texel()) : QString());
    const bool threshold_known = current != nullptr && !current->paper && !(current->record.wish.threshold > 0.0F) &&
                                 current->record.threshold > 0.0F;
    threshold_->set_amount(threshold_known ? QStringLiteral("%1").arg(double(current->record.threshold)) : QString());
    refresh();
}

std::vector<NodeId> CausticSection::targets() const {
    std::vector<NodeId> out;
    std::copy_if(nodes_.begin(), nodes_.end(), std::back_inserter(out),
                 [this](NodeId id) { return scene().nodes.contains(id); });
    return out;
}

bool CausticSection::has_target() const { return !targets().empty(); }

void CausticSection::refresh_more() {
    const std::vector<NodeId> nodes = targets();
    reset_->setEnabled(std::any_of(nodes.begin(), nodes.end(),
                                   [this](NodeId id) { return !scene().nodes.find(id)->caustics.automatic(); }));
}

SceneEdit CausticSection::write(const std::function<void(CausticWish&)>& change) const {
    std::vector<SceneEdit> edits;
    for (const NodeId id : targets()) {
        Node value = *scene().nodes.find(id);
        change(value.caustics);
        edits.push_back(SceneEdit{SetNode{id, std::move(value)}});
    }
    return as_one(std::move(edits));
}

} // namespace atrium::ui
