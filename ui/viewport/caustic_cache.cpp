#include "ui/viewport/caustic_cache.h"

#include "engine/base/half.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace atrium::ui {
namespace {

/// Uploads of one frame, or of one turn of the event loop, milliseconds.
constexpr double kUploadMs = 6.0;

/// Texels between two looks at the clock: well below a millisecond.
constexpr std::uint32_t kSlice = 1U << 15U;

double milliseconds(const QElapsedTimer& clock) { return double(clock.nsecsElapsed()) * 1e-6; }

/// Fills `out` for an image of the given width; false when it gets too high.
bool fill_shelves(const CausticList& list, const std::vector<std::size_t>& order, std::uint32_t width,
                  std::uint32_t largest_side, CausticPlaces& out) {
    out.places.assign(list.size(), {});
    std::uint64_t x = 0, y = 0, shelf = 0;
    for (const std::size_t i : order) {
        if (x + list[i]->width > width) {
            y += shelf;
            x = shelf = 0;
        }
        if (list[i]->width > width || y + list[i]->height > largest_side) {
            return false;
        }
        out.places[i] = {std::uint32_t(x), std::uint32_t(y)};
        x += list[i]->width;
        shelf = std::max<std::uint64_t>(shelf, list[i]->height);
    }
    out.width = width;
    out.height = std::uint32_t(y + shelf);
    return true;
}

} // namespace

CausticPlaces place_caustics(const CausticList& list, std::uint32_t largest_side) {
    CausticPlaces out;
    std::vector<std::size_t> order(list.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    // High ones first, so that those on a shelf are about as high as it is.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return list[a]->height > list[b]->height; });
    double area = 0.0;
    std::uint32_t widest = 0;
    for (const auto& texture : list) {
        area += double(texture->width) * texture->height;
        widest = std::max(widest, texture->width);
    }
    const auto square = std::uint32_t(std::ceil(std::min(std::sqrt(area), double(largest_side))));
    if (list.size() > largest_side || (!fill_shelves(list, order, std::max(widest, square), largest_side, out) &&
                                       !fill_shelves(list, order, largest_side, largest_side, out))) {
        return {};
    }
    return out;
}

void CausticCache::initialize(Gl& gl) {
    GLint side = 0;
    gl.glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    largest_side_ = std::uint32_t(std::max(side, 0));
}

void CausticCache::release(Gl& gl) { collect(gl, {}); }

void CausticCache::begin_frame() {
    spent_ms_ = 0;
    pending_ = false;
}

bool CausticCache::too_large(const CausticList& list) const {
    return !list.empty() && place_caustics(list, largest_side_).places.empty();
}

bool CausticCache::ready(const CausticList& list) const {
    if (list.empty()) {
        return true;
    }
    const auto found = entries_.find(list);
    return found != entries_.end() ? found->second.complete : too_large(list);
}

const CausticCache::Texture* CausticCache::get(Gl& gl, const CausticList& list) {
    if (list.empty()) {
        return nullptr;
    }
    Entry& entry = entries_[list];
    if (!entry.complete && spent_ms_ < kUploadMs) {
        QElapsedTimer clock;
        clock.start();
        work(gl, list, entry, kUploadMs - spent_ms_);
        spent_ms_ += milliseconds(clock);
    }
    if (!entry.complete) {
        pending_ = true;
        return nullptr;
    }
    return entry.texture.count > 0 ? &entry.texture : nullptr;
}

bool CausticCache::upload_some(Gl& gl, const CausticList& list) {
    if (!ready(list)) {
        work(gl, list, entries_[list], kUploadMs);
    }
    return ready(list);
}

void CausticCache::work(Gl& gl, const CausticList& list, Entry& entry, double budget_ms) {
    QElapsedTimer clock;
    clock.start();
    if (entry.places.places.empty()) {
        entry.places = place_caustics(list, largest_side_);
        if (entry.places.places.empty()) {
            entry.complete = true; // shown as coarsely as the vertices are
            return;
        }
    }
    while (entry.scanned < list.size()) {
        const auto& image = list[entry.scanned]->image;
        const std::size_t end = std::min(entry.texels_scanned + kSlice, image.size());
        for (std::size_t i = entry.texels_scanned; i < end; ++i) {
            entry.largest = std::max(entry.largest, max_component(image[i]));
        }
        entry.texels_scanned = end;
        if (end == image.size()) {
            ++entry.scanned;
            entry.texels_scanned = 0;
        }
        if (milliseconds(clock) > budget_ms) {
            return;
        }
    }
    Texture& out = entry.texture;
    const int exponent = half_scale_exponent(entry.largest);
    const float inverse = std::ldexp(1.0F, -exponent);
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (out.image == 0) {
        out.scale = std::ldexp(1.0F, exponent);
        out.image = new_texture(gl, GL_LINEAR);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, GLsizei(entry.places.width), GLsizei(entry.places.height), 0, GL_RGB,
                        GL_HALF_FLOAT, nullptr);
        std::vector<vec4> table;
        out.low = list[0]->low;
        out.high = list[0]->high;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const CausticTexture& t = *list[i];
            const auto& place = entry.places.places[i];
            table.emplace_back(t.low.x, t.low.y, t.high.x, t.high.y);
            table.emplace_back(float(place.x), float(place.y), float(t.width), float(t.height));
            out.low = glm::min(out.low, t.low);
            out.high = glm::max(out.high, t.high);
        }
        out.boxes = new_texture(gl, GL_NEAREST);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 2, GLsizei(list.size()), 0, GL_RGBA, GL_FLOAT, table.data());
    }
    gl.glBindTexture(GL_TEXTURE_2D, out.image);
    while (entry.sent < list.size()) {
        if (milliseconds(clock) > budget_ms) {
            return;
        }
        const CausticTexture& t = *list[entry.sent];
        const auto& place = entry.places.places[entry.sent];
        const std::uint32_t end = std::min(entry.rows_sent + std::max(kSlice / std::max(t.width, 1U), 1U), t.height);
        halves_.clear();
        for (std::size_t i = std::size_t(entry.rows_sent) * t.width; i < std::size_t(end) * t.width; ++i) {
            for (int c = 0; c < 3; ++c) {
                halves_.push_back(half_from_float(t.image[i][c] * inverse));
            }
        }
        gl.glTexSubImage2D(GL_TEXTURE_2D, 0, GLint(place.x), GLint(place.y + entry.rows_sent), GLsizei(t.width),
                           GLsizei(end - entry.rows_sent), GL_RGB, GL_HALF_FLOAT, halves_.data());
        entry.rows_sent = end;
        if (end == t.height) {
            ++entry.sent;
            entry.rows_sent = 0;
        }
    }
    out.count = int(list.size());
    entry.complete = true;
}

void CausticCache::collect(Gl& gl, const std::set<CausticList>& wanted) {
    std::erase_if(entries_, [&](auto& item) {
        const bool gone = !wanted.contains(item.first);
        if (gone) {
            gl.glDeleteTextures(1, &item.second.texture.image);
            gl.glDeleteTextures(1, &item.second.texture.boxes);
        }
        return gone;
    });
}

} // namespace atrium::ui
