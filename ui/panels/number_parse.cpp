#include "ui/panels/number_parse.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace atrium::ui {

namespace {

constexpr double kFoot = 0.3048;
constexpr double kInch = 0.0254;

using Bad = tl::unexpected<std::string>;

struct Term {
    double value = 0;
    double factor = 0; ///< 0 = no unit typed
    bool sign_before = false;
    double sign = 1;
};

/// ASCII form: typographic minus, primes, quotes, degree and no-break spaces become what a keyboard has.
std::string plain_ascii(std::string_view text) {
    static const std::pair<std::string_view, std::string_view> kTable[] = {
        {"\u2212", "-"},    {"\u2013", "-"},    {"\u2032", "'"},   {"\u2019", "'"}, {"\u2033", "\""},
        {"\u201d", "\""},   {"\u00b0", "deg"},  {"\u00a0", " "},   {"\u202f", " "}, {"\u00b2", "2"},
        {"\u00bd", " 1/2"}, {"\u00bc", " 1/4"}, {"\u00be", " 3/4"}};
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        bool replaced = false;
        for (const auto& [from, to] : kTable) {
            if (text.substr(i, from.size()) == from) {
                out += to;
                i += from.size();
                replaced = true;
                break;
            }
        }
        if (!replaced) {
            out += char(std::tolower(static_cast<unsigned char>(text[i++])));
        }
    }
    return out;
}

class Parser {
public:
    Parser(std::string_view text, const UnitSet& units) : text_(plain_ascii(text)), units_(units) {}

    tl::expected<double, std::string> run() {
        double sign = 1;
        bool sign_before = false;
        skip_space();
        if (at_end()) {
            return Bad("the field is empty");
        }
        while (!at_end()) {
            if (peek() == '+' || peek() == '-') {
                if (sign_before) {
                    return Bad("there are two signs in a row");
                }
                sign = text_[at_++] == '-' ? -1 : 1;
                sign_before = true;
                skip_space();
                continue;
            }
            Term term;
            term.sign = sign;
            term.sign_before = sign_before || terms_.empty();
            if (auto ok = read_term(term); !ok) {
                return Bad(ok.error());
            }
            terms_.push_back(term);
            sign_before = false;
            skip_space();
        }
        if (sign_before) {
            return Bad("a number is missing after the sign");
        }
        return sum();
    }

private:
    bool at_end() const { return at_ >= text_.size(); }
    char peek() const { return at_end() ? '\0' : text_[at_]; }
    void skip_space() {
        while (peek() == ' ' || peek() == '\t') {
            ++at_;
        }
    }

