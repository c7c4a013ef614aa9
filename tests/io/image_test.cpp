#include "tests/io/io_test_support.h"

namespace atrium::test {
namespace {

Image gradient(int channels) {
    Image image;
    image.width = 5;
    image.height = 3;
    image.channels = channels;
    for (int i = 0; i < 15 * channels; ++i) {
        image.bytes.push_back(std::uint8_t(i * 4));
    }
    return image;
}

TEST(ImageFile, png_keeps_every_sample_also_under_transparency) {
    for (int channels = 1; channels <= 4; ++channels) {
        const Image image = gradient(channels);
        const auto png = encode_png(image);
        ASSERT_TRUE(png) << png.error().message();
        const auto again = decode_image(*png, "test.png");
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_EQ(*again, image) << channels;
        EXPECT_EQ(encode_png(*again).value(), *png);
    }
}

TEST(ImageFile, exr_keeps_floats_beyond_display_range) {
    const TemporaryFolder folder;
    Picture picture{3, 2, {}};
    for (int i = 0; i < 6; ++i) {
        picture.pixels.push_back(vec3(0.1F * float(i), 28489.25F, 1e-6F));
    }
    ASSERT_TRUE(write_picture(folder / "a.exr", picture));
    const auto image = read_image(folder / "a.exr");
    ASSERT_TRUE(image) << image.error().message();
    ASSERT_EQ(image->floats.size(), 18U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(vec3(image->floats[3 * i], image->floats[3 * i + 1], image->floats[3 * i + 2]), picture.pixels[i]);
    }
}

TEST(ImageFile, png_picture_is_rounded_and_survives_nan) {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ASSERT_TRUE(write_picture(folder / "a.png", {2, 1, {vec3(0.0F, 0.5F, 1.0F), vec3(nan, -1.0F, 7.0F)}}));
    const auto image = read_image(folder / "a.png");
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->bytes, (std::vector<std::uint8_t>{0, 128, 255, 0, 0, 255}));
}

TEST(ImageFile, hdr_is_read_as_linear_floats) {
    // Radiance HDR by hand: one flat, uncompressed pixel row; RGBE (128, 64, 32, 129) is mantissa / 256 * 2^(129 - 128).
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    for (int i = 0; i < 2; ++i) {
        hdr += {char(128), char(64), char(32), char(129)};
    }
    const auto image = decode_image({reinterpret_cast<const std::uint8_t*>(hdr.data()), hdr.size()}, "sky.hdr");
    ASSERT_TRUE(image) << image.error().message();
    ASSERT_EQ(image->floats.size(), 6U);
    EXPECT_NEAR(image->floats[0], 1.0F, 0.01F);
    EXPECT_NEAR(image->floats[1], 0.5F, 0.01F);
    EXPECT_NEAR(image->floats[2], 0.25F, 0.01F);
}

TEST(ImageFile, a_huge_size_is_refused_before_allocating) {
    const Image image = gradient(3);
    std::vector<std::uint8_t> png = encode_png(image).value();
    // IHDR: width and height at 16 and 20. The checksum no longer fits; either complaint will do, a crash will not.
    png[16] = png[20] = 0x00;
    png[17] = png[21] = 0x0F;
    EXPECT_FALSE(decode_image(png, "bomb.png"));
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
    const auto bomb = decode_image({reinterpret_cast<const std::uint8_t*>(hdr.data()), hdr.size()}, "bomb.hdr");
    ASSERT_FALSE(bomb);
    EXPECT_NE(bomb.error().message().find("too large"), std::string::npos) << bomb.error().message();
}

TEST(ImageFile, what_is_no_image_is_refused_with_its_name) {
    const TemporaryFolder folder;
    put_content(folder / "a.png", "hello");
    put_content(folder / "b", "hello");
    for (const char* name : {"a.png", "b", "missing.png"}) {
        const auto image = read_image(folder / name);
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().message().find(name), std::string::npos);
    }
    const std::vector<std::uint8_t> whole = encode_png(gradient(4)).value();
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        EXPECT_FALSE(decode_image({whole.data(), length}, "cut.png")) << length;
    }
}

TEST(ImageFile, pictures_need_pixels_and_a_known_name) {
    const TemporaryFolder folder;
    EXPECT_FALSE(write_picture(folder / "a.png", {2, 2, {}}));
    EXPECT_FALSE(write_picture(folder / "a.tga", {1, 1, {vec3(0.0F)}}));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

} // namespace
} // namespace atrium::test
