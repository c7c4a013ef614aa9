// Measured light distributions: the luminous intensity of a luminaire over the sphere, as photometric files hold it.
#pragma once

#include "engine/base/math.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace atrium {

/// How a file's two angles are laid over the sphere (IES LM-75). In the axes of a light, which aims along -z with +y up and
/// +x to its right as in glTF, a direction is
///   C  (sin v cos h, sin v sin h, -cos v)    v from nadir (-z) to zenith, h counter-clockwise as seen from above
///   B  (sin h, cos h sin v, -cos h cos v)    about a horizontal axis; floodlights
///   A  (sin h cos v, sin v, -cos h cos v)    about a vertical axis; vehicle lamps
enum class PhotometryType : std::uint8_t { C = 1, B = 2, A = 3 };

/// What a photometric file says. Angles in degrees, ascending; intensities in candela with all factors of the file applied.
struct PhotometricData {
    PhotometryType type = PhotometryType::C;
    std::vector<float> vertical;   ///< at least two
    std::vector<float> horizontal; ///< as in the file: what is symmetric is there once. See PhotometricWeb::symmetry()
    std::vector<float> candela;    ///< for each horizontal angle all vertical ones

    std::string file_name;    ///< without its folder
    std::string standard;     ///< "LM-63-2002"
    std::string manufacturer; ///< these four as UTF-8; may be empty
    std::string catalog;
    std::string luminaire;
    std::string lamp;
    double lamp_lumens = 0.0; ///< of all bare lamps together; 0 where the file was measured absolutely (-1)
    double watts = 0.0;
    double scale = 1.0;           ///< by which the file's numbers were multiplied: multiplier and ballast factors
    dvec3 luminous_opening{0.0};  ///< width, length, height in metres; a negative width is a round opening's diameter
    std::vector<float> tilt;      ///< degrees by which the luminaire is turned away from straight down; empty: no matter
    std::vector<float> tilt_part; ///< of its light that it then gives

    std::vector<std::uint8_t> file; ///< bytes of a complete LM-63 file from which all of this can be read again
    friend bool operator==(const PhotometricData&, const PhotometricData&) = default;
};

/// A distribution that can be asked. Between the angles of the file intensity is bilinear in the angles, outside of them it
/// is 0. Immutable; safe from any thread; shared between lights.
class PhotometricWeb {
public:
    /// Which parts of a type C web are measured and which are mirror images or turned.
    enum class Symmetry : std::uint8_t { Axial, Quadrants, About0, About90, None };

    /// The angles must be such that coverage_fault() finds nothing.
    explicit PhotometricWeb(PhotometricData data);
    /// What about the angles is none that a web can have ("horizontal angles end at 45"), or nothing.
    static std::string coverage_fault(const PhotometricData& data);

    [[nodiscard]] const PhotometricData& data() const { return data_; }
    [[nodiscard]] Symmetry symmetry() const { return symmetry_; }
    /// The greatest intensity, candela; above 0.
    [[nodiscard]] float peak() const { return peak_; }
    /// Intensity over the peak towards a unit direction in the light's axes.
    [[nodiscard]] float relative(const vec3& direction) const;
    [[nodiscard]] float candela(const vec3& direction) const { return peak_ * relative(direction); }
    /// Lumen in all directions: the exact integral of what relative() tells.
    [[nodiscard]] double flux() const { return flux_; }
    /// What a luminaire gives that is turned away from straight down by so many degrees, over what it was measured with.
    [[nodiscard]] float tilt_factor(double degrees) const;
    /// Angle between the outermost directions of the plane through the axis and horizontal angle `plane` (degrees, type C)
    /// that have at least `share` of the peak, degrees; 360 where all have.
    [[nodiscard]] double beam_angle(double plane, double share = 0.5) const;

    friend bool operator==(const PhotometricWeb& a, const PhotometricWeb& b) { return a.data_ == b.data_; }

private:
    // Ascending angles with a table that leads to the interval of any of them.
    struct Axis {
        std::vector<float> at;
        std::vector<std::uint32_t> bins;
        float bins_per_degree = 0.0F;
        void prepare();
        /// False outside.
        bool find(float angle, std::size_t& index, float& t) const;
    };
    void expand();
    [[nodiscard]] double integrate() const;

    PhotometricData data_;
    Symmetry symmetry_ = Symmetry::None;
    Axis vertical_;
    Axis horizontal_;             // without symmetry: the whole circle, or the front half for types A and B
    std::vector<float> relative_; // for each horizontal angle all vertical ones
    float peak_ = 0.0F;
    double flux_ = 0.0;
};

/// Unit direction of a pair of angles, degrees.
dvec3 photometric_direction(PhotometryType type, double vertical, double horizontal);

} // namespace atrium
