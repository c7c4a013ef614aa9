#include "ui/panels/caustic_words.h"

#include "ui/panels/number_parse.h"

#include <QCoreApplication>
#include <QLocale>

#include <algorithm>
#include <map>
#include <tuple>

namespace atrium::ui {

namespace {

using Decision = CausticRecord::Decision;
using Sizing = CausticRecord::Sizing;

constexpr std::uint32_t kNoChart = 0xFFFFFFFFU;

// Not tr(): these are no QObject's, but the translator's tool must find them.
QString words(const char* text, int n = -1) { return QCoreApplication::translate("Caustics", text, nullptr, n); }

QString number(double value, int decimals) { return QLocale().toString(value, 'f', decimals); }

auto place_of(const CausticRow& row) {
    const CausticRecord& r = row.record;
    return std::tuple(r.node.key(), r.part, r.back, r.chart);
}

QString node_name(const Scene& scene, NodeId id) {
    const Node* node = scene.nodes.find(id);
    if (node == nullptr) {
        return words(QT_TRANSLATE_NOOP("Caustics", "(deleted)"));
    }
    if (!node->name.empty()) {
        return QString::fromStdString(node->name);
    }
    const Shape* shape = scene.shapes.find(node->shape);
    return shape != nullptr && !shape->name.empty() ? QString::fromStdString(shape->name)
                                                    : words(QT_TRANSLATE_NOOP("Caustics", "(unnamed)"));
}

// By how much the light is more uneven than chance, against what is needed.
QString test_text(const CausticRow& row) {
    const CausticRecord& r = row.record;
    if (row.paper) {
        return words(QT_TRANSLATE_NOOP("Caustics", "contrast %1, %2 needed"))
            .arg(number(r.contrast, 2), number(r.threshold, 2));
    }
    QString text = words(QT_TRANSLATE_NOOP("Caustics", "%1 deviations beyond chance, %2 needed"))
                       .arg(number(std::max(r.dispersion, 0.0F), r.dispersion < 100.0F ? 1 : 0),
                            number(r.threshold, r.threshold < 10.0F && r.threshold != std::floor(r.threshold) ? 1 : 0));
    if (r.wish.threshold > 0.0F) {
        text += words(QT_TRANSLATE_NOOP("Caustics", " (set by hand)"));
    }
    return text;
}

QString finding_text(const CausticRow& row, Decision found) {
    switch (found) {
    case Decision::Texture:
        return words(QT_TRANSLATE_NOOP("Caustics", "finer detail than the mesh has (%1)")).arg(test_text(row));
    case Decision::Uniform: return words(QT_TRANSLATE_NOOP("Caustics", "as even as chance allows (%1)")).arg(test_text(row));
    case Decision::Coarse:
        return words(QT_TRANSLATE_NOOP("Caustics", "no finer detail than the mesh has (%1)")).arg(test_text(row));
    case Decision::TooFew: return words(QT_TRANSLATE_NOOP("Caustics", "too few particles to say"));
    case Decision::Uncharted: return words(QT_TRANSLATE_NOOP("Caustics", "pieces too small for a texture"));
    case Decision::SetToMesh: break;
    }
    return {};
}

const Feature* feature_named(const Solution& solution, const char* name) {
    const auto& all = solution.statistics.features;
    const auto at = std::find_if(all.begin(), all.end(), [name](const Feature& f) { return f.name == name; });
    return at == all.end() ? nullptr : &*at;
}

} // namespace

double CausticRow::coverage() const {
    double sum = 0.0;
    for (const vec4& box : record.boxes) {
        sum += double(box.z - box.x) * double(box.w - box.y);
    }
    return std::min(sum, 1.0);
}

double CausticRow::texel() const {
    if (!has_texture() || record.width == 0 || record.height == 0) {
        return 0.0;
    }
    // Paper mode gives every box as many texels as the whole chart would have.
    if (!textures.empty() && !record.boxes.empty() && textures.front()->width > 0) {
        const vec4& box = record.boxes.front();
        return double(box.z - box.x) * double(record.extent.x) / textures.front()->width;
    }
    return double(record.extent.x) / record.width;
}

bool CausticRow::same_place(const CausticRow& other) const { return place_of(*this) == place_of(other); }
bool CausticRow::before(const CausticRow& other) const { return place_of(*this) < place_of(other); }

std::vector<CausticRow> caustic_rows(const Scene& scene, const Solution& solution) {
    std::map<std::pair<NodeId, std::uint32_t>, const SurfaceLayer*> layers;
    for (const auto& layer : solution.surfaces) {
        layers[{layer->node, layer->part}] = layer.get();
    }
    // A side's textures are those of its charts in the order of its records.
    std::map<std::tuple<NodeId, std::uint32_t, bool>, std::size_t> next;
    std::map<NodeId, std::size_t> parts;
    std::map<std::tuple<NodeId, std::uint32_t, bool>, std::size_t> charts;
    for (const CausticRecord& r : solution.caustic_records) {
        parts[r.node] = std::max<std::size_t>(parts[r.node], r.part + 1);
        ++charts[{r.node, r.part, r.back}];
    }
    std::vector<CausticRow> rows;
    rows.reserve(solution.caustic_records.size());
    for (const CausticRecord& r : solution.caustic_records) {
        CausticRow row;
        row.record = r;
        row.paper = solution.statistics.mode == "paper";
        row.name = node_name(scene, r.node);
        if (parts[r.node] > 1) {
            row.name += words(QT_TRANSLATE_NOOP("Caustics", ", part %1")).arg(r.part + 1);
        }
        if (charts[{r.node, r.part, r.back}] > 1 && r.chart != kNoChart) {
            row.name += words(QT_TRANSLATE_NOOP("Caustics", ", piece %1")).arg(r.chart + 1);
        } else if (r.chart == kNoChart) {
            row.name += words(QT_TRANSLATE_NOOP("Caustics", ", small pieces"));
        }
        if (r.back) {
            row.name += words(QT_TRANSLATE_NOOP("Caustics", ", back"));
        }
        const auto layer = layers.find({r.node, r.part});
        if (layer != layers.end()) {
            const auto& all = r.back ? layer->second->caustic_textures_back : layer->second->caustic_textures_front;
            std::size_t& at = next[{r.node, r.part, r.back}];
            for (std::size_t i = 0; i < r.boxes.size() && at < all.size(); ++i) {
                row.textures.push_back(all[at++]);
            }
        }
        rows.push_back(std::move(row));
    }
    std::sort(rows.begin(), rows.end(), [](const CausticRow& a, const CausticRow& b) { return a.before(b); });
    return rows;
}

QString caustic_decision_text(const CausticRow& row) {
    QString text =
        row.has_texture() ? words(QT_TRANSLATE_NOOP("Caustics", "Texture")) : words(QT_TRANSLATE_NOOP("Caustics", "Mesh"));
    if (row.record.wish.show != CausticWish::Show::Automatic) {
        text += words(QT_TRANSLATE_NOOP("Caustics", " (by hand)"));
    }
    return text;
}

QString caustic_reason_text(const CausticRow& row) {
    const CausticRecord& r = row.record;
    const QString found = finding_text(row, r.found);
    QString text;
    switch (r.wish.show) {
    case CausticWish::Show::Automatic: text = found; break;
    case CausticWish::Show::Mesh:
        text = words(QT_TRANSLATE_NOOP("Caustics", "set by hand to the mesh; found: %1")).arg(found);
        break;
    case CausticWish::Show::Texture:
        text = row.has_texture() ? words(QT_TRANSLATE_NOOP("Caustics", "set by hand to a texture; found: %1")).arg(found)
                                 : words(QT_TRANSLATE_NOOP("Caustics", "set by hand to a texture, which cannot be: %1"))
                                       .arg(finding_text(row, r.decision));
        break;
    }
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    return text;
}

QString caustic_sizing_text(const CausticRow& row) {
    if (!row.has_texture()) {
        return {};
    }
    switch (row.record.sizing) {
    case Sizing::Footprints: return words(QT_TRANSLATE_NOOP("Caustics", "Half as wide as narrow kernels"));
    case Sizing::Mesh: return words(QT_TRANSLATE_NOOP("Caustics", "A quarter of the mesh; kernels are wide"));
    case Sizing::Particles: return words(QT_TRANSLATE_NOOP("Caustics", "About one particle a texel"));
    case Sizing::Brightness: return words(QT_TRANSLATE_NOOP("Caustics", "The most light that a texel can hold"));
    case Sizing::Memory: return words(QT_TRANSLATE_NOOP("Caustics", "The memory for textures"));
    case Sizing::ByHand: return words(QT_TRANSLATE_NOOP("Caustics", "Set by hand"));
    case Sizing::Equation7: return words(QT_TRANSLATE_NOOP("Caustics", "Equation 7 of the paper"));
    case Sizing::None: break; // light stored by an earlier version does not say
    }
    return words(QT_TRANSLATE_NOOP("Caustics", "Not known"));
}

QString caustic_kernel_text(const CausticRow& row) {
    if (!row.has_texture()) {
        return {};
    }
    if (row.paper) {
        return words(QT_TRANSLATE_NOOP("Caustics", "spiral"));
    }
    return row.record.kernel > 0.0F ? length_text(double(row.record.kernel)) : QString();
}

QString caustic_nothing_text(const Solution* solution) {
    if (solution == nullptr) {
        return words(QT_TRANSLATE_NOOP("Caustics", "There is no light yet."));
    }
    if (!solution->caustic_records.empty()) {
        return {};
    }
    QString text = words(QT_TRANSLATE_NOOP("Caustics", "No caustics fall on any surface of this scene."));
    QStringList reasons;
    for (const char* name : {"particles", "caustic_textures"}) {
        const Feature* feature = feature_named(*solution, name);
        if (feature != nullptr && !feature->used && !reasons.contains(QString::fromStdString(feature->why))) {
            reasons += QString::fromStdString(feature->why);
        }
    }
    if (!solution->final && reasons.isEmpty()) {
        reasons += words(QT_TRANSLATE_NOOP("Caustics", "The light is still being computed."));
    }
    for (const QString& reason : reasons) {
        text += QLatin1Char('\n') + reason;
    }
    return text;
}

QString caustic_summary_text(const Solution& solution) {
    std::uint64_t textures = 0, bytes = 0;
    double in_textures = 0.0, on_mesh = 0.0;
    for (const CausticRecord& r : solution.caustic_records) {
        textures += r.boxes.size();
        bytes += r.bytes;
        in_textures += r.power_texture;
        on_mesh += r.power_mesh;
    }
    const Statistics& s = solution.statistics;
    const double all = in_textures + on_mesh;
    QString text = textures == 1 ? words(QT_TRANSLATE_NOOP("Caustics", "1 texture"))
                                 : words(QT_TRANSLATE_NOOP("Caustics", "%1 textures")).arg(count_text(textures));
    text += words(QT_TRANSLATE_NOOP("Caustics", ", %1 \u00b7 %2 particles sent, %3 landings kept"))
                .arg(memory_text(bytes), count_text(s.particles_emitted), count_text(s.particles_stored));
    if (all > 0.0) {
        text += words(QT_TRANSLATE_NOOP("Caustics", " \u00b7 %1 in textures, %2 on the mesh"))
                    .arg(lumen_text(in_textures), lumen_text(on_mesh));
        if (s.energy.emitted > 0.0) {
            text +=
                words(QT_TRANSLATE_NOOP("Caustics", ": %1 of the scene's light")).arg(share_text(all / s.energy.emitted));
        }
    }
    return text;
}

QString count_text(std::uint64_t n) { return QLocale().toString(qulonglong(n)); }

QString length_text(double metres) {
    if (metres < 0.1) {
        return words(QT_TRANSLATE_NOOP("Caustics", "%1 mm"))
            .arg(number(1000.0 * metres, metres < 0.001  ? 2
                                         : metres < 0.01 ? 1
                                                         : 0));
    }
    return words(QT_TRANSLATE_NOOP("Caustics", "%1 m")).arg(number(metres, 2));
}

QString lumen_text(double lumen) {
    const int decimals = lumen >= 100.0 || lumen == 0.0 ? 0 : (lumen >= 10.0 ? 1 : 2);
    return words(QT_TRANSLATE_NOOP("Caustics", "%1 lm")).arg(number(lumen, decimals));
}

QString memory_text(std::uint64_t bytes) {
    return QLocale().formattedDataSize(qint64(bytes), 1, QLocale::DataSizeTraditionalFormat);
}

QString share_text(double share) {
    return words(QT_TRANSLATE_NOOP("Caustics", "%1 %")).arg(number(100.0 * share, share < 0.0995 ? 1 : 0));
}

} // namespace atrium::ui
