// What the fast and slow tests of chapter 02's program share: its plan, read.
#ifndef SHADOW_PLAN_H
#define SHADOW_PLAN_H

#include "image.h"
#include "plan_lines.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// What the program's plan says of its last frame; the picture stays in `picture` where that is given.
static inline char *plan_of(const char *arguments, const char *picture)
{
    const char *build = getenv("BUILD");
    char *out = text_format("/tmp/shadow-%d", (int)getpid()), *own = text_format("%s.exr", out);
    char *command = text_format("%s/02_shadow_maps --out %s --size 48x40 --plan %s >%s 2>&1",
                                build ? build : "build", picture ? picture : own, arguments, out);
    int status = system(command);
    char *plan = file_read(out, NULL);
    cr_assert_eq(status, 0, "%s: %s", command, plan);
    unlink(out);
    unlink(own);
    free(command);
    free(out);
    free(own);
    return plan;
}

// "… 3 of 6 left out": the 3.
static inline double left_out(const char *plan, const char *pass)
{
    const char *line = line_of(plan, pass), *end = line ? strchr(line, '\n') : NULL;
    cr_assert(line && end, "no pass '%s' in\n%s", pass, plan);
    for (const char *at = line; at < end; at++) {
        double skipped, of;
        if (sscanf(at, "%lf of %lf left out", &skipped, &of) == 2 && at[-1] == ' ')
            return skipped;
    }
    return -1;
}

// The pass's own "primitives=3": the 3; 0 where it did not run.
static inline double primitives(const char *plan, const char *pass)
{
    const char *line = line_of(plan, pass), *end = line ? strchr(line, '\n') : NULL,
               *at = line ? strstr(line, "primitives=") : NULL;
    return at && at < end ? atof(at + strlen("primitives=")) : 0;
}

// With and without --everything: the same numbers, and each pass of `passes` (NULL ends them) leaves something out, alone without it.
static inline void check_everything(const char *arguments, const char *const *passes)
{
    char *less = text_format("/tmp/less-%d.exr", (int)getpid()),
         *all = text_format("/tmp/all-%d.exr", (int)getpid());
    char *everything = text_format("%s --everything", arguments);
    char *plan = plan_of(arguments, less), *whole = plan_of(everything, all);
    for (; *passes; passes++) {
        const bool fewer = primitives(plan, *passes) < primitives(whole, *passes);
        cr_assert(!ran(plan, *passes) || left_out(plan, *passes) > 0 || fewer,
                  "%s: %s leaves out nothing\n%s", arguments, *passes, plan);
        cr_assert(ran(whole, *passes), "%s: %s does not run under --everything\n%s", arguments, *passes,
                  whole);
        if (ran(plan, *passes) && strcmp(*passes, "casters") == 0)
            cr_assert_eq(left_out(whole, *passes), 0, "%s", whole);
    }
    Image a = image_read(less), b = image_read(all);
    cr_assert(memcmp(a.pixels, b.pixels, sizeof(float) * (size_t)(a.width * a.height * a.channels)) == 0,
              "%s: the pictures differ", arguments);
    image_free(&a);
    image_free(&b);
    unlink(less);
    unlink(all);
    free(plan);
    free(whole);
    free(everything);
    free(less);
    free(all);
}
#define CHECK_EVERYTHING(arguments, ...) check_everything(arguments, (const char *const[]){__VA_ARGS__, NULL})

// What the plan of one run says of a pass.
static inline double left_out_by(const char *arguments, const char *pass)
{
    char *plan = plan_of(arguments, NULL);
    const double skipped = left_out(plan, pass);
    free(plan);
    return skipped;
}

// Each dependency of a map by itself.
typedef struct Dependency {
    const char *arguments;
    bool map, ask, reflective; // drawn, asked, drawn again in the last frame
} Dependency;
static inline void check_dependencies(const Dependency *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char *arguments = text_format("%s --set resolution=64 --set samples=4 --set reflective_resolution=16",
                                      cases[i].arguments);
        char *plan = plan_of(arguments, NULL);
        cr_expect_eq(ran(plan, "depth map"), cases[i].map, "%s: depth map\n%s", arguments, plan);
        cr_expect_eq(ran(plan, "bounce: ask"), cases[i].ask, "%s: ask\n%s", arguments, plan);
        cr_expect_eq(ran(plan, "reflective map"), cases[i].reflective, "%s: reflective map\n%s", arguments,
                     plan);
        free(plan);
        free(arguments);
    }
}

#endif
