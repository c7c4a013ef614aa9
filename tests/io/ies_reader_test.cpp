// LM-63 files: the published cases, makers' files, and what is wrong with damaged ones.
#include "engine/io/ies_reader.h"

#include "engine/base/units.h"
#include "engine/reference/web_reading.h"
#include "tests/io/io_test_support.h"

#include <nlohmann/json.hpp>

namespace atrium {
namespace {

Result<LoadedPhotometry> parse(const std::string& text, const TiltSource& tilt = {}) {
    return parse_ies({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "lamp.ies", tilt);
}

double candela(const PhotometricWeb& web, double v, double h) {
    return double(web.candela(vec3(photometric_direction(web.data().type, v, h))));
}

// "h45_v62_5" or "v90": angles as the cases name them.
std::pair<double, double> angles_of(std::string name) {
    std::replace(name.begin(), name.end(), 'v', ' ');
    double h = 0.0;
    if (name.front() == 'h') {
        h = std::stod(name.substr(1));
        name = name.substr(name.find('_') + 1);
    }
    std::replace(name.begin(), name.end(), '_', '.');
    return {h, std::stod(name)};
}

/// A type C file of 2002 with these angles and intensities.
std::string file_of(const std::string& vertical, const std::string& horizontal, const std::string& candela, int type = 1) {
    const auto count = [](const std::string& list) {
        std::istringstream in(list);
        return std::distance(std::istream_iterator<std::string>(in), {});
    };
    return "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 " + std::to_string(count(vertical)) + " " +
           std::to_string(count(horizontal)) + " " + std::to_string(type) + " 2 0 0 0\n1 1 10\n" + vertical + "\n" +
           horizontal + "\n" + candela + "\n";
}

TEST(IesReader, PublishedCases) {
    const auto cases = nlohmann::json::parse(test::content(ATRIUM_SOURCE_DIR "/tests/io/ies_lm63_cases.json"));
    const double tolerance = cases["tolerance"]["rel"];
    ASSERT_EQ(cases["expected"].size(), 10U);
    for (const auto& c : cases["expected"]) {
        SCOPED_TRACE(c["name"].get<std::string>());
        const auto& expect = c["expect"];
        const auto loaded = parse(c["text"]);
        if (expect.contains("error")) {
            ASSERT_FALSE(loaded.has_value());
            EXPECT_TRUE(loaded.error().where.starts_with("line ")) << loaded.error().message();
            continue;
        }
        ASSERT_TRUE(loaded.has_value()) << loaded.error().message();
        const PhotometricWeb& web = *loaded->web;
        if (expect.contains("flux_lm")) {
            EXPECT_NEAR(web.flux() / expect["flux_lm"].get<double>(), 1.0, tolerance);
        }
        if (expect.contains("true_flux")) { // what linear interpolation loses of a cosine
            EXPECT_NEAR(web.flux() / expect["true_flux"].get<double>(), 1.0, 0.0007);
        }
        if (expect.contains("I0")) {
            EXPECT_NEAR(candela(web, 0, 0), expect["I0"].get<double>(), tolerance * expect["I0"].get<double>());
        }
        if (expect.contains("I_at")) {
            for (const auto& [name, value] : expect["I_at"].items()) {
                const auto [h, v] = angles_of(name);
                // Single precision: 1e-6 of the peak.
                EXPECT_NEAR(candela(web, v, h), value.get<double>(), tolerance * double(web.peak())) << name;
                EXPECT_NEAR(read_candela(web.data(), photometric_direction(PhotometryType::C, v, h)), value.get<double>(),
                            tolerance * double(web.peak()))
                    << name;
            }
        }
        if (expect.contains("scale")) {
            EXPECT_NEAR(web.data().scale, expect["scale"].get<double>(), 1e-12);
        }
        if (expect.contains("size_m")) {
            EXPECT_NEAR(web.data().luminous_opening.x, expect["size_m"]["width"].get<double>(), 1e-12);
            EXPECT_NEAR(web.data().luminous_opening.y, expect["size_m"]["length"].get<double>(), 1e-12);
        }
        if (expect.contains("tilt_factors")) {
            const std::vector<float> factors = expect["tilt_factors"];
            EXPECT_EQ(web.data().tilt_part, factors);
        }
        if (expect.contains("version")) {
            EXPECT_EQ(web.data().standard, "LM-63-" + std::to_string(expect["version"].get<int>()));
        }
        if (c["name"] == "quadrant") {
            EXPECT_EQ(web.symmetry(), PhotometricWeb::Symmetry::Quadrants);
        }
        if (c["name"] == "bilateral_1995_90_270") {
            EXPECT_EQ(web.symmetry(), PhotometricWeb::Symmetry::About90);
        }
        if (c["name"] == "negative_size_circle") {
            EXPECT_DOUBLE_EQ(web.data().luminous_opening.x, -0.2);
        }
        EXPECT_EQ(loaded->warnings.size(), c["name"] == "crlf_trailing_garbage" ? 1U : 0U);
    }
}

// Lumens by zones, as catalogues have them: the mean intensity at a zone's borders times its solid angle.
double zonal_lumens(const PhotometricData& d) {
    const auto rad = [](float degrees) { return radians_from_degrees(double(degrees)); };
    const std::size_t n = d.vertical.size();
    const std::size_t planes = d.horizontal.size();
    double sum = 0.0, circle = 0.0;
    for (std::size_t i = 0; i < planes; ++i) {
        const float before = d.horizontal[i > 0 ? i - 1 : 0], after = d.horizontal[std::min(i + 1, planes - 1)];
        const double share = planes > 1 ? 0.5 * (rad(after) - rad(before)) : 1.0;
        circle += share;
        for (std::size_t j = 0; j + 1 < n; ++j) {
            const double mean = 0.5 * double(d.candela[i * n + j] + d.candela[i * n + j + 1]);
            sum += share * mean * (std::cos(rad(d.vertical[j])) - std::cos(rad(d.vertical[j + 1])));
        }
    }
    return 2.0 * kPiD * sum / circle;
}

// Five makers' files; lumens as integrated by zones by whoever collected them, to the digits given.
TEST(IesReader, MakersFiles) {
    ATRIUM_NEED_SHARED_SCENES();
    const struct {
        const char* name;
        double lumens, peak;
        const char* maker;
    } kFiles[] = {{"ledalite_apex55_251602SN.ies", 5297.4, 1065.2, "Ledalite Architectural Products  604-888-6811"},
                  {"acuity_ASA_15M_R2.ies", 9561.0, 6019.0, "American Electric Lighting"},
                  {"interlight_ovni_highbay_60W.ies", 5300.9, 1917.1, "Interlight"},
                  {"els_track_spot_DT106.ies", 2438.3, 14635.2, "Efficient Lighting Systems, Brunswick. VIC. 3056."},
                  {"bega_50975_6K3.ies", 321.5, 337.2, "BEGA Copyright LUMCat V"}};
    for (const auto& file : kFiles) {
        SCOPED_TRACE(file.name);
        const auto loaded = read_ies(test::shared_scenes() / "ies" / file.name);
        ASSERT_TRUE(loaded.has_value()) << loaded.error().message();
        EXPECT_NEAR(zonal_lumens(loaded->web->data()), file.lumens, 0.051);
        EXPECT_NEAR(loaded->web->flux() / file.lumens, 1.0, 0.001); // intensity between the angles is not constant
        EXPECT_NEAR(double(loaded->web->peak()), file.peak, 0.051);
        EXPECT_EQ(loaded->web->data().manufacturer, file.maker);
        EXPECT_EQ(loaded->web->data().file_name, file.name);
    }
    // Latin-1: "120" and a degree sign become UTF-8.
    const auto bay = read_ies(test::shared_scenes() / "ies" / "interlight_ovni_highbay_60W.ies");
    EXPECT_NE(bay->web->data().luminaire.find("120\xC2\xB0"), std::string::npos) << bay->web->data().luminaire;
}

TEST(IesReader, OddTextIsTheSame) {
    const std::string plain = file_of("0 45 90", "0", "100 80 0");
    const auto reference = parse(plain);
    ASSERT_TRUE(reference.has_value());
    std::string crlf, cr, words;
    for (const char c : plain) {
        crlf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    const std::size_t numbers = plain.find("1 1000");
    words = plain.substr(0, numbers);
    for (const char c : plain.substr(numbers)) {
        words += c == ' ' || c == '\n' ? " ,\n\t" : std::string(1, c); // one number a line
    }
    std::string commas = plain;
    std::replace(commas.begin() + std::ptrdiff_t(numbers), commas.end(), ' ', ',');
    for (const std::string& text : {crlf, cr, words, commas, "\xEF\xBB\xBF" + plain, plain + "\x1A\x1A\x1A"}) {
        const auto other = parse(text);
        ASSERT_TRUE(other.has_value()) << other.error().message();
        EXPECT_TRUE(other->warnings.empty());
        EXPECT_EQ(other->web->data().candela, reference->web->data().candela);
        EXPECT_EQ(other->web->data().vertical, reference->web->data().vertical);
    }
}

TEST(IesReader, FactorsByVersion) {
    // The third number of the second line counted until 1991 and tells how the file was made since 2019.
    const std::string numbers = "TILT=NONE\n1 -1 2 2 1 1 2 0 0 0\n0.5 0.8 10\n0 90\n0\n100 0\n";
    const std::pair<const char*, float> kVersions[] = {
        {"any label\n", 80.0F}, {"IESNA91\n", 80.0F}, {"IESNA:LM-63-1995\n", 100.0F}, {"IES:LM-63-2019\n", 100.0F}};
    for (const auto& [tag, peak] : kVersions) {
        const auto loaded = parse(tag + numbers);
        ASSERT_TRUE(loaded.has_value()) << loaded.error().message();
        EXPECT_FLOAT_EQ(loaded->web->peak(), peak) << tag;
    }
}

TEST(IesReader, Tilt) {
    const std::string text = "IESNA:LM-63-1995\nTILT=lamp.tlt\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 0\n";
    const std::string table = "1\n3\n0 45 90\n1 0.9 0.8\n";
    const auto with = parse(text, [&](const std::string& name) -> Result<std::vector<std::uint8_t>> {
        EXPECT_EQ(name, "lamp.tlt");
        return std::vector<std::uint8_t>(table.begin(), table.end());
    });
    ASSERT_TRUE(with.has_value());
    EXPECT_TRUE(with->warnings.empty());
    EXPECT_FLOAT_EQ(with->web->tilt_factor(22.5), 0.95F);
    EXPECT_FLOAT_EQ(with->web->tilt_factor(180), 1.0F);
    // The file that is kept needs no other one.
    const auto again = parse_ies(with->web->data().file, "lamp.ies");
    ASSERT_TRUE(again.has_value()) << again.error().message();
    EXPECT_EQ(*again->web, *with->web);

    const auto without = parse(text);
    ASSERT_TRUE(without.has_value());
    EXPECT_EQ(without->warnings.size(), 1U);
    EXPECT_EQ(without->web->tilt_factor(60), 1.0F);
    EXPECT_EQ(*parse_ies(without->web->data().file, "lamp.ies")->web, *without->web);

    // Beside the file, and nowhere else.
    const test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "in");
    test::put_content(folder / "in/lamp.ies", text);
    test::put_content(folder / "lamp.tlt", table);
    test::put_content(folder / "in/up.ies", std::string(text).replace(text.find("lamp.tlt"), 8, "../lamp.tlt"));
    EXPECT_EQ(read_ies(folder / "in/lamp.ies")->warnings.size(), 1U);
    EXPECT_EQ(read_ies(folder / "in/up.ies")->warnings.size(), 1U);
    test::put_content(folder / "in/lamp.tlt", table);
    EXPECT_EQ(read_ies(folder / "in/lamp.ies")->warnings.size(), 0U);
}

TEST(IesReader, DamagedFilesSayWhere) {
    const std::string good = file_of("0 45 90", "0", "100 80 0");
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string text = good;
        return text.replace(text.find(what), what.size(), instead);
    };
    const struct {
        std::string text, where, words;
    } kCases[] = {
        {"", "", "no TILT= line"},
        {"glTF\x02\x01\x01", "", "no TILT= line"},
        {std::string("a\0b", 3), "", "no text file"},
        {with("100 80 0", "100 80"), "line 8", "the file ends where an intensity"},
        {with("100 80 0", "100 8O 0"), "line 7", "\"8O\" stands where an intensity should"},
        {with("100 80 0", "100 nan 0"), "line 7", "no number"},
        {with("100 80 0", "100 1e999 0"), "line 7", "no number"},
        {with("100 80 0", "0 0 0"), "line 7", "all intensities are 0"},
        {with("1 1000 1 3", "1 1000 1 99999"), "line 3", "more than the file holds"},
        {with("1 1000 1 3 1", "1 1000 1 3 1000000000"), "line 3", "the number of horizontal angles is 1e+09"},
        {with("1 1000 1 3", "1 1000 1 -3"), "line 3", "the number of vertical angles is -3"},
        {with("1 1000 1 3", "1 1000 1 2.5"), "line 3", "not a whole number"},
        {with("1 1000 1", "1 1000 0"), "line 3", "the candela multiplier is 0"},
        {with("1 1 2 0 0 0", "1 4 2 0 0 0"), "line 3", "the type of photometry"},
        {with("0 45 90", "0 90 45"), "line 5", "must ascend"},
        {with("0 45 90", "0 45 190"), "line 6", "between 0 and 180"},
        {file_of("0 1e-38", "0", "1 1"), "line 6", "next to nothing"},
        {file_of("0 90", "0 45", "1 1 1 1"), "line 6", "horizontal angles go from 0 to 45"},
        {file_of("0 90", "0 90", "1 1 1 1", 4), "line 3", "type"},
        {file_of("10 90", "0 90", "1 1 1 1", 2), "line 6", "from 10 to 90"},
    };
    for (const auto& c : kCases) {
        const auto loaded = parse(c.text);
        ASSERT_FALSE(loaded.has_value()) << c.words;
        EXPECT_EQ(loaded.error().where, c.where) << loaded.error().message();
        EXPECT_NE(loaded.error().what.find(c.words), std::string::npos) << loaded.error().message();
        EXPECT_EQ(loaded.error().file, "lamp.ies");
        EXPECT_FALSE(loaded.error().hint.empty());
    }
}

// Every prefix of a file and every file with one byte changed is read or refused, never worse.
TEST(IesReader, SurvivesAnyDamage) {
    const std::string good = "IESNA:LM-63-1995\n[LUMINAIRE] x\nTILT=INCLUDE\n1\n2\n0 90\n1 0.9\n"
                             "1 1000 1 3 3 1 1 2 4 0\n1 1 60\n0 45 90\n0 45 90\n300 200 0\n300 150 0\n300 100 0\n";
    ASSERT_TRUE(parse(good).has_value());
    std::size_t read = 0;
    const auto look = [&](const std::string& text) {
        if (const auto loaded = parse(text)) {
            ++read;
            const PhotometricWeb& web = *loaded->web;
            EXPECT_TRUE(std::isfinite(web.flux()) && web.flux() >= 0.0);
            for (double v = -180.0; v <= 180.0; v += 22.0) {
                EXPECT_GE(candela(web, v, 2.0 * v), 0.0);
            }
            EXPECT_EQ(parse_ies(web.data().file, "lamp.ies")->web->data(), web.data());
        }
    };
    for (std::size_t n = 0; n < good.size(); ++n) {
        look(good.substr(0, n));
        for (const char c : {'0', '9', '-', '.', ' ', '\n', ',', 'e', '\xFF'}) {
            std::string text = good;
            text[n] = c;
            look(text);
        }
    }
    EXPECT_GT(read, good.size()); // changes of labels and many digits do no harm
}

} // namespace
} // namespace atrium
