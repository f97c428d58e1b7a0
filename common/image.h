// image: float pictures in memory; read, write and compare them through OpenImageIO behind `extern "C"` (image.cpp).
// EXR holds linear radiance for data; PNG is for eyes: value × 2^exposure, clipped to [0, 1], sRGB-encoded, 8 bits,
// the first three channels (or the first alone); a pixel that holds NaN or Inf is magenta.
#ifndef IMAGE_H
#define IMAGE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Row 0 is the top; pixels[(y * width + x) * channels + c]. Linear colour.
typedef struct Image {
    int width, height, channels;
    float *pixels;
} Image;

Image image_make(int width, int height, int channels); // zeroed
void image_free(Image *image);

// Of an .exr or .png file; a PNG's colours (not its alpha) are decoded to linear. Ends the program (status 1) where the file
// cannot be read whole.
Image image_read(const char *path);
// By the path's ending: .exr (float) or .png (8 bit, at `exposure` stops). Written whole or not at all; ends the program
// (status 1) where it cannot be written.
void image_write(const char *path, const Image *image, float exposure_stops);
// Any other ending is a wrong request, which names the option that asked for it.
void image_path_check(const char *option, const char *path);

// Errors of a against the reference b over the first three channels of all pixels; sizes must agree.
//   nrmse = sqrt(mean((a−b)²)) / mean(b);  rel_rmse = sqrt(mean(((a−b)/(b+0.1·mean(b)))²));
//   p99_abs: the smallest |a−b| that at least 99 % of the |a−b| do not exceed (rank ⌈0.99 n⌉, no interpolation);
//   max_abs: of |a−b|;  mean_ratio = mean(a)/mean(b);
//   nonfinite: NaN or Inf values in a, left out of the rest with their reference. Nothing left: all errors are infinite.
// A reference whose mean is 0: nrmse, rel_rmse are 0 where a equals b, else infinite; mean_ratio is 1 or infinite.
// A reference that holds NaN or Inf ends the program.
typedef struct ImageError {
    double nrmse, rel_rmse, p99_abs, max_abs, mean_ratio;
    long nonfinite;
} ImageError;
ImageError image_compare(const Image *a, const Image *b);
long image_count_nonfinite(const Image *image); // of all channels
// |a − b| a channel (the first three), for looking at.
Image image_difference(const Image *a, const Image *b);
// Every n-th pixel along both sides, from the top left.
Image image_every(const Image *image, int every);
// Left to right, same height, as RGB (one channel becomes grey); for a picture beside its truth and its difference.
Image image_beside(const Image *const *images, int count);

#ifdef __cplusplus
}
#endif
#endif
