// program_plan: a chapter's program run as a user runs it, its plan and its picture; what is left out changes nothing. PROGRAM, defined before, is its name and the options
// that all runs have.
#ifndef PROGRAM_PLAN_H
#define PROGRAM_PLAN_H

#include "base.h"
#include "image.h"
#include "plan_lines.h"

#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct Outcome {
    int status;
    char *text; // what it said: the plan
    Image picture;
} Outcome;

static inline Outcome program(const char *arguments)
{
    const char *build = getenv("BUILD");
    char *out = text_format("/tmp/program-%d", (int)getpid());
    char *command = text_format("%s/" PROGRAM " --out %s.exr --plan %s >%s 2>&1", build ? build : "build",
                                out, arguments, out);
    char *picture = text_format("%s.exr", out);
    const int status = system(command);
    Outcome outcome = {.status = status >> 8, .text = file_read(out, NULL)};
    if (outcome.status == 0)
        outcome.picture = image_read(picture);
    unlink(out);
    unlink(picture);
    free(out);
    free(command);
    free(picture);
    return outcome;
}
static inline void outcome_free(Outcome *outcome)
{
    free(outcome->text);
    image_free(&outcome->picture);
}

static inline double count(const char *plan, const char *pass, const char *what)
{
    const char *line = line_of(plan, pass);
    cr_assert(line, "no pass '%s' in\n%s", pass, plan);
    const char *end = strchr(line, '\n'), *found = strstr(line, what);
    return found && (!end || found < end) ? atof(found + strlen(what)) : -1.0;
}

// The plans of three runs, for more to ask; the caller frees them.
typedef struct Plans {
    char *fires, *all, *beyond;
} Plans;
static inline void plans_free(Plans plans)
{
    free(plans.fires);
    free(plans.all);
    free(plans.beyond);
}
// Left out: the same picture with --everything, bit for bit, which does the passes (NULL ends them) all the same. Just beyond the rule: another picture.
static inline Plans check_left_out(const char *fires, const char *beyond, const char *const *passes)
{
    char *everything = text_format("%s --everything", fires);
    Outcome without = program(fires), with = program(everything), other = program(beyond);
    cr_assert(without.status == 0 && with.status == 0 && other.status == 0, "%s\n%s\n%s", without.text,
              with.text, other.text);
    for (; passes && *passes; passes++) {
        cr_assert(!ran(without.text, *passes) && ran(with.text, *passes) && ran(other.text, *passes),
                  "%s: %s", fires, *passes);
        if (strcmp(*passes, "clear") != 0) // clears a buffer: no invocation
            cr_assert(count(with.text, *passes, "compute_invocations=") > 0 ||
                          count(with.text, *passes, "fragments=") > 0,
                      "%s --everything does no %s", fires, *passes);
    }
    cr_assert_eq(image_compare(&without.picture, &with.picture).max_abs, 0.0,
                 "%s: --everything shows another picture", fires);
    cr_assert(image_compare(&without.picture, &other.picture).max_abs > 0.0, "%s: %s shows the same", fires,
              beyond);
    image_free(&without.picture);
    image_free(&with.picture);
    image_free(&other.picture);
    free(everything);
    return (Plans){without.text, with.text, other.text};
}

#endif
