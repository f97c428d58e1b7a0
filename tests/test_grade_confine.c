// What confines a program that is not trusted: each limit is broken once, each way out tried once, with bubblewrap and without.
#include <criterion/criterion.h>

#include "grade/confine.h"

#include "base.h"
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Small, since the machine is shared: what is broken here is broken long before it hurts.
static const ConfineLimits SMALL = {.wall_seconds = 5,
                                    .cpu_seconds = 5,
                                    .memory_bytes = 100 << 20,
                                    .folder_bytes = 1 << 20,
                                    .folder_files = 50,
                                    .text_bytes = 4096,
                                    .process_count = 24};

static char folder[] = "/tmp/test_confine_XXXXXX";

static void open_folder(void)
{
    cr_assert(mkdtemp(folder));
    confine_folder(folder);
}

// Criterion does not count what fails here: each test asks for itself whether it left something.
static void close_folder(void)
{
    confine_folder_remove(folder);
}

static ConfineResult shell_within(const char *script, ConfineLimits limits)
{
    const char *const command[] = {"/bin/sh", "-c", script, NULL};
    return confine_run(&(Confine){.command = command, .folder = folder, .limits = limits});
}

static ConfineResult shell(const char *script)
{
    return shell_within(script, SMALL);
}

static void ends(const char *script, ConfineLimits limits, ConfineEnd end, int status, const char *said)
{
    ConfineResult result = shell_within(script, limits);
    char *sentence = confine_said(&result, &limits);
    cr_assert_eq(result.end, end, "%s: it %s", script, sentence);
    cr_assert_eq(result.status, status, "%s: it %s", script, sentence);
    cr_assert(strstr(sentence, said), "'%s' does not say '%s'", sentence, said);
    free(sentence);
    free(result.text);
}

static void prints(const char *script, const char *expected)
{
    ConfineResult result = shell(script);
    cr_assert_str_eq(result.text, expected, "%s", script);
    free(result.text);
}

