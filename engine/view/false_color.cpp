#include "engine/view/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace atrium {
namespace {

constexpr double kSmallest = 1e-6; ///< lux or cd/m2: starlight is a hundred times that
constexpr double kLargest = 1e12;
constexpr double kSlack = 1e-9; ///< relative; so that 0.3 counts as a multiple of 0.1

constexpr std::array<std::uint32_t, kMapColors> kViridis = {
    0x440154, 0x440256, 0x450457, 0x450559, 0x46075a, 0x46085c, 0x460a5d, 0x460b5e, 0x470d60, 0x470e61, 0x471063, 0x471164,
    0x471365, 0x481467, 0x481668, 0x481769, 0x48186a, 0x481a6c, 0x481b6d, 0x481c6e, 0x481d6f, 0x481f70, 0x482071, 0x482173,
    0x482374, 0x482475, 0x482576, 0x482677, 0x482878, 0x482979, 0x472a7a, 0x472c7a, 0x472d7b, 0x472e7c, 0x472f7d, 0x46307e,
    0x46327e, 0x46337f, 0x463480, 0x453581, 0x453781, 0x453882, 0x443983, 0x443a83, 0x443b84, 0x433d84, 0x433e85, 0x423f85,
    0x424086, 0x424186, 0x414287, 0x414487, 0x404588, 0x404688, 0x3f4788, 0x3f4889, 0x3e4989, 0x3e4a89, 0x3e4c8a, 0x3d4d8a,
    0x3d4e8a, 0x3c4f8a, 0x3c508b, 0x3b518b, 0x3b528b, 0x3a538b, 0x3a548c, 0x39558c, 0x39568c, 0x38588c, 0x38598c, 0x375a8c,
    0x375b8d, 0x365c8d, 0x365d8d, 0x355e8d, 0x355f8d, 0x34608d, 0x34618d, 0x33628d, 0x33638d, 0x32648e, 0x32658e, 0x31668e,
    0x31678e, 0x31688e, 0x30698e, 0x306a8e, 0x2f6b8e, 0x2f6c8e, 0x2e6d8e, 0x2e6e8e, 0x2e6f8e, 0x2d708e, 0x2d718e, 0x2c718e,
    0x2c728e, 0x2c738e, 0x2b748e, 0x2b758e, 0x2a768e, 0x2a778e, 0x2a788e, 0x29798e, 0x297a8e, 0x297b8e, 0x287c8e, 0x287d8e,
    0x277e8e, 0x277f8e, 0x27808e, 0x26818e, 0x26828e, 0x26828e, 0x25838e, 0x25848e, 0x25858e, 0x24868e, 0x24878e, 0x23888e,
    0x23898e, 0x238a8d, 0x228b8d, 0x228c8d, 0x228d8d, 0x218e8d, 0x218f8d, 0x21908d, 0x21918c, 0x20928c, 0x20928c, 0x20938c,
    0x1f948c, 0x1f958b, 0x1f968b, 0x1f978b, 0x1f988b, 0x1f998a, 0x1f9a8a, 0x1e9b8a, 0x1e9c89, 0x1e9d89, 0x1f9e89, 0x1f9f88,
    0x1fa088, 0x1fa188, 0x1fa187, 0x1fa287, 0x20a386, 0x20a486, 0x21a585, 0x21a685, 0x22a785, 0x22a884, 0x23a983, 0x24aa83,
    0x25ab82, 0x25ac82, 0x26ad81, 0x27ad81, 0x28ae80, 0x29af7f, 0x2ab07f, 0x2cb17e, 0x2db27d, 0x2eb37c, 0x2fb47c, 0x31b57b,
    0x32b67a, 0x34b679, 0x35b779, 0x37b878, 0x38b977, 0x3aba76, 0x3bbb75, 0x3dbc74, 0x3fbc73, 0x40bd72, 0x42be71, 0x44bf70,
    0x46c06f, 0x48c16e, 0x4ac16d, 0x4cc26c, 0x4ec36b, 0x50c46a, 0x52c569, 0x54c568, 0x56c667, 0x58c765, 0x5ac864, 0x5cc863,
    0x5ec962, 0x60ca60, 0x63cb5f, 0x65cb5e, 0x67cc5c, 0x69cd5b, 0x6ccd5a, 0x6ece58, 0x70cf57, 0x73d056, 0x75d054, 0x77d153,
    0x7ad151, 0x7cd250, 0x7fd34e, 0x81d34d, 0x84d44b, 0x86d549, 0x89d548, 0x8bd646, 0x8ed645, 0x90d743, 0x93d741, 0x95d840,
    0x98d83e, 0x9bd93c, 0x9dd93b, 0xa0da39, 0xa2da37, 0xa5db36, 0xa8db34, 0xaadc32, 0xaddc30, 0xb0dd2f, 0xb2dd2d, 0xb5de2b,
    0xb8de29, 0xbade28, 0xbddf26, 0xc0df25, 0xc2df23, 0xc5e021, 0xc8e020, 0xcae11f, 0xcde11d, 0xd0e11c, 0xd2e21b, 0xd5e21a,
    0xd8e219, 0xdae319, 0xdde318, 0xdfe318, 0xe2e418, 0xe5e419, 0xe7e419, 0xeae51a, 0xece51b, 0xefe51c, 0xf1e51d, 0xf4e61e,
    0xf6e620, 0xf8e621, 0xfbe723, 0xfde725,
};

double power_of_ten(double value) { return std::pow(10.0, std::floor(std::log10(value) + kSlack)); }

std::vector<double> even_steps(double from, double to, std::size_t most) {
    std::vector<double> out;
    double unit = power_of_ten((to - from) / double(std::max<std::size_t>(most, 1)));
    for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0}) {
        const double width = unit * step;
        const double first = std::ceil(from / width - kSlack);
        const double last = std::floor(to / width + kSlack);
        if (last - first + 1.0 <= double(most)) {
            for (double k = first; k <= last; k += 1.0) {
                out.push_back(k * width + 0.0); // never -0
            }
            return out;
        }
    }
    return out;
}

