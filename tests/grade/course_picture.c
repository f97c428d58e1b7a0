// course_picture: yours, the wanted and their difference side by side, of the two raw float32 files of one check:
//     course_picture GOT WANTED DIMENSIONS WIDTH HEIGHT DEPTH CHANNELS OUT.png
// A program of its own, since what writes pictures loads 260 libraries, and make check is to answer at once.
#include "compare.h"
#include "image.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 256, GAP = 1 };

// The layers of a grid stand side by side in rows, as square as they go, with a line between them.
typedef struct Sheet {
    int columns, rows, scale; // scale: pixels an item
    int width, height;        // items
} Sheet;

static Sheet sheet_of(const Shape *shape)
{
    Sheet sheet = {.columns = (int)ceil(sqrt((double)shape->size[2]))};
    sheet.rows = (shape->size[2] + sheet.columns - 1) / sheet.columns;
    sheet.width = sheet.columns * (shape->size[0] + GAP) - GAP;
    sheet.height = sheet.rows * (shape->size[1] + GAP) - GAP;
    int longest = sheet.width > sheet.height ? sheet.width : sheet.height;
    sheet.scale = longest < SIDE ? SIDE / longest : 1;
    return sheet;
}

static float largest(const float *values, size_t count)
{
    float most = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            most = fmaxf(most, fabsf(values[i]));
    return most > 0 ? most : 1;
}

// A value as 0 to 1; what is not finite stays so and becomes magenta.
static void paint(Image *image, const Sheet *sheet, const Shape *shape, const float *values, float scale)
{
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            int item_x = x / sheet->scale, item_y = y / sheet->scale;
            int column = item_x / (shape->size[0] + GAP), row = item_y / (shape->size[1] + GAP);
            int inner_x = item_x % (shape->size[0] + GAP), inner_y = item_y % (shape->size[1] + GAP);
            int layer = row * sheet->columns + column;
            float *pixel = image->pixels + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
            if (inner_x == shape->size[0] || inner_y == shape->size[1] || layer >= shape->size[2]) {
                pixel[0] = pixel[1] = 0.02f;
                pixel[2] = 0.2f;
                continue;
            }
            if (shape->dimensions == 3) // grids grow upwards
                inner_y = shape->size[1] - 1 - inner_y;
            size_t item =
                ((size_t)layer * (size_t)shape->size[1] + (size_t)inner_y) * (size_t)shape->size[0] +
                (size_t)inner_x;
            for (int c = 0; c < 3; c++) {
                int channel = shape->channels >= 3 ? c : 0;
                pixel[c] = values[item * (size_t)shape->channels + (size_t)channel] / scale;
            }
        }
}

static float *values_or_end(const char *path, size_t count)
{
    char *error;
    float *values = values_read(path, count, &error);
    if (!values)
        fail_work("%s", error);
    return values;
}

int main(int argc, char **argv)
{
    if (argc != 9)
        fail_request("GOT WANTED DIMENSIONS WIDTH HEIGHT DEPTH CHANNELS OUT.png are needed");
    Shape shape = {.dimensions = atoi(argv[3]),
                   .size = {atoi(argv[4]), atoi(argv[5]), atoi(argv[6])},
                   .channels = atoi(argv[7])};
    size_t count = check_values(&(Check){.shape = shape});
    float *values[2] = {values_or_end(argv[1], count), values_or_end(argv[2], count)};
    Sheet sheet = sheet_of(&shape);
    int width = sheet.width * sheet.scale, height = sheet.height * sheet.scale;
    Image images[3], gap = image_make(sheet.scale, height, 3);
    for (int i = 0; i < 2; i++) {
        images[i] = image_make(width, height, 3);
        paint(&images[i], &sheet, &shape, values[i], largest(values[1], count));
        free(values[i]);
    }
    images[2] = image_difference(&images[0], &images[1]);
    for (size_t i = 0; i < (size_t)gap.width * (size_t)gap.height * 3; i++)
        gap.pixels[i] = 1;
    Image all = image_beside((const Image *const[]){&images[0], &gap, &images[1], &gap, &images[2]}, 5);
    image_write(argv[8], &all, 0);
    image_free(&all);
    image_free(&gap);
    for (int i = 0; i < 3; i++)
        image_free(&images[i]);
    return 0;
}