// Each test twice: with bubblewrap where there is one, and with limits alone.
#define BOTH(name)                                                                                           \
    static void name(void);                                                                                  \
    Test(grade_confine, name##_wrapped, .init = open_folder, .fini = close_folder, .timeout = 60)            \
    {                                                                                                        \
        if (!confine_wrapped())                                                                              \
            cr_skip_test("bubblewrap does not work here");                                                   \
        name();                                                                                              \
    }                                                                                                        \
    Test(grade_confine, name##_limits_alone, .init = open_folder, .fini = close_folder, .timeout = 60)       \
    {                                                                                                        \
        confine_without_bubblewrap();                                                                        \
        name();                                                                                              \
    }                                                                                                        \
    static void name(void)

BOTH(causes_are_told_apart)
{
    ends("exit 0", SMALL, CONFINE_EXIT, 0, "exit status 0");
    ends("exit 3", SMALL, CONFINE_EXIT, 3, "exit status 3");
    ends("kill -SEGV $$", SMALL, CONFINE_SIGNAL, SIGSEGV, "Segmentation fault");
    ConfineLimits brief = SMALL;
    brief.wall_seconds = 0.3;
    ends("sleep 20", brief, CONFINE_WALL, 0, "within 0.3 s");
    ends("yes", SMALL, CONFINE_TEXT, 0, "printed more than 4 kB");
    ends("exec head -c 2000000 /dev/zero > big", SMALL, CONFINE_FOLDER, SIGXFSZ, "wrote more than 1 MB");
    ends("for i in 1 2 3 4; do head -c 500000 /dev/zero > big$i; done; sleep 5", SMALL, CONFINE_FOLDER, 0,
         "wrote more");
    ends("i=0; while :; do i=$((i+1)); : > file$i; done", SMALL, CONFINE_FOLDER, 0, "50 files");
}

BOTH(processor_time_is_limited)
{
    ConfineLimits brief = SMALL;
    brief.cpu_seconds = 1;
    brief.wall_seconds = 50; // a busy machine may give little of it
    ends("while :; do :; done", brief, CONFINE_CPU, SIGXCPU, "1 s of processor time");
}

BOTH(memory_is_limited_over_all_processes)
{
    ConfineLimits small = SMALL;
    small.memory_bytes = 40 << 20;
    ends("head -c 200000000 /dev/zero | tail", small, CONFINE_MEMORY, 0, "40 MB of memory");
    ends("for i in 1 2 3 4; do (head -c 20000000 /dev/zero; sleep 3) | tail & done; wait", small,
         CONFINE_MEMORY, 0, "40 MB");
    ends("head -c 1000000 /dev/zero | tail | head -c 0", small, CONFINE_EXIT, 0, "status 0");
}

BOTH(a_fork_bomb_ends)
{
    ConfineLimits brief = SMALL;
    brief.wall_seconds = 0.5;
    ConfineResult result = shell_within("bomb() { bomb | bomb & bomb; }; bomb", brief);
    cr_assert(result.end != CONFINE_NOT_RUN && result.seconds < 5, "end %d", result.end);
    cr_assert_eq(waitpid(-1, NULL, WNOHANG), -1, "a process is left");
    free(result.text);
}

BOTH(what_it_leaves_running_is_killed)
{
    // A session and group of its own, its parent gone: a process group's signal does not reach it.
    ConfineResult result = shell("(setsid sh -c 'trap \"\" TERM HUP; echo $$ > number; sleep 30' &) ; while "
                                 "! [ -s number ]; do :; done");
    cr_assert_eq(result.end, CONFINE_EXIT, "%s", result.text);
    cr_assert_lt(result.seconds, 4, "nobody waits for it");
    cr_assert_eq(waitpid(-1, NULL, WNOHANG), -1, "a process is left");
    free(result.text);
}

BOTH(nothing_is_inherited)
{
    setenv("SECRET", "42", 1);
    int leaked = dup2(0, 77);
    cr_assert_eq(leaked, 77);
    prints("echo ${SECRET-none}; ls /proc/self/fd | tr '\\n' ' '", "none\n0 1 2 3 "); // 3 is ls' own
    prints("cat; echo $PATH", "/usr/local/bin:/usr/bin:/bin\n");
    char *place = text_format("%s %s %s\n", folder, folder, folder);
    prints("echo $(pwd) $HOME $TMPDIR", place);
    free(place);
}

BOTH(outputs_are_read_without_following)
{
    ConfineResult result = shell(
        "printf 0123456789abcdef > whole; printf 0123 > brief; ln -s /etc/passwd link; ln whole second; "
        "mkdir folder; mkfifo pipe; printf 0123456789abcdef > alone; head -c 17 /dev/zero > long");
    cr_assert_eq(result.end, CONFINE_EXIT);
    cr_assert_eq(result.status, 0, "%s", result.text);
    free(result.text);
    const char *const wrong[][2] = {{"nowhere", "is missing"},       {"brief", "has 4 bytes, not 16"},
                                    {"link", "is a symbolic link"},  {"whole", "has another name"},
                                    {"folder", "is not a file"},     {"pipe", "is not a file"},
                                    {"long", "has 17 bytes, not 16"}};
    char *why;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        cr_assert_null(confine_read(folder, wrong[i][0], 16, &why));
        cr_assert(strstr(why, wrong[i][1]), "%s: %s", wrong[i][0], why);
        free(why);
    }
    char *data = confine_read(folder, "alone", 16, &why);
    cr_assert(data && !why && memcmp(data, "0123456789abcdef", 16) == 0);
    free(data);
}

BOTH(stubborn_folders_are_removed)
{
    // Deep, and closed to their owner; close_folder asks whether they are gone.
    ConfineResult result = shell("for i in $(seq 40); do mkdir d && cd d; done; mkdir shut; chmod 0 shut");
    cr_assert_eq(result.end, CONFINE_EXIT, "%s", result.text);
    confine_folder_remove(folder);
    cr_assert(access(folder, F_OK) != 0, "what a child leaves can be removed");
    free(result.text);
}

BOTH(a_program_that_is_not_there_is_not_its_own_fault)
{
    const char *const command[] = {"/usr/bin/no-such-program", NULL};
    ConfineResult result = confine_run(&(Confine){.command = command, .folder = folder, .limits = SMALL});
    char *sentence = confine_said(&result, &SMALL);
    cr_assert_eq(result.end, CONFINE_NOT_RUN);
    cr_assert(strstr(sentence, "no-such-program"), "%s", sentence);
    free(sentence);
    free(result.text);
}

Test(grade_confine, bubblewrap_shows_nothing_else, .init = open_folder, .fini = close_folder, .timeout = 60)
{
    if (!confine_wrapped())
        cr_skip_test("bubblewrap does not work here");
    prints("cat /etc/passwd 2>/dev/null || echo unseen", "unseen\n");
    prints("ls /home /root /tmp/.. 2>/dev/null | grep -cE 'home|root'", "0\n");
    prints("(: > /x || : > /dev/shm/x || : > /usr/x || : > /tmp/x) 2>/dev/null || echo unwritten",
           "unwritten\n");
    prints("ls /proc | grep -cE '^[0-9]+$' | awk '{ print $1 < 8 }'", "1\n");
    prints("cat /proc/net/dev | grep -c :", "1\n"); // the loopback
    prints("unshare -Ur true 2>/dev/null || echo alone",
           "alone\n"); // a name space of its own would be a place to fill
}

Test(grade_confine, it_reads_what_it_is_given, .init = open_folder, .fini = close_folder, .timeout = 60)
{
    char given[] = "/tmp/test_given_XXXXXX";
    cr_assert(mkdtemp(given));
    char *change = text_format("chmod 755 %s; echo given > %s/file", given, given);
    cr_assert_eq(system(change), 0);
    const char *const readable[] = {given, NULL}, *const environment[] = {"WORD=word", NULL};
    char *script = text_format("cat %s/file; echo $WORD; : > %s/file", given, given);
    const char *const command[] = {"/bin/sh", "-c", script, NULL};
    ConfineResult result = confine_run(&(Confine){.command = command,
                                                  .folder = folder,
                                                  .readable = readable,
                                                  .environment = environment,
                                                  .limits = SMALL});
    cr_assert_eq(strncmp(result.text, "given\nword\n", 11), 0, "%s", result.text);
    cr_assert(!confine_wrapped() || result.status != 0, "it is not to be written");
    confine_folder_remove(given);
    free(result.text);
    free(change);
    free(script);
}
