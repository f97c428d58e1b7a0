// run_plan: passes, what they cost and count, and --plan. While measuring, glFinish parts the passes: GL's own timers mean
// nothing on a software renderer.
#include "run_internal.h"
#include <stdlib.h>
#include <string.h>

// GL_ARB_pipeline_statistics_query (core in 4.6), for --plan where the renderer has it.
static const struct {
    GLenum target;
    const char *what;
} statistics[] = {{GL_FRAGMENT_SHADER_INVOCATIONS_ARB, "fragments"},
                  {GL_PRIMITIVES_SUBMITTED_ARB, "primitives"},
                  {GL_COMPUTE_SHADER_INVOCATIONS_ARB, "compute_invocations"}};
enum { STATISTICS = sizeof statistics / sizeof *statistics };

static void queries_open(Run *run)
{
    GLint extensions = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &extensions);
    for (GLint i = 0; i < extensions; ++i)
        if (strcmp((const char *)gl.GetStringi(GL_EXTENSIONS, (GLuint)i),
                   "GL_ARB_pipeline_statistics_query") == 0)
            gl.GenQueries(STATISTICS, run->queries); // Mesa 22.3 refuses these targets to CreateQueries
}

void run_plan_begin_frame(Run *run)
{
    if (run->plan && !run->queries[0])
        queries_open(run);
    run->pass_count = run->count_count = 0;
    run->pass_current = -1;
}

void run_plan_close(Run *run)
{
    if (run->queries[0])
        gl.DeleteQueries(STATISTICS, run->queries);
    free(run->counts);
    free(run->passes);
}

void run_plan_end_pass(Run *run)
{
    if (run->pass_current < 0)
        return;
    for (int q = 0; q < STATISTICS && run->queries[0]; ++q)
        gl.EndQuery(statistics[q].target);
    if (run->timing) {
        gl.Finish();
        run->passes[run->pass_current].ms += measure_now_ms() - run->pass_start_ms;
    }
    for (int q = 0; q < STATISTICS && run->queries[0]; ++q) {
        GLuint64 value = 0;
        gl.GetQueryObjectui64v(run->queries[q], GL_QUERY_RESULT, &value);
        if (value)
            run_count(run, statistics[q].what, (double)value);
    }
    run->pass_current = -1;
}

static bool pass_begin(Run *run, const char *name, bool common, bool needed, const char *reason)
{
    run_plan_end_pass(run);
    if (run->stopped)
        return false;
    size_t index = 0;
    while (index < run->pass_count && strcmp(run->passes[index].name, name) != 0)
        ++index;
    if (index == run->pass_count) {
        run->passes = memory_grow(run->passes, ++run->pass_count, sizeof *run->passes, "the passes");
        run->passes[index] = (RunPass){.name = name, .common = common};
    }
    RunPass *pass = &run->passes[index];
    if (!needed)
        pass->reason = reason ? reason : "not needed";
    if (!needed && !run->everything)
        return false;
    pass->ran = true;
    run->pass_current = (int)index;
    if (run->timing)
        gl.Finish();
    for (int q = 0; q < STATISTICS && run->queries[0]; ++q)
        gl.BeginQuery(statistics[q].target, run->queries[q]);
    run->pass_start_ms = measure_now_ms();
    return true;
}

// clang-format off
bool run_pass(Run *run, const char *name, bool needed, const char *reason) { return pass_begin(run, name, false, needed, reason); }
bool run_pass_common(Run *run, const char *name, bool needed, const char *reason) { return pass_begin(run, name, true, needed, reason); }
// clang-format on

void run_count(Run *run, const char *what, double count)
{
    if (run->pass_current < 0)
        return;
    if (!isfinite(count))
        fail_work("pass '%s': its count of %s is not a finite number", run->passes[run->pass_current].name,
                  what);
    size_t i = 0;
    while (i < run->count_count &&
           (run->counts[i].pass != run->pass_current || strcmp(run->counts[i].what, what) != 0))
        ++i;
    if (i == run->count_count) {
        run->counts = memory_grow(run->counts, ++run->count_count, sizeof *run->counts, "the counts");
        run->counts[i] = (RunCount){run->pass_current, what, 0};
    }
    run->counts[i].value += count;
}

void run_skipped(Run *run, double skipped, double of)
{
    if (run->pass_current < 0)
        return;
    run->passes[run->pass_current].skipped += skipped;
    run->passes[run->pass_current].of += of;
}

double run_plan_ms(const Run *run, bool with_common)
{
    double sum = 0;
    for (size_t i = 0; i < run->pass_count; ++i)
        sum += run->passes[i].common && !with_common ? 0 : run->passes[i].ms;
    return sum;
}

char *run_plan_text(const Run *run)
{
    char *text = NULL;
    size_t bytes = 0;
    FILE *to = open_memstream(&text, &bytes);
    fprintf(to, "%-36s %-4s %9s  %s\n", "pass", "ran", "ms", "left out, counts");
    for (size_t i = 0; i < run->pass_count; ++i) {
        const RunPass *pass = &run->passes[i];
        fprintf(to, "%-36s %-4s %9.3f ", pass->name, pass->ran ? "yes" : "no", pass->ms);
        if (pass->reason)
            fprintf(to, " [%s%s]", pass->ran ? "needless: " : "", pass->reason);
        if (pass->of > 0)
            fprintf(to, " %.15g of %.15g left out", pass->skipped, pass->of);
        for (size_t c = 0; c < run->count_count; ++c)
            if (run->counts[c].pass == (int)i)
                fprintf(to, " %s=%.15g", run->counts[c].what, run->counts[c].value);
        fputc('\n', to);
    }
    fprintf(to, "%-36s %-4s %9.3f\n", "all", "", run_plan_ms(run, true));
    fclose(to);
    return text;
}

// `before`, then the text as a JSON string, or null.
static void json_string(FILE *to, const char *before, const char *text)
{
    fprintf(to, "%s%s", before, text ? "\"" : "null");
    for (const char *c = text; c && *c; ++c)
        fprintf(to, (unsigned char)*c < 0x20 ? "\\u%04x" : *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
    fputs(text ? "\"" : "", to);
}

char *run_plan_json(const Run *run)
{
    char *text = NULL;
    size_t bytes = 0;
    FILE *to = open_memstream(&text, &bytes);
    json_string(to, "{\"chapter\": ", run->about->chapter);
    json_string(to, ", \"scene\": ", run->scene_name);
    fputs(", \"passes\": [", to);
    for (size_t i = 0; i < run->pass_count; ++i) {
        const RunPass *pass = &run->passes[i];
        json_string(to, i ? ",\n  {\"name\": " : "\n  {\"name\": ", pass->name);
        fprintf(to, ", \"ran\": %s, \"ms\": %.6f, \"skipped\": %.15g, \"of\": %.15g, \"counts\": {",
                pass->ran ? "true" : "false", pass->ms, pass->skipped, pass->of);
        const char *comma = "";
        for (size_t c = 0; c < run->count_count; ++c)
            if (run->counts[c].pass == (int)i) {
                json_string(to, comma, run->counts[c].what);
                fprintf(to, ": %.15g", run->counts[c].value);
                comma = ", ";
            }
        json_string(to, "}, \"reason\": ", pass->reason);
        fputs("}", to);
    }
    fprintf(to, "],\n \"total_ms\": %.6f}\n", run_plan_ms(run, true));
    fclose(to);
    return text;
}
