// Which build this is. The number has one source, project(VERSION) in CMakeLists.txt.
#pragma once

#include <string>

namespace atrium {

/// The number alone, as "0.1.0".
std::string version_number();
/// The number and, where the build knew it, the commit: "0.1.0 (1a2b3c4d5e6f)"; "modified" follows where files had been
/// changed since. For people to read and to quote in reports; files keep the number alone.
std::string version_text();

} // namespace atrium
