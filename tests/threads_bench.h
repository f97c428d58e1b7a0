// threads_bench: what a test finds, hashed, on a given number of threads. llvmpipe reads LP_NUM_THREADS when a context is made: one process a count.
#ifndef THREADS_BENCH_H
#define THREADS_BENCH_H

#include "base.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

// `find` opens its own context and gets `what`; 0 says that there was too little to compare.
static inline uint64_t hash_with_threads(const char *threads, uint64_t (*find)(const char *what),
                                         const char *what)
{
    int ends[2];
    uint64_t hash = 0;
    cr_assert_eq(pipe(ends), 0, "no pipe");
    pid_t child = fork();
    if (child == 0) {
        setenv("LP_NUM_THREADS", threads, 1);
        hash = find(what);
        _exit(write(ends[1], &hash, sizeof hash) != sizeof hash);
    }
    close(ends[1]);
    cr_assert_eq(read(ends[0], &hash, sizeof hash), (ssize_t)sizeof hash, "%s threads: nothing came out",
                 threads);
    close(ends[0]);
    waitpid(child, NULL, 0);
    cr_assert(hash != 0, "%s threads: too little was found", threads);
    return hash;
}

#endif
