// confine: run a program that is not trusted as a child, and say how it ended.
//
// Contents: what a child may use (ConfineLimits), how it ended (ConfineEnd), the folder that it may write, the run.
//
// Where bubblewrap works, the child sees the system's /usr, the folders that it is given to read and one folder that it may write, nothing else:
// no network, no other process, no home, no /tmp. Where it does not, limits and a process group are all there is; confine_way says which.
// Either way it begins with no descriptor but stdin (empty), stdout and stderr, no environment but the one given, a group of processes that
// is killed to the last when it ends and, where the caller is root, a user that owns nothing (limits on processes do not bind root).
#ifndef CONFINE_H
#define CONFINE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ConfineLimits {
    double wall_seconds;
    double cpu_seconds; // of each of its processes; rounded up to whole seconds
    size_t
        memory_bytes; // of all its processes together: what they wrote to, not what is mapped or reserved (a GL program here: 22 MB of some 2 GB)
    size_t folder_bytes;  // of all files in its folder together
    size_t folder_files;  // and how many
    size_t text_bytes;    // of stdout and stderr together
    size_t process_count; // processes and threads at the same time
} ConfineLimits;

typedef enum ConfineEnd {
    CONFINE_EXIT,   // by itself; `status` is its exit status
    CONFINE_SIGNAL, // `status` is the signal
    CONFINE_WALL,   // killed: one of the limits
    CONFINE_CPU,
    CONFINE_MEMORY,
    CONFINE_FOLDER,
    CONFINE_TEXT,
    CONFINE_NOT_RUN, // the machine's failure, not the program's; `text` says what
} ConfineEnd;

typedef struct ConfineResult {
    ConfineEnd end;
    int status;
    double seconds;      // wall time
    size_t memory_bytes; // the most that was seen
    char *text;          // stdout and stderr, as they came; NUL-terminated, the caller frees it
} ConfineResult;

typedef struct Confine {
    const char *const *command; // the program's absolute path and its arguments, NULL ends
    const char *folder;         // made by confine_folder: its working folder, HOME and TMPDIR
    const char *const
        *readable; // absolute paths that it may read beside the system's, NULL ends; the pointer may be NULL
    const char *const
        *environment; // "NAME=value" beside PATH, HOME, TMPDIR and LANG, NULL ends; the pointer may be NULL
    ConfineLimits limits;
} Confine;

ConfineResult confine_run(const Confine *confine);

// One clause for the one who wrote the program: "ended by signal 11 (Segmentation fault)". The caller frees it.
char *confine_said(const ConfineResult *result, const ConfineLimits *limits);

// Whether bubblewrap confines (tried once a process); and what does, as a clause for the instructor.
bool confine_wrapped(void);
const char *confine_way(void);
// For tests: as where there is no bubblewrap.
void confine_without_bubblewrap(void);

// Make a folder that the child may write; hand a file or folder to the child's user; remove a folder and all in it, whatever the child left.
void confine_folder(const char *path);
void confine_folder_remove(const char *path);
// A file or a folder with all in it, links followed; `to` is a folder. Ends the program where that fails.
void confine_folder_copy(const char *from, const char *to);
// Lets every user read what is in it.
void confine_folder_open(const char *path);

// --- confine_scratch.c
typedef struct ConfineScratch {
    char *path; // /tmp/KIND_XXXXXX, or in TMPDIR; others may enter it and not list it
    int lock;   // held while it is in use
} ConfineScratch;
// A new one; what others of this kind left behind is removed first: a grader that was killed, or ended early, cannot.
ConfineScratch confine_scratch_open(const char *kind);
void confine_scratch_close(ConfineScratch *scratch);

// A file that a child left in its folder, read without following a link: exactly `bytes`, a regular file with
// one name. NULL where it is not, and *why is then a clause that says so ("is missing", "has 12 bytes, not 16"); both are the caller's to free.
void *confine_read(const char *folder, const char *name, size_t bytes, char **why);

#endif
