// overlap: does a triangle touch the closed box of a voxel? Taught line by line in chapter 01.
// Schwarz and Seidel, "Fast parallel surface and solid voxelization on GPUs" (2010), section 4.1: the box reaches the triangle's
// plane from both sides, the two bounding boxes meet, and in each of the three projections the square reaches the inner
// side of each edge. Together these are the 13 separating axes of a box and a triangle.
//
// Each test has the form: value ≥ 0 where they touch. Touching in a point counts.
#ifndef OVERLAP_GLSL
#define OVERLAP_GLSL

//[exact
// The three corners and the box [low, low + size]³ in the same unit. In double, since a sign decides.
// Component k of a vec3 below belongs to the projection along axis k, onto the axes (k+1, k+2): .yzx and .zxy.
double overlap_edge(dvec3 from, dvec3 to, dvec3 inner, dvec3 low, double size)
{
    dvec3 a = -inner * (to - from).zxy, b = inner * (to - from).yzx; // the edge's normal, towards the triangle
    dvec3 value = a * (low - from).yzx + b * (low - from).zxy + size * (max(a, 0.0) + max(b, 0.0));
    return min(value.x, min(value.y, value.z));
}

// A triangle seen edge on has no inner side: either sign then tests both sides, as its edges run to and fro.
dvec3 overlap_inner(dvec3 normal)
{
    return mix(dvec3(1.0), dvec3(-1.0), lessThan(normal, dvec3(0.0)));
}

bool overlap_exact(dvec3 p0, dvec3 p1, dvec3 p2, dvec3 low, double size)
{
    dvec3 lower = min(p0, min(p1, p2)), upper = max(p0, max(p1, p2));
    if (any(greaterThan(lower, low + size)) || any(lessThan(upper, low)))
        return false;
    dvec3 normal = cross(p1 - p0, p2 - p0);
    double plane = dot(normal, low - p0);
    if (plane + size * dot(min(normal, 0.0), dvec3(1.0)) > 0.0 || plane + size * dot(max(normal, 0.0), dvec3(1.0)) < 0.0)
        return false;
    dvec3 inner = overlap_inner(normal);
    return min(overlap_edge(p0, p1, inner, low, size),
               min(overlap_edge(p1, p2, inner, low, size), overlap_edge(p2, p0, inner, low, size))) >= 0.0;
}
//]

//[filter
// The same in single precision, prepared once a triangle and then asked of many voxels. Voxels are counted from a voxel `base` near the triangle, and
// each test is scaled until its largest factor is 1, so that one bound on the rounding serves all.
struct Overlap {
    vec3 a[3], b[3], c[3]; // edge i in the three projections: a·v.yzx + b·v.zxy + c ≥ 0 for voxel v
    vec4 plane;            // |plane.xyz·v + plane.w| ≤ reach
    float reach, error;    // a value farther from 0 than `error` has the right sign
};

// An edge parallel to an axis adds nothing to the box's test in that projection.
void overlap_prepare_edge(inout Overlap tests, int i, dvec3 from, dvec3 edge, dvec3 inner)
{
    dvec3 a = -inner * edge.zxy, b = inner * edge.yzx, c = max(a, 0.0) + max(b, 0.0) - a * from.yzx - b * from.zxy;
    bvec3 parallel = equal(min(abs(a), abs(b)), dvec3(0.0));
    dvec3 scale = 1.0 / mix(max(abs(a), abs(b)), dvec3(1.0), parallel);
    tests.a[i] = mix(vec3(a * scale), vec3(0.0), parallel);
    tests.b[i] = mix(vec3(b * scale), vec3(0.0), parallel);
    tests.c[i] = mix(vec3(c * scale), vec3(1.0), parallel);
}

// With M = `extent` above every |coordinate| of v, plus 1, and u = 2^-24: a test is a sum of up to four terms, and where its sign is in doubt none is
// greater than 6M, so it is off by 64uM at most. The double precision before that adds less than 2^-30 of the farthest corner, but for
// the plane of a sliver, whose normal is the difference of nearly equal numbers: that test stays undecided.
const float ROUNDING = exp2(-18.0), ROUNDING_BEFORE = exp2(-30.0);
const double SLIVER = 1.0LF / 65536.0LF; // width to length

Overlap overlap_prepare(dvec3 p0, dvec3 p1, dvec3 p2, double size, dvec3 base, float extent)
{
    Overlap tests;
    dvec3 edge0 = (p1 - p0) / size, edge1 = (p2 - p1) / size, edge2 = (p0 - p2) / size, normal = cross(edge0, -edge2);
    dvec3 inner = overlap_inner(normal);
    p0 = p0 / size - base;
    overlap_prepare_edge(tests, 0, p0, edge0, inner);
    overlap_prepare_edge(tests, 1, p1 / size - base, edge1, inner);
    overlap_prepare_edge(tests, 2, p2 / size - base, edge2, inner);
    dvec3 far = abs(p0) + abs(edge0) + abs(edge2), box = max(abs(edge0), abs(edge2)), n = abs(normal);
    double largest = max(n.x, max(n.y, n.z)), length = max(box.x, max(box.y, box.z));
    normal = largest < SLIVER * length * length ? dvec3(0.0) : normal / largest;
    tests.plane = vec4(normal, 0.5 * (normal.x + normal.y + normal.z) - dot(normal, p0));
    tests.reach = float(0.5 * dot(abs(normal), dvec3(1.0)));
    if (any(equal(max(abs(edge0), max(abs(edge1), abs(edge2))), dvec3(0.0)))) {
        tests.plane = vec4(0.0); // flat: the box's test again
        tests.reach = 1.0;
    }
    tests.error = ROUNDING * extent + ROUNDING_BEFORE * float(max(far.x, max(far.y, far.z)));
    return tests;
}

// The least of all tests but the box's: above tests.error they touch, below its negative they do not.
float overlap_value(Overlap tests, vec3 voxel)
{
    vec3 edge = min(tests.a[0] * voxel.yzx + (tests.b[0] * voxel.zxy + tests.c[0]),
                    min(tests.a[1] * voxel.yzx + (tests.b[1] * voxel.zxy + tests.c[1]),
                        tests.a[2] * voxel.yzx + (tests.b[2] * voxel.zxy + tests.c[2])));
    float plane = tests.reach - abs(dot(tests.plane.xyz, voxel) + tests.plane.w);
    return min(plane, min(edge.x, min(edge.y, edge.z)));
}
//]

#endif
