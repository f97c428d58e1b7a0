// lanes: 16 floats at a time, as Embree's packets hold them, by compiler extensions. In a mask -1 is true, 0 false.
#ifndef LANES_H
#define LANES_H

#include <stdbool.h>
#include <stdint.h>

enum { LANES = 16 };
typedef float lanes __attribute__((vector_size(64)));
typedef int32_t mask __attribute__((vector_size(64)));
typedef struct lanes3 {
    lanes x, y, z;
} lanes3;

static inline lanes lanes_all(float value)
{
    return value - (lanes){0};
}
static inline lanes lanes_choose(mask which, lanes yes, lanes no)
{
    return (lanes)((which & (mask)yes) | (~which & (mask)no));
}
static inline bool lanes_any(mask m)
{
    int32_t some = 0;
    for (int i = 0; i < LANES; i++)
        some |= m[i];
    return some != 0;
}

// e^x for x <= 0: 2^n · 2^f with f in [-1/2, 1/2], whose polynomial (Taylor's in f ln 2) is good to 2e-7.
static inline lanes lanes_exp(lanes x)
{
    const lanes magic = lanes_all(12582912.0f); // 1.5 · 2^23: adding it rounds to a whole number
    x *= 1.44269504f;
    x = lanes_choose(x > lanes_all(-126.0f), x, lanes_all(-126.0f));
    const lanes whole = (x + magic) - magic;
    const lanes f = (x - whole) * 0.693147181f;
    const lanes p =
        1.0f +
        f * (1.0f + f * (0.5f + f * (1.66666667e-1f +
                                     f * (4.16666667e-2f + f * (8.33333333e-3f + f * 1.38888889e-3f)))));
    const mask exponent = __builtin_convertvector(whole, mask);
    return p * (lanes)((exponent + 127) << 23);
}

static inline int lanes_count(mask m)
{
    int count = 0;
    for (int i = 0; i < LANES; i++)
        count -= m[i];
    return count;
}

#endif
