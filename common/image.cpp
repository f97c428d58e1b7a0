// image: pictures through OpenImageIO behind `extern "C"`.
//
// A file is encoded in memory and written with stdio, so that every failure of the disk is seen and named: OpenImageIO's
// own PNG writer does not notice a full one.
#include "image.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace
{

bool ends_with(const std::string &path, const std::string &ending)
{
    return path.size() > ending.size() &&
           path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}
bool is_picture(const char *path)
{
    return ends_with(path, ".exr") || ends_with(path, ".png");
}

// IEC 61966-2-1, both ways; of [0, 1].
float srgb_encode(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}
float srgb_decode(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

size_t pixel_count(const Image &image)
{
    return static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
}
const float *pixel(const Image &image, size_t index)
{
    return image.pixels + index * static_cast<size_t>(image.channels);
}
int colours(const Image &image)
{
    return image.channels >= 3 ? 3 : 1;
}

std::vector<unsigned char> display_bytes(const Image &image, float exposure_stops)
{
    const int count = colours(image);
    const float scale = std::exp2(exposure_stops);
    std::vector<unsigned char> bytes;
    bytes.reserve(pixel_count(image) * 3);
    for (size_t i = 0; i < pixel_count(image); i++) {
        const float *value = pixel(image, i);
        const bool finite = std::all_of(value, value + count, [](float v) { return std::isfinite(v); });
        for (int c = 0; c < 3; c++) {
            // to the nearest of 256 levels: no dithering, so equal values give equal bytes
            const float shown = std::fmin(std::fmax(value[count == 3 ? c : 0] * scale, 0.0f), 1.0f);
            const float level = finite ? srgb_encode(shown) : static_cast<float>(c != 1);
            bytes.push_back(static_cast<unsigned char>(std::lround(level * 255.0f)));
        }
    }
    return bytes;
}

std::vector<unsigned char> encode(const char *path, const Image &image, float exposure_stops)
{
    const bool png = ends_with(path, ".png");
    std::vector<unsigned char> display;
    if (png)
        display = display_bytes(image, exposure_stops);
    const OIIO::TypeDesc type = png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    OIIO::ImageSpec spec(image.width, image.height, png ? 3 : image.channels, type);
    spec.attribute("oiio:ColorSpace", png ? "sRGB" : "linear");

    OIIO::Filesystem::IOVecOutput memory;
    const auto output = OIIO::ImageOutput::create(path, &memory);
    if (!output)
        fail_work("%s: cannot be written: %s", path, OIIO::geterror().c_str());
    const void *data = png ? static_cast<const void *>(display.data()) : image.pixels;
    if (!output->open(path, spec) || !output->write_image(type, data) || !output->close())
        fail_work("%s: cannot be written: %s", path, output->geterror().c_str());
    return memory.buffer();
}

void check_sizes(const Image &a, const Image &b)
{
    if (a.width != b.width || a.height != b.height || colours(a) != colours(b))
        fail_work("pictures to compare differ in size: %dx%d with %d colours against %dx%d with %d", a.width,
                  a.height, colours(a), b.width, b.height, colours(b));
}

} // namespace

extern "C" {

Image image_make(int width, int height, int channels)
{
    if (width < 1 || height < 1 || channels < 1)
        fail_work("a picture of %dx%d with %d channels cannot be made", width, height, channels);
    Image image = {width, height, channels, nullptr};
    const size_t bytes_a_pixel = static_cast<size_t>(channels) * sizeof(float);
    image.pixels = static_cast<float *>(memory_new(pixel_count(image), bytes_a_pixel, "a picture"));
    return image;
}
void image_free(Image *image)
{
    free(image->pixels);
    *image = Image{};
}

void image_path_check(const char *option, const char *path)
{
    if (!is_picture(path))
        fail_request("%s %s: a picture's name must end in .exr (data) or .png (for eyes)", option, path);
}

Image image_read(const char *path)
{
    if (!is_picture(path))
        fail_work("%s: cannot be read: its name ends in neither .exr nor .png", path);
    size_t bytes = 0;
    char *content = file_read(path, &bytes);
    if (!content)
        fail_work("%s: cannot be read: %s", path, std::strerror(errno));
    // libpng says so itself, on a line of its own, where a file is cut off
    if (ends_with(path, ".png") && (bytes < 8 || std::memcmp(content + bytes - 8, "IEND", 4) != 0))
        fail_work("%s: cannot be read: not a whole PNG file", path);
    std::free(content);

    OIIO::ImageSpec raw; // or colours would be multiplied by alpha while still encoded
    raw.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &raw);
    if (!input)
        fail_work("%s: cannot be read: %s", path, OIIO::geterror().c_str());
    const OIIO::ImageSpec &spec = input->spec();
    Image image = image_make(spec.width, spec.height, spec.nchannels);
    if (!input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, image.pixels))
        fail_work("%s: cannot be read: %s", path, input->geterror().c_str());
    if (ends_with(path, ".png"))
        for (size_t i = 0; i < pixel_count(image) * static_cast<size_t>(image.channels); i++)
            if (static_cast<int>(i % static_cast<size_t>(image.channels)) != spec.alpha_channel)
                image.pixels[i] = srgb_decode(image.pixels[i]);
    return image;
}

