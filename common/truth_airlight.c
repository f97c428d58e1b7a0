// truth: single scattering by GSL's adaptive quadrature in double, straight along the ray: it shares no substitution with the techniques.
#include "truth_internal.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <stdlib.h>
#include <string.h>

double truth_phase(const TruthPhase *phase, double cosine)
{
    const double g = phase->mean_cosine, sphere = 4.0 * M_PI;
    const double rayleigh = 3.0 / (4.0 * sphere) * (1.0 + cosine * cosine);
    const double base = pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
    const double henyey = (1.0 - g * g) / base / sphere, printed = (1.0 - g) * (1.0 - g) / base / sphere;
    const double share = phase->rayleigh_share;
    if (strcmp(phase->name, "uniform") == 0)
        return 1.0 / sphere;
    if (strcmp(phase->name, "rayleigh") == 0)
        return rayleigh;
    if (strcmp(phase->name, "henyey_greenstein") == 0)
        return henyey;
    if (strcmp(phase->name, "hoffman_preetham") == 0)
        return share * rayleigh + (1.0 - share) * printed;
    if (strcmp(phase->name, "hoffman_preetham_normalized") == 0)
        return share * rayleigh + (1.0 - share) * henyey;
    fail_work("truth: no phase function '%s'", phase->name);
}

typedef struct Ray {
    double nearest, foot, radius, sigma, path; // path: what the exponent is taken relative to
    const TruthPhase *phase;
} Ray;

// What the panels below integrate: t comes as the distance from the foot, so that nothing is lost near it.
static double integrand(double from_foot, void *data)
{
    const Ray *ray = data;
    const double r = hypot(ray->nearest, from_foot), held = fmax(r, ray->radius);
    const double cosine = r > 0.0 ? -from_foot / r : 1.0;
    return truth_phase(ray->phase, cosine) * exp(-ray->sigma * (ray->foot + from_foot + r - ray->path)) /
           (held * held);
}

// Between neighbouring breakpoints, each panel no wider than the integrand's own scale there: its distance from the light.
static double panels(Ray *ray, gsl_integration_workspace *work, double from, double to)
{
    const double least = fmax(ray->nearest, 1e-3 * ray->radius);
    double sum = 0.0, a = from;
    while (a < to) {
        double part, error, b = a + fmax(least, a);
        if (a < 0.0) // towards the foot: halve the way
            b = -a > 2.0 * least ? 0.5 * a : fmin(a + least, 0.0);
        b = fmin(b, to);
        if (!(b > a))
            break;
        gsl_function function = {integrand, ray};
        gsl_integration_qag(&function, a, b, 0.0, 1e-10, 1000, GSL_INTEG_GAUSS31, work, &part, &error);
        sum += part;
        if (a > least && part < 1e-13 * sum)
            break; // of a sum whose parts fall at least as 1/t
        a = b;
    }
    return sum;
}

// What cannot reach 1e-10 is returned as good as it is: GSL's error handler, which would end the program, is off.
static double point_integral(double nearest, double foot, double radius, double from, double to, double sigma,
                             const TruthPhase *phase)
{
    if (!(from < to))
        return 0.0;
    Ray ray = {nearest, foot, radius, sigma, 0.0, phase};
    const double a = from - foot, b = to - foot;
    ray.path = from + hypot(nearest, a);
    // the way eye-point-light grows along the ray; e^-60 later nothing is left: t + r = path + 60/σ
    double last = b;
    if (sigma > 0.0) {
        const double s = ray.path - foot + 60.0 / sigma; // r + (t - foot) there
        last = fmin(b, 0.5 * (s - nearest * nearest / s));
    }
    if (isinf(last))
        last = 1e18 * fmax(1.0, hypot(nearest, a)); // σ = 0: what remains is 1e-18 of it
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(1000);
    const double half_chord = radius > nearest ? sqrt((radius - nearest) * (radius + nearest)) : 0.0;
    const double edges[] = {a, -half_chord, 0.0, half_chord, last};
    double sum = 0.0;
    for (int i = 0; i + 1 < 5; i++)
        sum += panels(&ray, work, fmax(edges[i], a), fmin(i == 3 ? last : edges[i + 1], last));
    gsl_integration_workspace_free(work);
    return sum * exp(-sigma * ray.path);
}

double truth_airlight_point(double nearest, double foot, double radius, double from, double to, double sigma,
                            const TruthPhase *phase)
{
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    const double integral = point_integral(nearest, foot, radius, from, to, sigma, phase);
    gsl_set_error_handler(handler);
    return integral;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The lit spans of one light for one extinction: ∫ ρ Lin e^(-σ t) dt for intensity 1.
static double light_integral(const Light *light, const TruthSpan *spans, size_t count, double sigma,
                             const TruthPhase *phase, const double origin[3], const double direction[3])
{
    double sum = 0.0, to_light[3], nearest = 0.0, towards[3];
    for (int k = 0; k < 3; k++) {
        to_light[k] = (double)light->position[k] - origin[k];
        towards[k] = (double)light->direction[k];
    }
    const double foot = dot(to_light, direction);
    for (int k = 0; k < 3; k++)
        nearest = hypot(nearest, to_light[k] - foot * direction[k]);
    for (size_t i = 0; i < count; i++) {
        const double t0 = spans[i].t0, t1 = spans[i].t1;
        if (light->kind == LIGHT_DIRECTIONAL)
            sum += truth_phase(phase, -dot(towards, direction) / sqrt(dot(towards, towards))) *
                   exp(-sigma * t0) * (sigma > 0.0 ? -expm1(-sigma * (t1 - t0)) / sigma : t1 - t0);
        else
            sum += point_integral(nearest, foot, (double)light->radius, t0, t1, sigma, phase);
    }
    return sum;
}

void truth_airlight_quiet(const TruthShadows *shadows, const Scene *scene, const TruthPhase *phase,
                          const double origin[3], const double direction[3], double length,
                          double radiance[3])
{
    memset(radiance, 0, 3 * sizeof *radiance);
    for (size_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        size_t count;
        TruthSpan *spans = truth_lit_spans(shadows, light, origin, direction, length, &count);
        double last_sigma = -1.0, integral = 0.0;
        for (int k = 0; k < 3; k++) {
            const double scattering = (double)scene->medium.scattering[k];
            const double sigma = scattering + (double)scene->medium.absorption[k];
            if (scattering == 0.0)
                continue;
            if (sigma != last_sigma)
                integral = light_integral(light, spans, count, sigma, phase, origin, direction);
            last_sigma = sigma;
            radiance[k] += scattering * (double)light->intensity[k] * integral;
        }
        free(spans);
    }
}

void truth_airlight(const TruthShadows *shadows, const Scene *scene, const TruthPhase *phase,
                    const double origin[3], const double direction[3], double length, double radiance[3])
{
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    truth_airlight_quiet(shadows, scene, phase, origin, direction, length, radiance);
    gsl_set_error_handler(handler);
}
