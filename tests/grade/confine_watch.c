// confine_watch: what a confined child uses while it runs. See confine_parts.h.
#include "confine_parts.h"

#include <ctype.h>
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { DEPTH_MOST = 32 };

// Calls visit for each process that a task of `process` (a number, or "self") has begun, and for theirs, the youngest first: depth first.
// The kernel's list may lack a process that ends meanwhile, never one that was there all the time.
static void each_descendant(const char *process, int depth, void (*visit)(pid_t, size_t *), size_t *sum)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/%.16s/task", process);
    DIR *tasks = depth < DEPTH_MOST ? opendir(path) : NULL;
    for (struct dirent *task; tasks && (task = readdir(tasks));) {
        if (!isdigit((unsigned char)task->d_name[0]))
            continue;
        char children[128];
        snprintf(children, sizeof children, "/proc/%.16s/task/%.16s/children", process, task->d_name);
        FILE *list = fopen(children, "re");
        for (char child[17]; list && fscanf(list, "%16s", child) == 1;) {
            each_descendant(child, depth + 1, visit, sum);
            visit((pid_t)atoi(child), sum);
        }
        if (list)
            fclose(list);
    }
    if (tasks)
        closedir(tasks);
}

// Memory of its own and memory shared with others; not files that are mapped, which need none.
static void add_memory(pid_t process, size_t *sum)
{
    char path[64], line[256];
    snprintf(path, sizeof path, "/proc/%d/status", (int)process);
    FILE *status = fopen(path, "re");
    unsigned long kilobytes = 0;
    while (status && fgets(line, sizeof line, status))
        if (sscanf(line, "RssAnon: %lu", &kilobytes) == 1 || sscanf(line, "RssShmem: %lu", &kilobytes) == 1 ||
            sscanf(line, "VmPTE: %lu", &kilobytes) == 1)
            *sum += (size_t)kilobytes << 10;
    if (status)
        fclose(status);
}

static void kill_one(pid_t process, size_t *sum)
{
    kill(process, SIGKILL);
    ++*sum;
}

size_t confine_memory(void)
{
    size_t sum = 0;
    each_descendant("self", 0, add_memory, &sum);
    return sum;
}

// Orphans come to this process (it is their subreaper), so that a round finds what the last one left, until there is none.
void confine_kill_all(void)
{
    for (;;) {
        size_t killed = 0;
        each_descendant("self", 0, kill_one, &killed);
        while (waitpid(-1, NULL, WNOHANG) > 0)
            ;
        if (killed == 0)
            return;
        usleep(500);
    }
}

static void add_usage(int folder, int depth, size_t most_bytes, size_t most_files, size_t *bytes,
                      size_t *files)
{
    DIR *list = fdopendir(folder);
    for (struct dirent *entry;
         list && *bytes <= most_bytes && *files <= most_files && (entry = readdir(list));) {
        struct stat about;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0 ||
            fstatat(folder, entry->d_name, &about, AT_SYMLINK_NOFOLLOW) != 0)
            continue;
        ++*files;
        *bytes += (size_t)about.st_blocks * 512; // what it takes: a file of holes takes none
        if (S_ISDIR(about.st_mode) && depth < DEPTH_MOST) {
            int inner = openat(folder, entry->d_name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
            if (inner >= 0)
                add_usage(inner, depth + 1, most_bytes, most_files, bytes, files);
        }
    }
    if (list)
        closedir(list);
    else
        close(folder);
}

void confine_usage(const char *folder, size_t most_bytes, size_t most_files, size_t *bytes, size_t *files)
{
    *bytes = *files = 0;
    int open_folder = open(folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (open_folder >= 0)
        add_usage(open_folder, 0, most_bytes, most_files, bytes, files);
}
