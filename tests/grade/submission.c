// submission: see submission.h.
#include "submission.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FILE_BYTES_MOST = 256 * 1024 }; // the course's longest is 20 kB

static void write_file(const char *path, const char *data, size_t bytes)
{
    char *folder = text_format("%.*s", (int)(strrchr(path, '/') - path), path);
    folder_make(folder);
    free(folder);
    FILE *file = fopen(path, "wb");
    bool written = file && fwrite(data, 1, bytes, file) == bytes;
    if (!file || fclose(file) != 0 || !written)
        fail_work("%s: cannot be written: %s", path, strerror(errno));
}

// Open a file below `folder` with no link anywhere on the way, `..` neither; -1 and errno.
static int open_below(const char *folder, const char *path)
{
    int base = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (base < 0)
        fail_work("%s: %s", folder, strerror(errno));
    struct open_how how = {.flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC,
                           .resolve = RESOLVE_NO_SYMLINKS | RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    int file = (int)syscall(SYS_openat2, base, path, &how, sizeof how);
    int error = errno;
    close(base);
    errno = error;
    return file;
}

static void take_note(Submission *submission, const char *path, const char *why)
{
    char *notes = text_format("%s%s: %s\n", submission->notes ? submission->notes : "", path, why);
    free(submission->notes);
    submission->notes = notes;
}

// The text of a submitted file, or NULL: it is not there, or a note says why it is not taken.
static char *take(Submission *submission, const char *path, size_t *bytes)
{
    int file = open_below(submission->folder, path);
    if (file < 0) {
        if (errno == ELOOP || errno == EXDEV)
            take_note(submission, path, "is a symbolic link, or behind one: hand in the file itself");
        else if (errno == ENOSYS || errno == EPERM)
            fail_work("openat2: %s; Linux 5.6 or newer is needed to open a submission's files without "
                      "following links",
                      strerror(errno));
        else if (errno != ENOENT && errno != ENOTDIR)
            take_note(submission, path, strerror(errno));
        return NULL;
    }
    struct stat about;
    char *text = NULL;
    if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode))
        take_note(submission, path, "is not a file");
    else if (about.st_size > FILE_BYTES_MOST)
        take_note(submission, path, "has more than 256 kB: that is no source file of this course");
    else {
        text = memory_new(FILE_BYTES_MOST + 1, 1, path);
        *bytes = 0;
        for (ssize_t got;
             *bytes < FILE_BYTES_MOST && (got = read(file, text + *bytes, FILE_BYTES_MOST - *bytes)) > 0;)
            *bytes += (size_t)got;
    }
    close(file);
    return text;
}

// Where answer and stub stand side by side the answer stays. A file that unifdef cannot read stays as it is: the compiler will say what is wrong.
static void keep_answer(const char *path)
{
    bool text_file = strcmp(strrchr(path, '.'), ".txt") == 0;
    char *cut = text_format("%s.cut", path);
    const char *const command[] = {"unifdef", "-x2", "-DSOLUTION", "-o", cut, path, text_file ? "-t" : NULL,
                                   NULL};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t process;
    int status = 0;
    if (posix_spawnp(&process, command[0], &actions, NULL, (char *const *)command, environ) != 0 ||
        waitpid(process, &status, 0) != process)
        fail_work("unifdef: cannot be run: %s; make deps-test installs it", strerror(errno));
    posix_spawn_file_actions_destroy(&actions);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && rename(cut, path) != 0)
        fail_work("%s: %s", path, strerror(errno));
    unlink(cut);
    free(cut);
}

static void take_file(Submission *submission, const char *folder, const char *file, const char *tree)
{
    char *places[] = {text_format("exercises/%s/%s", folder, file), text_format("%s/%s", folder, file),
                      text_format("%s", file)};
    char *text = NULL, *path = text_format("%s/%s/%s", tree, folder, file);
    size_t bytes = 0;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (!text)
            text = take(submission, places[i], &bytes);
        free(places[i]);
    }
    if (text) {
        write_file(path, text, bytes);
        if (memmem(text, bytes, "SOLUTION", strlen("SOLUTION")))
            keep_answer(path);
        submission->found++;
    }
    free(text);
    free(path);
}

static void copy_file(const char *from, const char *folder, const char *file, const char *tree)
{
    char *source = text_format("%s/%s/%s", from, folder, file),
         *target = text_format("%s/%s/%s", tree, folder, file);
    size_t bytes = 0;
    char *data = file_read(source, &bytes);
    if (!data)
        fail_work("%s: %s", source, strerror(errno));
    write_file(target, data, bytes);
    free(data);
    free(source);
    free(target);
}

static bool builds_on(const Manifest *manifest, const Entry *entry, const Entry *other)
{
    for (int i = 0; i < entry->builds_on_count; i++) {
        const Entry *earlier = manifest_find(manifest, entry->builds_on[i]);
        if (earlier == other ||
            builds_on(manifest, earlier, other)) // the manifest names earlier ones alone, so this ends
            return true;
    }
    return false;
}

void submission_lay(Submission *submission, const Manifest *manifest, const Entry *entry, Trees trees,
                    const char *tree)
{
    folder_make(tree);
    for (int i = 0; i < manifest->count; i++) {
        const Entry *other = &manifest->entries[i];
        if (other == entry || strcmp(other->folder, entry->folder) != 0)
            continue;
        for (int j = 0; j < other->file_count; j++)
            copy_file(builds_on(manifest, entry, other) ? trees.solutions : trees.stubs, other->folder,
                      other->files[j], tree);
    }
    for (int i = 0; i < entry->file_count; i++)
        take_file(submission, entry->folder, entry->files[i], tree);
    if (!submission->notes)
        submission->notes = text_format("%s", "");
}
