#include "engine/radiosity/leaf_exchange.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kGrain = 512;

} // namespace

LeafExchange::LeafExchange(const Hierarchy& h, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& around)
    : leaves_(leaves), first_(leaves.size() + 1, 0), rays_(std::max(around.rays, 1U)), area_(leaves.size()),
      opacity_(around.opacity), row_sums_(leaves.size(), 0.0F) {
    const std::size_t n = leaves_.size();
    std::vector<std::uint32_t> order(h.elements.size(), 0); // of a leaf in leaves_
    for (std::size_t i = 0; i < n; ++i) {
        order[leaves_[i]] = std::uint32_t(i);
        area_[i] = h.elements[leaves_[i]].area * around.open[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = around.first_seen[i]; k < around.first_seen[i + 1]; ++k) {
            ++first_[i + 1];
            ++first_[order[around.seen[k].leaf] + 1];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        first_[i + 1] += first_[i];
    }
    entries_.resize(first_[n]);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = around.first_seen[i]; k < around.first_seen[i + 1]; ++k) {
            const std::uint32_t j = order[around.seen[k].leaf];
            // Samples of both leaves weighted against their variances; a leaf that sees itself gets two halves.
            const float weight = area_[i] * (area_[j] / (area_[i] + area_[j])) * around.seen[k].weight;
            entries_[next[i]++] = {j, weight};
            entries_[next[j]++] = {std::uint32_t(i), weight};
        }
    }
    // Entries of the same pair become one.
    std::vector<std::size_t> count(n);
    parallel_chunks(n, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto from = entries_.begin() + std::ptrdiff_t(first_[i]);
            const auto to = entries_.begin() + std::ptrdiff_t(first_[i + 1]);
            std::stable_sort(from, to, [](const Entry& a, const Entry& b) { return a.other < b.other; });
            auto out = from;
            for (auto at = from; at != to; ++at) {
                if (out != from && (out - 1)->other == at->other) {
                    (out - 1)->k += at->k;
                } else {
                    *out++ = *at;
                }
            }
            count[i] = std::size_t(out - from);
        }
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
        std::copy_n(entries_.begin() + std::ptrdiff_t(first_[i]), count[i], entries_.begin() + std::ptrdiff_t(kept));
        first_[i] = kept;
        kept += count[i];
    }
    first_[n] = kept;
    entries_.resize(kept);
    entries_.shrink_to_fit();

    // Closure. Both ends of a pair are scaled alike, so that the matrix stays symmetric. Glass is left out of the sums: how
    // much of the light ends there depends on its direction.
    std::vector<float> opaque(n);
    for (std::size_t i = 0; i < n; ++i) {
        opaque[i] = opacity_[i] >= 1.0F ? 1.0F : 0.0F;
    }
    std::vector<double> wanted(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = around.first_seen[i]; k < around.first_seen[i + 1]; ++k) {
            wanted[i] += double(around.seen[k].weight) * opaque[order[around.seen[k].leaf]];
        }
    }
    constexpr int kMostPasses = 30;
    constexpr double kClosed = 1e-7; // float rows cannot do better
    std::vector<double> scale(n, 1.0);
    std::vector<double> sums(n);
    const auto sum_rows = [&] {
        parallel_chunks(n, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                double sum = 0.0;
                for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
                    sum += double(entries_[k].k) * scale[entries_[k].other] * opaque[entries_[k].other];
                }
                sums[i] = scale[i] * sum / area_[i];
            }
        });
    };
    double worst = 1.0;
    for (int pass = 0; pass < kMostPasses && worst > kClosed; ++pass) {
        sum_rows();
        worst = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            if (sums[i] > 0.0) {
                worst = std::max(worst, std::abs(sums[i] - wanted[i]));
                // Limits keep a leaf that hardly anything sees from being blown up.
                scale[i] = std::clamp(scale[i] * std::sqrt(wanted[i] / sums[i]), 0.25, 4.0);
            }
        }
    }
    sum_rows();
    // What is left over is taken off both sides, never added: min over the pair keeps the symmetry.
    parallel_chunks(n, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            double sum = 0.0;
            for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
                Entry& entry = entries_[k];
                const double over = std::max({sums[i], sums[entry.other], 1.0});
                entry.k = float(entry.k * scale[i] * scale[entry.other] / over);
                sum += double(entry.k) * opacity_[entry.other];
            }
            row_sums_[i] = float(sum / area_[i]);
        }
    });
}

