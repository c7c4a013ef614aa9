// Photometric files of luminaires: IES LM-63 of 1986, 1991, 1995, 2002 and 2019.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/photometric_web.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

namespace atrium {

struct LoadedPhotometry {
    std::shared_ptr<const PhotometricWeb> web;
    std::vector<std::string> warnings; ///< what was read in spite of the standard, one sentence each
};

/// Bytes of the file that a TILT= line names.
using TiltSource = std::function<Result<std::vector<std::uint8_t>>(const std::string& name)>;

/// Reads an LM-63 file from memory; numbers may be spread over lines in any way, between blanks or commas. A file that is
/// damaged, incomplete or of another kind is refused with line, reason and advice; nothing is allocated for numbers that it
/// cannot hold. A tilt table in a file of its own is put into PhotometricData::file; where `tilt` is missing or fails,
/// output is taken not to depend on tilt, with a warning. `name` is the file's, for messages. Any thread.
Result<LoadedPhotometry> parse_ies(std::span<const std::uint8_t> bytes, const std::string& name,
                                   const TiltSource& tilt = {});

/// Reads a file; a tilt table is looked for in its own folder only.
Result<LoadedPhotometry> read_ies(const std::filesystem::path& path);

} // namespace atrium
