// The running totals of beyond.glsl, one invocation a view ray α.
layout(local_size_x = 64) in;
#define EPIPOLE_AT_INFINITY 0
uniform vec3 extinction;
#define BEYOND_MAKE
#include "06_epipolar_vsv/beyond.glsl"

void main()
{
    int row = int(gl_GlobalInvocationID.x);
    if (row >= epipolar_count.x)
        return;
    float alpha = epipolar_alpha_at(float(row) + 0.5), step = beyond_step(row), from = epipolar_least.z + epipolar_span.z;
    Weight sum = Weight(0.0);
    for (int i = 0; i <= BEYOND_STEPS; i++) {
        beyond[row * (BEYOND_STEPS + 1) + i] = weight_store(sum);
        sum += weight_at(alpha, from + (float(i) + 0.5) * step) * step;
    }
}
