#include "engine/io/ies_reader.h"

#include "engine/io/file_access.h"
#include "engine/io/ies_tokens.h"

#include <algorithm>
#include <fmt/format.h>

namespace atrium {
namespace {

using ies::Fault;
using ies::Tokens;

constexpr std::uint64_t kMaxFile = std::uint64_t(32) << 20;
constexpr std::size_t kMaxHeaderLines = 10'000;
constexpr std::size_t kMaxAngles = 100'000;
constexpr double kMetresPerFoot = 0.3048;
constexpr char kDamaged[] = "It is damaged or was cut off; get it again from the maker.";

std::string upper(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
    return out;
}

class Reader {
public:
    Reader(std::span<const std::uint8_t> bytes, const std::string& name, const TiltSource& tilt)
        : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), tilt_source_(tilt), tokens_(text_) {
        out_.file_name = ies::to_utf8(std::filesystem::path(name).filename().string());
        out_.file.assign(bytes.begin(), bytes.end());
    }

    LoadedPhotometry read() {
        if (text_.find('\0') != std::string_view::npos) {
            throw Fault{0, "is no text file", "Choose an IES file (LM-63), which is plain text."};
        }
        read_header();
        read_tilt();
        read_counts();
        read_angles(out_.vertical, "a vertical angle");
        read_angles(out_.horizontal, "a horizontal angle");
        if (const std::string fault = PhotometricWeb::coverage_fault(out_); !fault.empty()) {
            throw Fault{horizontal_line_, fault, "The file does not keep to LM-63; ask its maker for another."};
        }
        judge_coverage();
        read_candela();
        if (!tokens_.at_end()) {
            warn(fmt::format("What follows the last intensity (line {}) was left out.", tokens_.line_number()));
        }
        return {std::make_shared<const PhotometricWeb>(std::move(out_)), std::move(warnings_)};
    }

private:
    void warn(std::string text) { warnings_.push_back(std::move(text)); }

    void read_version(std::string_view line) {
        static constexpr struct {
            const char* tag;
            int year;
        } kTags[] = {{"IESNA91", 1991},          {"IESNA:LM-63-1991", 1991}, {"IESNA95", 1995},
                     {"IESNA:LM-63-1995", 1995}, {"IESNA:LM-63-2002", 2002}, {"IES:LM-63-2019", 2019},
                     {"IESNA:LM-63-2019", 2019}};
        for (const auto& known : kTags) {
            if (line == known.tag) {
                year_ = known.year;
                return;
            }
        }
        if (line.starts_with("IES")) {
            year_ = 2002;
            warn("The first line names no version of LM-63 that is known; the file was read as of 2002.");
        }
    }

    void read_header() {
        std::string* last = nullptr;
        for (std::size_t count = 0;; ++count) {
            const auto line = tokens_.line();
            if (!line || count > kMaxHeaderLines) {
                throw Fault{0, "has no TILT= line, so it is no IES photometric file",
                            "Choose an LM-63 file (.ies), or ask the maker of the luminaire for one."};
            }
            const std::string_view text = ies::trimmed(*line);
            if (count == 0) {
                read_version(upper(text));
            }
            if (upper(text.substr(0, 4)) == "TILT") {
                const std::string_view rest = ies::trimmed(text.substr(4));
                if (rest.starts_with('=')) {
                    tilt_begin_ = std::size_t(line->data() - text_.data());
                    tilt_end_ = tilt_begin_ + line->size();
                    tilt_ = ies::trimmed(rest.substr(1));
                    break;
                }
            }
            read_keyword(text, last);
        }
        out_.standard = "LM-63-" + std::to_string(year_);
    }

    void read_keyword(std::string_view text, std::string*& last) {
        if (text.empty() || text.front() != '[') {
            return;
        }
        const std::size_t close = text.find(']');
        if (close == std::string_view::npos) {
            return;
        }
        const std::string key = upper(text.substr(1, close - 1));
        const std::string value = ies::to_utf8(ies::trimmed(text.substr(close + 1)));
        if (key == "MORE") {
            if (last != nullptr && !value.empty() && last->size() < 400) {
                *last += (last->empty() ? "" : " ") + value;
            }
            return;
        }
        last = key == "MANUFAC"     ? &out_.manufacturer
               : key == "LUMCAT"    ? &out_.catalog
               : key == "LUMINAIRE" ? &out_.luminaire
               : key == "LAMP"      ? &out_.lamp
                                    : nullptr;
        if (last != nullptr && last->empty()) {
            *last = value;
        }
    }

