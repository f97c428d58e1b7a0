// Airlight from the volume's bits by two fetches a view ray: what has been summed up to the word in which the ray ends, and that word. Between the grid's view
// rays it is interpolated (METHOD 1), or the nearest is taken (METHOD 0).
#define RAY_CONE (MAP_KIND == 1)
#include "common/airlight_ray.glsl"
#include "06_epipolar_vsv/query.glsl"
#include "06_epipolar_vsv/stretch.glsl"
layout(binding = 7, rgba32f) readonly uniform imageBuffer weights;
#include "06_epipolar_vsv/bytes.glsl"
#include "06_epipolar_vsv/beyond.glsl"
layout(binding = 5, r32ui) readonly uniform uimageBuffer words;
#if GREY
layout(binding = 6, r32f) readonly uniform imageBuffer prefixes;
#else
layout(binding = 6, rgba32f) readonly uniform imageBuffer prefixes;
#endif

// ANY_RAY 0: every ray ends in the grid and passes outside the light's radius. This renderer computes both sides of an if.
#define NEAREST 0
#define LINEAR 1
#if METHOD == LINEAR
const int SIDES = 2; // of the pixel's view ray, along each axis
#else
const int SIDES = 1;
#endif

// The view rays of the grid about the pixel's, and how much each counts.
struct Corners {
    int alpha[SIDES], row[SIDES]; // row: the first word of its slice's row in the plane α = 0
    float nearer[SIDES], share[SIDES];
};

//[corners
Corners corners_of(vec2 place) // (α, θ)
{
    Corners corners;
#if METHOD == LINEAR
    Between rows = query_between(place);
    corners.alpha = int[2](rows.least.x, rows.most.x);
    corners.row = int[2](epipolar_column(rows.least.y, 0), epipolar_column(rows.most.y, 0));
    corners.nearer = float[2](1.0 - rows.beyond.x, rows.beyond.x);
    corners.share = float[2](1.0 - rows.beyond.y, rows.beyond.y);
#else
    ivec2 row = clamp(ivec2(place), ivec2(0), epipolar_count.xy - 1);
    corners.alpha[0] = row.x;
    corners.row[0] = epipolar_column(row.y, 0);
    corners.nearer[0] = corners.share[0] = 1.0;
#endif
    return corners;
}
//]

//[reached
// ∫ V ρ e^(-σ (t + r)) dφ from where the grid begins up to φ.
Weight reached(Corners corners, float phi)
{
    float place = clamp(epipolar_phi_place(phi), 0.0, float(epipolar_count.z));
    int word = min(int(place) >> 5, epipolar_row_words() - 1);
    float start = float(32 * word), into = place - start; // 0 … 32 bits of the last word
    int whole = min(int(into), 31);
    float part = into - float(whole); // of bit number `whole`
    // A voxel stands for its middle: where that lies beyond the end, perhaps inside what ends the ray, the one before speaks for the part.
    int speaks = part < 0.5 ? max(whole - 1, 0) : whole;
    uint before = (1u << whole) - 1u;
    Weight sum = Weight(0.0);
    for (int i = 0; i < SIDES; i++) {
        int first = corners.alpha[i] * epipolar_columns() + word;
        vec4 lit = vec4(0.0);
        Weight total = Weight(0.0);
        for (int k = 0; k < SIDES; k++) {
            uint bits = ~imageLoad(words, first + corners.row[k]).x;
            // Byte by byte: behind a lamp the way by which light is dimmed grows fast with φ, and so weights differ within a word.
            vec4 counts = byte_counts(bits & before);
            counts[whole >> 3] += part * float((bits >> speaks) & 1u);
            lit += corners.share[k] * counts;
            total += corners.share[k] * weight_load(imageLoad(prefixes, first + corners.row[k]));
        }
        sum += corners.nearer[i] * (total + weighted(lit, corners.alpha[i] * epipolar_row_words() + word));
#if ANY_RAY && MAP_KIND != DIRECTIONAL
        sum += corners.nearer[i] * beyond_grid(corners.alpha[i], phi);
#endif
    }
    return sum;
}
//]

#if ANY_RAY && MAP_KIND != DIRECTIONAL
//[inverse_distance
// 1/D; for a ray through the light's radius, where the inverse square is held, what stands for it: ∫ dt / max(r, r0)² over Δφ.
float inverse_distance(Ray ray, float turned)
{
    float half_chord = sqrt(max(light_radius - ray.nearest, 0.0)) * sqrt(light_radius + ray.nearest);
    float a = clamp(ray.from - ray.foot, -half_chord, half_chord), b = clamp(ray.to - ray.foot, -half_chord, half_chord);
    float inside = atan(ray.nearest * (b - a), ray.nearest * ray.nearest + a * b);
    float held = ((b - a) / light_radius / light_radius + max(turned - inside, 0.0) / ray.nearest) / max(turned, 1e-30);
    return ray.nearest < light_radius ? held : 1.0 / ray.nearest;
}
//]
#endif

void main()
{
    airlight = vec4(0.0);
    ivec2 pixel = RAY_PIXEL;
#if MAP_KIND == DIRECTIONAL
    Ray ray = ray_of(pixel);
#else
    Ray ray = ray_to_surface(ray_direction(pixel), imageLoad(distances, pixel).x);
#endif
    if (!ray_needed(pixel, ray))
        return;
    vec3 epipolar = to_epipolar(ray.direction);
    vec2 alpha = vec2(length(cross(epipolar_axis, ray.direction)), dot(epipolar_axis, ray.direction));
    float phi = epipolar_phi(alpha, ray.to), turned = phi;
    Corners corners = corners_of(vec2(epipolar_alpha_place(epipolar.x), epipolar_theta_place(epipolar.y)));
    Weight sum = reached(corners, phi);
    vec3 rest = vec3(0.0);
#if RAY_CONE
    float from = ray.from > 0.0 ? epipolar_phi(alpha, ray.from) : 0.0; // a cone's border
    sum -= reached(corners, from);
    turned -= from;
#endif
#if ANY_RAY && MAP_KIND == DIRECTIONAL
    // No occluder reaches beyond the grid: there all is lit.
    float most = epipolar_least.z + epipolar_span.z, border = clamp(epipolar_along(alpha, most), ray.from, ray.to);
    rest = stretch(ray, phi > most * (1.0 + 1e-5) ? border : ray.to, ray.to);
#endif
#if ANY_RAY && MAP_KIND != DIRECTIONAL
    sum *= inverse_distance(ray, turned);
#elif MAP_KIND != DIRECTIONAL
    sum /= ray.nearest;
#endif
    ray_store(pixel, ray, vec3(sum) + rest, 3u * uint(SIDES * SIDES));
}
