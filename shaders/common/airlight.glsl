// airlight: light that a homogeneous medium scatters into a ray once, as an integral over a stretch of the ray that is lit throughout.
// Taught line by line in chapter 04.
//
//     L = σs ∫ ρ(θ) Lin(t) e^(-σt t) dt;   point, spot: Lin = I e^(-σt r) / max(r, r0)²;   directional: Lin = E
//
// t is the way from the eye, r(t) the way to the light, whose nearest point on the ray's line is the foot: r² = nearest² + (t - foot)². All
// integrals below are for σs = I = E = 1. They keep their precision for any lengths between 1e-18 and 1e18, scaled as you like.
#ifndef AIRLIGHT_GLSL
#define AIRLIGHT_GLSL
#include "common/phase.glsl"

#define AIRLIGHT_PEAKED (PHASE >= PHASE_HENYEY_GREENSTEIN)
#if !defined(AIRLIGHT_NODES) || AIRLIGHT_NODES == 0 // as many as 1e-4 takes: a peak a thousandth wide, backward, is off by 4e-3 with 16
#undef AIRLIGHT_NODES
#if AIRLIGHT_PEAKED
#define AIRLIGHT_NODES 24
#else
#define AIRLIGHT_NODES 16
#endif
#endif

// Exponents: what lies further on along a lit stretch is less than e^-14 = 8e-7 of it. A phase function with a backward peak grows on the way, at most as the third
// power of the distance behind the light (inside r0 nothing falls against that): ∫ x³ e^-x beyond 14 would be 5e-4 of the whole, beyond 20 it is 3e-6.
const float AIRLIGHT_CUT = AIRLIGHT_PEAKED ? 20.0 : 14.0;
const float AIRLIGHT_FAR = 1e30;   // metres: stands for infinity; its square is never taken
const float AIRLIGHT_LEAST = 1e-30;
const float HALF_PI = 1.57079633;

// Gauss and Legendre's rule on y in [0, 1], as (y², weight · 2y): in z = y² it crowds towards z = 0.
#if AIRLIGHT_NODES == 8
const vec2 airlight_nodes[8] = vec2[](
    vec2(0.000394223874, 0.00200989985), vec2(0.0103361304, 0.0226087595), vec2(0.0562798735, 0.0744218181), vec2(0.166694746, 0.148077507),
    vec2(0.350129388, 0.214606277), vec2(0.581812283, 0.239284828), vec2(0.807002608, 0.199772275), vec2(0.96068408, 0.0992186364));
#elif AIRLIGHT_NODES == 16
const vec2 airlight_nodes[16] = vec2[](
    vec2(2.80850448e-05, 0.000143895341), vec2(0.000767982017, 0.00172520006), vec2(0.00451374344, 0.0063931674), vec2(0.0149567509, 0.0152418485),
    vec2(0.0365046411, 0.0285820905), vec2(0.0734364533, 0.0458399977), vec2(0.129023365, 0.0655908225), vec2(0.204750589, 0.0857252162),
    vec2(0.299763099, 0.103725394), vec2(0.410626915, 0.117012593), vec2(0.531453231, 0.123316522), vec2(0.654380886, 0.121013898),
    vec2(0.770361159, 0.109387123), vec2(0.870144946, 0.0887653443), vec2(0.945343005, 0.0605283239), vec2(0.98942902, 0.0270085641));
