// What the engine says, in the user's language. The engine knows none but English; its messages are told by their wording.
#pragma once

#include "engine/base/result.h"

#include <QString>

#include <span>
#include <string>
#include <vector>

namespace atrium::ui {

/// The messages that are known, as the engine words them, with %1, %2, ... where it puts names and numbers. A test looks
/// them up in its sources: who changes a message there changes it here, too.
std::span<const char* const> engine_messages();
/// A message or a hint of the engine, translated with its names and numbers in it; as it is where it is not known. Any
/// thread.
QString engine_text(const std::string& text);
/// Error::message() in the user's language. Any thread.
QString error_message(const Error& error);

} // namespace atrium::ui