void image_write(const char *path, const Image *image, float exposure_stops)
{
    const std::vector<unsigned char> bytes = encode(path, *image, exposure_stops);
    const char *temporary = file_begin(path);
    FILE *file = std::fopen(temporary, "wb");
    if (!file || std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fclose(file) != 0)
        fail_work("%s: cannot be written: %s", path, std::strerror(errno));
    file_commit(temporary);
}

ImageError image_compare(const Image *a, const Image *b)
{
    check_sizes(*a, *b);
    std::vector<double> got, expected, absolute;
    double sum_got = 0.0, sum_expected = 0.0, squares = 0.0, relative_squares = 0.0;
    for (size_t i = 0; i < pixel_count(*a); i++)
        for (int c = 0; c < colours(*a); c++) {
            const double value = pixel(*a, i)[c], reference = pixel(*b, i)[c];
            if (!std::isfinite(reference))
                fail_work("the reference picture holds a value that is not finite");
            if (!std::isfinite(value))
                continue;
            got.push_back(value), expected.push_back(reference),
                absolute.push_back(std::abs(value - reference));
            sum_got += value, sum_expected += reference;
        }
    const size_t total = pixel_count(*a) * static_cast<size_t>(colours(*a)), n = got.size();
    const double infinite = std::numeric_limits<double>::infinity();
    ImageError error = {infinite, infinite, infinite, infinite, infinite, static_cast<long>(total - n)};
    if (n == 0)
        return error;

    const double mean = sum_expected / static_cast<double>(n);
    for (size_t i = 0; i < n; i++) {
        const double relative = (got[i] - expected[i]) / (expected[i] + 0.1 * mean);
        squares += absolute[i] * absolute[i];
        relative_squares += absolute[i] > 0.0 ? relative * relative : 0.0;
    }
    error.max_abs = *std::max_element(absolute.begin(), absolute.end());
    auto rank = absolute.begin() + static_cast<std::ptrdiff_t>((n * 99 + 99) / 100 - 1);
    std::nth_element(absolute.begin(), rank, absolute.end());
    error.p99_abs = *rank;
    error.nrmse = squares > 0.0 ? std::sqrt(squares / static_cast<double>(n)) / std::abs(mean) : 0.0;
    error.rel_rmse = std::sqrt(relative_squares / static_cast<double>(n));
    error.mean_ratio = sum_got == sum_expected ? 1.0 : sum_got / sum_expected;
    return error;
}

long image_count_nonfinite(const Image *image)
{
    const float *begin = image->pixels,
                *end = begin + pixel_count(*image) * static_cast<size_t>(image->channels);
    return std::count_if(begin, end, [](float v) { return !std::isfinite(v); });
}

Image image_difference(const Image *a, const Image *b)
{
    check_sizes(*a, *b);
    Image difference = image_make(a->width, a->height, colours(*a));
    float *out = difference.pixels;
    for (size_t i = 0; i < pixel_count(*a); i++)
        for (int c = 0; c < difference.channels; c++)
            *out++ = std::abs(pixel(*a, i)[c] - pixel(*b, i)[c]);
    return difference;
}

Image image_every(const Image *image, int every)
{
    const size_t step = static_cast<size_t>(every), width = static_cast<size_t>(image->width);
    Image some = image_make((image->width - 1) / every + 1, (image->height - 1) / every + 1, image->channels);
    float *out = some.pixels;
    for (size_t y = 0; y < static_cast<size_t>(image->height); y += step)
        for (size_t x = 0; x < width; x += step)
            out = std::copy_n(pixel(*image, y * width + x), image->channels, out);
    return some;
}

Image image_beside(const Image *const *images, int count)
{
    int width = 0;
    for (int i = 0; i < count; i++) {
        if (images[i]->height != images[0]->height)
            fail_work("pictures to put side by side differ in height");
        width += images[i]->width;
    }
    Image row = image_make(width, images[0]->height, 3);
    float *out = row.pixels;
    for (size_t y = 0; y < static_cast<size_t>(row.height); y++)
        for (int i = 0; i < count; i++) {
            const size_t columns = static_cast<size_t>(images[i]->width);
            for (size_t index = y * columns; index < (y + 1) * columns; index++)
                for (int c = 0; c < 3; c++)
                    *out++ = pixel(*images[i], index)[colours(*images[i]) == 3 ? c : 0];
        }
    return row;
}

} // extern "C"
