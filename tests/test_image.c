// image: files keep what they are given, PNG shows what sRGB says, errors are those of pictures worked out by hand.
#include "image.h"
#include "failure.h"

#include <criterion/criterion.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

static char folder[] = "/tmp/test_image_XXXXXX";
static char *path; // of the file in question

static void in_folder(const char *name)
{
    if (!path)
        cr_assert(mkdtemp(folder), "a folder to test in");
    path = text_format("%s/%s", folder, name);
}
static void clean(void)
{
    char *command = text_format("rm -rf '%s'", folder);
    cr_assert_eq(system(command), 0, "the folder is removed");
}

static Image grey(int width, int height, float value)
{
    Image image = image_make(width, height, 1);
    for (int i = 0; i < width * height; i++)
        image.pixels[i] = value;
    return image;
}

Test(image, exr_keeps_every_float)
{
    const float values[] = {0,  -0.0f,    1,         0.1f, 1.17549435e-38f, 1e-45f, 3.4e38f,
                            -7, INFINITY, -INFINITY, NAN,  65504.5f};
    for (int channels = 1; channels <= 4; channels++) {
        Image image = image_make(12 / channels, 2, channels);
        for (int i = 0; i < 24 / channels * channels && i < 2 * (12 / channels) * channels; i++)
            image.pixels[i] = values[i % 12];
        in_folder("a.exr");
        image_write(path, &image, 5); // exposure is for eyes: it may not touch data
        Image back = image_read(path);
        cr_assert(back.width == image.width && back.height == 2 && back.channels == channels, "same shape");
        cr_assert_eq(memcmp(back.pixels, image.pixels, sizeof(float) * (size_t)(2 * image.width * channels)),
                     0, "%d channels come back bit by bit", channels);
    }
    clean();
}

Test(image, png_is_srgb_of_the_exposed_value)
{
    // IEC 61966-2-1 worked out apart: 0.5 -> 187.52, 0.18 -> 117.65 (0.4613561), 0.002 -> 6.59, 1 -> 255; clipped beyond
    const float linear[] = {0, 0.002f, 0.18f, 0.5f, 1, 7, -3, 0.25f};
    const int bytes[] = {0, 7, 118, 188, 255, 255, 0, 137};
    Image image = image_make(8, 1, 1);
    memcpy(image.pixels, linear, sizeof linear);
    in_folder("a.png");
    for (int stops = -2; stops <= 2;
         stops++) { // the values times 2^-stops shown at 2^stops are the same picture
        Image exposed = image_make(8, 1, 1);
        for (int i = 0; i < 8; i++)
            exposed.pixels[i] = ldexpf(linear[i], -stops);
        image_write(path, &exposed, (float)stops);
        Image back = image_read(path);
        cr_assert_eq(back.channels, 3, "grey is shown as RGB");
        for (int i = 0; i < 8; i++) {
            float encoded = (float)bytes[i] / 255;
            float expected = encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
            // half the step between two bytes at its smallest is 1.5e-4
            cr_assert_float_eq(back.pixels[3 * i + 1], expected, 5e-5f, "%g shows as byte %d",
                               (double)linear[i], bytes[i]);
        }
    }
    image.pixels[3] = NAN;
    image_write(path, &image, 0);
    Image back = image_read(path);
    cr_assert(back.pixels[9] == 1 && back.pixels[10] == 0 && back.pixels[11] == 1,
              "NaN is magenta, not black");
    clean();
}

Test(image, rows_run_from_the_top)
{
    Image image = image_make(2, 3, 3);
    for (int i = 0; i < 18; i++)
        image.pixels[i] = (float)(i % 2); // 0 and 1 survive 8 bits
    image.pixels[0] = 1;
    const char *const names[] = {"a.exr", "a.png"};
    for (int i = 0; i < 2; i++) {
        in_folder(names[i]);
        image_write(path, &image, 0);
        Image back = image_read(path);
        cr_assert_eq(memcmp(back.pixels, image.pixels, 18 * sizeof(float)), 0,
                     "%s keeps each value at its place", names[i]);
    }
    clean();
}

