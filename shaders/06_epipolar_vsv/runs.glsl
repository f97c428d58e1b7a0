// runs: airlight from a row of bits by the closed form of each lit run. Comes after common/airlight_ray.glsl, 06_epipolar_vsv/query.glsl and stretch.glsl.
#ifndef RUNS_GLSL
#define RUNS_GLSL

// How far along the ray a border between voxels lies; the outermost borders are the ends of the ray's stretch.
float border_along(Ray ray, Query query, int place)
{
    float along = clamp(epipolar_along(query.alpha, epipolar_phi_at(float(place))), ray.from, ray.to);
    return place <= query.first ? ray.from : place >= query.last ? ray.to : along;
}

//[runs
// The next voxel at or after `place` that is lit, or not; query.last where there is none. A word is looked at whole.
int next_voxel(Query query, Row row, int place, bool lit, inout uint fetches)
{
    int from = place;
#if EVERYTHING
    int last = epipolar_count.z; // also what lies behind the ray's end, for nothing
#else
    if (row.lit)
        return lit ? place : query.last;
    int last = query.last;
#endif
    bool found = place >= last;
    while (!found) {
        uint word = query_texel(row, place >> 7)[(place >> 5) & 3];
        fetches++;
        uint rest = (lit ? ~word : word) & (~0u << (place & 31));
        place = rest != 0u ? (place & ~31) + findLSB(rest) : (place & ~31) + 32;
        found = rest != 0u || place >= last;
    }
#if EVERYTHING
    place = row.lit ? lit ? from : query.last : place;
#endif
    return min(place, query.last);
}

vec3 integral_of(Ray ray, Query query, Row row, inout uint fetches)
{
    vec3 sum = vec3(0.0);
    int place = row.dark && EVERYTHING == 0 ? query.last : next_voxel(query, row, query.first, true, fetches);
    while (place < query.last) {
        int end = next_voxel(query, row, place, false, fetches);
        sum += stretch(ray, border_along(ray, query, place), border_along(ray, query, end));
        place = next_voxel(query, row, end, true, fetches);
    }
    return sum;
}
//]

#endif
