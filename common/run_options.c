// run_options: the command line. Every wrong request is one line, so argp's own messages are off (ARGP_NO_ERRS).
#include "run_internal.h"
#include <argp.h>
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// The keys begin above every character, so no option has a short form: those that keep their text, those that are set, and the others.
enum { SCENE = 256, OUT, TRUTH, SWEEP, STABILITY, SHADERS };
enum { WINDOW = SHADERS + 1, PLAN, JSON, EVERYTHING, LIST, HELP };
enum { SIZE = HELP + 1, STEP, SET, FRAMES, SEED, PATH, ROW };
enum { SIZE_MOST = 16384 };     // GL 4.5 promises textures of this side
enum { FRAMES_MOST = 1000000 }; // 4.6 hours at 1/60 s
enum { ROWS_MOST = 1000000 };

// clang-format off
static const struct argp_option options[] = {
    {"scene", SCENE, "NAME|FILE", 0, "a built-in scene or a model file; a table runs only its rows of that scene", 0},
    {"size", SIZE, "WxH", 0, "picture size, 512x512 where not given, at most 16384x16384", 0},
    {"step", STEP, "N|NAME", 0, "stop the lesson at that point and show its picture (default: the last)", 0},
    {"set", SET, "KEY=VALUE", 0, "a number, a vector x,y,z or a name; repeatable. A table leaves out the rows that set KEY otherwise", 0},
    {"out", OUT, "FILE", 0, "write the last picture (.exr linear, .png display) and exit; name%04d.png writes every frame", 0},
    {"window", WINDOW, NULL, 0, "open a window: the default where there is a display and nothing is to be written", 0},
    {"truth", TRUTH, "FILE", 0, "write the truth for the same view (.exr, .png)", 0},
    {"sweep", SWEEP, "FILE.csv", 0, "write error against run time", 0},
    {"stability", STABILITY, "FILE.csv", 0, "write the stiff and extreme cases; goes with --sweep, which runs first", 0},
    {"row", ROW, "N|NAME,...", 0, "with --sweep or --stability: that row alone, as --list numbers them, or all rows of these names", 0},
    {"plan", PLAN, NULL, 0, "print which passes ran, their ms and counts, what was left out and why", 0},
    {"json", JSON, NULL, 0, "with --plan: as JSON", 0},
    {"everything", EVERYTHING, NULL, 0, "leave nothing out", 0},
    {"shaders", SHADERS, "DIR", 0, "look for shaders there first", 0},
    {"list", LIST, NULL, 0, "list scenes, steps, parameters and the tables' rows, tabs between the fields", 0},
    {"frames", FRAMES, "N", 0, "so many frames at 1/60 s (default: 1; 16 along --path; a window runs until closed)", 0},
    {"seed", SEED, "N", 0, "what is random is drawn from it (default: 1)", 0},
    {"path", PATH, "subpixel|orbit|light|deform", 0, "what moves over the frames; with --sweep it adds the metric flicker", 0},
    {"help", HELP, NULL, 0, "this text", 0},
    {0}};
// clang-format on

static uint64_t whole_parse(const char *option, const char *text, uint64_t least, uint64_t most)
{
    errno = 0;
    char *end = NULL;
    uint64_t value = isdigit((unsigned char)*text) ? strtoull(text, &end, 10) : 0;
    if (!end || *end || errno || value < least || value > most)
        fail_request("%s %s: a whole number from %llu to %llu is needed", option, text,
                     (unsigned long long)least, (unsigned long long)most);
    return value;
}

void run_size_parse(const char *option, const char *text, int *width, int *height)
{
    char *end = NULL;
    unsigned long w = isdigit((unsigned char)*text) ? strtoul(text, &end, 10) : 0, h = 0;
    if (end && *end == 'x' && isdigit((unsigned char)end[1]))
        h = strtoul(end + 1, &end, 10);
    if (!end || *end || w < 1 || h < 1 || w > SIZE_MOST || h > SIZE_MOST)
        fail_request("%s %s: WIDTHxHEIGHT is needed, each a whole number from 1 to %d, as 512x512", option,
                     text, SIZE_MOST);
    *width = (int)w;
    *height = (int)h;
}