Test(image, errors_are_those_worked_out_by_hand)
{
    Image a = image_make(2, 1, 1), b = image_make(2, 1, 1);
    a.pixels[0] = 3, b.pixels[0] = 1, a.pixels[1] = 3, b.pixels[1] = 3; // mean(b) = 2
    ImageError error = image_compare(&a, &b);
    const double tolerance = 1e-12; // double arithmetic on small whole numbers
    cr_assert_float_eq(error.nrmse, sqrt(2.0) / 2, tolerance, "nrmse = sqrt(4/2)/2");
    cr_assert_float_eq(error.rel_rmse, sqrt(pow(2 / 1.2, 2) / 2), tolerance, "rel_rmse = sqrt((2/1.2)^2/2)");
    cr_assert_float_eq(error.mean_ratio, 1.5, tolerance, "mean_ratio = 3/2");
    cr_assert(error.max_abs == 2 && error.p99_abs == 2 && error.nonfinite == 0, "max and p99 of two values");
    error = image_compare(&b, &b);
    cr_assert(error.nrmse == 0 && error.rel_rmse == 0 && error.max_abs == 0 && error.mean_ratio == 1,
              "equal: no error");
}

Test(image, p99_leaves_out_one_in_a_hundred)
{
    Image a = grey(100, 1, 1), b = grey(100, 1, 1);
    a.pixels[17] = 9;
    cr_assert_eq(image_compare(&a, &b).p99_abs, 0, "1 of 100 lies beyond the 99 %%");
    a.pixels[63] = 5;
    ImageError error = image_compare(&a, &b);
    cr_assert(error.p99_abs == 4 && error.max_abs == 8, "2 of 100 do not: p99 %g, max %g", error.p99_abs,
              error.max_abs);
}

Test(image, alpha_is_not_compared)
{
    Image a = image_make(1, 1, 4), b = image_make(1, 1, 4);
    for (int c = 0; c < 3; c++)
        a.pixels[c] = b.pixels[c] = 2;
    a.pixels[3] = 1;
    cr_assert_eq(image_compare(&a, &b).max_abs, 0, "only three channels count");
}

Test(image, nonfinite_values_are_counted_and_left_out)
{
    Image a = grey(4, 1, 2), b = grey(4, 1, 1);
    a.pixels[1] = NAN, a.pixels[3] = -INFINITY, b.pixels[1] = 1e6f;
    ImageError error = image_compare(&a, &b);
    cr_assert(error.nonfinite == 2 && image_count_nonfinite(&a) == 2, "two are not finite");
    cr_assert(error.nrmse == 1 && error.mean_ratio == 2, "the rest is compared, and its reference alone");
    a.pixels[0] = a.pixels[2] = NAN;
    error = image_compare(&a, &b);
    cr_assert(isinf(error.nrmse) && isinf(error.p99_abs) && error.nonfinite == 4,
              "nothing left is not a good picture");
}

Test(image, black_reference_gives_zero_or_infinity)
{
    Image black = grey(3, 1, 0), lit = grey(3, 1, 0);
    ImageError error = image_compare(&black, &black);
    cr_assert(error.nrmse == 0 && error.rel_rmse == 0 && error.mean_ratio == 1, "black against black");
    lit.pixels[1] = 1;
    error = image_compare(&lit, &black);
    cr_assert(isinf(error.nrmse) && isinf(error.rel_rmse) && isinf(error.mean_ratio), "light against black");
}

Test(image, difference_and_row_hold_their_pixels)
{
    Image a = grey(1, 2, 3), b = grey(1, 2, 5), wide = image_make(2, 2, 4);
    for (int i = 0; i < 16; i++)
        wide.pixels[i] = (float)i;
    Image difference = image_difference(&a, &b);
    cr_assert(difference.pixels[0] == 2 && difference.pixels[1] == 2 && difference.channels == 1,
              "|3 - 5| = 2");
    Image row = image_beside((const Image *[]){&a, &wide, &difference}, 3);
    const float expected[] = {3, 3, 3, 0, 1, 2, 4, 5, 6, 2, 2, 2, 3, 3, 3, 8, 9, 10, 12, 13, 14, 2, 2, 2};
    cr_assert(row.width == 4 && row.height == 2 && row.channels == 3, "4x2 RGB");
    cr_assert_eq(memcmp(row.pixels, expected, sizeof expected), 0,
                 "left to right, without alpha, grey as RGB");
    image_free(&row);
    cr_assert(!row.pixels && !row.width, "freed is empty");
}

