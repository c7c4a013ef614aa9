#include "engine/io/project_file.h"

#include "engine/base/checks.h"

#include <fmt/format.h>
#include <zstd.h>

namespace atrium::gltf {
namespace {

/// FNV-1a, 64 bits: finds damage, is no protection against intent.
std::string fingerprint(std::span<const std::byte> bytes) {
    std::uint64_t h = 0xCBF29CE484222325ULL;
    for (const std::byte b : bytes) {
        h = (h ^ std::uint64_t(b)) * 0x100000001B3ULL;
    }
    return fmt::format("{:016x}", h);
}

} // namespace

PackedSolution pack_solution(std::span<const std::byte> solution) {
    PackedSolution out;
    out.byte_length = solution.size();
    out.hash = fingerprint(solution);
    out.bytes.resize(ZSTD_compressBound(solution.size()));
    // Level 3: saving is something the user waits for.
    const std::size_t size = ZSTD_compress(out.bytes.data(), out.bytes.size(), solution.data(), solution.size(), 3);
    ATRIUM_CHECK(ZSTD_isError(size) == 0);
    out.bytes.resize(size);
    return out;
}

Result<std::vector<std::byte>> unpack_solution(std::span<const std::uint8_t> bytes, std::uint64_t byte_length,
                                               const std::string& hash, std::uint64_t most) {
    if (byte_length > most || ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != byte_length) {
        return fail("", "", "the stored solution has another length than the file says");
    }
    std::vector<std::byte> out(byte_length);
    const std::size_t size = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0 || size != out.size() || fingerprint(out) != hash) {
        return fail("", "", "the stored solution is damaged");
    }
    return out;
}

} // namespace atrium::gltf
