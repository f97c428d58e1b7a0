// pegoraro: Pegoraro and Parker, "An analytical solution to single scattering in homogeneous participating media" (2009): the same integral as the imaginary part of an
// exponential integral of a complex number, which a series evaluates. With w = s / nearest and τ = σ nearest,
//     ∫ e^(-τ w) / (1 + w²) dw = Im(e^(iτ) E1(τ (w + i))),
// as differentiating the right side shows. E1 = -γ - ln z - Σ (-z)^k / (k k!), and for large |z| e^-z / z · Σ k! (-z)^-k.
#ifndef PEGORARO_GLSL
#define PEGORARO_GLSL

const int PEGORARO_TERMS = 28;       // at |z| = 6 the last is below 1e-8
const int PEGORARO_LARGE_TERMS = 6;  // the smallest term of the divergent series at |z| = 6
const float PEGORARO_LARGE = 6.0;    // where both series are equally wrong in single precision, by about 1e-2

vec2 complex_times(vec2 a, vec2 b)
{
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

//[pegoraro
// Im(e^(iτ) E1(τ (w + i)))
float pegoraro_antiderivative(float tau, float w)
{
    vec2 z = tau * vec2(w, 1.0);
    float magnitude = airlight_hypotenuse(z.x, z.y);
    vec2 power = vec2(1.0, 0.0), sum = vec2(-0.577215665 - log(magnitude), -atan(z.y, z.x));
    for (int k = 1; k <= PEGORARO_TERMS; k++) {
        power = complex_times(power, -z) / float(k);
        sum -= power / float(k);
    }
    vec2 inverse = vec2(z.x, -z.y) / magnitude / magnitude, term = vec2(1.0, 0.0), large = term;
    for (int k = 1; k <= PEGORARO_LARGE_TERMS; k++) {
        term = complex_times(term, -inverse) * float(k);
        large += term;
    }
    float far = exp(-z.x) * complex_times(large, inverse).y; // e^(iτ) e^-z = e^(-τw)
    return magnitude > PEGORARO_LARGE ? far : complex_times(vec2(cos(tau), sin(tau)), sum).y;
}

float pegoraro_point(float nearest, float foot, float from, float to, float sigma)
{
    float tau = sigma * nearest;
    float first = (airlight_hypotenuse(nearest, from - foot) + from - foot) / nearest;
    float last = (airlight_hypotenuse(nearest, to - foot) + to - foot) / nearest;
    float difference = pegoraro_antiderivative(tau, last) - pegoraro_antiderivative(tau, first);
    float result = 2.0 * INVERSE_4_PI * exp(-sigma * foot) / nearest * difference;
    return isnan(result) || isinf(result) ? 0.0 : result;
}
//]

#endif
