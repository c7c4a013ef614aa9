// The course of the light: one line for every picture that the engine handed over. No widgets in here.
#pragma once

#include "engine/solver/solution.h"

#include <string>
#include <vector>

namespace atrium::ui {

/// What a picture was worth and what it took.
struct ConvergenceSample {
    enum class Kind : std::uint8_t {
        First,   ///< coarse, of a solution that goes on
        Hurried, ///< follows the hand
        Settled, ///< an exact update of what was there
        Final,   ///< a complete solution
        Stored   ///< came with the file: cost this session nothing
    };
    Kind kind = Kind::First;
    int run = 0;              ///< solutions and updates counted from 1; a first picture and the final one are one run
    double seconds = 0;       ///< run time within its run
    double total_seconds = 0; ///< run time of the session so far
    double estimate = 0;      ///< relative error by the solution's own samples; 0 = not known
    double measured = 0;      ///< relative error found by an audit (Statistics::audit); 0 = none was made
    Statistics statistics;
};
/// "first", "hurried", ...: as in the CSV.
const char* kind_name(ConvergenceSample::Kind kind);

/// Keeps the last 4096 pictures.
class ConvergenceLog {
public:
    void clear();
    /// A picture whose error has been measured takes the place of the same one before that.
    void add(const Solution& solution);
    [[nodiscard]] const std::vector<ConvergenceSample>& samples() const { return samples_; }
    /// One line for every picture. The columns of `atrium-cli solve --curve` but for the distance to a reference, and the
    /// figures of `--stats`, each under its key.
    [[nodiscard]] std::string csv() const;

private:
    std::vector<ConvergenceSample> samples_;
    double before_ = 0; ///< run time of all runs before the last one
};

} // namespace atrium::ui
