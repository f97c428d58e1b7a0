// Weights of the grid's φ along each of its view rays α, eight neighbours (a byte of the volume) together: the integrals of weight_at over them.
layout(local_size_x = 64) in;
#define EPIPOLE_AT_INFINITY (MAP_KIND == 2)
uniform vec3 extinction;
#include "06_epipolar_vsv/weight.glsl"
#if GREY
layout(std430, binding = 6) writeonly buffer Weights { float weights[]; };
#else
layout(std430, binding = 6) writeonly buffer Weights { vec4 weights[]; };
#endif

const int SAMPLES = 4; // a byte, by the midpoint rule

//[weights
void main()
{
    ivec2 byte = ivec2(gl_GlobalInvocationID.xy); // (of φ, α)
    int bytes = epipolar_count.z / 8;
    if (byte.x >= bytes || byte.y >= epipolar_count.x)
        return;
    float alpha = epipolar_alpha_at(float(byte.y) + 0.5);
    Weight sum = Weight(0.0);
    for (int k = 0; k < SAMPLES; k++) {
        float place = 8.0 * (float(byte.x) + float(k) / float(SAMPLES)), next = place + 8.0 / float(SAMPLES);
        sum += weight_at(alpha, epipolar_phi_at(0.5 * (place + next))) * (epipolar_phi_at(next) - epipolar_phi_at(place));
    }
    weights[byte.y * bytes + byte.x] = weight_store(sum);
}
//]
