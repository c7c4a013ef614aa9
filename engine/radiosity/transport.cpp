#include "engine/radiosity/transport.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

using Kind = Element::Kind;
constexpr std::size_t kGrain = 2048;

// Projected radiosity of an element towards d: sum over its faces of area * B * cosine.
Rgb emission_towards(const Hierarchy& h, const Element& e, const vec3& d) {
    if (e.kind == Kind::Patch) {
        return e.radiosity * (e.area * std::max(glm::dot(e.normal, d), 0.0F));
    }
    return glm::max(sh_dot(h.harmonics[e.harmonics].emission, sh_basis(d)), Rgb(0.0F));
}

} // namespace

Transport::Transport(Hierarchy& hierarchy, const std::vector<Link>& links)
    : hierarchy_(hierarchy), leaves_(hierarchy.leaves()), first_entry_(hierarchy.elements.size() + 1, 0),
      scale_(leaves_.size(), 1.0F), guard_(leaves_.size(), 1.0F), gathered_(hierarchy.elements.size()) {
    for (const Link& link : links) {
        if (link.weight > 0.0F) {
            ++first_entry_[link.a + 1];
            ++first_entry_[link.b + 1];
        }
    }
    for (std::size_t i = 1; i < first_entry_.size(); ++i) {
        first_entry_[i] += first_entry_[i - 1];
    }
    entries_.resize(first_entry_.back());
    std::vector<std::uint32_t> next(first_entry_.begin(), first_entry_.end() - 1);
    for (const Link& link : links) {
        if (link.weight > 0.0F) {
            const bool patches =
                hierarchy.elements[link.a].kind == Kind::Patch && hierarchy.elements[link.b].kind == Kind::Patch;
            entries_[next[link.a]++] = {link.b, link.weight, patches};
            entries_[next[link.b]++] = {link.a, link.weight, patches};
        }
    }
    update_row_sums();
}

void Transport::update_row_sums() {
    const std::vector<Rgb> ones(leaves_.size(), Rgb(1.0F));
    std::vector<Rgb> sums;
    apply(ones, sums);
    row_sums_.resize(leaves_.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        row_sums_[i] = sums[i].r;
    }
}

void Transport::apply(const std::vector<Rgb>& radiosity, std::vector<Rgb>& irradiance) {
    Hierarchy& h = hierarchy_;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        h.elements[leaves_[i]].radiosity = radiosity[i] * scale_[i];
    }
    h.pull_radiosity();

    parallel_chunks(h.elements.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const Element& e = h.elements[i];
            Rgb sum(0.0F);
            ShRgb incident{};
            for (std::uint32_t k = first_entry_[i]; k < first_entry_[i + 1]; ++k) {
                const Entry& entry = entries_[k];
                const Element& source = h.elements[entry.other];
                if (entry.patches) {
                    sum += source.radiosity * (entry.weight / e.area);
                    continue;
                }
                const vec3 d = source.centre - e.centre;
                const float r = glm::length(d);
                const vec3 w = r > 0.0F ? d / r : vec3(0.0F, 1.0F, 0.0F);
                const Rgb arriving = emission_towards(h, source, -w) * entry.weight; // irradiance facing the source
                if (e.kind == Kind::Patch) {
                    sum += arriving * std::max(glm::dot(e.normal, w), 0.0F);
                } else {
                    const Sh basis = sh_basis(w);
                    for (std::size_t s = 0; s < kShCount; ++s) {
                        incident[s] += arriving * basis[s];
                    }
                }
            }
            gathered_[i] = sum;
            if (e.harmonics != Element::kNone) {
                h.harmonics[e.harmonics].incident = incident;
            }
        }
    });

    // Push: parents precede children, so one forward pass hands everything down.
    for (std::size_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const std::uint32_t c = e.first_child + k;
            const Element& child = h.elements[c];
            if (e.kind == Kind::Patch) {
                gathered_[c] += gathered_[i];
            } else if (child.kind == Kind::Patch) {
                gathered_[c] += sh_dot(h.harmonics[e.harmonics].incident, sh_clamped_cosine(child.normal, 1.0F));
            } else {
                ShRgb& into = h.harmonics[child.harmonics].incident;
                const ShRgb& from = h.harmonics[e.harmonics].incident;
                for (std::size_t s = 0; s < kShCount; ++s) {
                    into[s] += from[s];
                }
            }
        }
    }
    irradiance.resize(leaves_.size());
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        const Element& e = h.elements[leaves_[i]];
        Rgb value = gathered_[leaves_[i]];
        if (e.kind == Kind::Faces) {
            const Harmonics& own = h.harmonics[e.harmonics];
            value = sh_dot(own.incident, own.projected_area) / e.area;
        }
        irradiance[i] = value * (scale_[i] * guard_[i]);
    }
}

void Transport::close_rows(const std::vector<std::uint8_t>& enclosed) {
    constexpr int kPasses = 10; // the closure error falls about tenfold in five
    for (int pass = 0; pass < kPasses; ++pass) {
        for (std::size_t i = 0; i < leaves_.size(); ++i) {
            const float sum = row_sums_[i];
            if (sum > 1.0F || (enclosed[i] != 0 && sum > 0.0F)) {
                // Limits keep a leaf that hardly anything is linked to from being blown up.
                scale_[i] = std::clamp(scale_[i] / std::sqrt(sum), 0.25F, 2.0F);
            }
        }
        update_row_sums();
    }
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        // What ten passes left: exact on the receiving side.
        const bool fix = row_sums_[i] > 1.0F || (enclosed[i] != 0 && row_sums_[i] > 0.5F);
        guard_[i] = fix ? 1.0F / row_sums_[i] : 1.0F;
        row_sums_[i] *= guard_[i];
    }
}