#elif AIRLIGHT_NODES == 24
const vec2 airlight_nodes[24] = vec2[](
    vec2(5.79071284e-06, 2.9697812e-05), vec2(0.000159661471, 0.000360514695), vec2(0.000952507733, 0.00136652237), vec2(0.00322535813, 0.00336769926),
    vec2(0.00809982126, 0.00660111049), vec2(0.016883859, 0.011199369), vec2(0.0309595195, 0.0171763117), vec2(0.0516604097, 0.0244209291),
    vec2(0.080147448, 0.0327000296), vec2(0.117291633, 0.0416695405), vec2(0.163572172, 0.0508937721), vec2(0.218997375, 0.059871436),
    vec2(0.283054268, 0.0680667593), vec2(0.354691039, 0.0749436842), vec2(0.432334312, 0.0800009324), vec2(0.513940956, 0.0828056385),
    vec2(0.597081881, 0.083023341), vec2(0.679053171, 0.0804423404), vec2(0.757008051, 0.0749907926), vec2(0.828101807, 0.0667453709),
    vec2(0.889640885, 0.0559308857), vec2(0.93922706, 0.0429109164), vec2(0.974888217, 0.0281708739), vec2(0.995193011, 0.012311532));
#endif

//[numbers
// √(a² + b²) without squares that over- or underflow.
float airlight_hypotenuse(float a, float b)
{
    float longer = max(abs(a), abs(b)), ratio = min(abs(a), abs(b)) / max(longer, AIRLIGHT_LEAST);
    return longer * sqrt(1.0 + ratio * ratio);
}

// atan(height / base) / height, also for a height of (nearly) 0. A series where the renderer's atan, off by 3.4e-6 here, would be relatively worse.
float airlight_angle(float height, float base)
{
    base = max(base, 1e-37);
    float ratio = height / base, r2 = ratio * ratio;
    return ratio < 0.25 ? (1.0 - r2 * (1.0 / 3.0 - r2 * (0.2 - r2 * (1.0 / 7.0 - r2 / 9.0)))) / base : atan(ratio) / height;
}

float airlight_sinc(float x) // sin(x) / x
{
    return abs(x) < 1e-2 ? 1.0 - x * x / 6.0 : sin(x) / x;
}

float airlight_sinh(float x)
{
    return abs(x) < 0.3 ? x * (1.0 + x * x / 6.0 * (1.0 + x * x / 20.0)) : 0.5 * (exp(x) - exp(-x));
}

float airlight_asinh(float x) // x >= 0
{
    return x < 0.1 ? x * (1.0 - x * x / 6.0 * (1.0 - 0.45 * x * x)) : log(x + sqrt(1.0 + x * x));
}

// asinh(b) - asinh(a) for 0 <= a <= b, where `step` = b - a is better known than a and b.
float airlight_asinh_step(float a, float b, float step)
{
    float sum = a * sqrt(1.0 + b * b) + b * sqrt(1.0 + a * a);
    return sum > 0.0 ? airlight_asinh(step * ((a + b) / sum)) : 0.0;
}
//]

//[dimmed
// x e^(-depth), by two halves: e^(-depth) itself may be no normal float where the product is. `precise`: compiled as a square it would be the same again.
float airlight_dimmed(float x, float depth)
{
    float half_way = exp(-0.5 * depth);
    precise float once = x * half_way;
    precise float twice = once * half_way;
    return twice;
}
//]

