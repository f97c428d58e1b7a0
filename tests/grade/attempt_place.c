// attempt_place: where an attempt takes place. See attempt.h.
// Root's children run as a user that owns nothing and cannot enter a folder like /root. Where they could not read what they need, it is copied to a
// scratch folder, and the attempt takes place there.
#include "attempt.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char *absolute(const char *path)
{
    char *real = realpath(path, NULL);
    if (!real)
        fail_work("%s: %s", path, strerror(errno));
    return real;
}

// Whether every user may enter each folder on the way to an absolute path and read what is there.
static bool all_may_read(const char *path)
{
    struct stat about;
    if (stat(path, &about) != 0)
        return true; // what is not there is told of when it is needed
    mode_t needed = S_ISDIR(about.st_mode) ? S_IROTH | S_IXOTH : S_IROTH;
    bool may = (about.st_mode & needed) == needed;
    for (const char *slash = strchr(path + 1, '/'); may && slash; slash = strchr(slash + 1, '/')) {
        char *folder = text_format("%.*s", (int)(slash - path), path);
        may = stat(folder, &about) == 0 && (about.st_mode & S_IXOTH);
        free(folder);
    }
    return may;
}

static bool all_may_read_each(char *const paths[], int count)
{
    bool may = true;
    for (int i = 0; i < count; i++)
        may = may && all_may_read(paths[i]);
    return may;
}

static bool children_may_read(const Attempt *attempt)
{
    if (geteuid() != 0)
        return true; // they are the same user
    char *const needed[] = {
        text_format("%s/common/exercise.h", attempt->root), text_format("%s/shaders", attempt->root),
        text_format("%s/libexercise.a", attempt->build),
        text_format("%s/%s", attempt->tree, attempt->entry->folder), text_format("%s", attempt->given)};
    enum { COUNT = sizeof needed / sizeof *needed };
    bool may = all_may_read_each(needed, COUNT);
    for (int i = 0; i < COUNT; i++)
        free(needed[i]);
    for (int i = 0; i < attempt->entry->file_count && may; i++) {
        char *file = text_format("%s/%s/%s", attempt->tree, attempt->entry->folder, attempt->entry->files[i]);
        may = all_may_read(file);
        free(file);
    }
    return may;
}

static void make_empty(const char *folder, const char *given)
{
    folder_make(folder);
    folder_make(given);
    confine_folder_remove(folder);
    confine_folder_remove(given);
    confine_folder(folder);
    folder_make(given);
}

static void replace(char **text, char *by)
{
    free(*text);
    *text = by;
}

static void copy_into(const char *folder, const char *name, const char *scratch)
{
    char *from = text_format("%s/%s", folder, name);
    confine_folder_copy(from, scratch);
    free(from);
}

// Everything that compiler and program read, in a folder that their user may enter.
static void move_to_scratch(Attempt *attempt)
{
    attempt->place = confine_scratch_open("check");
    const char *scratch = attempt->place.path;
    // The tree keeps its place below the root, by which messages name its files.
    size_t root = strlen(attempt->root);
    bool below = !strncmp(attempt->tree, attempt->root, root) && attempt->tree[root] == '/';
    char *tree = text_format("%s/%s", scratch, below ? attempt->tree + root + 1 : "tree");
    folder_make(tree);
    copy_into(attempt->tree, attempt->entry->folder, tree);
    copy_into(attempt->root, "common", scratch);
    copy_into(attempt->root, "shaders", scratch);
    copy_into(attempt->build, "libexercise.a", scratch);
    copy_into(attempt->build, "exercise_commands", scratch);
    confine_folder_open(scratch);
    replace(&attempt->root, text_format("%s", scratch));
    replace(&attempt->build, text_format("%s", scratch));
    replace(&attempt->tree, tree);
    attempt->kept = attempt->given;
    attempt->given = text_format("%s/work.given", scratch);
    replace(&attempt->folder, text_format("%s/work", scratch));
    make_empty(attempt->folder, attempt->given);
}

Attempt attempt_open(const Entry *entry, const char *tree, const char *build, const char *folder)
{
    // What the children are given lies beside what they may write: nothing that one of them leaves behind can lead the next input astray.
    char *given = text_format("%s.given", folder);
    make_empty(folder, given);
    Attempt attempt = {.entry = entry,
                       .root = absolute("."),
                       .tree = absolute(tree),
                       .folder = absolute(folder),
                       .given = absolute(given),
                       .build = absolute(build)};
    free(given);
    if (!children_may_read(&attempt))
        move_to_scratch(&attempt);
    return attempt;
}

const char *attempt_kept(const Attempt *attempt)
{
    return attempt->kept ? attempt->kept : attempt->given;
}

void attempt_close(Attempt *attempt)
{
    if (attempt->place.path) {
        char *all = text_format("%s/.", attempt->given);
        confine_folder_copy(all, attempt->kept);
        free(all);
        confine_scratch_close(&attempt->place);
    }
    free(attempt->root);
    free(attempt->tree);
    free(attempt->folder);
    free(attempt->given);
    free(attempt->build);
    free(attempt->kept);
    *attempt = (Attempt){0};
}