    void read_table(Tokens& tokens) {
        tokens.whole("the position of the lamp in the luminaire (1 to 3)", 1, 3);
        const std::size_t n = tokens.whole("the number of tilt angles", 1, kMaxAngles);
        if (n > tokens.bytes_left()) {
            throw Fault{tokens.line_number(), fmt::format("it announces {} tilt angles and ends before", n), kDamaged};
        }
        for (std::size_t i = 0; i < n; ++i) {
            out_.tilt.push_back(float(tokens.number("a tilt angle")));
            if (i > 0 && !(out_.tilt[i] > out_.tilt[i - 1])) {
                throw Fault{tokens.line_number(), "tilt angles must ascend",
                            "The file is damaged; get it again from the maker."};
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            out_.tilt_part.push_back(float(tokens.number("a tilt factor")));
            if (out_.tilt_part[i] < 0.0F) {
                throw Fault{tokens.line_number(), "a tilt factor is negative",
                            "The file is damaged; get it again from the maker."};
            }
        }
    }

    void read_tilt() {
        const std::string kind = upper(tilt_);
        if (kind == "NONE" || kind.empty()) {
            return;
        }
        if (kind == "INCLUDE") {
            read_table(tokens_);
            return;
        }
        const std::string file(tilt_);
        auto bytes = tilt_source_ ? tilt_source_(file) : Result<std::vector<std::uint8_t>>(fail(file, "", "is not at hand"));
        // What is saved with a scene must not need the other file.
        const auto replace_line = [&](const std::string& line) {
            out_.file.erase(out_.file.begin() + std::ptrdiff_t(tilt_begin_), out_.file.begin() + std::ptrdiff_t(tilt_end_));
            out_.file.insert(out_.file.begin() + std::ptrdiff_t(tilt_begin_), line.begin(), line.end());
        };
        if (bytes) {
            try {
                const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
                Tokens tokens(text);
                read_table(tokens);
                replace_line("TILT=INCLUDE\r\n" + std::string(ies::trimmed(tokens.taken())));
                return;
            } catch (const Fault& fault) {
                bytes = fail(file, "", fault.what);
                out_.tilt.clear();
                out_.tilt_part.clear();
            }
        }
        warn(fmt::format(
            "The table \"{}\" of how light depends on tilt could not be read ({}); it is taken not to depend on it.",
            ies::to_utf8(file), bytes.error().what));
        replace_line("TILT=NONE");
    }

    void read_counts() {
        const std::size_t lamps = tokens_.whole("the number of lamps", 0, 1'000'000);
        const double lumens = tokens_.number("the lumens per lamp");
        const double multiplier = tokens_.number("the candela multiplier");
        positive(multiplier, "the candela multiplier");
        vertical_count_ = tokens_.whole("the number of vertical angles", 2, kMaxAngles);
        horizontal_count_ = tokens_.whole("the number of horizontal angles", 1, kMaxAngles);
        count_line_ = tokens_.line_number();
        // 1986 knew no other number for types A and C.
        out_.type = PhotometryType(tokens_.whole("the type of photometry (1 = C, 2 = B, 3 = A)", 1, 3));
        const std::size_t unit = tokens_.whole("the unit of length (1 = feet, 2 = metres)", 1, 2);
        const double metres = unit == 1 ? kMetresPerFoot : 1.0;
        for (int k = 0; k < 3; ++k) {
            out_.luminous_opening[k] = metres * tokens_.number("a size of the luminous opening");
        }
        const double ballast = tokens_.number("the ballast factor");
        positive(ballast, "the ballast factor");
        const double lamp_factor = tokens_.number("the ballast-lamp factor");
        out_.watts = tokens_.number("the input watts");
        out_.scale = multiplier * ballast;
        if (year_ < 1995) { // later the field is unused or tells how the file was made
            positive(lamp_factor, "the ballast-lamp factor");
            out_.scale *= lamp_factor;
        }
        out_.lamp_lumens = lumens < 0.0 ? 0.0 : double(lamps) * lumens;
        // Each number takes a digit and what parts it from the next.
        const std::size_t numbers = vertical_count_ + horizontal_count_ + vertical_count_ * horizontal_count_;
        if (numbers > tokens_.bytes_left() / 2 + 1) {
            throw Fault{count_line_,
                        fmt::format("it announces {} vertical and {} horizontal angles, more than the file holds",
                                    vertical_count_, horizontal_count_),
                        kDamaged};
        }
    }

    void positive(double value, const char* what) const {
        if (!(value > 0.0)) {
            throw Fault{tokens_.line_number(), fmt::format("{} is {}, so there would be no light", what, value),
                        "The file is damaged, or no LM-63 file; get it again from the maker."};
        }
    }

    void read_angles(std::vector<float>& out, const char* what) {
        const std::size_t n = &out == &out_.vertical ? vertical_count_ : horizontal_count_;
        out.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            out.push_back(float(tokens_.number(what)));
            if (i > 0 && !(out[i] > out[i - 1])) {
                throw Fault{tokens_.line_number(),
                            fmt::format("{} of {} follows one of {}; they must ascend", what, out[i], out[i - 1]),
                            "The file is damaged; get it again from the maker."};
            }
        }
        horizontal_line_ = tokens_.line_number();
    }

