#include "engine/io/ldt_reader.h"

#include "engine/io/file_access.h"
#include "engine/io/ies_tokens.h"

#include <algorithm>
#include <fmt/format.h>

namespace atrium {
namespace {

using ies::Fault;
using ies::Tokens;

constexpr std::uint64_t kMaxFile = std::uint64_t(32) << 20;
constexpr std::size_t kMaxPlanes = 721;
constexpr std::size_t kMaxAngles = 3601;
constexpr char kDamaged[] = "It is damaged or was cut off; get it again from the maker.";

/// Lines as the format has them: one value on each.
class LdtReader {
public:
    explicit LdtReader(std::string_view text) : text_(with_points(text)), lines_(text_) {}

    /// The same file as LM-63.
    std::string as_ies();
    [[nodiscard]] std::vector<std::string> take_warnings() { return std::move(warnings_); }

private:
    enum class Symmetry : std::uint8_t { None, Axial, About0, About90, Quadrants };

    // Some makers write decimal commas; a value never has another one.
    static std::string with_points(std::string_view text) {
        std::string out(text);
        std::replace(out.begin(), out.end(), ',', '.');
        return out;
    }

    std::string_view line(const char* what) {
        const auto out = lines_.line();
        if (!out) {
            throw Fault{lines_.line_number(), fmt::format("the file ends where {} should stand", what), kDamaged};
        }
        return ies::trimmed(*out);
    }
    std::string words(const char* what) { return ies::to_utf8(line(what)); }
    double number(const char* what) {
        const std::string_view text = line(what);
        const std::size_t at = lines_.line_number();
        try {
            Tokens tokens(text);
            return tokens.number(what);
        } catch (Fault& fault) {
            fault.line = at; // within the file, not within the line
            if (text.empty()) {
                fault.what = fmt::format("the line is empty where {} should stand", what);
            }
            throw;
        }
    }
    std::size_t whole(const char* what, std::size_t least, std::size_t most) {
        const double value = number(what);
        if (value != std::floor(value) || value < double(least) || value > double(most)) {
            throw Fault{lines_.line_number(),
                        fmt::format("{} is {}, not a whole number from {} to {}", what, value, least, most),
                        "The file is damaged, or no EULUMDAT file; get it again from the maker."};
        }
        return std::size_t(value);
    }
    void skip(std::size_t count, const char* what) {
        for (std::size_t i = 0; i < count; ++i) {
            line(what);
        }
    }

    void read_head();
    void read_lamps();
    void read_intensities();
    [[nodiscard]] std::size_t measured_planes() const;

