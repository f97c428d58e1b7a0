// watch: check again whenever one of the exercise's files is saved. See course.h.
#include "course.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <time.h>
#include <unistd.h>

// Whether one of the events that have come names a file of the exercise.
static bool concerns(const Entry *entry, const char *events, ssize_t bytes)
{
    bool found = false;
    for (ssize_t at = 0; at < bytes;) {
        struct inotify_event event;
        memcpy(&event, events + at, sizeof event);
        const char *name = events + at + sizeof event;
        for (int i = 0; i < entry->file_count && event.len; i++)
            found = found || !strcmp(name, entry->files[i]);
        at += (ssize_t)(sizeof event + event.len);
    }
    return found;
}

int course_watch(Course *course, const Entry *entry)
{
    // The folder, not the files: many editors write a new file and rename it over the old one.
    char *folder = text_format("%s/%s", course->tree, entry->folder), events[4096];
    int watch = inotify_init1(IN_CLOEXEC);
    if (watch < 0 || inotify_add_watch(watch, folder, IN_CLOSE_WRITE | IN_MOVED_TO) < 0)
        fail_work("%s: cannot be watched: %s", folder, strerror(errno));
    free(folder);
    for (;;) {
        if (isatty(STDOUT_FILENO))
            printf("\033[H\033[2J\033[3J"); // a clean screen
        course_check(course, entry);
        printf("\n  Watching; save to check again, Ctrl-C ends.\n");
        fflush(stdout);
        for (bool saved = false; !saved;) {
            ssize_t bytes = read(watch, events, sizeof events);
            if (bytes < 0 && errno != EINTR)
                fail_work("watching: %s", strerror(errno));
            saved = bytes > 0 && concerns(entry, events, bytes);
        }
        nanosleep(&(struct timespec){.tv_nsec = 100000000}, NULL); // an editor may write more than once
    }
}