    void judge_coverage() {
        const auto is = [](float a, float b) { return std::abs(a - b) < 1e-3F; };
        const std::vector<float>& v = out_.vertical;
        const std::vector<float>& h = out_.horizontal;
        if (out_.type != PhotometryType::C) {
            return;
        }
        if (!(is(v.front(), 0.0F) || is(v.front(), 90.0F)) || !(is(v.back(), 90.0F) || is(v.back(), 180.0F))) {
            warn(fmt::format("Vertical angles go from {} to {}; nothing shines beyond.", v.front(), v.back()));
        }
        if (h.size() == 1 && !is(h.front(), 0.0F)) {
            warn(fmt::format("The only horizontal angle is {}, not 0; the light is the same all round.", h.front()));
        } else if (h.back() > 180.5F && !is(h.back(), 360.0F) && !is(h.front(), 90.0F)) {
            warn(fmt::format("Horizontal angles end at {}; from there to 360 light is interpolated.", h.back()));
        }
    }

    void read_candela() {
        const std::size_t n = vertical_count_ * horizontal_count_;
        out_.candela.reserve(n);
        std::size_t negative = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double value = tokens_.number("an intensity") * out_.scale;
            if (!(std::abs(value) < 1e30)) {
                throw Fault{tokens_.line_number(), fmt::format("an intensity of {} candela is no lamp's", value), kDamaged};
            }
            negative += value < 0.0 ? 1 : 0;
            out_.candela.push_back(float(std::max(value, 0.0)));
        }
        if (negative > 0) {
            warn(fmt::format("{} negative {} taken as 0.", negative, negative == 1 ? "intensity was" : "intensities were"));
        }
        if (!(*std::max_element(out_.candela.begin(), out_.candela.end()) > 0.0F)) {
            throw Fault{tokens_.line_number(), "all intensities are 0, so there would be no light", "Choose another file."};
        }
    }

    std::string_view text_;
    const TiltSource& tilt_source_;
    Tokens tokens_;
    PhotometricData out_;
    std::vector<std::string> warnings_;
    int year_ = 1986;
    std::string_view tilt_;
    std::size_t tilt_begin_ = 0; // of the TILT= line, bytes
    std::size_t tilt_end_ = 0;
    std::size_t vertical_count_ = 0;
    std::size_t horizontal_count_ = 0;
    std::size_t count_line_ = 0;
    std::size_t horizontal_line_ = 0;
};

} // namespace

Result<LoadedPhotometry> parse_ies(std::span<const std::uint8_t> bytes, const std::string& name, const TiltSource& tilt) {
    if (bytes.size() > kMaxFile) {
        return fail(name, "", "is larger than 32 MiB, so it is no photometric file", "Choose an IES file (LM-63).");
    }
    try {
        return Reader(bytes, name, tilt).read();
    } catch (const Fault& fault) {
        return fail(name, fault.line > 0 ? "line " + std::to_string(fault.line) : "", fault.what, fault.hint);
    }
}

Result<LoadedPhotometry> read_ies(const std::filesystem::path& path) {
    auto bytes = read_file(path, kMaxFile);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    return parse_ies(*bytes, path.string(), [&](const std::string& name) -> Result<std::vector<std::uint8_t>> {
        const auto file = resolve_uri(path.parent_path(), name);
        if (!file) {
            return tl::unexpected(file.error());
        }
        return read_file(*file, kMaxFile);
    });
}

} // namespace atrium