std::vector<double> series(double from, double to, std::span<const double> digits) {
    std::vector<double> out;
    for (double decade = power_of_ten(from); decade <= to * (1.0 + kSlack); decade *= 10.0) {
        for (const double digit : digits) {
            const double value = decade * digit;
            if (value >= from * (1.0 - kSlack) && value <= to * (1.0 + kSlack)) {
                out.push_back(value);
            }
        }
    }
    return out;
}

} // namespace

const char* unit_name(LightQuantity quantity) { return quantity == LightQuantity::Illuminance ? "lx" : "cd/m\xC2\xB2"; }

FalseColor valid_scale(FalseColor scale) {
    const auto bounded = [](double value) { return std::isfinite(value) ? std::clamp(value, 0.0, kLargest) : 0.0; };
    scale.minimum = bounded(scale.minimum);
    scale.maximum = bounded(scale.maximum);
    if (scale.minimum > scale.maximum) {
        std::swap(scale.minimum, scale.maximum);
    }
    if (scale.maximum < 10.0 * kSmallest) {
        scale.maximum = 1.0;
    }
    if (scale.logarithmic) {
        scale.minimum = std::max(scale.minimum, std::max(kSmallest, 1e-9 * scale.maximum));
    }
    scale.minimum = std::min(scale.minimum, 0.999 * scale.maximum);
    return scale;
}

std::span<const std::uint32_t, kMapColors> color_map() { return kViridis; }

Rgb map_color(float place) {
    const float at = std::clamp(place, 0.0F, 1.0F) * float(kMapColors - 1);
    const auto low = std::min(std::size_t(at), kMapColors - 2);
    const auto color = [](std::uint32_t c) {
        return Rgb(float(c >> 16U & 0xFFU), float(c >> 8U & 0xFFU), float(c & 0xFFU)) / 255.0F;
    };
    return glm::mix(color(kViridis[low]), color(kViridis[low + 1]), at - float(low));
}

float scale_place(const FalseColor& scale, double value) {
    const double place = scale.logarithmic ? std::log(std::max(value, scale.minimum) / scale.minimum) /
                                                 std::log(scale.maximum / scale.minimum)
                                           : (value - scale.minimum) / (scale.maximum - scale.minimum);
    return float(std::clamp(place, 0.0, 1.0));
}

Rgb false_color(const FalseColor& scale, double value) { return map_color(scale_place(scale, value)); }

std::vector<double> round_values(const FalseColor& scale, std::size_t most) {
    if (scale.logarithmic) {
        static constexpr std::array<double, 4> kFine{1.0, 2.0, 3.0, 5.0};
        static constexpr std::array<double, 3> kMiddle{1.0, 2.0, 5.0};
        static constexpr std::array<double, 2> kCoarse{1.0, 3.0};
        static constexpr std::array<double, 1> kDecades{1.0};
        for (const std::span<const double> digits : {std::span<const double>(kFine), std::span<const double>(kMiddle),
                                                     std::span<const double>(kCoarse), std::span<const double>(kDecades)}) {
            std::vector<double> out = series(scale.minimum, scale.maximum, digits);
            if (out.size() <= most) {
                return out.size() < 3 ? even_steps(scale.minimum, scale.maximum, most) : out;
            }
        }
        std::vector<double> out = series(scale.minimum, scale.maximum, kDecades); // every second, third ... of them
        const std::size_t stride = (out.size() + most - 1) / most;
        for (std::size_t i = 0; i * stride < out.size(); ++i) {
            out[i] = out[i * stride];
        }
        out.resize((out.size() + stride - 1) / stride);
        return out;
    }
    return even_steps(scale.minimum, scale.maximum, most);
}

double round_up(double value) {
    const double decade = power_of_ten(value);
    for (const double digit : {1.0, 2.0, 3.0, 5.0}) {
        if (value <= decade * digit * (1.0 + kSlack)) {
            return decade * digit;
        }
    }
    return decade * 10.0;
}

double round_down(double value) {
    const double decade = power_of_ten(value);
    for (const double digit : {5.0, 3.0, 2.0}) {
        if (value >= decade * digit * (1.0 - kSlack)) {
            return decade * digit;
        }
    }
    return decade;
}

} // namespace atrium
