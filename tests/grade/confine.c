// confine: see confine.h.
#include "confine.h"
#include "confine_parts.h"

#include "base.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { WATCH_MILLISECONDS = 10, STATUS_BYTES = 1024 };

typedef enum Wrapping { WRAPPING_UNKNOWN, WRAPPING_WORKS, WRAPPING_NOT } Wrapping;
static Wrapping wrapping; // tried once a process: it says something of the machine, not of a run

static double now_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct Child {
    pid_t process;
    int text, status;          // read ends
    char state[STATUS_BYTES];  // bubblewrap's JSON lines
    char failed[STATUS_BYTES]; // why it could not begin
    char *said;
    size_t said_bytes, state_bytes;
} Child;

// Append what has come, up to `most` bytes in all.
static void take(int from, char *text, size_t most, size_t *bytes)
{
    for (ssize_t got; *bytes < most && (got = read(from, text + *bytes, most - *bytes)) > 0;)
        *bytes += (size_t)got;
}

static void drain(Child *child, size_t most)
{
    take(child->text, child->said, most + 1,
         &child->said_bytes); // one byte too many tells that it printed too much
    take(child->status, child->state, sizeof child->state - 1, &child->state_bytes);
}

static Child start(const Confine *confine, bool wrapped)
{
    int text[2], status[2], begun[2];
    if (pipe2(text, O_CLOEXEC) != 0 || pipe2(status, O_CLOEXEC) != 0 || pipe2(begun, O_CLOEXEC) != 0)
        fail_work("confine: no pipe: %s", strerror(errno));
    fcntl(text[0], F_SETFL, O_NONBLOCK);
    fcntl(status[0], F_SETFL, O_NONBLOCK);
    // What the child leaves behind becomes this process's child, and is found there.
    prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
    uid_t user = confine_user();
    fflush(NULL);
    Child child = {.text = text[0], .status = status[0], .process = fork()};
    if (child.process == 0)
        confine_become(confine, &(ConfineSeat){wrapped, user, text[1], status[1], begun[1]});
    close(text[1]);
    close(status[1]);
    close(begun[1]);
    child.said = memory_new(confine->limits.text_bytes + 2, 1, "what a program prints");
    // Until it is another program its memory is a copy of this one's, which is not to be counted.
    size_t bytes = 0;
    take(begun[0], child.failed, sizeof child.failed - 1, &bytes);
    close(begun[0]);
    if (child.process < 0)
        snprintf(child.failed, sizeof child.failed, "no process: %s", strerror(errno));
    return child;
}

// Wait until it ends or breaks a limit; true where it ended by itself, with wait's status.
static bool watch(Child *child, const Confine *confine, ConfineResult *result, int *wait_status)
{
    const ConfineLimits *limits = &confine->limits;
    double begin = now_seconds(), next = begin;
    for (;;) {
        bool ended = waitpid(child->process, wait_status, WNOHANG) == child->process;
        drain(child, limits->text_bytes);
        result->seconds = now_seconds() - begin;
        if (child->said_bytes > limits->text_bytes)
            return result->end = CONFINE_TEXT, false;
        if (ended || now_seconds() >= next) {
            size_t bytes, files, memory = confine_memory();
            next = now_seconds() + 1e-3 * WATCH_MILLISECONDS; // though it prints all the time
            result->memory_bytes = memory > result->memory_bytes ? memory : result->memory_bytes;
            confine_usage(confine->folder, limits->folder_bytes, limits->folder_files, &bytes, &files);
            if (result->memory_bytes > limits->memory_bytes)
                return result->end = CONFINE_MEMORY, false;
            if (bytes > limits->folder_bytes || files > limits->folder_files)
                return result->end = CONFINE_FOLDER, false;
        }
        if (ended)
            return true;
        if (result->seconds > limits->wall_seconds)
            return result->end = CONFINE_WALL, false;
        poll(&(struct pollfd){.fd = child->text, .events = POLLIN}, 1, WATCH_MILLISECONDS);
    }
}

static ConfineEnd end_by_signal(int signal_number)
{
    return signal_number == SIGXCPU   ? CONFINE_CPU
           : signal_number == SIGXFSZ ? CONFINE_FOLDER
                                      : CONFINE_SIGNAL;
}