Test(image, every_third_pixel_from_the_first)
{
    Image image = image_make(7, 4, 2);
    for (int i = 0; i < 7 * 4 * 2; i++)
        image.pixels[i] = (float)i;
    Image some = image_every(&image, 3), all = image_every(&image, 1);
    const float expected[] = {0, 1, 6, 7, 12, 13, 42, 43, 48, 49, 54, 55};
    cr_assert(some.width == 3 && some.height == 2 && some.channels == 2, "%dx%d", some.width, some.height);
    cr_assert_eq(memcmp(some.pixels, expected, sizeof expected), 0);
    cr_assert(all.width == 7 && all.height == 4 && all.pixels[55] == 55.0f, "1: all");
    image_free(&image);
    image_free(&some);
    image_free(&all);
}

// --- what cannot be done is said in one line ---

static void read_path(void)
{
    image_read(path);
}
static void write_path(void)
{
    Image image = grey(64, 64, 0.5f);
    image_write(path, &image, 0);
}
static void write_noise(void) // does not compress to nothing
{
    Image image = image_make(64, 64, 3);
    for (int i = 0; i < 64 * 64 * 3; i++)
        image.pixels[i] = (float)(i * 7919 % 1009) / 1009;
    image_write(path, &image, 0);
}
static void write_on_full_disk(void)
{
    signal(SIGXFSZ, SIG_IGN); // a write past the limit then fails as on a full disk
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){100, 100});
    write_path();
}
static void check_path(void)
{
    image_path_check("--out", path);
}
static void compare_sizes(void)
{
    Image a = grey(2, 1, 0), b = grey(1, 2, 0);
    image_compare(&a, &b);
}
static void compare_with_nan(void)
{
    Image a = grey(2, 1, 0), b = grey(2, 1, NAN);
    image_compare(&a, &b);
}
static void make_empty(void)
{
    image_make(0, 5, 3);
}

static void expect(void (*function)(void), int status, const char *text)
{
    Failure failure = failure_of(function);
    cr_assert(failure.status == status && failure_says(&failure, text), "status %d: %s", failure.status,
              failure.message);
}

static void put(const char *name, const char *bytes, size_t count)
{
    in_folder(name);
    FILE *file = fopen(path, "wb");
    cr_assert(file && fwrite(bytes, 1, count, file) == count && fclose(file) == 0, "%s is made", name);
}

Test(image, unreadable_files_are_refused)
{
    in_folder("missing.exr");
    expect(read_path, 1, "No such file");
    in_folder("picture.jpg");
    expect(read_path, 1, "neither .exr nor .png");
    put("empty.exr", "", 0);
    expect(read_path, 1, "empty.exr");
    put("empty.png", "", 0);
    expect(read_path, 1, "empty.png");
    put("text.exr", "not a picture at all", 20);
    expect(read_path, 1, "text.exr");
    const char *const names[] = {"whole.exr", "whole.png"};
    for (int i = 0; i < 2; i++) {
        in_folder(names[i]);
        // in a child: OpenImageIO started here would leave its threads out of the next child, which would wait for them
        cr_assert_eq(failure_of(write_noise).status, 0, "%s is made", names[i]);
        struct stat status;
        cr_assert(stat(path, &status) == 0 && truncate(path, status.st_size / 2) == 0, "cut in half");
        expect(read_path, 1, names[i]);
    }
    clean();
}

Test(image, unwritable_files_are_refused_whole)
{
    in_folder("nowhere/a.exr");
    expect(write_path, 1, "No such file or directory");
    const char *const names[] = {"a.exr", "a.png"};
    for (int i = 0; i < 2; i++) {
        put(names[i], "the old one", 11);
        expect(write_on_full_disk, 1, "cannot be written");
        char *text = file_read(path, NULL);
        cr_assert_str_eq(text, "the old one", "%s: the old file stays", names[i]);
        in_folder(i ? "full.png" : "full.exr");
        cr_assert_eq(symlink("/dev/full", path), 0, "a link to the full device");
        expect(write_path, 1, "No space left");
    }
    char *count = text_format("test $(ls -A '%s' | wc -l) = 4", folder);
    cr_assert_eq(system(count), 0, "nothing unfinished is left behind");
    clean();
}

Test(image, wrong_requests_are_named)
{
    path = (char *)"a.jpg";
    expect(check_path, 2, "--out a.jpg");
    path = (char *)".png";
    expect(check_path, 2, "must end in .exr");
    path = (char *)"a.png";
    cr_assert_eq(failure_of(check_path).status, 0, "a .png is fine");
    expect(compare_sizes, 1, "2x1 with 1 colours against 1x2");
    expect(compare_with_nan, 1, "reference");
    expect(make_empty, 1, "0x5");
}
