// confine_scratch: folders below /tmp (or TMPDIR) that are gone once nobody uses them, though their maker was killed. See confine.h.
#include "confine.h"

#include "base.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

// Between making a folder and locking it: none that was written to since is taken for one that was left behind.
static const time_t YOUNG_SECONDS = 60;

static const char *temporary_folder(void)
{
    const char *temporary = getenv("TMPDIR");
    return temporary && temporary[0] == '/' ? temporary : "/tmp";
}

static int lock_folder(const char *path)
{
    int lock = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) != 0) {
        close(lock);
        lock = -1;
    }
    return lock;
}

// What another one of this kind has left behind: this user's, and nobody holds its lock, which ends with the process.
static void remove_if_left(const char *path)
{
    struct stat about;
    if (lstat(path, &about) != 0 || !S_ISDIR(about.st_mode) || about.st_uid != geteuid() ||
        time(NULL) - about.st_mtime < YOUNG_SECONDS)
        return;
    int lock = lock_folder(path);
    if (lock < 0)
        return;
    confine_folder_remove(path);
    close(lock);
}

static void remove_left(const char *temporary, const char *kind)
{
    DIR *list = opendir(temporary);
    size_t length = strlen(kind);
    for (struct dirent *entry; list && (entry = readdir(list));)
        if (!strncmp(entry->d_name, kind, length) && entry->d_name[length] == '_' &&
            strlen(entry->d_name) == length + strlen("_XXXXXX")) {
            char *path = text_format("%s/%s", temporary, entry->d_name);
            remove_if_left(path);
            free(path);
        }
    if (list)
        closedir(list);
}

ConfineScratch confine_scratch_open(const char *kind)
{
    const char *temporary = temporary_folder();
    remove_left(temporary, kind);
    ConfineScratch scratch = {.path = text_format("%s/%s_XXXXXX", temporary, kind), .lock = -1};
    if (!mkdtemp(scratch.path) || (scratch.lock = lock_folder(scratch.path)) < 0 ||
        chmod(scratch.path, 0711) != 0)
        fail_work("%s: %s", scratch.path, strerror(errno));
    return scratch;
}

void confine_scratch_close(ConfineScratch *scratch)
{
    confine_folder_remove(scratch->path);
    close(scratch->lock);
    free(scratch->path);
    *scratch = (ConfineScratch){.lock = -1};
}
