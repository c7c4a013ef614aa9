#include "tests/fuzz/entries.h"

#include "app/cli_points.h"
#include "engine/io/edit_script_reader.h"
#include "engine/io/ldt_reader.h"
#include "engine/io/scene_file.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace atrium::fuzz {
namespace {

// A folder of this process, gone at its end. In memory where there is such a place.
class Folder {
public:
    Folder() {
        std::string pattern =
            std::filesystem::is_directory("/dev/shm") ? "/dev/shm/atrium-fuzz-XXXXXX" : "/tmp/atrium-fuzz-XXXXXX";
        const char* made = mkdtemp(pattern.data());
        path_ = made != nullptr ? made : ".";
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::filesystem::path file(const char* name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

void require(bool fine, const char* what) {
    if (!fine) {
        std::fprintf(stderr, "fuzz: %s\n", what);
        std::abort();
    }
}

int read_as(const char* name, const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    std::ofstream(folder.file(name), std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
    const auto read = read_scene(folder.file(name));
    if (!read) {
        require(!read.error().what.empty(), "refused without a reason");
        return 0;
    }
    (void)find_problems(read->scene);
    // What can be read can be written, and that can be read.
    const auto written = write_scene(folder.file("again.glb"), read->scene);
    if (written) {
        const auto again = read_scene(folder.file("again.glb"));
        require(again.has_value(), "what was written cannot be read");
    }
    return 0;
}

int looked_up(const Result<LoadedPhotometry>& read) {
    if (!read) {
        require(!read.error().what.empty(), "refused without a reason");
        return 0;
    }
    for (int i = 0; i < 64; ++i) {
        const float z = 1.0F - 2.0F * (float(i) + 0.5F) / 64.0F, r = std::sqrt(1.0F - z * z), angle = 2.4F * float(i);
        const float x = read->web->relative({r * std::cos(angle), r * std::sin(angle), z});
        require(std::isfinite(x) && x >= 0.0F, "light that cannot be");
    }
    // What is kept of the file is what scene files hold: it must be read again, to the same.
    const auto again = parse_ies(read->web->data().file, "again.ies");
    require(again.has_value(), "what was kept cannot be read");
    return 0;
}

std::string text_of(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

} // namespace

int gltf(const std::uint8_t* data, std::size_t size) { return read_as("a.gltf", data, size); }
int glb(const std::uint8_t* data, std::size_t size) { return read_as("a.glb", data, size); }
int project(const std::uint8_t* data, std::size_t size) { return read_as("a.atrium", data, size); }

int edit_script(const std::uint8_t* data, std::size_t size) {
    const auto script = parse_edit_script(text_of(data, size), "a.json");
    require(script.has_value() || !script.error().what.empty(), "refused without a reason");
    return 0;
}

int points(const std::uint8_t* data, std::size_t size) {
    const auto list = cli::parse_points(text_of(data, size), "a.csv");
    require(list.has_value() || !list.error().what.empty(), "refused without a reason");
    if (list) {
        for (const auto& p : *list) {
            require(is_finite(vec3(p.normal)), "a normal that is no direction");
        }
    }
    return 0;
}

int ies(const std::uint8_t* data, std::size_t size) { return looked_up(parse_ies({data, size}, "a.ies")); }
int ldt(const std::uint8_t* data, std::size_t size) { return looked_up(parse_ldt({data, size}, "a.ldt")); }

} // namespace atrium::fuzz
