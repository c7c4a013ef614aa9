#include "ui/viewport/light_inspector.h"

#include "engine/measure/light_range.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"

#include <QCoreApplication>
#include <QLocale>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kFadeMs = 4000; ///< marks of an update: full for the first half, gone after all of it
constexpr int kFadeTickMs = 200;

QString told(const char* text) { return QCoreApplication::translate("Inspection", text); }

} // namespace

LightInspector::LightInspector(std::function<const Scene&()> scene,
                               std::function<std::shared_ptr<const LocalError>()> known_error, QObject* parent)
    : QObject(parent), scene_(std::move(scene)), known_error_(std::move(known_error)) {
    fade_.setInterval(kFadeTickMs);
    connect(&fade_, &QTimer::timeout, this, [this] {
        if (update_age_.elapsed() >= kFadeMs) {
            fade_.stop();
            update_.reset();
        }
        if (update_age_.elapsed() > kFadeMs / 2) {
            Q_EMIT figures_changed();
        }
    });
}

void LightInspector::set_choice(const InspectionChoice& choice) {
    if (choice == choice_) {
        return;
    }
    choice_ = choice;
    if (!choice_.links) {
        place_.reset();
        links_.reset();
    }
    if (!choice_.last_update) {
        update_.reset();
        update_words_.clear();
        fade_.stop();
    }
    if (choice_.colors != ElementColors::Error) {
        stop_error_.request_stop();
        error_ = {};
        error_surfaces_.clear();
    }
    make();
    make_error();
    make_histogram();
    Q_EMIT figures_changed();
}

void LightInspector::take(const std::shared_ptr<const Solution>& solution) {
    const std::shared_ptr<const Solution> before = std::exchange(solution_, solution);
    // An update: not a whole new solution, and not a first, coarse picture of one.
    const bool update = solution && solution->updatable && !solution->final;
    if (choice_.last_update && before && update && before != solution) {
        make_update(before, solution);
    }
    if (choice_.needs_insides()) {
        make();
        follow_element();
    }
    make_error();
    make_histogram();
}

void LightInspector::select(const std::unordered_set<NodeId>& nodes) {
    if (nodes != of_) {
        of_ = nodes;
        if (choice_.elements || choice_.ways || choice_.octree) {
            make();
        }
        make_histogram();
    }
}

void LightInspector::clear() {
    ++number_;
    ++count_number_;
    stop_error_.request_stop();
    error_ = {};
    error_surfaces_.clear();
    amounts_.clear();
    solution_.reset();
    of_.clear();
    made_ = {};
    place_.reset();
    links_.reset();
    update_.reset();
    update_words_.clear();
    fade_.stop();
}

void LightInspector::make() {
    ++number_;
    const bool elements = choice_.elements || of_elements(choice_.colors);
    if (!elements) {
        made_.view.reset();
        made_.from.reset();
        made_.mesh.reset();
        made_.colors.reset();
    }
    if (!choice_.ways) {
        made_.ways.reset();
        made_.way_words.clear();
    }
    if (!choice_.octree) {
        made_.octree.reset();
        made_.octree_words.clear();
    }
    if (working_ || !(elements || choice_.ways || choice_.octree)) {
        return; // it looks again when it is done
    }
    if (!solution_ || !solution_->insides) {
        return; // what there was stays until the next ones come
    }
    working_ = true;
    run_in_background(
        this,
        [solution = solution_, of = of_, choice = choice_, known = made_, known_colors = made_colors_,
         elements]() -> Result<Made> {
            Made out;
            out.from = solution->insides;
            if (elements) {
                const bool same = known.from == solution->insides && known.view;
                out.view = same ? known.view : view_elements(*solution);
                if (choice.elements) {
                    out.mesh = element_mesh(*out.view, of);
                    out.leaves = count_leaves(*out.view, of);
                }
                if (of_elements(choice.colors)) {
                    const bool ready = same && known.colors && known_colors == choice.colors;
                    out.scale = ready ? known.scale : element_scale(*out.view, choice.colors);
                    out.colors = ready ? known.colors : element_colors(*out.view, choice.colors, out.scale);
                }
            }
            if (choice.ways) {
                const ParticleView particles = view_particles(*solution, of);
                out.ways = particle_ways(particles);
                out.way_words = particle_words(particles, !of.empty());
            }
            if (choice.octree) {
                const OctreeView octree = view_octree(*solution, of);
                out.octree = octree_cells(octree);
                out.octree_words = octree_words(octree, !of.empty());
            }
            return out;
        },
        [this, wanted = number_, colors = choice_.colors](const Result<Made>& made) {
            working_ = false;
            if (wanted != number_) {
                make();
                return;
            }
            if (made) {
                made_ = *made;
                made_colors_ = colors;
                Q_EMIT figures_changed();
            }
        });
}

