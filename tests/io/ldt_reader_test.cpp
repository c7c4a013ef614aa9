// EULUMDAT files: every symmetry against its rule, factors, what is wrong with damaged ones.
#include "engine/io/ldt_reader.h"

#include "engine/base/units.h"
#include "tests/io/io_test_support.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

namespace atrium {
namespace {

using testing::HasSubstr;

struct Ldt {
    int symmetry = 0;
    int planes = 24; ///< 15 degrees apart
    std::string factor = "1";
    std::string sets = "1\n1\nLED\n2000\n4000 K\n80\n20";
    std::function<double(double gamma, double c)> per_kilolumen = [](double g, double) { return 300.0 - g; };

    [[nodiscard]] std::string text() const {
        std::string out = fmt::format(
            "Maker\n1\n{}\n{}\n{}\n19\n10\nR 1\nLumin\xE9re\nNo. 5\nx.ldt\n2026\n1200\n80\n60\n1150\n60\n0\n0\n0\n"
            "0\n100\n80\n{}\n0\n{}\n",
            symmetry, planes, 360.0 / planes, factor, sets);
        for (int i = 0; i < 10; ++i) {
            out += "0.5\n";
        }
        for (int i = 0; i < planes; ++i) {
            out += fmt::format("{}\n", 360.0 * i / planes);
        }
        for (int j = 0; j < 19; ++j) {
            out += fmt::format("{}\n", 10 * j);
        }
        const int first = symmetry == 3 ? 3 * planes / 4 : 0;
        const int count = symmetry == 0 ? planes : symmetry == 1 ? 1 : symmetry == 4 ? planes / 4 + 1 : planes / 2 + 1;
        for (int i = first; i < first + count; ++i) {
            for (int j = 0; j < 19; ++j) {
                out += fmt::format("{}\n", per_kilolumen(10.0 * j, 360.0 * (i % planes) / planes));
            }
        }
        return out;
    }
};

Result<LoadedPhotometry> parse(const std::string& text) {
    return parse_ldt({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "in/x.ldt");
}

double candela(const PhotometricWeb& web, double gamma, double c) {
    return double(web.candela(vec3(photometric_direction(PhotometryType::C, gamma, c))));
}

TEST(LdtReader, EverySymmetry) {
    const auto rad = [](double degrees) { return radians_from_degrees(degrees); };
    const std::function<double(double, double)> kLights[] = {
        [&](double g, double c) { return 200 + 60 * std::sin(rad(g)) * std::cos(rad(c - 33)); },
        [](double g, double) { return 300 - g; },
        [&](double g, double c) { return 200 + 60 * std::sin(rad(g)) * std::cos(rad(c)); },
        [&](double g, double c) { return 200 + 60 * std::sin(rad(g)) * std::sin(rad(c)); },
        [&](double g, double c) { return 200 + 60 * std::sin(rad(g)) * std::cos(rad(2 * c)); }};
    for (int symmetry = 0; symmetry < 5; ++symmetry) {
        SCOPED_TRACE(symmetry);
        Ldt file;
        file.symmetry = symmetry;
        file.per_kilolumen = kLights[symmetry];
        file.factor = "1.5";
        const auto loaded = parse(file.text());
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings.front();
        for (int i = 0; i < 24; ++i) {
            for (int j = 0; j < 19; ++j) {
                const double expected = 1.5 * 2.0 * file.per_kilolumen(10.0 * j, 15.0 * i);
                EXPECT_NEAR(candela(*loaded->web, 10.0 * j, 15.0 * i), expected, 1e-4 * expected) << i << " " << j;
            }
        }
        // Kept as LM-63: read again it is the same to the bit.
        const PhotometricData& data = loaded->web->data();
        EXPECT_EQ(data.file_name, "x.ies");
        EXPECT_EQ(data.manufacturer, "Maker");
        EXPECT_EQ(data.luminaire, "Lumin\xC3\xA9re");
        EXPECT_EQ(data.catalog, "No. 5");
        EXPECT_NEAR(data.luminous_opening.y, 1.15, 1e-12);
        EXPECT_EQ(data.watts, 20.0);
        EXPECT_EQ(*parse_ies(data.file, "x.ies")->web, *loaded->web);
    }
}

TEST(LdtReader, FluxPerThousandLumens) {
    // 1000 / 4 pi in every direction: the whole flux of the lamps.
    Ldt file;
    file.symmetry = 1;
    file.per_kilolumen = [](double, double) { return 1000.0 / (4.0 * kPiD); };
    const auto loaded = parse(file.text());
    ASSERT_TRUE(loaded);
    EXPECT_NEAR(loaded->web->flux(), 2000.0, 0.01);
    // Absolute measurement: the number of lamps is negative, the flux the luminaire's.
    file.sets = "1\n-1\nLED\n2000\n4000 K\n80\n20";
    EXPECT_NEAR(parse(file.text())->web->flux(), 2000.0, 0.01);
    // Other sets of lamps are told of.
    file.sets = "2\n1\nLED\n2000\n4000 K\n80\n20\n1\nLED\n3000\n3000 K\n80\n20";
    const auto sets = parse(file.text());
    ASSERT_TRUE(sets);
    EXPECT_NEAR(sets->web->flux(), 2000.0, 0.01);
    EXPECT_EQ(sets->warnings.size(), 1U);
    // Decimal commas.
    std::string commas = Ldt().text();
    std::replace(commas.begin(), commas.end(), '.', ',');
    EXPECT_EQ(parse(commas)->web->data().candela, parse(Ldt().text())->web->data().candela);
}

TEST(LdtReader, DamagedFilesSayWhere) {
    const std::string good = Ldt().text();
    const auto refusal = [](const std::string& text) {
        const auto loaded = parse(text);
        return loaded ? std::string("read") : loaded.error().message();
    };
    EXPECT_THAT(refusal(""), HasSubstr("the file ends where the maker"));
    EXPECT_THAT(refusal(good.substr(0, good.size() - 8)), HasSubstr("the file ends where an intensity"));
    EXPECT_THAT(refusal(good.substr(0, good.size() / 2)), HasSubstr("it announces 456 intensities"));
    Ldt file;
    file.symmetry = 4;
    file.planes = 18;
    EXPECT_THAT(refusal(file.text()), HasSubstr("line 4: 18 C planes cannot have the symmetry"));
    file.planes = 24;
    file.symmetry = 7;
    EXPECT_THAT(refusal(file.text()), HasSubstr("line 3: the symmetry (0 to 4) is 7"));
    file.symmetry = 0;
    file.factor = "";
    EXPECT_THAT(refusal(file.text()), HasSubstr("line 24: the line is empty"));
    file.factor = "0";
    EXPECT_THAT(refusal(file.text()), HasSubstr("no light"));
    file.factor = "x1";
    EXPECT_THAT(refusal(file.text()), HasSubstr("line 24: \"x1\" stands where the conversion factor"));
    // Any byte changed or cut away: read or refused, never worse.
    for (std::size_t n = 0; n < good.size(); n += 3) {
        std::string text = good;
        text[n] = "-9\n.x"[n % 5];
        refusal(text);
        refusal(good.substr(0, n));
    }
}

TEST(LdtReader, ByTheNameOfTheFile) {
    const test::TemporaryFolder folder;
    test::put_content(folder / "a.LDT", Ldt().text());
    test::put_content(folder / "b.ies", "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1 0 90 0 5 0\n");
    ASSERT_TRUE(read_photometric_file(folder / "a.LDT"));
    ASSERT_TRUE(read_photometric_file(folder / "b.ies"));
    EXPECT_FALSE(read_photometric_file(folder / "c.ldt"));
}

} // namespace
} // namespace atrium
