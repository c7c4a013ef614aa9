#include "engine/io/relink.h"

#include "engine/io/file_access.h"
#include "engine/io/image_file.h"

#include <algorithm>
#include <map>

namespace atrium {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLevels = 8;
constexpr int kMaxEntries = 100000;
constexpr std::uint64_t kMaxImageFile = std::uint64_t(1) << 30;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : char(c); });
    return text;
}

/// Parts of a path from its end, in lower case; Windows programs write backslashes.
std::vector<std::string> parts_from_end(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    std::vector<std::string> out;
    for (const fs::path& part : fs::path(path)) {
        out.insert(out.begin(), lower(part.string()));
    }
    return out;
}

std::size_t agreement(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    const auto [end, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    return std::size_t(end - a.begin());
}

const char* mime_type_of(const std::vector<std::uint8_t>& bytes, const std::string& before) {
    const auto starts = [&](std::initializer_list<std::uint8_t> magic) {
        return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    return starts({0x89, 'P', 'N', 'G'})  ? "image/png"
           : starts({0xFF, 0xD8, 0xFF})   ? "image/jpeg"
           : starts({'R', 'I', 'F', 'F'}) ? "image/webp"
                                          : before.c_str();
}

} // namespace

std::vector<TextureId> missing_textures(const Scene& scene) {
    std::vector<TextureId> out;
    scene.textures.for_each([&](TextureId id, const Texture& texture) {
        if (!texture.uri.empty() && !texture.encoded && !texture.image) {
            out.push_back(id);
        }
    });
    return out;
}

std::vector<std::pair<TextureId, Texture>> find_missing_textures(const Scene& scene, const fs::path& folder,
                                                                 const RunContext& context) {
    std::map<std::string, std::vector<fs::path>> by_name; // of the files that are wanted
    const std::vector<TextureId> missing = missing_textures(scene);
    for (const TextureId id : missing) {
        by_name[parts_from_end(scene.textures.find(id)->uri).front()];
    }
    std::error_code error;
    int entries = 0;
    for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
         !error && it != end && entries < kMaxEntries && !context.should_stop(); it.increment(error), ++entries) {
        std::error_code ignored;
        if (it.depth() >= kMaxLevels) {
            it.disable_recursion_pending();
        }
        const auto wanted = by_name.find(lower(it->path().filename().string()));
        if (wanted != by_name.end() && it->is_regular_file(ignored)) {
            wanted->second.push_back(it->path());
        }
    }
    std::vector<std::pair<TextureId, Texture>> out;
    for (const TextureId id : missing) {
        const Texture& texture = *scene.textures.find(id);
        const std::vector<std::string> wanted = parts_from_end(texture.uri);
        std::vector<fs::path> found = by_name[wanted.front()];
        std::sort(found.begin(), found.end());
        std::stable_sort(found.begin(), found.end(), [&](const fs::path& a, const fs::path& b) {
            return agreement(wanted, parts_from_end(a.string())) > agreement(wanted, parts_from_end(b.string()));
        });
        for (const fs::path& path : found) {
            if (context.should_stop()) {
                return out;
            }
            auto bytes = read_file(path, kMaxImageFile);
            if (!bytes) {
                continue;
            }
            auto image = decode_image(*bytes, path.filename().string());
            if (!image) {
                continue;
            }
            Texture linked = texture;
            linked.mime_type = mime_type_of(*bytes, texture.mime_type);
            linked.encoded = std::make_shared<const std::vector<std::uint8_t>>(std::move(*bytes));
            linked.image = std::make_shared<const Image>(std::move(*image));
            out.emplace_back(id, std::move(linked));
            break;
        }
    }
    return out;
}

} // namespace atrium
