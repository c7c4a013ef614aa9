// What people type into number fields, as numbers: decimal point or comma, units, sums, feet and inches. No Qt in here.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace atrium::ui {

/// The units a field understands; values are in the field's base unit (metres, degrees, ...).
struct UnitSet {
    struct Unit {
        std::string name;    ///< as typed, lower case ("mm"); several spellings are several entries
        double factor = 1.0; ///< base units in one of these
    };
    std::vector<Unit> units;
    double default_factor = 1.0; ///< for a number without a unit
    bool feet_and_inches = false;
};

UnitSet length_units(); ///< base: metre; m, cm, mm, km, ft, in, ' and ", with fractions of an inch
UnitSet angle_units();  ///< base: degree; deg, °, rad
UnitSet plain_units(const std::string& suffix = {}); ///< the suffix may be typed and changes nothing; % where it is "%"

/// Value in base units, or why the text is not a number, in English, as one sentence without a full stop.
/// Terms add up ("1 m 10 mm", "10+10 mm", 8' 2 1/2"); a sign in front of a term counts for the terms beside it up to the
/// next sign, so "-1m 10mm" is -1.01. A term without a unit takes that of the next term, else the one before it.
tl::expected<double, std::string> parse_quantity(std::string_view text, const UnitSet& units);

/// Shortest text with at most `decimals` digits after the point, trailing zeros removed; always with a point.
std::string format_number(double value, int decimals);

} // namespace atrium::ui