void LeafExchange::append(std::span<const std::uint32_t> leaves, const Hierarchy& h, const LeafSurroundings& around) {
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        leaves_.push_back(leaves[i]);
        first_.push_back(first_.back());
        area_.push_back(h.elements[leaves[i]].area * around.open[i]);
        opacity_.push_back(around.opacity[i]);
        row_sums_.push_back(around.share[i]);
    }
}

void LeafExchange::apply(const std::vector<Rgb>& radiosity, std::vector<Rgb>& irradiance) const {
    irradiance.resize(leaves_.size());
    parallel_chunks(leaves_.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            Rgb sum(0.0F);
            for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
                sum += radiosity[entries_[k].other] * entries_[k].k;
            }
            irradiance[i] = sum / area_[i];
        }
    });
}

double LeafExchange::error_estimate(const Hierarchy& h, const SolveReport& report) const {
    // Stratified rays err less than independent ones: by about this share of the variance, measured in furnished rooms.
    constexpr double kStratified = 0.35;
    const std::size_t n = leaves_.size();
    std::vector<double> light(n);    // luminance of B
    std::vector<double> variance(n); // of B: by chance, and within the leaf
    for (std::size_t i = 0; i < n; ++i) {
        light[i] = luminance(h.elements[leaves_[i]].radiosity);
    }
    parallel_chunks(n, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const Element& e = h.elements[leaves_[i]];
            double sum = 0.0;
            double weight = 0.0;
            for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
                sum += double(entries_[k].k) * light[entries_[k].other];
                weight += entries_[k].k;
            }
            const double mean = weight > 0.0 ? sum / weight : 0.0;
            double chance = 0.0;
            for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
                const double area = area_[entries_[k].other]; // samples of both leaves were weighted by each other's areas
                const double d = light[entries_[k].other] - mean;
                chance += entries_[k].k * area / (area_[i] + area) * d * d;
            }
            const double rho = luminance(e.rho);
            chance *= kStratified * rho * rho / (double(area_[i]) * rays_);
            // A gradient over the parent goes on within its parts: half as far each way in a part of half the length.
            double within = 0.0;
            if (e.kind == Element::Kind::Patch && h.elements[e.parent].kind == Element::Kind::Patch) {
                const double d = 0.5 * (light[i] - luminance(h.elements[e.parent].radiosity));
                within = d * d;
            }
            variance[i] = chance + within;
        }
    });
    // One gather: errors of leaves are independent, so squares add.
    struct Sums {
        double error = 0.0, light = 0.0, area = 0.0;
        Sums operator+(const Sums& o) const { return {error + o.error, light + o.light, area + o.area}; }
        Sums& operator+=(const Sums& o) { return *this = *this + o; }
    };
    const Sums sums = parallel_sum(n, kGrain, Sums{}, [&](std::size_t i) {
        double error = 0.0;
        double received = 0.0;
        for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
            const double f = double(entries_[k].k) / area_[i];
            const double area = area_[entries_[k].other];
            // A sampled factor's square is too large by its variance, that of a count times the weight of one ray.
            const double one_ray = area / ((area_[i] + area) * rays_);
            error += f * (f - one_ray) * variance[entries_[k].other];
            received += f * light[entries_[k].other];
        }
        return Sums{double(area_[i]) * error, double(area_[i]) * received, area_[i]};
    });
    if (!(sums.light > 0.0)) {
        return 0.0;
    }
    // What the solver left shrinks by the reflectance with every bounce still to come.
    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        most = std::max(most, double(max_component(h.elements[leaves_[i]].rho)) * row_sums_[i]);
    }
    return std::sqrt(std::max(sums.error, 0.0) / sums.area) / (sums.light / sums.area) +
           report.residual / std::max(1.0 - most, 1e-6);
}

std::size_t LeafExchange::memory_bytes() const {
    return entries_.capacity() * sizeof(Entry) + first_.capacity() * sizeof(std::size_t) +
           leaves_.capacity() * (sizeof(std::uint32_t) + 3 * sizeof(float));
}

