// confine's own parts: the child's side (confine_child.c) and what is watched while it runs (confine_watch.c).
#ifndef CONFINE_PARTS_H
#define CONFINE_PARTS_H

#include "confine.h"
#include <sys/types.h>

// The user that this process's children run as: its own; where that is root, one that does not exist.
uid_t confine_user(void);

typedef struct ConfineSeat {
    bool wrapped; // by bubblewrap
    uid_t user;   // confine_user() of the parent
    int text;     // takes stdout and stderr
    int status;   // takes bubblewrap's JSON lines: "exit-code" only where the program ran
    int begun; // closes when this program's memory is given up for another's; takes the reason where that cannot be
} ConfineSeat;

// Never returns: become the program. Called in the child.
__attribute__((noreturn)) void confine_become(const Confine *confine, const ConfineSeat *seat);

// Bytes that all children of this process and theirs have written to; kill (and with reap: wait for) all of them.
size_t confine_memory(void);
void confine_kill_all(void);

// What lies in a folder, links not followed; stops counting beyond the limits.
void confine_usage(const char *folder, size_t most_bytes, size_t most_files, size_t *bytes, size_t *files);

#endif
