// confine_child: between fork and exec. See confine_parts.h.
#include "confine_parts.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <linux/close_range.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

enum { ARGUMENTS_MOST = 256, USER_ALONE = 2000000000, USER_NOBODY = 65534 };

static const rlim_t OPEN_FILES = 128;

uid_t confine_user(void)
{
    // A user of each grader's own: the kernel counts a user's processes over all of them. A container that maps few users may know none of
    // these; nobody is then taken.
    return geteuid() == 0 ? (uid_t)(USER_ALONE + getpid()) : geteuid();
}

static void limit(__rlimit_resource_t resource, rlim_t most)
{
    struct rlimit old;
    if (getrlimit(resource, &old) == 0 && old.rlim_max != RLIM_INFINITY && old.rlim_max < most)
        most = old.rlim_max; // may be lowered only
    setrlimit(resource, &(struct rlimit){most, most});
}

// Tasks that a user who is no stranger to this machine runs already: the kernel counts them all.
static size_t tasks_of_user(void)
{
    size_t tasks = 0;
    DIR *list = opendir("/proc");
    for (struct dirent *entry; list && (entry = readdir(list));) {
        char path[64], line[256];
        struct stat about;
        snprintf(path, sizeof path, "/proc/%.16s/status", entry->d_name);
        FILE *status = stat(path, &about) == 0 && about.st_uid == geteuid() ? fopen(path, "re") : NULL;
        for (size_t threads; status && fgets(line, sizeof line, status);)
            if (sscanf(line, "Threads: %zu", &threads) == 1)
                tasks += threads;
        if (status)
            fclose(status);
    }
    if (list)
        closedir(list);
    return tasks;
}

static void set_limits(const ConfineLimits *limits)
{
    enum { WRAPPER_TASKS = 3 }; // bubblewrap's own
    size_t tasks = limits->process_count + WRAPPER_TASKS + (geteuid() == 0 ? 0 : tasks_of_user());
    rlim_t seconds =
        (rlim_t)limits->cpu_seconds + ((double)(rlim_t)limits->cpu_seconds < limits->cpu_seconds);
    setrlimit(RLIMIT_CPU,
              &(struct rlimit){seconds, seconds + 1}); // soft: SIGXCPU, which tells it from other kills
    limit(RLIMIT_FSIZE, limits->folder_bytes);
    limit(RLIMIT_NPROC, tasks);
    limit(RLIMIT_NOFILE, OPEN_FILES);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_MEMLOCK, 0);
    limit(RLIMIT_MSGQUEUE, 0);
    setpriority(PRIO_PROCESS, 0, 5); // the one who watches comes first
}

static bool become(uid_t user)
{
    return setresgid(user, user, user) == 0 && setresuid(user, user, user) == 0;
}

static bool leave_root(uid_t user)
{
    return geteuid() != 0 || (setgroups(0, NULL) == 0 && (become(user) || become(USER_NOBODY)));
}

typedef struct Arguments {
    const char *list[ARGUMENTS_MOST];
    size_t count;
    bool full;
} Arguments;

static void add(Arguments *arguments, const char *argument)
{
    arguments->full = arguments->full || arguments->count + 1 >= ARGUMENTS_MOST;
    if (!arguments->full)
        arguments->list[arguments->count++] = argument;
}
#define ADD(arguments, ...)                                                                                  \
    for (const char *const *one = (const char *const[]){__VA_ARGS__, NULL}; *one; one++)                     \
    add(arguments, *one)

// /lib and its like are links into /usr on most systems: what each is here, it is there.
static void add_system(Arguments *arguments)
{
    static const char *const folders[] = {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32"};
    static char links[sizeof folders / sizeof *folders][256];
    ADD(arguments, "--ro-bind", "/usr", "/usr");
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        ssize_t length = readlink(folders[i], links[i], sizeof links[i] - 1);
        if (length > 0)
            ADD(arguments, "--symlink", links[i], folders[i]);
        else
            ADD(arguments, "--ro-bind-try", folders[i], folders[i]);
    }
    // cc may be a link into /etc/alternatives; the loader looks libraries up in its cache.
    ADD(arguments, "--ro-bind-try", "/etc/alternatives", "/etc/alternatives");
    ADD(arguments, "--ro-bind-try", "/etc/ld.so.cache", "/etc/ld.so.cache");
}

static void wrap(Arguments *arguments, const Confine *confine, int status)
{
    static char descriptor[16];
    snprintf(descriptor, sizeof descriptor, "%d", status);
    ADD(arguments, "bwrap", "--unshare-all", "--unshare-user", "--disable-userns", "--die-with-parent",
        "--new-session", "--json-status-fd", descriptor);
    add_system(arguments);
    ADD(arguments, "--proc", "/proc", "--dev", "/dev");
    for (const char *const *path = confine->readable; path && *path; path++)
        ADD(arguments, "--ro-bind", *path, *path);
    ADD(arguments, "--bind", confine->folder, confine->folder, "--chdir", confine->folder);
    // The root and /dev are folders in memory: not to be filled.
    ADD(arguments, "--remount-ro", "/dev", "--remount-ro", "/", "--");
}

static char *variable(const char *name, const char *value)
{
    char *text = NULL;
    return asprintf(&text, "%s=%s", name, value) < 0 ? NULL : text;
}

static void set_environment(const Confine *confine, Arguments *environment)
{
    ADD(environment, "PATH=/usr/local/bin:/usr/bin:/bin", "LANG=C.UTF-8", variable("HOME", confine->folder),
        variable("TMPDIR", confine->folder));
    for (const char *const *one = confine->environment; one && *one; one++)
        add(environment, *one);
}

__attribute__((noreturn)) static void give_up(int begun, const char *what)
{
    dprintf(begun, "%s: %s\n", what, strerror(errno));
    _exit(127);
}

void confine_become(const Confine *confine, const ConfineSeat *seat)
{
    int nothing = open("/dev/null", O_RDONLY);
    if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(seat->text, 1) < 0 || dup2(seat->text, 2) < 0)
        give_up(seat->begun, "descriptors");
    setsid();
    for (int number = 1; number < NSIG; number++)
        signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    umask(022);
    set_limits(&confine->limits);
    if (!seat->wrapped)
        (void)!unshare(CLONE_NEWNET | CLONE_NEWIPC); // root alone may; the others keep their network
    if (!leave_root(seat->user))
        give_up(seat->begun, "the user cannot be changed");
    if (chdir(confine->folder) != 0)
        give_up(seat->begun, confine->folder);
    if (close_range(3, ~0U, CLOSE_RANGE_CLOEXEC) != 0)
        give_up(seat->begun, "descriptors cannot be closed");

    Arguments environment = {0}, arguments = {0};
    set_environment(confine, &environment);
    if (seat->wrapped) {
        wrap(&arguments, confine, seat->status);
        fcntl(seat->status, F_SETFD, 0); // bubblewrap writes it and closes it before the program begins
    } else {
        prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    }
    for (const char *const *argument = confine->command; *argument; argument++)
        add(&arguments, *argument);
    if (arguments.full || environment.full) {
        errno = E2BIG;
        give_up(seat->begun, "arguments");
    }
    execvpe(arguments.list[0], (char *const *)arguments.list, (char *const *)environment.list);
    give_up(seat->begun, arguments.list[0]);
}