//[free
// Outside the light's radius. With s = r + (t - foot), the way eye-point-light is foot + s, and dt / r² = 2 ds / (nearest² + s²): so the integral is
//     e^(-σ (t0 + r0)) · 2 ∫ ρ e^(-σ (s - s0)) / (nearest² + s²) ds,   and tan(θ/2) = s / nearest.
// Everything falls along s, wherever the light is. We integrate over the angle q = atan(nearest / s), from q0 down to q1: the fraction is then
// constant and the exponential, 1 at q0, falls towards q1, where the nodes crowd. `before` and `behind` are the ends' t - foot; their difference
// is given, since it is better known: the foot may be far away.
float airlight_free(float nearest, float before, float behind, float difference, float path, float sigma)
{
    nearest = max(nearest, AIRLIGHT_LEAST);
    behind = min(behind, AIRLIGHT_FAR);
    float distance0 = airlight_hypotenuse(nearest, before), distance1 = airlight_hypotenuse(nearest, behind);
    // s, or nearest²/s on the other side of the foot: the sum that does not cancel
    float sum0 = distance0 + abs(before), sum1 = distance1 + abs(behind);
    float s0 = before >= 0.0 ? sum0 : nearest * (nearest / sum0);
    float s1 = behind >= 0.0 ? sum1 : nearest * (nearest / sum1);
    float ratio = before >= 0.0 ? sum1 / sum0 : behind <= 0.0 ? sum0 / sum1 : (sum0 / nearest) * (sum1 / nearest); // s1 / s0
    float growth = min(difference, AIRLIGHT_FAR) / (distance0 + distance1) * (1.0 + ratio); // (s1 - s0) / s0
    growth = min(growth, AIRLIGHT_CUT / max(sigma * s0, 1e-37));
    s1 = min(s1, s0 + AIRLIGHT_CUT / max(sigma, 1e-37));

    // angles over `nearest`, which may be (nearly) 0: their quotients are what counts
    float width = airlight_angle(nearest, 2.0 * distance0 / max(growth, 1e-37) + s0); // q0 - q1
    float last = airlight_angle(nearest, s1);                                         // q1
    float reach = airlight_hypotenuse(nearest, s0);
#if AIRLIGHT_PEAKED
    // A second map crowds the nodes about the phase function's peak, forward (q = π/2) or backward (q = 0), of width k.
    float g = mean_cosine, k = (1.0 - abs(g)) / (2.0 * sqrt(max(abs(g), 1e-4)));
    float ahead = nearest * airlight_angle(nearest, sum0), span = nearest * width;
    float peak_angle = g < 0.0 ? nearest * last : before >= 0.0 ? HALF_PI - ahead : ahead; // from the peak to the near end
    float u0 = peak_angle / k, u1 = (peak_angle + span) / k;
    float step = airlight_asinh_step(u0, u1, span / k), first = airlight_asinh(u0);
    float whole = airlight_sinh(0.5 * step) * cosh(first + 0.5 * step);
#endif
    float sum = 0.0;
    for (int i = 0; i < AIRLIGHT_NODES; i++) {
        float z = airlight_nodes[i].x, weight = airlight_nodes[i].y;
#if AIRLIGHT_PEAKED
        float from_peak = g < 0.0 ? z : 1.0 - z;
        if (step > 1e-3) {
            weight *= 0.5 * step * cosh(first + from_peak * step) / whole;
            from_peak = cosh(first + 0.5 * from_peak * step) * airlight_sinh(0.5 * from_peak * step) / whole;
        }
        z = g < 0.0 ? from_peak : max(1.0 - from_peak, 0.0);
#endif
        float q = last + z * width, turned = (1.0 - z) * width; // over nearest, as last and width are
        float farther = reach * turned * airlight_sinc(nearest * turned) / (q * airlight_sinc(nearest * q)); // s - s0
#if AIRLIGHT_PEAKED
        float sine = sin(peak_angle + from_peak * span); // of the angle from the peak: precise where the function is steep
        vec2 half_angle = g < 0.0 ? vec2(1.0 - sine * sine, sine * sine) : vec2(sine * sine, 1.0 - sine * sine);
#else
        float sine = sin(nearest * q);
        vec2 half_angle = vec2(1.0 - sine * sine, sine * sine);
#endif
        sum += weight * exp(-sigma * farther) * phase(half_angle);
    }
    return airlight_dimmed(2.0 * width * sum, sigma * path);
}
//]

