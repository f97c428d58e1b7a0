// compare: how far a picture lies from a reference, as one CSV table; and pictures of where.
//
//     build/compare A.exr REFERENCE.exr [--difference FILE] [--beside FILE] [--exposure STOPS]
#include <argp.h>
#include <stdlib.h>

#include "image.h"

typedef struct Request {
    const char *pictures[2], *difference, *beside;
    float exposure_stops;
} Request;

static const struct argp_option options[] = {
    {"difference", 'd', "FILE", 0, "Write |A - REFERENCE| (.exr or .png)", 0},
    {"beside", 'b', "FILE", 0, "Write A, REFERENCE and |A - REFERENCE| side by side (.exr or .png)", 0},
    {"exposure", 'e', "STOPS", 0, "Brightness of a .png: values times 2^STOPS (default 0)", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    Request *request = state->input;
    char *end;
    switch (key) {
    case 'd':
        image_path_check("--difference", request->difference = argument);
        return 0;
    case 'b':
        image_path_check("--beside", request->beside = argument);
        return 0;
    case 'e':
        request->exposure_stops = strtof(argument, &end);
        if (end == argument || *end || !(request->exposure_stops >= -64 && request->exposure_stops <= 64))
            fail_request("--exposure %s: stops are a number from -64 to 64", argument);
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num >= 2)
            fail_request("'%s': two pictures are compared, this is a third", argument);
        image_path_check("picture", request->pictures[state->arg_num] = argument);
        return 0;
    case ARGP_KEY_END:
        if (state->arg_num < 2)
            fail_request("two pictures are needed: A REFERENCE");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    const struct argp argp = {
        options, parse, "A REFERENCE", "Errors of picture A against a reference, as CSV.", NULL, NULL, NULL};
    Request request = {0};
    argp_err_exit_status = 2;
    argp_parse(&argp, argc, argv, 0, NULL, &request);

    Image a = image_read(request.pictures[0]), b = image_read(request.pictures[1]);
    ImageError error = image_compare(&a, &b);
    printf("width,height,nrmse,rel_rmse,p99_abs,max_abs,mean_ratio,nonfinite\n");
    printf("%d,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%ld\n", a.width, a.height, error.nrmse, error.rel_rmse,
           error.p99_abs, error.max_abs, error.mean_ratio, error.nonfinite);
    if (request.difference || request.beside) {
        Image difference = image_difference(&a, &b);
        Image row = image_beside((const Image *[]){&a, &b, &difference}, 3);
        if (request.difference)
            image_write(request.difference, &difference, request.exposure_stops);
        if (request.beside)
            image_write(request.beside, &row, request.exposure_stops);
        image_free(&row);
        image_free(&difference);
    }
    image_free(&a);
    image_free(&b);
    return fflush(stdout) ? 1 : 0;
}
