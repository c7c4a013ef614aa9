// Layers and statistics as bytes for the project file: a fixed header, a JSON part, arrays as byte planes, light maps as
// residuals of halves; all zstd-compressed.
#include "engine/base/float_traps.h"
#include "engine/solver/light_map_codec.h"
#include "engine/solver/solution.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <zstd.h>

namespace atrium {
namespace {

constexpr char kMagic[8] = {'A', 'T', 'R', 'L', 'I', 'G', 'H', 'T'};
constexpr std::uint32_t kVersion = 4;
constexpr std::uint32_t kOldest = 3; ///< without what CausticRecord says of kernels and of what was set by hand
constexpr std::uint64_t kMaxBytes = std::uint64_t(4) << 30;
constexpr float kLargestChartCoordinate = 1e6F; ///< tiles; no surface has a thousandth of it

struct Header {
    char magic[8];
    std::uint32_t version;
    std::uint32_t reserved;
    std::uint64_t raw_size;
};

nlohmann::json to_json(const Statistics& s) {
    nlohmann::json phases = nlohmann::json::array();
    for (const auto& p : s.phases) {
        phases.push_back({p.name, p.seconds, p.share});
    }
    nlohmann::json features = nlohmann::json::array();
    for (const auto& f : s.features) {
        features.push_back({f.name, f.used, f.why});
    }
    return {{"phases", phases},
            {"features", features},
            {"time", {s.time.load, s.time.build, s.time.solve, s.time.first_picture, s.time.total}},
            {"threads", s.threads},
            {"seed", s.seed},
            {"mode", s.mode},
            {"quality", s.quality},
            {"iterations", s.iterations},
            {"converged", s.converged},
            {"residual", s.residual},
            {"error_estimate", s.error_estimate},
            {"audit",
             {s.audit.rms, s.audit.low, s.audit.high, s.audit.bias, s.audit.bias_error, s.audit.points, s.audit.paths,
              s.audit.rays, s.audit.seconds, s.audit.typical}},
            {"link_budget_reached", s.link_budget_reached},
            {"counts", {s.triangles, s.elements, s.clusters, s.links, s.rays}},
            {"records", s.records},
            {"particles", {s.particles_emitted, s.particles_stored}},
            {"memory",
             {s.memory.elements, s.memory.links, s.memory.layers, s.memory.ray_scene, s.memory.peak_rss, s.memory.particles,
              s.memory.octree, s.memory.caustic_textures}},
            {"energy", {s.energy.emitted, s.energy.absorbed, s.energy.escaped, s.energy.defect}}};
}

Statistics statistics_from(const nlohmann::json& j) {
    Statistics s;
    for (const auto& p : j.at("phases")) {
        s.phases.push_back({p.at(0), p.at(1), p.at(2)});
    }
    for (const auto& f : j.at("features")) {
        s.features.push_back({f.at(0), f.at(1), f.at(2)});
    }
    const auto& t = j.at("time");
    s.time = {t.at(0), t.at(1), t.at(2), t.at(3), t.at(4)};
    s.threads = j.at("threads");
    s.seed = j.at("seed");
    s.mode = j.at("mode");
    s.quality = j.at("quality");
    s.iterations = j.at("iterations");
    s.converged = j.at("converged");
    s.residual = j.at("residual");
    s.error_estimate = j.at("error_estimate");
    if (j.contains("audit")) { // older projects have none
        const auto& a = j.at("audit");
        s.audit = {a.at(0), a.at(1), a.at(2), a.at(3), a.at(4),
                   a.at(5), a.at(6), a.at(7), a.at(8), a.size() > 9 ? double(a.at(9)) : 0.0};
    }
    s.link_budget_reached = j.value("link_budget_reached", false); // older projects do not say
    const auto& c = j.at("counts");
    s.triangles = c.at(0);
    s.elements = c.at(1);
    s.clusters = c.at(2);
    s.links = c.at(3);
    s.rays = c.at(4);
    s.records = j.at("records");
    const auto& p = j.at("particles");
    s.particles_emitted = p.at(0);
    s.particles_stored = p.at(1);
    const auto& m = j.at("memory");
    s.memory.elements = m.at(0);
    s.memory.links = m.at(1);
    s.memory.layers = m.at(2);
    s.memory.ray_scene = m.at(3);
    s.memory.peak_rss = m.at(4);
    s.memory.particles = m.at(5);
    s.memory.octree = m.at(6);
    s.memory.caustic_textures = m.at(7);
    const auto& e = j.at("energy");
    s.energy = {e.at(0), e.at(1), e.at(2), e.at(3)};
    return s;
}

bool on_chart(const vec2& uv) {
    return is_finite(uv) && std::abs(uv.x) <= kLargestChartCoordinate && std::abs(uv.y) <= kLargestChartCoordinate;
}

// Light may be any finite number; geometry must be finite and indices in range, or the file is damaged.
bool plausible(const SurfaceLayer& layer) {
    const DisplayMesh& mesh = *layer.mesh;
    const std::size_t n = mesh.positions.size();
    const auto optional = [&](const auto& values) { return values.empty() || values.size() == n; };
    if (mesh.normals.size() != n || layer.irradiance_front.size() != n || !optional(layer.irradiance_back) ||
        !optional(layer.direct_front) || !optional(layer.direct_back) || !optional(layer.caustic_front) ||
        !optional(layer.caustic_back) || !optional(mesh.texcoords0) || !optional(mesh.texcoords1) ||
        !optional(mesh.colors) || !optional(mesh.light_uv) || mesh.indices.size() % 3 != 0) {
        return false;
    }
    for (const std::uint32_t i : mesh.indices) {
        if (i >= n) {
            return false;
        }
    }
    for (const auto* values : {&mesh.positions, &mesh.normals, &layer.irradiance_front, &layer.irradiance_back,
                               &layer.direct_front, &layer.direct_back, &layer.caustic_front, &layer.caustic_back}) {
        for (const vec3& v : *values) {
            if (!is_finite(v)) {
                return false;
            }
        }
    }
    return std::all_of(mesh.light_uv.begin(), mesh.light_uv.end(), on_chart);
}

// Vertices of neighbouring triangles have neighbouring numbers: what is stored is the step from one to the next.
std::vector<std::uint32_t> steps_of(const std::vector<std::uint32_t>& indices) {
    std::vector<std::uint32_t> steps(indices.size());
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::uint32_t step = indices[i] - last;
        steps[i] = (step << 1U) ^ ((step >> 31U) != 0 ? 0xFFFFFFFFU : 0U);
        last = indices[i];
    }
    return steps;
}
void take_steps(std::vector<std::uint32_t>& indices) {
    std::uint32_t last = 0;
    for (std::uint32_t& i : indices) {
        last += (i >> 1U) ^ ((i & 1U) != 0 ? 0xFFFFFFFFU : 0U);
        i = last;
    }
}

void write_map(ByteWriter& out, const std::shared_ptr<const LightMap>& map) {
    out.value(std::uint8_t(map != nullptr));
    if (map) {
        write_light_map(out, *map);
    }
}
bool read_map(ByteReader& in, std::shared_ptr<const LightMap>& out) {
    std::uint8_t present = 0;
    if (!in.value(present) || present > 1) {
        return false;
    }
    if (present == 0) {
        return true;
    }
    auto map = std::make_shared<LightMap>();
    const bool good = read_light_map(in, *map);
    out = std::move(map);
    return good;
}

// GLM's vectors are not trivially copyable.
void write_pair(ByteWriter& out, const vec2& v) {
    out.value(v.x);
    out.value(v.y);
}
bool read_pair(ByteReader& in, vec2& v) { return in.value(v.x) && in.value(v.y); }

void write_textures(ByteWriter& out, const std::vector<std::shared_ptr<const CausticTexture>>& textures) {
    out.value(std::uint64_t(textures.size()));
    for (const auto& texture : textures) {
        write_pair(out, texture->low);
        write_pair(out, texture->high);
        out.value(texture->width);
        out.value(texture->height);
        out.array(texture->image);
    }
}
// A texture that was read can be evaluated anywhere.
bool plausible(const CausticTexture& t) {
    return t.width > 0 && t.height > 0 && t.image.size() == std::uint64_t(t.width) * t.height && on_chart(t.low) &&
           on_chart(t.high) && t.low.x < t.high.x && t.low.y < t.high.y &&
           std::all_of(t.image.begin(), t.image.end(), [](const Rgb& e) { return is_finite(e); });
}
bool read_textures(ByteReader& in, std::vector<std::shared_ptr<const CausticTexture>>& out) {
    std::uint64_t count = 0;
    if (!in.value(count) || count > in.left()) {
        return false;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        auto texture = std::make_shared<CausticTexture>();
        if (!read_pair(in, texture->low) || !read_pair(in, texture->high) || !in.value(texture->width) ||
            !in.value(texture->height) || !in.array(texture->image) || !plausible(*texture)) {
            return false;
        }
        out.push_back(std::move(texture));
    }
    return true;
}

void write_record(ByteWriter& out, const CausticRecord& r) {
    out.value(r.part);
    out.value(r.chart);
    out.value(std::uint8_t(r.back));
    out.value(std::uint8_t(r.decision));
    out.value(r.particles);
    out.value(r.contrast);
    out.value(r.dispersion);
    out.value(r.threshold);
    write_pair(out, r.extent);
    out.value(r.width);
    out.value(r.height);
    out.array(std::vector<char>(r.why.begin(), r.why.end()));
    out.array(r.boxes);
    out.value(r.power_texture);
    out.value(r.power_mesh);
    out.value(r.bytes);
    out.value(std::uint8_t(r.found));
    out.value(std::uint8_t(r.sizing));
    out.value(r.kernel);
    out.value(std::uint8_t(r.wish.show));
    out.value(r.wish.texel);
    out.value(r.wish.threshold);
}
bool read_wish(ByteReader& in, CausticRecord& r) {
    std::uint8_t found = 0, sizing = 0, show = 0;
    if (!in.value(found) || !in.value(sizing) || !in.value(r.kernel) || !in.value(show) || !in.value(r.wish.texel) ||
        !in.value(r.wish.threshold) || found > std::uint8_t(CausticRecord::Decision::SetToMesh) ||
        sizing > std::uint8_t(CausticRecord::Sizing::Equation7) || show > std::uint8_t(CausticWish::Show::Texture)) {
        return false;
    }
    r.found = CausticRecord::Decision(found);
    r.sizing = CausticRecord::Sizing(sizing);
    r.wish.show = CausticWish::Show(show);
    return true;
}
bool read_record(ByteReader& in, CausticRecord& r, std::uint32_t version) {
    std::uint8_t back = 0, decision = 0;
    std::vector<char> why;
    if (!in.value(r.part) || !in.value(r.chart) || !in.value(back) || !in.value(decision) || !in.value(r.particles) ||
        !in.value(r.contrast) || !in.value(r.dispersion) || !in.value(r.threshold) || !read_pair(in, r.extent) ||
        !in.value(r.width) || !in.value(r.height) || !in.array(why) || !in.array(r.boxes) || !in.value(r.power_texture) ||
        !in.value(r.power_mesh) || !in.value(r.bytes) || back > 1 ||
        decision > std::uint8_t(CausticRecord::Decision::SetToMesh)) {
        return false;
    }
    r.back = back != 0;
    r.decision = r.found = CausticRecord::Decision(decision);
    r.why.assign(why.begin(), why.end());
    return version == kOldest || read_wish(in, r);
}

} // namespace

