#include "engine/io/ies_tokens.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace atrium::ies {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_separator(char c) { return is_blank(c) || c == ',' || c == '\r' || c == '\n'; }

// Length of the valid UTF-8 sequence at the start of the text; 0 where there is none.
std::size_t sequence_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t n = first < 0x80                    ? 1
                          : first >= 0xC2 && first < 0xE0 ? 2
                          : first < 0xE0                  ? 0
                          : first < 0xF0                  ? 3
                          : first < 0xF5                  ? 4
                                                          : 0;
    if (n == 0 || n > text.size()) {
        return 0;
    }
    for (std::size_t i = 1; i < n; ++i) {
        if ((byte(i) & 0xC0) != 0x80) {
            return 0;
        }
    }
    const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
    const bool outside = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
    return overlong || outside ? 0 : n;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t n = sequence_length(text);
        if (n == 0) {
            return false;
        }
        text.remove_prefix(n);
    }
    return true;
}

} // namespace

std::string to_utf8(std::string_view text) {
    const bool as_it_stands = is_utf8(text);
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) {
            out += ' ';
        } else if (byte < 0x80 || as_it_stands) {
            out += c;
        } else {
            out += char(0xC0 | (byte >> 6));
            out += char(0x80 | (byte & 0x3F));
        }
    }
    return out;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_separator(text.front()) && text.front() != ',') {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_separator(text.back()) && text.back() != ',') {
        text.remove_suffix(1);
    }
    return text;
}

Tokens::Tokens(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) {
        text_.remove_prefix(3);
    }
    text_ = text_.substr(0, text_.find('\x1A')); // how DOS ended text
}

bool Tokens::take_line_end() {
    if (text_[at_] != '\r' && text_[at_] != '\n') {
        return false;
    }
    at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
    ++next_line_;
    return true;
}

std::optional<std::string_view> Tokens::line() {
    if (at_ >= text_.size()) {
        return std::nullopt;
    }
    line_ = next_line_;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    const std::string_view out = text_.substr(at_, end - at_);
    at_ = end;
    if (at_ < text_.size()) {
        take_line_end();
    }
    return out;
}

void Tokens::skip_separators() {
    while (at_ < text_.size() && is_separator(text_[at_])) {
        if (!take_line_end()) {
            ++at_;
        }
    }
}

bool Tokens::at_end() {
    skip_separators();
    return at_ >= text_.size();
}

double Tokens::number(const char* what) {
    if (at_end()) {
        throw Fault{next_line_, std::string("the file ends where ") + what + " should stand",
                    "It is damaged or was cut off; get it again from the maker."};
    }
    line_ = next_line_;
    std::size_t end = at_;
    while (end < text_.size() && !is_separator(text_[end])) {
        ++end;
    }
    const std::string_view word = text_.substr(at_, end - at_);
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0.0;
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != digits.data() + digits.size() || !std::isfinite(value) ||
        std::abs(value) > double(std::numeric_limits<float>::max())) {
        throw Fault{line_, "\"" + to_utf8(word.substr(0, 24)) + "\" stands where " + what + " should, and is no number",
                    "The file is damaged, or no LM-63 file; get it again from the maker."};
    }
    at_ = end;
    return value;
}

std::size_t Tokens::whole(const char* what, std::size_t least, std::size_t most) {
    const double value = number(what);
    if (value != std::floor(value) || value < double(least) || value > double(most)) {
        char text[32] = {};
        std::to_chars(text, text + sizeof text - 1, value);
        throw Fault{line_,
                    std::string(what) + " is " + text + ", not a whole number from " + std::to_string(least) + " to " +
                        std::to_string(most),
                    "The file is damaged, or no LM-63 file; get it again from the maker."};
    }
    return std::size_t(value);
}

} // namespace atrium::ies
