// fuzz_replay ENTRY FILE...: gives files to an entry as the fuzzer would, in the ordinary build.
#include "tests/fuzz/entries.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    using namespace atrium;
    const std::map<std::string, int (*)(const std::uint8_t*, std::size_t)> entries = {
        {"gltf", fuzz::gltf},     {"glb", fuzz::glb}, {"project", fuzz::project}, {"edit_script", fuzz::edit_script},
        {"points", fuzz::points}, {"ies", fuzz::ies}, {"ldt", fuzz::ldt}};
    const auto entry = argc > 2 ? entries.find(argv[1]) : entries.end();
    if (entry == entries.end()) {
        std::fputs("usage: fuzz_replay gltf|glb|project|edit_script|points|ies|ldt FILE...\n", stderr);
        return 1;
    }
    for (int i = 2; i < argc; ++i) {
        std::ifstream in(argv[i], std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
        if (bytes.empty()) {
            std::fprintf(stderr, "%s: nothing to read\n", argv[i]);
            return 1;
        }
        entry->second(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    std::printf("%s: %d files\n", argv[1], argc - 2);
    return 0;
}
