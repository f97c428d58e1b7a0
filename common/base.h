// base: what every module needs and no library gives in this form: the one-line failure, memory that
// is never NULL, files that are written whole or not at all.
//
// Exit status of every program: 0 done, 1 the work failed, 2 the request was wrong.
#ifndef BASE_H
#define BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define BASE_NORETURN __attribute__((noreturn)) // in C and C++ alike

#ifdef __cplusplus
extern "C" {
#endif

// Print "PROGRAM: MESSAGE" as one line on stderr, remove temporary files, exit with status 1 (the work failed).
BASE_NORETURN void fail_work(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The same with status 2 (the request was wrong): names the option, what is wrong, what would be right.
BASE_NORETURN void fail_request(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Print "PROGRAM: note: MESSAGE" on stderr and go on.
void note(const char *format, ...) __attribute__((format(printf, 1, 2)));

// count × size; ends the program, naming `what` and the bytes needed, where it overflows or exceeds the machine's memory.
size_t memory_bytes(size_t count, size_t size, const char *what);

// count × size bytes, zeroed (memory_new) or grown (memory_grow); count × size may not overflow.
// A request that cannot be met ends the program, naming `what` and the bytes needed.
void *memory_new(size_t count, size_t size, const char *what);
void *memory_grow(void *old, size_t count, size_t size, const char *what);

// printf into new memory; the caller frees it.
char *text_format(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The whole file as NUL-terminated text, or NULL (errno says why); *bytes may be NULL. The caller frees it.
char *file_read(const char *path, size_t *bytes);

// A path beside `path`, with the same ending, to be written first; file_commit renames it to `path` and ends the
// program where that fails. What was begun and not committed is removed when the program ends, fails or is interrupted.
// A path that is a device or a pipe (/dev/stdout, /dev/full) is written directly, never replaced: its writer sees the errors.
const char *file_begin(const char *path);
void file_commit(const char *temporary);

// Create the folder and its parents; ends the program where that fails.
void folder_make(const char *path);

// FNV-1a, 64 bits: hash_bytes(hash_bytes(HASH_START, a, n), b, m) hashes a then b.
#define HASH_START UINT64_C(14695981039346656037)
uint64_t hash_bytes(uint64_t hash, const void *data, size_t bytes);

#ifdef __cplusplus
}
#endif
#endif
