// 04 airlight: what takes long: the whole stability table, and random stretches by the thousand.
#include "airlight_bench.h"
#include "stability_table.h"

#include <unistd.h>

Test(airlight_slow, the_stability_table_passes)
{
    check_stability_table("04_airlight", "", 42 + 90);
}

Test(airlight_slow, eight_nodes_and_24)
{
    check_stiff("PHASE 0\nAIRLIGHT_NODES 8", &(TruthPhase){.name = "uniform"}, 5e-2);
    check_stiff("PHASE 0\nAIRLIGHT_NODES 24", &(TruthPhase){.name = "uniform"}, 3e-5);
    check_stiff("PHASE 2\nAIRLIGHT_NODES 16",
                &(TruthPhase){.name = "henyey_greenstein", .mean_cosine = (double)0.999f}, 1e-4);
}

// The search finds the same again, worst first, and what it finds are cases as the program takes them.
Test(airlight_slow, the_search_for_the_worst)
{
    const char *build = getenv("BUILD");
    char *command =
        text_format("cd /tmp && d=$(mktemp -d) && cd - >/dev/null && b=%s && $b/worst --views 20 --keep 2 "
                    ">$d/a && $b/worst --views 20 --keep 2 >$d/b && "
                    "cmp $d/a $d/b && [ $(grep -c '^{\"worst of' $d/a) -eq 18 ] && "
                    "$b/worst --views 20 --keep 2 --seed 2 >$d/b && ! cmp -s $d/a $d/b && "
                    "awk '{ if (NR %% 2 == 1 && NR > 1 && $NF + 0 > last) exit 1; last = $NF + 0 }' $d/a && "
                    "s=$(sed -n 's/.*\"worst of march, 1\", \"haze\", \"\\([^\"]*\\)\".*/--set \\1/p' $d/a | "
                    "sed 's/ / --set /2g') && "
                    "$b/04_airlight --scene haze --size 8x8 $s --out $d/x.exr && rm -r $d",
                    build ? build : "build");
    cr_assert_eq(system(command), 0, "%s", command);
    free(command);
}

static float power(double least, double most) // of ten, between these exponents
{
    return (float)pow(10.0, least + (most - least) * ((double)rand() / RAND_MAX));
}

// Drawn over the whole range that the stiff cases are taken from, every power of ten alike.
Test(airlight_slow, ten_thousand_random_stretches)
{
    enum { COUNT = 10000 };
    static PointCase cases[COUNT];
    const TruthPhase uniform = {.name = "uniform"};
    srand(11);
    for (int i = 0; i < COUNT; i++) {
        const float from = i % 2 ? 0.0f : power(-6, -0.01), to = i % 11 == 0 ? INFINITY : 1.0f;
        const float inside = from + power(-6, 0) * (1 - from);
        const float foot = i % 3 == 0 ? -power(-6, 6) : i % 3 == 1 ? power(-6, 6) : inside;
        cases[i] = (PointCase){power(-6, 6), foot, power(-9, -1), from, to, power(-6, 4)};
    }
    gl_open(GL_PLATFORM_OSMESA, 16, 16, "test");
    float *got = bench_run("point.comp", "PHASE 0", NULL, cases, sizeof *cases, COUNT, 2);
    size_t compared = 0;
    for (int i = 0; i < COUNT; i++) {
        const PointCase *c = &cases[i];
        const double expected = point_truth(c, &uniform);
        cr_assert(isfinite(got[2 * i]));
        compared += normal_float(expected);
        if (normal_float(expected))
            cr_assert(fabs((double)got[2 * i] - expected) <= 1e-4 * expected,
                      "%g for %g: nearest %g foot %g radius %g [%g, %g] sigma %g", (double)got[2 * i],
                      expected, (double)c->nearest, (double)c->foot, (double)c->radius, (double)c->from,
                      (double)c->to, (double)c->sigma);
    }
    cr_assert(compared > COUNT / 3, "%zu", compared);
    free(got);
    gl_close();
}