std::vector<std::byte> encode_solution(const Solution& solution, const Scene& scene) {
    std::unordered_map<NodeId, std::uint32_t> order;
    for (const NodeId id : scene.in_tree_order()) {
        order.emplace(id, std::uint32_t(order.size()));
    }
    ByteWriter out;
    const std::string text = to_json(solution.statistics).dump();
    out.array(std::vector<char>(text.begin(), text.end()));
    out.value(std::uint8_t(solution.final));
    out.value(solution.mean_radiance);
    std::vector<const SurfaceLayer*> layers;
    for (const auto& layer : solution.surfaces) {
        if (order.contains(layer->node)) {
            layers.push_back(layer.get());
        }
    }
    out.value(std::uint64_t(layers.size()));
    for (const SurfaceLayer* layer : layers) {
        out.value(order.at(layer->node));
        out.value(layer->part);
        const DisplayMesh& mesh = *layer->mesh;
        out.array(mesh.positions);
        out.array(mesh.normals);
        out.array(mesh.texcoords0);
        out.array(mesh.texcoords1);
        out.array(mesh.colors);
        out.array(mesh.light_uv);
        out.array(steps_of(mesh.indices));
        out.array(layer->irradiance_front);
        out.array(layer->irradiance_back);
        out.array(layer->direct_front);
        out.array(layer->direct_back);
        write_map(out, layer->direct_map_front);
        write_map(out, layer->direct_map_back);
        out.array(layer->caustic_front);
        out.array(layer->caustic_back);
        write_textures(out, layer->caustic_textures_front);
        write_textures(out, layer->caustic_textures_back);
    }
    const auto kept = [&](const CausticRecord& r) { return order.contains(r.node); };
    const auto& records = solution.caustic_records;
    out.value(std::uint64_t(std::count_if(records.begin(), records.end(), kept)));
    for (const CausticRecord& record : records) {
        if (kept(record)) {
            out.value(order.at(record.node));
            write_record(out, record);
        }
    }
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    header.version = kVersion;
    header.raw_size = out.bytes.size();
    std::vector<std::byte> packed(sizeof(Header) + ZSTD_compressBound(out.bytes.size()));
    std::memcpy(packed.data(), &header, sizeof header);
    // The frame's checksum tells damage that would still decompress; without it flipped bits became other light.
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> compressor(ZSTD_createCCtx(), &ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(compressor.get(), ZSTD_c_compressionLevel, 3);
    ZSTD_CCtx_setParameter(compressor.get(), ZSTD_c_checksumFlag, 1);
    const std::size_t size = ZSTD_compress2(compressor.get(), packed.data() + sizeof header, packed.size() - sizeof header,
                                            out.bytes.data(), out.bytes.size());
    packed.resize(ZSTD_isError(size) != 0U ? 0 : sizeof header + size);
    return packed;
}

Result<std::shared_ptr<const Solution>> decode_solution(std::span<const std::byte> bytes, const Scene& scene) {
    const auto damaged = [] { return fail("", "stored light", "it is damaged", "The light is computed again"); };
    Header header{};
    if (bytes.size() < sizeof header) {
        return damaged();
    }
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) {
        return damaged();
    }
    if (header.version < kOldest || header.version > kVersion) {
        return fail("", "stored light", "it was written by another version of the program", "The light is computed again");
    }
    const auto packed = bytes.subspan(sizeof header);
    // The frame's own size is checked before anything of the claimed size is allocated.
    if (header.raw_size > kMaxBytes || ZSTD_getFrameContentSize(packed.data(), packed.size()) != header.raw_size) {
        return damaged();
    }
    std::vector<std::byte> raw(header.raw_size);
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) != 0U || size != raw.size()) {
        return damaged();
    }
    ByteReader in(raw);
    auto solution = std::make_shared<Solution>();
    std::vector<char> text;
    std::uint8_t final = 0;
    std::uint64_t count = 0;
    if (!in.array(text) || !in.value(final) || !in.value(solution->mean_radiance) || !in.value(count) ||
        count > raw.size()) {
        return damaged();
    }
    try {
        const FloatTrapsOff library; // which tells by an infinity that a number is too large
        solution->statistics = statistics_from(nlohmann::json::parse(text));
    } catch (const nlohmann::json::exception&) {
        return damaged();
    }
    solution->final = final != 0;
    const std::vector<NodeId> nodes = scene.in_tree_order();
    for (std::uint64_t i = 0; i < count; ++i) {
        auto layer = std::make_shared<SurfaceLayer>();
        auto mesh = std::make_shared<DisplayMesh>();
        std::uint32_t node = 0;
        if (!in.value(node) || node >= nodes.size() || !in.value(layer->part) || !in.array(mesh->positions) ||
            !in.array(mesh->normals) || !in.array(mesh->texcoords0) || !in.array(mesh->texcoords1) ||
            !in.array(mesh->colors) || !in.array(mesh->light_uv) || !in.array(mesh->indices) ||
            !in.array(layer->irradiance_front) || !in.array(layer->irradiance_back) || !in.array(layer->direct_front) ||
            !in.array(layer->direct_back) || !read_map(in, layer->direct_map_front) ||
            !read_map(in, layer->direct_map_back) || !in.array(layer->caustic_front) || !in.array(layer->caustic_back) ||
            !read_textures(in, layer->caustic_textures_front) || !read_textures(in, layer->caustic_textures_back)) {
            return damaged();
        }
        take_steps(mesh->indices);
        layer->node = nodes[node];
        layer->mesh = std::move(mesh);
        if (!plausible(*layer)) {
            return damaged();
        }
        solution->surfaces.push_back(std::move(layer));
    }
    if (!in.value(count) || count > in.left()) {
        return damaged();
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        CausticRecord record;
        std::uint32_t node = 0;
        if (!in.value(node) || node >= nodes.size() || !read_record(in, record, header.version)) {
            return damaged();
        }
        record.node = nodes[node];
        solution->caustic_records.push_back(std::move(record));
    }
    if (in.left() != 0) {
        return damaged();
    }
    return solution;
}

} // namespace atrium