void LightInspector::make_update(const std::shared_ptr<const Solution>& before,
                                 const std::shared_ptr<const Solution>& after) {
    struct Marks {
        std::shared_ptr<const FigureSet> set;
        QStringList words;
    };
    run_in_background(
        this,
        [before, after]() -> Result<Marks> {
            const UpdateView view = view_update(*before, *after);
            return Marks{update_marks(view), update_words(view, 1000.0 * after->statistics.time.solve)};
        },
        [this, after](const Result<Marks>& marks) {
            if (!marks || !choice_.last_update || solution_ != after) {
                return;
            }
            update_ = marks->set;
            update_words_ = marks->words;
            update_age_.restart();
            fade_.start();
            Q_EMIT figures_changed();
        });
}

void LightInspector::follow_element() {
    if (!choice_.links || !place_ || !solution_ || !solution_->insides) {
        return;
    }
    const auto leaf = leaf_at(*solution_, place_->node, place_->part, place_->point, place_->back);
    links_ = leaf ? std::optional(links_of(*solution_, *leaf)) : std::nullopt;
    shaft_ = 0;
    Q_EMIT changed();
}

void LightInspector::make_error() {
    if (choice_.colors != ElementColors::Error || !solution_) {
        return;
    }
    if (error_.set && solution_->surfaces != error_surfaces_) { // of other light
        error_ = {};
        Q_EMIT figures_changed();
    }
    if (error_.set || measuring_error_ || !solution_->final) {
        return;
    }
    measuring_error_ = true;
    error_failure_.clear();
    stop_error_ = StopFlag();
    run_in_background(
        this,
        [scene = scene_(), solution = solution_, stop = stop_error_, known = known_error_()]() -> Result<ErrorFigures> {
            if (known) {
                return error_colors(scene, *solution, *known);
            }
            AuditSettings settings = audit_settings(scene.settings.quality);
            settings.seed = scene.settings.seed;
            RunContext context;
            context.stop = stop;
            auto places = audit_places(scene, *solution, settings, context);
            if (!places) {
                return tl::unexpected(places.error());
            }
            return error_colors(scene, *solution, LocalError(std::move(*places)));
        },
        [this, of = solution_, stop = stop_error_](const Result<ErrorFigures>& made) {
            measuring_error_ = false;
            if (stop.stop_requested() || !solution_ || solution_->surfaces != of->surfaces) {
                make_error(); // for what is wanted by now
                return;
            }
            if (made) {
                error_ = *made;
                error_surfaces_ = of->surfaces;
            } else {
                error_failure_ = error_message(made.error());
            }
            Q_EMIT figures_changed();
        });
    Q_EMIT changed();
}

void LightInspector::measure(const std::optional<FalseColor>& scale, const LightShares& shares) {
    const bool other = scale.has_value() != measured_.has_value() || (scale && scale->quantity != measured_->quantity) ||
                       !(shares == shares_);
    measured_ = scale;
    shares_ = shares;
    if (other) {
        make_histogram();
    }
}

std::vector<float> LightInspector::bars() const {
    return choice_.histogram && measured_ ? light_bars(*measured_, amounts_) : std::vector<float>();
}

void LightInspector::make_histogram() {
    ++count_number_;
    if (!choice_.histogram || !measured_ || !solution_) {
        amounts_.clear();
        return;
    }
    if (counting_) {
        return; // it looks again when it is done
    }
    counting_ = true;
    run_in_background(
        this,
        [scene = scene_(), solution = solution_, quantity = measured_->quantity, shares = shares_,
         of = of_]() -> Result<std::vector<double>> {
            return light_amounts(scene, *solution, quantity, shares, of.empty() ? nullptr : &of);
        },
        [this, wanted = count_number_](const Result<std::vector<double>>& amounts) {
            counting_ = false;
            if (wanted != count_number_) {
                make_histogram();
            } else if (amounts) {
                amounts_ = *amounts;
                Q_EMIT changed();
            }
        });
}

bool LightInspector::choose(const Scene& scene, const std::optional<PickHit>& hit) {
    if (!choice_.links) {
        return false;
    }
    place_.reset();
    links_.reset();
    if (hit && scene.nodes.contains(hit->node)) {
        const dmat4 to_node = glm::inverse(scene.world_matrix(hit->node));
        place_ = Place{hit->node, hit->part, vec3(dvec3(to_node * dvec4(hit->point, 1.0))), !hit->front};
        follow_element();
    }
    return true;
}

bool LightInspector::point_at(const Scene& scene, const std::optional<PickHit>& hit) {
    if (!links_ || !solution_) {
        return false;
    }
    std::size_t found = 0;
    if (hit && scene.nodes.contains(hit->node)) {
        const dmat4 to_node = glm::inverse(scene.world_matrix(hit->node));
        const auto leaf =
            leaf_at(*solution_, hit->node, hit->part, vec3(dvec3(to_node * dvec4(hit->point, 1.0))), !hit->front);
        for (std::size_t i = 0; leaf && i < links_->links.size(); ++i) {
            found = links_->links[i].end.leaf == *leaf ? i : found;
        }
    }
    return std::exchange(shaft_, found) != found;
}