SolveReport solve_radiosity(Hierarchy& h, const LeafExchange& exchange, double tolerance, int max_iterations,
                            const RunContext& context) {
    const std::vector<std::uint32_t>& leaves = exchange.leaves();
    const std::size_t n = leaves.size();
    SolveReport report;
    // With S = sqrt(rho A), u = S E solves (I - S K' S) u = S K' b, K' = K / A^2 between S, which is symmetric and positive
    // definite whatever the reflectances, black included.
    std::vector<Rgb> b(n), s(n), u(n), scratch(n), e(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Element& element = h.elements[leaves[i]];
        b[i] = element.first_radiosity();
        s[i] = glm::sqrt(element.rho * exchange.area()[i]);
        u[i] = s[i] * element.irradiance;
    }
    const auto dot = [&](const std::vector<Rgb>& p, const std::vector<Rgb>& q) {
        return parallel_sum(n, kGrain, 0.0, [&](std::size_t i) {
            return double(p[i].r) * q[i].r + double(p[i].g) * q[i].g + double(p[i].b) * q[i].b;
        });
    };
    const auto gather = [&](const std::vector<Rgb>& radiosity) {
        exchange.apply(radiosity, e);
        ++report.iterations;
    };
    const auto reflect = [&](const std::vector<Rgb>& from, std::vector<Rgb>& to) {
        for (std::size_t i = 0; i < n; ++i) {
            scratch[i] = s[i] * from[i] / exchange.area()[i];
        }
        gather(scratch);
        for (std::size_t i = 0; i < n; ++i) {
            to[i] = s[i] * e[i];
        }
    };
    std::vector<Rgb> r(n), p(n), q(n);
    // r = S K (b + rho E) / A - u: one gather for both.
    for (std::size_t i = 0; i < n; ++i) {
        scratch[i] = b[i] + s[i] * u[i] / exchange.area()[i];
    }
    gather(scratch);
    for (std::size_t i = 0; i < n; ++i) {
        r[i] = s[i] * e[i] - u[i];
    }
    // Of B = b + rho E what another gather would change, and B's size: area-weighted squares.
    const auto residual = [&] {
        const double change = parallel_sum(n, kGrain, 0.0, [&](std::size_t i) {
            const Rgb d = s[i] * r[i];
            return double(glm::dot(d, d)) / exchange.area()[i];
        });
        const double size = parallel_sum(n, kGrain, 0.0, [&](std::size_t i) {
            const Rgb radiosity = b[i] + s[i] * u[i] / exchange.area()[i];
            return double(exchange.area()[i]) * glm::dot(radiosity, radiosity);
        });
        return size > 0.0 ? std::sqrt(change / size) : 0.0;
    };
    p = r;
    double rr = dot(r, r);
    report.residual = residual();
    while (report.residual > tolerance && report.iterations + 1 < max_iterations && !context.should_stop()) {
        reflect(p, q);
        for (std::size_t i = 0; i < n; ++i) {
            q[i] = p[i] - q[i];
        }
        const double pq = dot(p, q);
        if (!(pq > 0.0)) {
            break;
        }
        const auto alpha = float(rr / pq);
        for (std::size_t i = 0; i < n; ++i) {
            u[i] += alpha * p[i];
            r[i] -= alpha * q[i];
        }
        const double next = dot(r, r);
        const auto beta = float(next / rr);
        rr = next;
        for (std::size_t i = 0; i < n; ++i) {
            p[i] = r[i] + beta * p[i];
        }
        report.residual = residual();
    }
    // One gather more takes its share of what is left and gives the irradiances that belong to the radiosities.
    for (std::size_t i = 0; i < n; ++i) {
        scratch[i] = glm::max(b[i] + s[i] * u[i] / exchange.area()[i], Rgb(0.0F));
    }
    gather(scratch);
    double change = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        Element& element = h.elements[leaves[i]];
        const Rgb next = b[i] + element.rho * e[i];
        const Rgb d = next - scratch[i];
        change += double(exchange.area()[i]) * glm::dot(d, d);
        size += double(exchange.area()[i]) * glm::dot(next, next);
        element.irradiance = e[i];
        element.radiosity = next;
    }
    report.residual = size > 0.0 ? std::sqrt(change / size) : 0.0;
    report.converged = report.residual <= tolerance;
    h.pull_radiosity();
    return report;
}

} // namespace atrium
