// Bad input yields a Result with file, place and reason; our own mistakes are CHECKs (checks.h).
#pragma once

#include <string>
#include <tl/expected.hpp>

namespace atrium {

/// Why something could not be done, in words for the person at the screen.
struct Error {
    std::string file;  ///< path as the user gave it; empty when no file is involved
    std::string where; ///< node, accessor, line: where in the file; may be empty
    std::string what;  ///< what is wrong
    std::string hint;  ///< what to do about it; may be empty

    /// "file: where: what. hint" with empty parts left out.
    [[nodiscard]] std::string message() const {
        std::string out;
        for (const std::string* part : {&file, &where}) {
            if (!part->empty()) {
                out += *part + ": ";
            }
        }
        out += what;
        if (!hint.empty()) {
            out += (what.empty() || what.back() == '.' ? " " : ". ") + hint;
        }
        return out;
    }
    friend bool operator==(const Error&, const Error&) = default;
};

template <class T> using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string file, std::string where, std::string what, std::string hint = {}) {
    return tl::unexpected<Error>(Error{std::move(file), std::move(where), std::move(what), std::move(hint)});
}

} // namespace atrium