std::vector<ShownFigures> LightInspector::figures() const {
    std::vector<ShownFigures> out;
    const auto add = [&](bool on, const std::shared_ptr<const FigureSet>& set, float alpha = 1.0F) {
        if (on && set) {
            out.push_back({set, alpha});
        }
    };
    add(of_elements(choice_.colors) && choice_.colors == made_colors_, made_.colors);
    add(choice_.colors == ElementColors::Error, error_.set);
    add(choice_.elements, made_.mesh);
    add(choice_.ways, made_.ways);
    add(choice_.octree, made_.octree);
    if (update_) {
        add(choice_.last_update, update_,
            std::clamp(2.0F - 2.0F * float(update_age_.elapsed()) / float(kFadeMs), 0.0F, 1.0F));
    }
    return out;
}

void LightInspector::draw(OverlayBatch& batch, const CameraController& camera) const {
    if (choice_.links && links_) {
        draw_links(batch, camera, *links_, shaft_);
    }
}

QStringList LightInspector::words(const Scene& scene) const {
    QStringList out;
    if (choice_.needs_insides() && !(solution_ && solution_->insides) && !made_.from) {
        out << told(QT_TRANSLATE_NOOP("Inspection", "Elements and links come with the complete light"));
        return out;
    }
    if (choice_.elements && made_.mesh) {
        out << (of_.empty() ? told(QT_TRANSLATE_NOOP("Inspection", "%1 elements"))
                            : told(QT_TRANSLATE_NOOP("Inspection", "%1 elements of the selection")))
                   .arg(QLocale().toString(qulonglong(made_.leaves)));
    }
    if (choice_.links) {
        out << (links_
                    ? link_words(scene, *links_, shaft_)
                    : QStringList(told(QT_TRANSLATE_NOOP("Inspection", "Click a surface to see the links of its element"))));
    }
    if (choice_.ways && made_.ways) {
        out << made_.way_words;
    }
    if (choice_.octree && made_.octree) {
        out << made_.octree_words;
    }
    if (choice_.colors == ElementColors::Error) {
        if (measuring_error_) {
            out << told(QT_TRANSLATE_NOOP("Inspection", "Measuring the error ..."));
        } else if (error_.set) {
            out << told(QT_TRANSLATE_NOOP("Inspection", "Likely error (rms) from %1 measured places, %2 % over all"))
                       .arg(QLocale().toString(qulonglong(error_.places)), QLocale().toString(error_.overall, 'f', 1));
            out << told(QT_TRANSLATE_NOOP("Inspection",
                                          "Every place: from the %1 most like it, by position, direction and light"))
                       .arg(LocalError::kPlaces);
        } else {
            out << (error_failure_.isEmpty()
                        ? told(QT_TRANSLATE_NOOP("Inspection", "The error is measured when the light is complete"))
                        : error_failure_);
        }
    }
    if (choice_.histogram) {
        if (!measured_) {
            out << told(QT_TRANSLATE_NOOP("Inspection",
                                          "The histogram stands beside the legend of illuminance (F6) and luminance (F7)"));
        } else if (!amounts_.empty()) {
            const auto at = [&](double share) {
                return amount_text(amounts_[std::size_t(share * double(amounts_.size() - 1))]);
            };
            double sum = 0.0;
            for (const double amount : amounts_) {
                sum += amount;
            }
            out << (of_.empty() ? told(QT_TRANSLATE_NOOP(
                                      "Inspection", "All surfaces: mean %1 %2, median %3, nine tenths between %4 and %5"))
                                : told(QT_TRANSLATE_NOOP("Inspection",
                                                         "Selection: mean %1 %2, median %3, nine tenths between %4 and %5")))
                       .arg(amount_text(sum / double(amounts_.size())), QString::fromUtf8(unit_name(measured_->quantity)),
                            at(0.5), at(0.05), at(0.95));
        }
    }
    if (choice_.last_update) {
        out << (update_words_.isEmpty()
                    ? QStringList(told(QT_TRANSLATE_NOOP("Inspection", "Move something to see what the update changes")))
                    : update_words_);
    }
    return out;
}

std::optional<LightInspector::Scale> LightInspector::scale() const {
    if (choice_.colors == ElementColors::Error && error_.set) {
        return Scale{error_.scale, told(QT_TRANSLATE_NOOP("Inspection", "Error\n%"))};
    }
    if (!of_elements(choice_.colors) || made_colors_ != choice_.colors || !made_.colors) {
        return std::nullopt;
    }
    return Scale{made_.scale, choice_.colors == ElementColors::Level
                                  ? told(QT_TRANSLATE_NOOP("Inspection", "Subdivision\nlevel"))
                                  : told(QT_TRANSLATE_NOOP("Inspection", "Link density\n1/m\u00b2"))};
}

} // namespace atrium::ui