// How a child that ended by itself ended. Bubblewrap passes a signal on as 128 + its number, as shells do.
static void judge_end(const Child *child, bool wrapped, int wait_status, ConfineResult *result)
{
    const char *code = strstr(child->state, "\"exit-code\":");
    int status = code ? atoi(code + strlen("\"exit-code\":")) : 0;
    bool by_signal = wrapped ? status > 128 : WIFSIGNALED(wait_status);
    if (wrapped && !code)
        return;
    if (by_signal)
        result->status = wrapped ? status - 128 : WTERMSIG(wait_status);
    else
        result->status = wrapped ? status : WEXITSTATUS(wait_status);
    result->end = by_signal ? end_by_signal(result->status) : CONFINE_EXIT;
}

static ConfineResult run(const Confine *confine, bool wrapped)
{
    ConfineResult result = {.end = CONFINE_NOT_RUN};
    size_t most = confine->limits.text_bytes;
    Child child = start(confine, wrapped);
    int wait_status = 0;
    bool ended = child.process > 0 && watch(&child, confine, &result, &wait_status);
    confine_kill_all();
    drain(&child, most);
    if (child.failed[0])
        child.said_bytes = (size_t)snprintf(child.said, most + 1, "%s", child.failed);
    else if (ended)
        judge_end(&child, wrapped, wait_status, &result);
    child.said[child.said_bytes < most ? child.said_bytes : most] = '\0';
    close(child.text);
    close(child.status);
    result.text = child.said;
    return result;
}

bool confine_wrapped(void)
{
    if (wrapping == WRAPPING_UNKNOWN) {
        char folder[] = "/tmp/confine_XXXXXX";
        if (!mkdtemp(folder))
            fail_work("%s: %s", folder, strerror(errno));
        confine_folder(folder);
        ConfineLimits limits = {10, 10, 64 << 20, 1 << 20, 10, 1024, 16};
        ConfineResult tried = run(&(Confine){.command = (const char *const[]){"/usr/bin/true", NULL},
                                             .folder = folder,
                                             .limits = limits},
                                  true);
        wrapping = tried.end == CONFINE_EXIT && tried.status == 0 ? WRAPPING_WORKS : WRAPPING_NOT;
        free(tried.text);
        confine_folder_remove(folder);
    }
    return wrapping == WRAPPING_WORKS;
}

void confine_without_bubblewrap(void)
{
    wrapping = WRAPPING_NOT;
}

const char *confine_way(void)
{
    if (confine_wrapped())
        return geteuid() == 0 ? "bubblewrap, as a user that owns nothing" : "bubblewrap";
    return geteuid() == 0 ? "limits alone, without network, as a user that owns nothing (bubblewrap is "
                            "missing or does not work here)"
                          : "limits alone, as your own user (bubblewrap is missing or does not work here): "
                            "grade nobody's work "
                            "that you would not run yourself";
}

ConfineResult confine_run(const Confine *confine)
{
    return run(confine, confine_wrapped());
}

char *confine_said(const ConfineResult *result, const ConfineLimits *limits)
{
    enum { MEGABYTE = 1 << 20 };
    switch (result->end) {
    case CONFINE_EXIT:
        return text_format("ended with exit status %d", result->status);
    case CONFINE_SIGNAL:
        return text_format("was ended by signal %d (%s)", result->status, strsignal(result->status));
    case CONFINE_WALL:
        return text_format("did not end within %g s", limits->wall_seconds);
    case CONFINE_CPU:
        return text_format("used more than %g s of processor time", limits->cpu_seconds);
    case CONFINE_MEMORY:
        return text_format("used more than %zu MB of memory", limits->memory_bytes / MEGABYTE);
    case CONFINE_FOLDER:
        return text_format("wrote more than %zu MB or %zu files", limits->folder_bytes / MEGABYTE,
                           limits->folder_files);
    case CONFINE_TEXT:
        return text_format("printed more than %zu kB", limits->text_bytes / 1024);
    case CONFINE_NOT_RUN:
        break;
    }
    return text_format("could not be run: %.*s", (int)strcspn(result->text, "\n"), result->text);
}
