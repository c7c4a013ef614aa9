#include "ui/panels/number_parse.h"

#include <gtest/gtest.h>

namespace atrium::ui {
namespace {

double length(const char* text) {
    const auto parsed = parse_quantity(text, length_units());
    EXPECT_TRUE(parsed.has_value()) << text << ": " << (parsed ? "" : parsed.error());
    return parsed.value_or(-12345.0);
}

TEST(NumberParse, ReadsPointAndComma) {
    EXPECT_DOUBLE_EQ(length("2.5"), 2.5);
    EXPECT_DOUBLE_EQ(length("2,5"), 2.5);
    EXPECT_DOUBLE_EQ(length(" ,5 m "), 0.5);
    EXPECT_DOUBLE_EQ(length("-3"), -3);
    EXPECT_DOUBLE_EQ(length("1e-3"), 0.001);
    EXPECT_DOUBLE_EQ(length("\u22122 m"), -2) << "typographic minus";
}

TEST(NumberParse, ReadsUnits) {
    EXPECT_DOUBLE_EQ(length("250cm"), 2.5);
    EXPECT_DOUBLE_EQ(length("250 mm"), 0.25);
    EXPECT_DOUBLE_EQ(length("2 ft"), 0.6096);
    EXPECT_DOUBLE_EQ(length("10 in"), 0.254);
    EXPECT_DOUBLE_EQ(length("3 M"), 3);
}

TEST(NumberParse, AddsTerms) {
    EXPECT_DOUBLE_EQ(length("10+10 mm"), 0.02) << "the unit at the end counts for both";
    EXPECT_DOUBLE_EQ(length("10mm+10"), 0.02);
    EXPECT_DOUBLE_EQ(length("1 m - 1 cm"), 0.99);
    EXPECT_DOUBLE_EQ(length("1m 10mm"), 1.01);
    EXPECT_DOUBLE_EQ(length("-1m 10mm"), -1.01) << "the sign counts for the whole length";
    EXPECT_DOUBLE_EQ(length("2+3"), 5);
}

TEST(NumberParse, ReadsFeetAndInches) {
    EXPECT_NEAR(length("8'2 1/2\""), 8 * 0.3048 + 2.5 * 0.0254, 1e-12);
    EXPECT_NEAR(length("8' 2 1/2\""), 8 * 0.3048 + 2.5 * 0.0254, 1e-12);
    EXPECT_NEAR(length("6'5 1/4"), 6 * 0.3048 + 5.25 * 0.0254, 1e-12) << "inches after feet need no mark";
    EXPECT_NEAR(length("3/4\""), 0.75 * 0.0254, 1e-12);
    EXPECT_NEAR(length("-6' 6\""), -6.5 * 0.3048, 1e-12);
    EXPECT_NEAR(length("5\u2032 3\u2033"), 5.25 * 0.3048, 1e-12);
}

TEST(NumberParse, SaysWhyItRefuses) {
    const auto why = [](const char* text) {
        const auto parsed = parse_quantity(text, length_units());
        return parsed ? std::string("accepted") : parsed.error();
    };
    EXPECT_NE(why("").find("empty"), std::string::npos);
    EXPECT_NE(why("abc").find("not a number"), std::string::npos);
    EXPECT_NE(why("3 parsec").find("parsec"), std::string::npos);
    EXPECT_NE(why("1.000,5").find("more than one decimal point"), std::string::npos);
    EXPECT_NE(why("1 000").find("not clear"), std::string::npos);
    EXPECT_NE(why("1m 10").find("not clear"), std::string::npos);
    EXPECT_NE(why("3+").find("missing"), std::string::npos);
    EXPECT_NE(why("1/0").find("zero"), std::string::npos);
    EXPECT_NE(why("1e999").find("too large"), std::string::npos);
    EXPECT_NE(why("nan"), "accepted");
    EXPECT_NE(why("inf"), "accepted");
}

TEST(NumberParse, KnowsTheFieldsOwnSuffix) {
    EXPECT_DOUBLE_EQ(parse_quantity("45\u00b0", angle_units()).value(), 45);
    EXPECT_NEAR(parse_quantity("1 rad", angle_units()).value(), 57.29577951308232, 1e-12);
    EXPECT_DOUBLE_EQ(parse_quantity("30 %", plain_units("%")).value(), 30);
    EXPECT_DOUBLE_EQ(parse_quantity("1200 cd/m\u00b2", plain_units("cd/m2")).value(), 1200);
    EXPECT_FALSE(parse_quantity("3 m", angle_units()).has_value());
}

TEST(NumberParse, FormatsShortly) {
    EXPECT_EQ(format_number(2.5, 4), "2.5");
    EXPECT_EQ(format_number(2, 4), "2");
    EXPECT_EQ(format_number(-0.00001, 3), "0");
    EXPECT_EQ(format_number(100, 0), "100");
    EXPECT_EQ(format_number(0.12345, 3), "0.123");
}

} // namespace
} // namespace atrium::ui
