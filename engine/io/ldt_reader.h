// Photometric files of European makers: EULUMDAT (.ldt).
#pragma once

#include "engine/io/ies_reader.h"

namespace atrium {

/// Reads an EULUMDAT file from memory; intensities are those of the first set of lamps. What is kept in
/// PhotometricData::file is the same as LM-63, which scene files can hold. Damaged files are refused with line, reason and
/// advice. `name` is the file's, for messages. Any thread.
Result<LoadedPhotometry> parse_ldt(std::span<const std::uint8_t> bytes, const std::string& name);

/// Reads LM-63 or, where the name ends in .ldt, EULUMDAT.
Result<LoadedPhotometry> read_photometric_file(const std::filesystem::path& path);

} // namespace atrium
