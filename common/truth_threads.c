// truth: work on all cores.
#include "truth_internal.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

enum { MOST_THREADS = 256 };

void truth_run(void *(*work)(void *), void *shared, int threads)
{
    pthread_t others[MOST_THREADS];
    long wanted = threads > 0 ? threads : sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    // Where the system gives no more threads, those that there are do all the work.
    while (started < wanted - 1 && started < MOST_THREADS &&
           pthread_create(&others[started], NULL, work, shared) == 0)
        started++;
    work(shared);
    for (int i = 0; i < started; i++)
        pthread_join(others[i], NULL);
}

typedef struct Segments {
    const Truth *truth;
    const vec3 *from, *to;
    size_t count;
    uint32_t *bits;
    atomic_size_t next;
} Segments;

static void *occlude_some(void *shared)
{
    Segments *segments = shared;
    enum { PIECE = 2048 }; // whole words, so that no two threads write one
    for (;;) {
        size_t first = PIECE * atomic_fetch_add(&segments->next, 1);
        if (first >= segments->count)
            return NULL;
        size_t end = first + PIECE < segments->count ? first + PIECE : segments->count;
        for (size_t i = first; i < end; i++)
            if (truth_occluded(segments->truth, segments->from[i], segments->to[i]))
                segments->bits[i >> 5] |= UINT32_C(1) << (i & 31);
    }
}

uint32_t *truth_occluded_many(const Truth *truth, const vec3 *from, const vec3 *to, size_t count)
{
    Segments segments = {.truth = truth, .from = from, .to = to, .count = count};
    segments.bits = memory_new(count / 32 + 1, sizeof(uint32_t), "visibilities");
    truth_run(occlude_some, &segments, 0);
    return segments.bits;
}