static void step_parse(Run *run, const char *text)
{
    char *names = run_names_join(run->about->steps, sizeof(RunStep)), *end = NULL;
    long number = strtol(text, &end, 10);
    run->step_given = true;
    run->step_wanted =
        !*end && number > 0 && number <= run->step_count ? (int)number - 1 : run_word_find(names, text);
    if (run->step_wanted < 0)
        fail_request("--step %s: no such step; 1 to %d or one of:%s", text, run->step_count, names);
    free(names);
}

static void scene_check(const Run *run, const char *name)
{
    char *own = run_names_join(run->about->own_scenes, sizeof(SceneKind)),
         *all = run_names_join(scene_kinds, sizeof(SceneKind));
    bool file = strchr(name, '.') || strchr(name, '/'); // scene_open judges it
    if (!file && run_word_find(own, name) < 0 && run_word_find(all, name) < 0)
        fail_request("--scene %s: no such scene; a file with its ending, or one of:%s%s", name, own, all);
    free(own);
    free(all);
}

// Levenshtein (1966), one row at a time.
static size_t edit_distance(const char *a, const char *b)
{
    size_t length = strlen(b), *row = memory_new(length + 1, sizeof *row, "an edit distance");
    for (size_t j = 0; j <= length; ++j)
        row[j] = j;
    for (size_t i = 1; a[i - 1]; ++i)
        for (size_t j = 1, diagonal = row[0]++; j <= length; ++j) {
            size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = 1 + (row[j] < row[j - 1] ? row[j] : row[j - 1]);
            row[j] = replaced < row[j] ? replaced : row[j];
        }
    size_t distance = row[length];
    free(row);
    return distance;
}

// getopt stops after the word that is wrong, but at it where short options are given together (-xy): `word` is then right, and `next` is not.
BASE_NORETURN static void option_refuse(const char *word, const char *next)
{
    word = *word == '-' || !next ? word : next;
    size_t least = SIZE_MAX, dashes = strspn(word, "-");
    char *name = text_format("%.*s", (int)strcspn(word + dashes, "="), word + dashes);
    const struct argp_option *nearest = options;
    for (const struct argp_option *option = options; option->name; ++option) {
        size_t distance =
            dashes == 2 && strcmp(option->name, name) == 0 ? 0 : 1 + edit_distance(name, option->name);
        if (distance < least) {
            least = distance;
            nearest = option;
        }
    }
    if (least)
        fail_request("%s: no such option; the nearest is --%s, --help lists all", word, nearest->name);
    if (nearest->arg && !strchr(word, '='))
        fail_request("--%s: a value is needed, as --%s %s", name, name, nearest->arg);
    if (!nearest->arg && strchr(word, '='))
        fail_request("%s: --%s takes no value", word, name);
    if (next && word != next)
        option_refuse(next, next);
    fail_request("%s: not understood; --help lists all options", word);
}

