// closed_form: see closed_form.h.
#include "closed_form.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"sun", "pegoraro", "gauss",
                                    NULL}; // in closed.comp: SUN 0, PEGORARO 1, GAUSS 2

bool closed_form_is(const char *method)
{
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], method) == 0)
            return true;
    return false;
}

static double sun_integrand(double xi, void *u)
{
    return exp(-*(double *)u * tan(xi));
}

double sun_f(double u, double v)
{
    gsl_function function = {sun_integrand, &u};
    double result, error;
    size_t evaluations;
    gsl_integration_cquad_workspace *work = gsl_integration_cquad_workspace_alloc(100);
    gsl_integration_cquad(&function, 0.0, v, 0.0, 1e-9, work, &result, &error, &evaluations);
    gsl_integration_cquad_workspace_free(work);
    return result;
}

float *sun_table(int size)
{
    float *table = memory_new((size_t)size * (size_t)size, sizeof *table, "the table of F");
    for (int row = 0; row < size; row++)
        for (int column = 0; column < size; column++)
            table[row * size + column] =
                (float)sun_f(SUN_MOST_U * column / (size - 1.0), M_PI_2 * row / (size - 1.0));
    return table;
}

AirlightSettings closed_form_settings(AirlightSettings settings, GLuint table)
{
    settings.shader = closed_form_is(settings.method) ? "04_airlight/closed.comp" : NULL;
    settings.table = table;
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], settings.method) == 0)
            settings.number = i;
    return settings;
}

GLuint closed_form_table(int size)
{
    GLuint texture = gl_texture(.label = "Sun's F", .format = GL_R32F, .width = size, .height = size);
    float *table = sun_table(size);
    gl.TextureSubImage2D(texture, 0, 0, 0, size, size, GL_RED, GL_FLOAT, table);
    free(table);
    return texture;
}