//[held
// Inside the light's radius, on one side of the foot, where the inverse square is held at 1/radius². Over v with t - foot = ±nearest · sinh v: r, s
// and dt grow as e^v, which Gauss's rule takes in its stride however near the light the ray passes.
float airlight_held(float nearest, float radius, float before, float behind, float difference, float path, float sigma)
{
    bool ahead = before < 0.0;
    nearest = max(nearest, AIRLIGHT_LEAST);
    float distance0 = airlight_hypotenuse(nearest, before), sum0 = distance0 + abs(before);
    float s0 = ahead ? nearest * (nearest / sum0) : sum0, cut = s0 + AIRLIGHT_CUT / max(sigma, 1e-37);
    float last = 0.5 * (cut - nearest * (nearest / cut));
    float span = last < behind ? max(last - before, 0.0) : difference;
    behind = min(behind, last);
    // So that v stays below 21; what that moves is less than 1e-9 of the stretch, of a peaked phase function's 1e-9 over the peak's width.
    nearest = max(nearest, 1e-9 * max(abs(before), abs(behind)));
    span /= nearest;
    float u0 = min(abs(before), abs(behind)) / nearest, first = airlight_asinh(u0);
    float step = airlight_asinh_step(u0, u0 + span, span);
    float sum = 0.0;
    for (int i = 0; i < AIRLIGHT_NODES; i++) {
        float z = airlight_nodes[i].x, weight = airlight_nodes[i].y;
        float growing = exp(first + (1.0 - z) * step), shrinking = 1.0 / growing, both = growing + shrinking;
        float s = nearest * (ahead ? shrinking : growing);
        vec2 half_angle = (ahead ? vec2(shrinking, growing) : vec2(growing, shrinking)) / both;
        sum += weight * both * exp(-sigma * max(s - s0, 0.0)) * phase(half_angle);
    }
    return airlight_dimmed(0.5 * step * sum * (nearest / radius / radius), sigma * path);
}
//]

//[point
// ∫ ρ e^(-σ (t + r)) / max(r, radius)² dt over [from, to], 0 <= from <= to, which may be infinite.
float airlight_point(float nearest, float foot, float radius, float from, float to, float sigma)
{
    radius = max(radius, 1e-18);
    float half_chord = sqrt(max(radius - nearest, 0.0)) * sqrt(radius + nearest);
    float before = from - foot, behind = to - foot;
    bool held = nearest < radius;
    // Loops, since this renderer computes both sides of an if for all pixels, but ends a loop that no pixel needs.
    float sum = 0.0;
    for (int part = 0; part < (held ? 2 : 1); part++) {
        float a = held && part == 1 ? max(before, half_chord) : before;
        float b = held && part == 0 ? min(behind, -half_chord) : behind;
        bool whole = a == before && b == behind;
        if (whole ? from < to : a < b)
            sum += airlight_free(nearest, a, b, whole ? to - from : b - a, (a == before ? from : foot + a) + airlight_hypotenuse(nearest, a), sigma);
    }
    for (int part = 0; part < (held ? 2 : 0); part++) {
        float a = max(before, part == 0 ? -half_chord : 0.0), b = min(behind, part == 0 ? 0.0 : half_chord);
        bool whole = a == before && b == behind;
        if (whole ? from < to : a < b)
            sum += airlight_held(nearest, radius, a, b, whole ? to - from : b - a, (a == before ? from : foot + a) + airlight_hypotenuse(nearest, a), sigma);
    }
    return sum;
}
//]

//[vectors
// The light's distance from the line of a ray (unit direction), and the foot. The cross product loses no more than the problem does by itself: a light a
// thousand times nearer to the line than to the eye is known a thousand times worse.
void airlight_from_vectors(vec3 to_light, vec3 direction, out float nearest, out float foot)
{
    float scale = max(abs(to_light.x), max(abs(to_light.y), abs(to_light.z))); // so that no square over- or underflows
    nearest = scale > 0.0 ? scale * length(cross(to_light / scale, direction)) : 0.0;
    foot = dot(to_light, direction);
}
//]

//[directional
// ∫ e^(-σ t) dt over [from, to], which may be infinite where σ > 0.
float airlight_directional(float from, float to, float sigma)
{
    float thickness = sigma * (to - from);
    float share = thickness < 0.05 ? 1.0 - thickness * (0.5 - thickness * (1.0 / 6.0 - thickness / 24.0)) : (1.0 - exp(-thickness)) / thickness;
    float along = thickness > AIRLIGHT_CUT ? 1.0 / sigma : (to - from) * share;
    return exp(-sigma * from) * along;
}
//]

#endif