static error_t take(int key, char *text, struct argp_state *state)
{
    Run *run = state->input;
    const char **texts[] = {&run->scene_given, &run->out,       &run->truth,
                            &run->sweep,       &run->stability, &run->shaders};
    bool *flags[] = {&run->window, &run->plan, &run->json, &run->everything, &run->list, &run->help};
    if (key >= SCENE && key <= SHADERS) {
        *texts[key - SCENE] = text;
    } else if (key >= WINDOW && key <= HELP) {
        *flags[key - WINDOW] = true;
    } else if (key == SIZE) {
        run_size_parse("--size", text, &run->width, &run->height);
    } else if (key == STEP) {
        step_parse(run, text);
    } else if (key == SET) {
        char *name = text_format("%.*s", (int)strcspn(text, "="), text);
        if (!strchr(text, '='))
            fail_request("--set %s: KEY=VALUE is needed; --list names the keys", text);
        run_value_parse(run, run->asked, "--set", name, strchr(text, '=') + 1);
        free(name);
    } else if (key == FRAMES) {
        run->frames = (int)whole_parse("--frames", text, 1, FRAMES_MOST);
    } else if (key == SEED) {
        run->seed = whole_parse("--seed", text, 0, UINT64_MAX);
    } else if (key == ROW) {
        run->row = isalpha((unsigned char)*text) ? 0 : (int)whole_parse("--row", text, 1, ROWS_MOST);
        run->row_names = run->row ? NULL : text;
    } else if (key == PATH) {
        run->path = (RunPath)(1 + run_word_find("subpixel orbit light deform", text));
        if (run->path == RUN_STILL)
            fail_request("--path %s: not one of: subpixel orbit light deform", text);
    } else if (key == ARGP_KEY_ARG) {
        fail_request("%s: not an option, they begin with --; --help lists them", text);
    } else if (key == ARGP_KEY_ERROR) {
        option_refuse(state->argv[state->next - 1], state->argv[state->next]);
    } else {
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static void list_print(const Run *run)
{
    const RunAbout *about = run->about;
    printf("chapter\t%s\t%s\n", about->chapter, about->title);
    for (const char *const *name = about->scenes; *name; ++name)
        printf("default\t%s\n", *name);
    const SceneKind *lists[] = {about->own_scenes, scene_kinds};
    for (int i = 0; i < 2; ++i)
        for (const SceneKind *kind = lists[i]; kind && kind->name; ++kind)
            printf("scene\t%s\t%s\n", kind->name, kind->shows);
    for (int i = 0; i < run->step_count; ++i)
        printf("step\t%d\t%s\t%s\n", i + 1, about->steps[i].name, about->steps[i].shows);
    for (size_t i = 0; i < run->parameter_count; ++i) {
        const RunParameter *p = &run->parameters[i];
        RunValue initial = {.number = {p->initial[0], p->initial[1], p->initial[2]}};
        char *range = p->kind == RUN_CHOICE
                          ? text_format("%s", p->choices)
                          : text_format("%s%g..%g%s%s", p->kind == RUN_VECTOR ? "x,y,z " : "", p->least,
                                        p->most, p->unit ? " " : "", p->unit ? p->unit : "");
        char *text = run_parameter_of_scene(run, i) ? text_format("scene") : run_value_text(run, i, &initial);
        printf("parameter\t%s\t%s\t%s\t%s\n", p->name, range, text, p->shows);
        free(range);
        free(text);
    }
    const struct {
        const char *kind;
        const RunRow *rows;
    } tables[] = {{"sweep", about->sweep}, {"stability", about->stability}};
    for (int i = 0; i < 2; ++i)
        for (const RunRow *row = tables[i].rows; row && row->name; ++row)
            printf("%s\t%td\t%s\t%s\t%s\t%s\n", tables[i].kind, row - tables[i].rows + 1, row->name,
                   row->scene ? row->scene : "-", row->settings && *row->settings ? row->settings : "-",
                   row->size ? row->size : "-");
}

// What does not go together. Two outputs to one file would leave the later one only.
static void together_check(const Run *run)
{
    bool table = run->sweep || run->stability, row = run->row || run->row_names;
    bool turns = run->path == RUN_SUBPIXEL || run->path == RUN_ORBIT;
    unsigned uses = run->about->uses;
    // clang-format off
    const struct { bool given; const char *text; } wrong[] = {
        {run->json && !run->plan, "--json: goes with --plan only"},
        {table && run->window, "--window: does not go with --sweep or --stability, which show nothing"},
        {table && run->out, "--out: does not go with --sweep or --stability, which write tables"},
        {table && run->truth, "--truth: does not go with --sweep or --stability, which write tables"},
        {table && run->plan, "--plan: does not go with --sweep or --stability; give one setting by --set"},
        {table && run->step_given, "--step: does not go with --sweep or --stability, which run every pass"},
        {run->window && run->truth, "--truth: does not go with --window; use --out beside it"},
        {run->window && run->plan, "--plan: does not go with --window, which has a key for it"},
        {row && run->sweep && run->stability, "--row: names a row of --sweep or of --stability; give one of them"},
        {row && !table, "--row: goes with --sweep or --stability only"},
        {table && run->frames && !run->path, "--frames: with --sweep it needs --path"},
        {run->sweep && run->path && run->frames == 1, "--frames 1: flicker along --path needs 2 frames or more"},
        {run->stability && run->path, "--path: does not go with --stability, whose cases are single pictures"},
        {run->sweep && !run->about->sweep, "--sweep: this chapter has no sweep"},
        {run->stability && !run->about->stability, "--stability: this chapter has no stability table"},
        {turns && !(uses & RUN_USES_CAMERA), "--path: this chapter has no camera that could move"},
        {run->path == RUN_LIGHT && !(uses & RUN_USES_LIGHT), "--path light: this chapter has no light"},
        {run->path == RUN_DEFORM && !(uses & RUN_USES_DEFORM), "--path deform: nothing deforms in this chapter"},
    };
    // clang-format on
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i)
        if (wrong[i].given)
            fail_request("%s", wrong[i].text);
    if (run->sweep && run->stability && strcmp(run->sweep, run->stability) == 0)
        fail_request("--stability %s: --sweep goes to the same file", run->stability);
    if (run->out && run->truth && strcmp(run->out, run->truth) == 0)
        fail_request("--truth %s: --out goes to the same file", run->truth);
}

void run_options_parse(Run *run, int argc, char **argv)
{
    static const struct argp argp = {.options = options, .parser = take};
    while (run->about->steps && run->about->steps[run->step_count].name)
        ++run->step_count;
    run->step_wanted = run->step_count - 1;
    // getopt moves the words of argv about; those are left as they were, for the machine line.
    char **words = memory_new((size_t)argc + 1, sizeof *words, "the command line");
    memcpy(words, argv, (size_t)argc * sizeof *words);
    argp_parse(&argp, argc, words, ARGP_NO_ERRS | ARGP_NO_HELP | ARGP_NO_EXIT, NULL, run);
    free(words);
    if (run->help) {
        printf("%s: %s\n%s\nSource: %s\n", run->about->chapter, run->about->title, run->about->shows,
               run->about->source);
        argp_help(&argp, stdout, ARGP_HELP_LONG | ARGP_HELP_USAGE, program_invocation_short_name);
    }
    if (run->help || run->list) {
        list_print(run);
        run_stdout_flush();
        exit(0);
    }
    if (run->scene_given)
        scene_check(run, run->scene_given);
    together_check(run);
    bool writes = run->out || run->truth || run->sweep || run->stability || run->plan;
    if (!writes && !run->window && !(run->window = gl_display_present())) {
        run->out = run->out_made = text_format("out/%s.png", run->about->chapter);
        folder_make("out");
        note("no display: the picture goes to %s; --help lists what else there is", run->out);
    }
    struct stat is;
    if (run->shaders && (stat(run->shaders, &is) || !S_ISDIR(is.st_mode)))
        fail_request("--shaders %s: no such folder", run->shaders);
    // What cannot be written is found before the work; these temporary names go when the program ends.
    const char *option[] = {"--out", "--truth"};
    char *path[] = {run->out ? run_out_path(run, 0) : NULL,
                    run->truth ? text_format("%s", run->truth) : NULL};
    for (int i = 0; i < 2; free(path[i++]))
        if (path[i]) {
            image_path_check(option[i], path[i]);
            file_begin(path[i]);
        }
}