    std::string text_;
    Tokens lines_;
    std::vector<std::string> warnings_;
    std::string maker_, luminaire_, catalog_, report_, lamp_;
    Symmetry symmetry_ = Symmetry::None;
    std::size_t planes_ = 0;
    std::size_t angles_ = 0;
    dvec3 opening_{0.0};
    double factor_ = 1.0;
    double lumens_ = 0.0;
    double watts_ = 0.0;
    std::vector<double> c_;
    std::vector<double> gamma_;
    std::vector<double> candela_; ///< for each measured plane all angles
};

void LdtReader::read_head() {
    maker_ = words("the maker");
    whole("the type of luminaire (1 to 3)", 0, 3);
    symmetry_ = Symmetry(whole("the symmetry (0 to 4)", 0, 4));
    planes_ = whole("the number of C planes", 1, kMaxPlanes);
    number("the distance of C planes");
    angles_ = whole("the number of angles in a plane", 2, kMaxAngles);
    number("the distance of angles");
    report_ = words("the number of the report");
    luminaire_ = words("the name of the luminaire");
    catalog_ = words("the number of the luminaire");
    skip(2, "the file's name and date");
    skip(3, "a size of the luminaire");
    opening_.y = 0.001 * number("the length of the luminous area");
    opening_.x = 0.001 * number("the width of the luminous area");
    if (opening_.x == 0.0) {
        opening_ = {-opening_.y, 0.0, 0.0}; // round
    }
    for (int k = 0; k < 4; ++k) {
        opening_.z = std::max(opening_.z, 0.001 * number("a height of the luminous area"));
    }
    skip(2, "a share of flux");
    factor_ = number("the conversion factor of intensities");
    const double tilt = number("the tilt while it was measured");
    if (tilt != 0.0) {
        warnings_.push_back(
            fmt::format("The luminaire was measured tilted by {} degrees, which is not taken into account.", tilt));
    }
}

void LdtReader::read_lamps() {
    const std::size_t sets = whole("the number of lamp sets", 1, 100);
    for (std::size_t i = 0; i < sets; ++i) {
        const double count = number("the number of lamps");
        const std::string type = words("the type of lamps");
        const double lumens = number("the flux of the lamps");
        skip(2, "the colour of the lamps");
        const double watts = number("the watts");
        if (i == 0) {
            lumens_ = lumens;
            lamp_ = count < 0.0 ? type : fmt::format("{:.0f} x {}", count, type);
            watts_ = watts;
        }
    }
    if (sets > 1) {
        warnings_.push_back(
            fmt::format("The file has {} sets of lamps; the first ({}, {} lm) is used.", sets, lamp_, lumens_));
    }
    if (!(lumens_ > 0.0) || !(factor_ > 0.0)) {
        throw Fault{lines_.line_number(),
                    "the flux of the lamps or the conversion factor is not above 0, so there would be no light",
                    "The file is damaged, or no EULUMDAT file; get it again from the maker."};
    }
}

std::size_t LdtReader::measured_planes() const {
    switch (symmetry_) {
    case Symmetry::None: return planes_;
    case Symmetry::Axial: return 1;
    case Symmetry::About0:
    case Symmetry::About90: return planes_ / 2 + 1;
    case Symmetry::Quadrants: return planes_ / 4 + 1;
    }
    return planes_;
}

void LdtReader::read_intensities() {
    skip(10, "a direct ratio");
    for (std::size_t i = 0; i < planes_; ++i) {
        c_.push_back(number("a C angle"));
    }
    for (std::size_t j = 0; j < angles_; ++j) {
        gamma_.push_back(number("a gamma angle"));
    }
    const std::size_t fold = symmetry_ == Symmetry::Quadrants ? 4 : symmetry_ > Symmetry::Axial ? 2 : 1;
    if (planes_ % fold != 0) {
        throw Fault{4, fmt::format("{} C planes cannot have the symmetry that line 3 tells", planes_), kDamaged};
    }
    const std::size_t count = measured_planes() * angles_;
    if (count > lines_.bytes_left() / 2 + 1) {
        throw Fault{6, fmt::format("it announces {} intensities, more than the file holds", count), kDamaged};
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double value = number("an intensity") * factor_ * lumens_ / 1000.0;
        if (!(std::abs(value) < 1e30)) {
            throw Fault{lines_.line_number(), fmt::format("an intensity of {} candela is no lamp's", value), kDamaged};
        }
        candela_.push_back(value);
    }
}

std::string LdtReader::as_ies() {
    read_head();
    read_lamps();
    read_intensities();
    // Planes from C270 over C0 to C90, mirrored, are C90 to C270, which LM-63 had in 1995.
    const std::size_t n = measured_planes();
    std::vector<std::pair<double, std::size_t>> planes;
    for (std::size_t i = 0; i < n; ++i) {
        if (symmetry_ == Symmetry::About90) {
            const std::size_t at = 3 * planes_ / 4 + n - 1 - i;
            const double c = c_[at % planes_] + (at >= planes_ ? 360.0 : 0.0);
            planes.emplace_back(540.0 - c, n - 1 - i);
        } else {
            planes.emplace_back(symmetry_ == Symmetry::Axial ? 0.0 : c_[i], i);
        }
    }
    if (symmetry_ == Symmetry::None && planes.size() > 1 && planes.back().first < 360.0) {
        planes.emplace_back(planes.front().first + 360.0, 0);
    }
    std::string out = symmetry_ == Symmetry::About90 ? "IESNA:LM-63-1995\r\n" : "IESNA:LM-63-2002\r\n";
    const auto keyword = [&out](const char* key, const std::string& value) {
        out += fmt::format("[{}] {}\r\n", key, value.substr(0, 200));
    };
    keyword("TEST", report_);
    keyword("MANUFAC", maker_);
    keyword("LUMCAT", catalog_);
    keyword("LUMINAIRE", luminaire_);
    keyword("LAMP", lamp_);
    keyword("OTHER", "Converted from EULUMDAT");
    out += fmt::format("TILT=NONE\r\n1 -1 1 {} {} 1 2 {} {} {}\r\n1 1 {}\r\n", angles_, planes.size(), opening_.x,
                       opening_.y, opening_.z, watts_);
    const auto list = [&out](auto begin, auto end, auto get) {
        int on_line = 0;
        for (auto at = begin; at != end; ++at) {
            out += fmt::format("{}{}", on_line == 0 ? "" : on_line % 10 == 0 ? "\r\n" : " ", get(*at));
            ++on_line;
        }
        out += "\r\n";
    };
    const auto as_float = [](double v) { return float(v); };
    list(gamma_.begin(), gamma_.end(), as_float);
    list(planes.begin(), planes.end(), [](const auto& plane) { return float(plane.first); });
    for (const auto& plane : planes) {
        const auto first = candela_.begin() + std::ptrdiff_t(plane.second * angles_);
        list(first, first + std::ptrdiff_t(angles_), as_float);
    }
    return out;
}

} // namespace

Result<LoadedPhotometry> parse_ldt(std::span<const std::uint8_t> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (bytes.size() > kMaxFile || text.find('\0') != std::string_view::npos) {
        return fail(name, "", "is no text file of at most 32 MiB", "Choose an EULUMDAT file (.ldt).");
    }
    try {
        LdtReader reader(text);
        const std::string ies = reader.as_ies();
        auto loaded = parse_ies({reinterpret_cast<const std::uint8_t*>(ies.data()), ies.size()},
                                std::filesystem::path(name).replace_extension(".ies").string());
        if (!loaded) {
            // Its line is one of the conversion.
            return fail(name, "", loaded.error().what, loaded.error().hint);
        }
        std::vector<std::string> warnings = reader.take_warnings();
        warnings.insert(warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
        loaded->warnings = std::move(warnings);
        return loaded;
    } catch (const Fault& fault) {
        return fail(name, fault.line > 0 ? "line " + std::to_string(fault.line) : "", fault.what, fault.hint);
    }
}

Result<LoadedPhotometry> read_photometric_file(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (extension != ".ldt") {
        return read_ies(path);
    }
    const auto bytes = read_file(path, kMaxFile);
    return bytes ? parse_ldt(*bytes, path.string()) : Result<LoadedPhotometry>(tl::unexpected(bytes.error()));
}

} // namespace atrium