std::size_t Transport::memory_bytes() const {
    return entries_.capacity() * sizeof(Entry) + first_entry_.capacity() * sizeof(std::uint32_t) +
           gathered_.capacity() * sizeof(Rgb) + leaves_.capacity() * (sizeof(std::uint32_t) + 3 * sizeof(float));
}

SolveReport solve_radiosity(Hierarchy& h, Transport& transport, double tolerance, int max_iterations,
                            const RunContext& context) {
    const std::vector<std::uint32_t>& leaves = transport.leaves();
    const std::size_t n = leaves.size();
    SolveReport report;
    std::vector<Rgb> b(n); // right-hand side M + rho D
    std::vector<Rgb> x(n); // radiosity
    std::vector<Rgb> e(n); // irradiance scratch
    for (std::size_t i = 0; i < n; ++i) {
        const Element& element = h.elements[leaves[i]];
        b[i] = element.first_radiosity();
        x[i] = element.radiosity;
    }
    // All three channels are one vector: they share the operator, and one step length keeps the sums few.
    const auto dot = [&](const std::vector<Rgb>& p, const std::vector<Rgb>& q) {
        return parallel_sum(n, kGrain, 0.0, [&](std::size_t i) {
            return double(h.elements[leaves[i]].area) *
                   (double(p[i].r) * q[i].r + double(p[i].g) * q[i].g + double(p[i].b) * q[i].b);
        });
    };
    const auto multiply = [&](const std::vector<Rgb>& p, std::vector<Rgb>& out) { // (I - rho T) p
        transport.apply(p, e);
        out.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            out[i] = p[i] - h.elements[leaves[i]].rho * e[i];
        }
        ++report.iterations;
    };
    const double norm_b = std::sqrt(dot(b, b));
    if (!(norm_b > 0.0)) {
        x.assign(n, Rgb(0.0F));
        report.converged = true;
    } else {
        std::vector<Rgb> r(n), p(n, Rgb(0.0F)), v(n, Rgb(0.0F)), s(n), t(n), best = x;
        multiply(x, r);
        for (std::size_t i = 0; i < n; ++i) {
            r[i] = b[i] - r[i];
        }
        const std::vector<Rgb> shadow = r;
        double rho = 1.0, alpha = 1.0, omega = 1.0;
        double residual = std::sqrt(dot(r, r)) / norm_b;
        double best_residual = residual;
        while (residual > tolerance && report.iterations < max_iterations && !context.should_stop()) {
            const double rho_next = dot(shadow, r);
            if (!(std::abs(rho_next) > 1e-300) || !(std::abs(omega) > 1e-300)) {
                break;
            }
            const double beta = (rho_next / rho) * (alpha / omega);
            rho = rho_next;
            for (std::size_t i = 0; i < n; ++i) {
                p[i] = r[i] + float(beta) * (p[i] - float(omega) * v[i]);
            }
            multiply(p, v);
            const double shadow_v = dot(shadow, v);
            if (!(std::abs(shadow_v) > 1e-300)) {
                break;
            }
            alpha = rho / shadow_v;
            for (std::size_t i = 0; i < n; ++i) {
                s[i] = r[i] - float(alpha) * v[i];
            }
            multiply(s, t);
            const double tt = dot(t, t);
            omega = tt > 0.0 ? dot(t, s) / tt : 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                x[i] += float(alpha) * p[i] + float(omega) * s[i];
                r[i] = s[i] - float(omega) * t[i];
            }
            residual = std::sqrt(dot(r, r)) / norm_b;
            if (!std::isfinite(residual)) {
                break;
            }
            if (residual < best_residual) {
                best_residual = residual;
                best = x;
            }
        }
        x = best;
        // Plain gathering from the best point: finishes what a breakdown left and costs one sweep where nothing is left.
        for (;;) {
            transport.apply(x, e);
            ++report.iterations;
            double change = 0.0;
            double size = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                const Element& element = h.elements[leaves[i]];
                const Rgb next = b[i] + element.rho * glm::max(e[i], Rgb(0.0F));
                const Rgb d = next - x[i];
                change += double(element.area) * glm::dot(d, d);
                size += double(element.area) * glm::dot(next, next);
                x[i] = next;
            }
            report.residual = size > 0.0 ? std::sqrt(change / size) : 0.0;
            report.converged = report.residual <= tolerance;
            if (report.converged || report.iterations >= max_iterations || context.should_stop()) {
                break;
            }
        }
    }
    transport.apply(x, e);
    for (std::size_t i = 0; i < n; ++i) {
        h.elements[leaves[i]].irradiance = glm::max(e[i], Rgb(0.0F));
        h.elements[leaves[i]].radiosity = glm::max(x[i], Rgb(0.0F));
    }
    h.pull_radiosity();
    return report;
}

} // namespace atrium
