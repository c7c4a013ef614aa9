// Text of a photometric file as lines and numbers that know where they stand. Internal to engine/io.
#pragma once

#include "engine/base/result.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace atrium::ies {

/// Latin-1 or UTF-8 (as it stands if it is valid) to UTF-8, without control characters.
std::string to_utf8(std::string_view text);
/// Without blanks at either end.
std::string_view trimmed(std::string_view text);

/// Thrown where a file cannot be read on; parse_ies() turns it into its Result.
struct Fault {
    std::size_t line = 0; ///< 0: the whole file
    std::string what;
    std::string hint;
};

/// Reads lines first and numbers afterwards. Lines end with CR LF, LF or CR; a Ctrl-Z ends the file.
class Tokens {
public:
    explicit Tokens(std::string_view text);

    /// The next whole line, nothing at the end.
    std::optional<std::string_view> line();
    /// The next number, wherever it stands; `what` names it in the message where there is none.
    double number(const char* what);
    /// The same, within [least, most] and without a fraction.
    std::size_t whole(const char* what, std::size_t least, std::size_t most);
    /// Nothing but blanks is left.
    bool at_end();

    [[nodiscard]] std::size_t line_number() const { return line_; } ///< of what was read last
    [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
    [[nodiscard]] std::string_view taken() const { return text_.substr(0, at_); }

private:
    void skip_separators();
    bool take_line_end(); ///< counts it

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t next_line_ = 1; ///< that at_ stands in
    std::size_t line_ = 1;
};

} // namespace atrium::ies
