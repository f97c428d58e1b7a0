// base: see base.h.
#include "base.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void print_line(const char *kind, const char *format, va_list arguments)
{
    char *message = NULL;
    if (vasprintf(&message, format, arguments) < 0)
        message = NULL; // out of memory: the format alone still says what happened
    for (char *c = message; c && *c; c++)
        if (*c == '\n')
            *c = ' '; // one line, whatever a library put into it
    fflush(stdout);
    fprintf(stderr, "%s: %s%s\n", program_invocation_short_name, kind, message ? message : format);
    fflush(stderr); // leave() flushes nothing
    free(message);
}

#define PRINT_LINE(kind)                                                                                     \
    va_list arguments;                                                                                       \
    va_start(arguments, format);                                                                             \
    print_line(kind, format, arguments);                                                                     \
    va_end(arguments)

static void remove_unfinished(void);

// Not exit(): GL's own exit handler waits for its threads, for ever where one is still drawing what failed.
BASE_NORETURN static void leave(int status)
{
    remove_unfinished();
    _exit(status);
}

void fail_work(const char *format, ...)
{
    PRINT_LINE("");
    leave(1);
}

void fail_request(const char *format, ...)
{
    PRINT_LINE("");
    leave(2);
}

void note(const char *format, ...)
{
    PRINT_LINE("note: ");
}

size_t memory_bytes(size_t count, size_t size, const char *what)
{
    // Linux promises memory that it does not have and kills the program when it is touched: ask before.
    size_t machine = (size_t)sysconf(_SC_PHYS_PAGES) * (size_t)sysconf(_SC_PAGESIZE), bytes = 0;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > machine)
        fail_work("%s: %.0Lf bytes needed, this machine has %zu", what,
                  (long double)count * (long double)size, machine);
    return bytes;
}

void *memory_new(size_t count, size_t size, const char *what)
{
    size_t bytes = memory_bytes(count, size, what);
    void *memory = calloc(bytes ? bytes : 1, 1);
    if (!memory)
        fail_work("%s: out of memory, %zu bytes needed", what, bytes);
    return memory;
}

void *memory_grow(void *old, size_t count, size_t size, const char *what)
{
    size_t bytes = memory_bytes(count, size, what);
    void *memory = realloc(old, bytes ? bytes : 1);
    if (!memory)
        fail_work("%s: out of memory, %zu bytes needed", what, bytes);
    return memory;
}

char *text_format(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = NULL;
    if (vasprintf(&text, format, arguments) < 0)
        fail_work("text '%s': out of memory", format);
    va_end(arguments);
    return text;
}

char *file_read(const char *path, size_t *bytes)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    char *text = NULL;
    size_t length = 0, room = 0;
    do { // by chunks: the length of a pipe is not known before its end
        if (length + 1 >= room)
            text = memory_grow(text, room = 2 * room + 4096, 1, path);
        length += fread(text + length, 1, room - length - 1, file);
    } while (!feof(file) && !ferror(file));
    int error = ferror(file) ? errno : 0;
    fclose(file);
    if (error) {
        free(text);
        errno = error;
        return NULL;
    }
    text[length] = '\0';
    if (bytes)
        *bytes = length;
    return text;
}

// Files begun and not committed: the one list that must outlive every function, for exit and signals to clear.
typedef struct Unfinished {
    char *temporary, *path;
    bool direct; // a device or pipe: temporary is path itself, there is nothing to rename or remove
    struct Unfinished *next;
} Unfinished;
static Unfinished *volatile unfinished_files;
static pid_t unfinished_owner; // a forked child may not remove its parent's files

static void remove_unfinished(void) // async-signal-safe: unlink and getpid only
{
    if (unfinished_owner == getpid())
        for (const Unfinished *file = unfinished_files; file; file = file->next)
            if (!file->direct)
                unlink(file->temporary);
}

static void remove_and_die(int signal_number)
{
    remove_unfinished();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void remove_at_end(void) // once a process
{
    if (unfinished_owner == getpid())
        return;
    unfinished_owner = getpid();
    unfinished_files = NULL;
    atexit(remove_unfinished);
    const int signals[] = {SIGHUP, SIGINT, SIGTERM};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        if (signal(signals[i], remove_and_die) == SIG_IGN)
            signal(signals[i], SIG_IGN); // nohup stays nohup
}

const char *file_begin(const char *path)
{
    static unsigned serial; // two files of one name may be unfinished at once
    remove_at_end();
    struct stat status;
    bool exists = stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode))
        fail_work("%s: cannot be written: it is a folder", path);
    if (exists && access(path, W_OK))
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    Unfinished *file = memory_new(1, sizeof *file, path);
    file->direct = exists && !S_ISREG(status.st_mode);
    // Behind a symbolic link, not in its place. A pipe has no path to be resolved: /dev/stdout leads to none.
    file->path = exists && !file->direct ? realpath(path, NULL) : strdup(path);
    if (!file->path)
        fail_work("%s: cannot be written: %s", path, strerror(errno));
    const char *slash = strrchr(file->path, '/'), *name = slash ? slash + 1 : file->path,
               *dot = strrchr(name, '.');
    if (file->direct) {
        file->temporary = strdup(file->path);
    } else {
        int descriptor;
        do {
            free(file->temporary);
            file->temporary = text_format("%.*s.%s.%d.%u%s", (int)(name - file->path), file->path, name,
                                          (int)getpid(), serial++, dot ? dot : "");
            descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
        } while (descriptor < 0 && errno == EEXIST);
        if (descriptor < 0 || close(descriptor))
            fail_work("%s: cannot be written: %s", path, strerror(errno));
    }
    file->next = unfinished_files;
    unfinished_files = file;
    return file->temporary;
}

void file_commit(const char *temporary)
{
    Unfinished *file = unfinished_files, *before = NULL;
    while (file && file->temporary != temporary)
        before = file, file = file->next;
    if (!file)
        fail_work("%s: committed but not begun", temporary);
    if (!file->direct) {
        // fsync: a disk that fills up late says so here, and a power cut leaves the old file or the new one
        int descriptor = open(temporary, O_WRONLY);
        if (descriptor < 0 || fsync(descriptor) || close(descriptor) || rename(temporary, file->path))
            fail_work("%s: cannot be written: %s", file->path, strerror(errno));
    }
    if (before)
        before->next = file->next;
    else
        unfinished_files = file->next;
    free(file->temporary);
    free(file->path);
    free(file);
}

void folder_make(const char *path)
{
    char *folder = text_format("%s/", path);
    for (char *slash = strchr(folder + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        struct stat status;
        if (mkdir(folder, 0777) && (stat(folder, &status) || !S_ISDIR(status.st_mode)))
            fail_work("%s: the folder cannot be made: %s", folder, strerror(errno));
        *slash = '/';
    }
    free(folder);
}

uint64_t hash_bytes(uint64_t hash, const void *data, size_t bytes)
{
    for (const unsigned char *byte = data; bytes--; byte++)
        hash = (hash ^ *byte) * UINT64_C(1099511628211);
    return hash;
}
