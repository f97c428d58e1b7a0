// confine_folder: the folder that a confined child may write, before and after. See confine.h.
#include "confine.h"
#include "confine_parts.h"

#include "base.h"
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

void confine_folder(const char *path)
{
    if (mkdir(path, 0700) != 0 && errno != EEXIST)
        fail_work("%s: cannot be made: %s", path, strerror(errno));
    uid_t user = confine_user();
    if (geteuid() == 0 && lchown(path, user, user) != 0)
        fail_work("%s: cannot be given to user %u: %s", path, (unsigned)user, strerror(errno));
}

static void run_quietly(const char *const *command)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t process;
    if (posix_spawnp(&process, command[0], &actions, NULL, (char *const *)command, environ) == 0)
        waitpid(process, NULL, 0);
    posix_spawn_file_actions_destroy(&actions);
}

// rm and chmod follow no link and stand any depth, which nftw does not.
void confine_folder_remove(const char *path)
{
    run_quietly((const char *const[]){"chmod", "-R", "u+rwx", "--", path, NULL});
    run_quietly((const char *const[]){"rm", "-rf", "--", path, NULL});
    if (access(path, F_OK) == 0)
        note("%s: not removed", path);
}

void confine_folder_copy(const char *from, const char *to)
{
    const char *const command[] = {"cp", "-RL", "--", from, to, NULL};
    pid_t process;
    int status = 1;
    if (posix_spawnp(&process, command[0], NULL, NULL, (char *const *)command, environ) != 0 ||
        waitpid(process, &status, 0) != process || status != 0)
        fail_work("%s: cannot be copied to %s", from, to);
}

void confine_folder_open(const char *path)
{
    run_quietly((const char *const[]){"chmod", "-R", "go+rX", "--", path, NULL});
}

void *confine_read(const char *folder, const char *name, size_t bytes, char **why)
{
    *why = NULL;
    char *path = text_format("%s/%s", folder, name);
    // Not blocking: it may be a pipe that nobody writes to.
    int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    int error = errno;
    free(path);
    struct stat about;
    if (file < 0)
        *why = error == ENOENT  ? text_format("is missing")
               : error == ELOOP ? text_format("is a symbolic link, not a file")
                                : text_format("cannot be read: %s", strerror(error));
    else if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode))
        *why = text_format("is not a file");
    else if (about.st_nlink != 1)
        *why = text_format("has another name: a file of its own is wanted");
    else if ((size_t)about.st_size != bytes)
        *why = text_format("has %lld bytes, not %zu", (long long)about.st_size, bytes);
    char *data = NULL;
    if (!*why) {
        data = memory_new(bytes, 1, name);
        size_t done = 0;
        for (ssize_t got; done < bytes && (got = read(file, data + done, bytes - done)) > 0;)
            done += (size_t)got;
        if (done != bytes) {
            *why = text_format("cannot be read to its end");
            free(data);
            data = NULL;
        }
    }
    if (file >= 0)
        close(file);
    return data;
}
