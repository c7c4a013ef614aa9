// atrium-cli convert: between .gltf, .glb and .atrium.
#include "app/cli_commands.h"
#include "app/cli_support.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace atrium::cli {

namespace {

struct Arguments {
    std::string in;
    std::string out;
};

int run(const Arguments& a) {
    const std::string extension = extension_of(a.out);
    if (extension != ".gltf" && extension != ".glb" && extension != ".atrium") {
        return refuse({a.out, "", "cannot be written in this format", "Use a name that ends in .gltf, .glb or .atrium."});
    }
    if (auto fine = check_output(a.out); !fine) {
        return refuse(fine.error());
    }
    auto loaded = load(a.in);
    if (!loaded) {
        return refuse(loaded.error());
    }
    WriteOptions options;
    if (extension == ".atrium") {
        options.solution = std::move(loaded->solution);
    }
    const auto written = write_scene(a.out, loaded->scene, options);
    return written ? kDone : refuse(written.error());
}

} // namespace

void add_convert(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("convert", "Between .gltf, .glb and .atrium; stored light goes into .atrium only");
    command->add_option("IN", a->in, "Scene to read")->required();
    command->add_option("OUT", a->out, "File to write; its extension says the format")->required();
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
