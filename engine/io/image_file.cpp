#include "engine/io/image_file.h"

#include "engine/base/checks.h"
#include "engine/io/file_access.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstring>

namespace atrium {
namespace {

constexpr std::int64_t kMaxSamples = std::int64_t(1) << 28;
constexpr std::uint64_t kMaxImageFile = std::uint64_t(1) << 30;

/// A file name that makes OpenImageIO pick the right reader: by content where it is unmistakable, else by the given name.
/// Never a name that exists, so that no reader can open a file of its own.
std::string reader_name(std::span<const std::uint8_t> bytes, const std::string& name) {
    struct Magic {
        std::string_view begin;
        const char* extension;
    };
    static constexpr Magic kMagics[] = {{"\x89PNG", "png"},
                                        {"\xFF\xD8\xFF", "jpg"},
                                        {"#?RADIANCE", "hdr"},
                                        {"#?RGBE", "hdr"},
                                        {"\x76\x2F\x31\x01", "exr"},
                                        {"RIFF", "webp"},
                                        {"GIF8", "gif"},
                                        {"BM", "bmp"},
                                        {std::string_view("II*\0", 4), "tif"},
                                        {std::string_view("MM\0*", 4), "tif"}};
    const std::string prefix = "image held in memory.";
    for (const Magic& magic : kMagics) {
        if (bytes.size() >= magic.begin.size() && std::memcmp(bytes.data(), magic.begin.data(), magic.begin.size()) == 0) {
            return prefix + magic.extension;
        }
    }
    const std::string extension = std::filesystem::path(name).extension().string();
    return extension.size() > 1 ? prefix + extension.substr(1) : std::string();
}

Result<std::vector<std::uint8_t>> encode(const std::string& extension, OIIO::ImageSpec spec, const void* samples,
                                         const std::string& name) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::string file_name = "image held in memory." + extension;
    const auto out = OIIO::ImageOutput::create(file_name, &sink);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!out || !out->open(file_name, spec) || !out->write_image(spec.format, samples) || !out->close()) {
        const std::string reason = out ? out->geterror() : OIIO::geterror();
        return fail(name, "", "the image could not be encoded" + (reason.empty() ? "" : ": " + reason));
    }
    return bytes;
}

} // namespace

Result<Image> decode_image(std::span<const std::uint8_t> bytes, const std::string& name) {
    const std::string file_name = reader_name(bytes, name);
    if (bytes.empty() || file_name.empty()) {
        return fail(name, "", bytes.empty() ? "the image is empty" : "not an image of a known format",
                    "Use PNG, JPEG, HDR or EXR.");
    }
    try {
        OIIO::Filesystem::IOMemReader source(bytes.data(), bytes.size());
        OIIO::ImageSpec wish;
        wish.attribute("oiio:UnassociatedAlpha", 1);
        // Both ways of naming the source: the PNG and JPEG readers of OpenImageIO 2.4 look into the configuration only.
        OIIO::Filesystem::IOProxy* proxy = &source;
        wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        const auto in = OIIO::ImageInput::open(file_name, &wish, &source);
        if (!in) {
            return fail(name, "", "the image cannot be decoded: " + OIIO::geterror(), "Use PNG, JPEG, HDR or EXR.");
        }
        const OIIO::ImageSpec& spec = in->spec();
        const int channels = std::min(spec.nchannels, 4);
        if (spec.width <= 0 || spec.height <= 0 || channels <= 0 || spec.depth > 1) {
            return fail(name, "", "the image has no pixels that can be used");
        }
        const std::int64_t pixels = std::int64_t(spec.width) * spec.height;
        if (pixels > kMaxSamples / channels) {
            return fail(name, "",
                        "the image is too large: " + std::to_string(spec.width) + " x " + std::to_string(spec.height),
                        "Scale it down to at most 8192 x 8192.");
        }
        Image image;
        image.width = spec.width;
        image.height = spec.height;
        image.channels = channels;
        const bool is_float = spec.format.is_floating_point();
        bool read = false;
        if (is_float) {
            image.floats.resize(std::size_t(pixels * channels));
            read = in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, image.floats.data());
        } else {
            image.bytes.resize(std::size_t(pixels * channels));
            read = in->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, image.bytes.data());
        }
        if (!read) {
            return fail(name, "", "the image is damaged: " + in->geterror());
        }
        return image;
    } catch (const std::exception& e) {
        return fail(name, "", std::string("the image cannot be decoded: ") + e.what());
    }
}

Result<Image> read_image(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMaxImageFile);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    return decode_image(*bytes, path.string());
}

Result<void> write_picture(const std::filesystem::path& path, const Picture& picture,
                           const std::vector<PictureChannel>& extra) {
    const std::string extension = path.extension().string();
    if (picture.width <= 0 || picture.height <= 0 ||
        picture.pixels.size() != std::size_t(picture.width) * std::size_t(picture.height)) {
        return fail(path.string(), "", "the picture has no pixels");
    }
    Result<std::vector<std::uint8_t>> bytes =
        fail(path.string(), "", "is neither .exr nor .png", "Name the picture .exr or .png.");
    try {
        if (extension == ".exr") {
            OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT);
            spec.attribute("compression", "zip");
            spec.attribute("oiio:ColorSpace", "Linear");
            spec.nchannels += int(extra.size());
            std::vector<float> samples;
            samples.reserve(picture.pixels.size() * std::size_t(spec.nchannels));
            for (const PictureChannel& channel : extra) {
                ATRIUM_CHECK(channel.values.size() == picture.pixels.size());
                spec.channelnames.push_back(channel.name);
            }
            for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
                samples.insert(samples.end(), {picture.pixels[i].r, picture.pixels[i].g, picture.pixels[i].b});
                for (const PictureChannel& channel : extra) {
                    samples.push_back(channel.values[i]);
                }
            }
            bytes = encode("exr", spec, samples.data(), path.string());
        } else if (extension == ".png") {
            std::vector<std::uint8_t> samples;
            samples.reserve(picture.pixels.size() * 3);
            for (const vec3& pixel : picture.pixels) {
                for (int i = 0; i < 3; ++i) {
                    // fmax first: a NaN becomes 0 instead of an undefined conversion.
                    samples.push_back(std::uint8_t(std::fmin(std::fmax(pixel[i], 0.0F), 1.0F) * 255.0F + 0.5F));
                }
            }
            OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
            spec.attribute("oiio:ColorSpace", "sRGB");
            bytes = encode("png", spec, samples.data(), path.string());
        }
    } catch (const std::exception& e) {
        return fail(path.string(), "", std::string("the picture could not be encoded: ") + e.what());
    }
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    return write_file_atomically(path, *bytes);
}

Result<std::vector<std::uint8_t>> encode_png(const Image& image) {
    const std::size_t samples = std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0)) *
                                std::size_t(std::max(image.channels, 0));
    if (samples == 0 || image.channels > 4 || image.bytes.size() != samples) {
        return fail("", "", "only 8-bit images of 1 to 4 channels can be stored as PNG");
    }
    try {
        OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        return encode("png", spec, image.bytes.data(), "");
    } catch (const std::exception& e) {
        return fail("", "", std::string("the image could not be encoded: ") + e.what());
    }
}

} // namespace atrium
