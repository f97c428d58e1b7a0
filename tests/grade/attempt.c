// attempt: see attempt.h.
#include "attempt.h"
#include "answers.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MEGABYTE = 1 << 20, WORDS_MOST = 200 };

// A compiler needs seconds; a program that has not ended in ten hangs. Sizes are many times what the course's own need.
static const ConfineLimits build_limits = {60, 60, 1024u * MEGABYTE, 64 * MEGABYTE, 64, 256 * 1024, 32};
static const ConfineLimits run_limits = {10, 20, 1024u * MEGABYTE, 16 * MEGABYTE, 64, 64 * 1024, 64};

// --- building

typedef struct Words {
    int count;
    char *list[WORDS_MOST + 1];
} Words;

// Takes `word` over.
static void add(Words *words, char *word)
{
    if (words->count == WORDS_MOST)
        fail_work("exercise_commands: more than %d words", WORDS_MOST);
    words->list[words->count++] = word;
}

// From `text`, a word a line, up to an empty line; `@` becomes `root`. Returns what follows.
static const char *add_lines(Words *words, const char *text, const char *root)
{
    while (*text && *text != '\n') {
        int length = (int)strcspn(text, "\n");
        const char *at = memchr(text, '@', (size_t)length);
        int before = at ? (int)(at - text) : length;
        add(words, at ? text_format("%.*s%s%.*s", before, text, root, length - before - 1, at + 1)
                      : text_format("%.*s", length, text));
        text += length + (text[length] == '\n');
    }
    return text + (*text == '\n');
}

// The compiler prints the files by the names that it is given; the reader's own begin in the working folder.
static void shorten(char *text, const char *folder)
{
    size_t length = strlen(folder);
    for (char *at = text; (at = strstr(at, folder));)
        if (at[length] == '/')
            memmove(at, at + length + 1, strlen(at + length + 1) + 1);
        else
            at++;
}

ConfineResult attempt_build(const Attempt *attempt, const char *const *flags)
{
    char *file = text_format("%s/exercise_commands", attempt->build), *text = file_read(file, NULL);
    if (!text)
        fail_work("%s: %s; make writes it", file, strerror(errno));
    const char *root = attempt->root;
    Words words = {0};
    add(&words, text_format("/usr/bin/env")); // finds the compiler
    const char *link = add_lines(&words, text, root);
    for (; flags && *flags; flags++)
        add(&words, text_format("%s", *flags));
    for (int i = 0; i < attempt->entry->file_count; i++) {
        const char *name = attempt->entry->files[i], *ending = strrchr(name, '.');
        if (!strcmp(ending, ".c"))
            add(&words, text_format("%s/%s/%s", attempt->tree, attempt->entry->folder, name));
    }
    char *library = text_format("%s/libexercise.a", attempt->build),
         *headers = text_format("%s/common", root);
    add(&words, text_format("%s", library));
    add_lines(&words, link, root);
    add(&words, text_format("-o"));
    add(&words, text_format("%s/program", attempt->folder));
    // Not the whole of root: a file of solutions/ is not to be included.
    const char *const readable[] = {headers, library, attempt->tree, NULL};
    ConfineResult result = confine_run(&(Confine){.command = (const char *const *)words.list,
                                                  .folder = attempt->folder,
                                                  .readable = readable,
                                                  .limits = build_limits});
    shorten(result.text, root);
    // Among what the program is given: one that deletes or replaces its own file would else look like a failure of the machine.
    char *made = text_format("%s/program", attempt->folder),
         *kept = text_format("%s/program", attempt->given);
    if (result.end == CONFINE_EXIT && result.status == 0 && rename(made, kept) != 0)
        fail_work("%s: %s", kept, strerror(errno));
    free(made);
    free(kept);
    for (int i = 0; i < words.count; i++)
        free(words.list[i]);
    free(headers);
    free(library);
    free(text);
    free(file);
    return result;
}

// --- running

// An answer counts beside a prediction, right or wrong: who has guessed first remembers what was measured.
static void answer(const Attempt *attempt, const Check *check, Outcome *outcome)
{
    double value = 0, guess = 0;
    char *file = text_format("%s/%s/%s", attempt->tree, attempt->entry->folder, attempt->entry->files[0]);
    char *predicted = text_format("predicted %s", check->name);
    if (answer_read(file, predicted, &guess, &outcome->why) &&
        answer_read(file, check->name, &value, &outcome->why)) {
        outcome->values = memory_new(1, sizeof(float), "answer");
        outcome->values[0] = (float)value;
        outcome->text = text_format("you predicted %.6g", guess);
    }
    free(predicted);
    free(file);
}

// What of this process's environment decides how GL works goes to the child, too.
static void gl_environment(const char *list[8], char *made[8])
{
    static const char *const names[] = {"HEADLESS", "LP_NUM_THREADS", "MESA_SHADER_CACHE_DIR"};
    int count = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (getenv(names[i]))
            list[count] = made[count] = text_format("%s=%s", names[i], getenv(names[i])), count++;
    // Built with sanitizers: what a driver leaks is not the program's fault.
    list[count] = made[count] = text_format("ASAN_OPTIONS=detect_leaks=0"), count++;
    list[count] = made[count] = NULL;
}

static void run_program(const Attempt *attempt, const Check *check, uint64_t seed, const char *root,
                        Outcome *outcome)
{
    char *program = text_format("%s/program", attempt->given), *out = text_format("%s.out", check->name);
    char *in = text_format("%s/%s.in", attempt->given, check->name);
    char *old = text_format("%s/%s", attempt->folder, out), *why = NULL;
    char *shaders = text_format("%s/shaders", root);
    confine_folder_remove(old); // whatever an earlier run has made of it
    outcome->input = input_make(attempt->entry, check, seed);
    input_write(&outcome->input, in);
    const char *environment[8];
    char *made[8];
    gl_environment(environment, made);
    ConfineResult result = confine_run(
        &(Confine){.command = (const char *const[]){program, in, out, NULL},
                   .folder = attempt->folder,
                   .readable = (const char *const[]){shaders, attempt->tree, attempt->given, NULL},
                   .environment = environment,
                   .limits = run_limits});
    outcome->text = result.text;
    shorten(outcome->text, root);
    outcome->seconds = result.seconds;
    outcome->end = result.end;
    outcome->machine_failed = result.end == CONFINE_NOT_RUN;
    if (result.end != CONFINE_EXIT || result.status != 0)
        outcome->why = confine_said(&result, &run_limits);
    else
        outcome->values = confine_read(attempt->folder, out, check_values(check) * sizeof(float), &why);
    if (why)
        outcome->why = text_format("its output %s", why);
    for (int i = 0; made[i]; i++)
        free(made[i]);
    free(why);
    free(old);
    free(shaders);
    free(in);
    free(out);
    free(program);
}

Outcome attempt_run(const Attempt *attempt, const Check *check, uint64_t seed)
{
    Outcome outcome = {0};
    if (attempt->entry->kind == EXERCISE_MEASURE)
        answer(attempt, check, &outcome);
    else
        run_program(attempt, check, seed, attempt->root, &outcome);
    if (outcome.why)
        shorten(outcome.why, attempt->root);
    return outcome;
}

void outcome_free(Outcome *outcome)
{
    free(outcome->values);
    free(outcome->why);
    free(outcome->text);
    input_free(&outcome->input);
    *outcome = (Outcome){0};
}