    tl::expected<double, std::string> read_number() {
        const std::size_t start = at_;
        std::string digits;
        int separators = 0;
        while (!at_end()) {
            const char c = peek();
            if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
                digits += c;
            } else if (c == '.' || c == ',') {
                digits += '.';
                ++separators;
            } else {
                break;
            }
            ++at_;
        }
        if (digits.empty() || digits == ".") {
            return Bad("\"" + std::string(1, peek()) + "\" is not a number");
        }
        if (separators > 1) {
            return Bad("\"" + text_.substr(start, at_ - start) +
                       "\" has more than one decimal point; write thousands without separators");
        }
        if (peek() == 'e') { // exponent only when digits follow, so that a unit may begin with e
            std::size_t probe = at_ + 1;
            if (probe < text_.size() && (text_[probe] == '-' || text_[probe] == '+')) {
                ++probe;
            }
            if (probe < text_.size() && std::isdigit(static_cast<unsigned char>(text_[probe])) != 0) {
                const std::size_t end = text_.find_first_not_of("0123456789", probe);
                const std::size_t stop = end == std::string::npos ? text_.size() : end;
                digits += text_.substr(at_, stop - at_);
                at_ = stop;
            }
        }
        double value = 0;
        // from_chars: the same in every locale; it wants a digit before the point in no case.
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error == std::errc::result_out_of_range || !std::isfinite(value)) {
            return Bad("the number is too large or too small");
        }
        if (error != std::errc() || end != digits.data() + digits.size()) {
            return Bad("\"" + digits + "\" is not a number");
        }
        return value;
    }

    /// "/4" after a numerator; 1 when there is none.
    tl::expected<double, std::string> read_divisor() {
        skip_space();
        if (peek() != '/') {
            return 1.0;
        }
        ++at_;
        skip_space();
        auto divisor = read_number();
        if (divisor && *divisor == 0) {
            return Bad("a fraction cannot be divided by zero");
        }
        return divisor;
    }

    tl::expected<void, std::string> read_term(Term& term) {
        auto number = read_number();
        if (!number) {
            return Bad(number.error());
        }
        auto divisor = read_divisor();
        if (!divisor) {
            return Bad(divisor.error());
        }
        term.value = *number / *divisor;
        // "2 1/2": a whole number, a space, a fraction.
        if (*divisor == 1.0 && peek() != '\0' && std::isdigit(static_cast<unsigned char>(peek())) != 0) {
            const std::size_t back = at_;
            auto numerator = read_number();
            auto below = numerator ? read_divisor() : numerator;
            if (numerator && below && *below != 1.0) {
                term.value += *numerator / *below;
            } else {
                at_ = back;
            }
        }
        skip_space();
        return read_unit(term);
    }

    tl::expected<void, std::string> read_unit(Term& term) {
        if (units_.feet_and_inches && peek() == '\'') {
            ++at_;
            if (peek() == '\'') { // two primes are an inch mark
                ++at_;
                term.factor = kInch;
            } else {
                term.factor = kFoot;
            }
            return {};
        }
        if (units_.feet_and_inches && peek() == '"') {
            ++at_;
            term.factor = kInch;
            return {};
        }
        const std::size_t start = at_;
        while (!at_end() && (std::isalpha(static_cast<unsigned char>(peek())) != 0 || peek() == '%' ||
                             (at_ > start && (peek() == '/' || (peek() == '2' && text_[at_ - 1] == 'm'))))) {
            ++at_;
        }
        if (at_ == start) {
            if (!at_end() && std::isdigit(static_cast<unsigned char>(peek())) == 0 && peek() != '+' && peek() != '-') {
                return Bad("\"" + text_.substr(at_) + "\" is not understood");
            }
            return {};
        }
        const std::string name = text_.substr(start, at_ - start);
        for (const UnitSet::Unit& unit : units_.units) {
            if (unit.name == name) {
                term.factor = unit.factor;
                return {};
            }
        }
        std::string known;
        for (const UnitSet::Unit& unit : units_.units) {
            known += (known.empty() ? "" : ", ") + unit.name;
        }
        return Bad("the unit \"" + name + "\" is not known here" + (known.empty() ? "" : "; known are " + known));
    }

    tl::expected<double, std::string> sum() {
        bool any_unit = false;
        for (std::size_t i = 0; i < terms_.size(); ++i) {
            any_unit = any_unit || terms_[i].factor != 0;
            if (terms_[i].sign_before || terms_[i].factor != 0) {
                continue;
            }
            // Beside its neighbour without a sign and without a unit: inches after feet, otherwise a guess we do not make.
            if (units_.feet_and_inches && terms_[i - 1].factor == kFoot) {
                terms_[i].factor = kInch;
            } else {
                return Bad("it is not clear what the second number stands for; give it a unit or a sign");
            }
        }
        for (std::size_t i = 1; i < terms_.size(); ++i) {
            if (!terms_[i].sign_before && terms_[i - 1].factor == 0) {
                return Bad("it is not clear what the first number stands for; give it a unit or a sign");
            }
        }
        double total = 0;
        for (std::size_t i = 0; i < terms_.size(); ++i) {
            double factor = terms_[i].factor;
            for (std::size_t j = i + 1; factor == 0 && j < terms_.size(); ++j) {
                factor = terms_[j].factor;
            }
            for (std::size_t j = i; factor == 0 && j-- > 0;) {
                factor = terms_[j].factor;
            }
            total += terms_[i].sign * terms_[i].value * (any_unit ? factor : units_.default_factor);
        }
        if (!std::isfinite(total)) {
            return Bad("the number is too large");
        }
        return total;
    }

    std::string text_;
    const UnitSet& units_;
    std::size_t at_ = 0;
    std::vector<Term> terms_;
};

} // namespace

UnitSet length_units() {
    return {{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"km", 1000.0}, {"ft", kFoot}, {"in", kInch}}, 1.0, true};
}

UnitSet angle_units() { return {{{"deg", 1.0}, {"rad", 57.295779513082320877}}, 1.0, false}; }

UnitSet plain_units(const std::string& suffix) {
    UnitSet set;
    if (!suffix.empty()) {
        set.units.push_back({plain_ascii(suffix), 1.0});
    }
    return set;
}

tl::expected<double, std::string> parse_quantity(std::string_view text, const UnitSet& units) {
    return Parser(text, units).run();
}

std::string format_number(double value, int decimals) {
    char buffer[512];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
    if (error != std::errc()) {
        return "?";
    }
    std::string text(buffer, end);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') {
            text.pop_back();
        }
    }
    return text == "-0" ? "0" : text;
}

} // namespace atrium::ui
