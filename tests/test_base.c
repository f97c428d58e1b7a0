// base: every failure is one line with its status; memory and files keep their promises.
#include "base.h"
#include "failure.h"

#include <criterion/criterion.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>

static char folder[] = "/tmp/test_base_XXXXXX";
static char target[64];

static void open_folder(void)
{
    cr_assert(mkdtemp(folder), "a folder to test in");
    snprintf(target, sizeof target, "%s/picture.exr", folder);
}

// Files in the folder, hidden ones too.
static int count_files(void)
{
    int count = -2; // . and ..
    DIR *listing = opendir(folder);
    while (readdir(listing))
        count++;
    closedir(listing);
    return count;
}

static void remove_folder(void)
{
    DIR *listing = opendir(folder);
    for (struct dirent *entry; (entry = readdir(listing));)
        unlinkat(dirfd(listing), entry->d_name, 0);
    closedir(listing);
    rmdir(folder);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    cr_assert(file && fputs(text, file) >= 0 && fclose(file) == 0, "%s can be written", path);
}

static bool holds(const char *path, const char *text)
{
    char *content = file_read(path, NULL);
    bool same = content && strcmp(content, text) == 0;
    free(content);
    return same;
}

static void fail_in_work(void)
{
    fail_work("first\nsecond %d", 2);
}
static void fail_in_request(void)
{
    fail_request("--size 0x0: at least 1x1");
}
static void note_only(void)
{
    note("as you were");
}

Test(base, failure_is_one_line_with_its_status)
{
    Failure work = failure_of(fail_in_work), request = failure_of(fail_in_request),
            noted = failure_of(note_only);
    cr_assert_eq(work.status, 1, "work: %d", work.status);
    cr_assert_eq(request.status, 2, "request: %d", request.status);
    cr_assert_eq(noted.status, 0, "a note goes on");
    char line[256];
    snprintf(line, sizeof line, "%s: first second 2", program_invocation_short_name);
    cr_assert(failure_says(&work, line), "%s", work.message);
    cr_assert(failure_says(&request, ": --size 0x0: at least 1x1"), "%s", request.message);
    cr_assert(failure_says(&noted, ": note: as you were"), "%s", noted.message);
}

static void ask_for_more_than_size_t(void)
{
    memory_new(SIZE_MAX / 4, 16, "grid");
}
static void ask_for_what_wraps_to_little(void)
{
    memory_new(SIZE_MAX / 16 + 2, 16, "grid");
}
static void ask_for_more_than_the_machine(void)
{
    memory_new((size_t)1 << 40, 64, "grid");
}
static void grow_too_far(void)
{
    memory_grow(NULL, SIZE_MAX, 2, "list");
}

Test(base, memory_that_cannot_be_had_names_its_bytes)
{
    Failure overflow = failure_of(ask_for_more_than_size_t);
    cr_assert_eq(overflow.status, 1, "%d", overflow.status);
    // (2⁶⁴ − 1) / 4 · 16, by hand: SIZE_MAX / 4 is 2⁶² − 1
    cr_assert(failure_says(&overflow, "grid: 73786976294838206448 bytes needed"), "%s", overflow.message);
    // (2⁶⁰ + 1) · 16 is 16 in size_t: a product that is looked at after it has overflowed would be granted
    Failure wrapped = failure_of(ask_for_what_wraps_to_little);
    cr_assert_eq(wrapped.status, 1, "%d", wrapped.status);
    cr_assert(failure_says(&wrapped, "grid: 18446744073709551632 bytes needed"), "%s", wrapped.message);
    Failure machine = failure_of(ask_for_more_than_the_machine);
    cr_assert_eq(machine.status, 1, "%d", machine.status);
    cr_assert(failure_says(&machine, "grid: 70368744177664 bytes needed"), "%s", machine.message); // 2⁴⁶
    cr_assert_eq(failure_of(grow_too_far).status, 1, "memory_grow checks as well");
}

Test(base, memory_is_zeroed_never_null_and_keeps_what_it_held)
{
    unsigned char *memory = memory_new(1000, 1, "bytes");
    for (int i = 0; i < 1000; i++)
        cr_assert_eq(memory[i], 0, "byte %d", i);
    memset(memory, 7, 1000);
    memory = memory_grow(memory, 5000, 2, "bytes");
    for (int i = 0; i < 1000; i++)
        cr_assert_eq(memory[i], 7, "byte %d after growing", i);
    free(memory);
    void *nothing = memory_new(0, 8, "nothing");
    cr_assert_not_null(nothing, "no bytes are no failure");
    free(nothing);
}

Test(base, file_appears_whole_at_commit_under_its_own_ending, .init = open_folder, .fini = remove_folder)
{
    write_text(target, "old");
    const char *temporary = file_begin(target);
    cr_assert_str_eq(strrchr(temporary, '.'), ".exr", "a writer that goes by the ending is not misled: %s",
                     temporary);
    cr_assert_eq(strncmp(temporary, folder, strlen(folder)), 0, "same folder, else rename copies: %s",
                 temporary);
    write_text(temporary, "new");
    cr_assert(holds(target, "old"), "before the commit the old file stands");
    file_commit(temporary);
    cr_assert(holds(target, "new"), "after it the new one");
    cr_assert_eq(count_files(), 1, "and nothing else");
}

static void begin_and_fail(void)
{
    write_text(file_begin(target), "half");
    write_text(file_begin(target), "a second of the same name");
    fail_work("something else");
}
static void begin_and_end(void)
{
    write_text(file_begin(target), "half");
    exit(0);
}
static void begin_and_interrupt(void)
{
    write_text(file_begin(target), "half");
    raise(SIGINT);
}
static void begin_and_kill(void)
{
    write_text(file_begin(target), "half");
    raise(SIGKILL);
}
static void begin_and_fork(void)
{
    const char *temporary = file_begin(target);
    write_text(temporary, "from the parent");
    pid_t child = fork();
    if (child == 0)
        exit(0);
    waitpid(child, NULL, 0);
    file_commit(temporary);
}

Test(base, file_not_committed_leaves_the_old_one_alone, .init = open_folder, .fini = remove_folder)
{
    write_text(target, "old");
    cr_assert_eq(failure_of(begin_and_fail).status, 1, "fails");
    cr_assert_eq(count_files(), 1, "a failure removes what was begun");
    cr_assert_eq(failure_of(begin_and_end).status, 0, "ends");
    cr_assert_eq(count_files(), 1, "so does an end");
    cr_assert_eq(failure_of(begin_and_interrupt).status, -SIGINT, "still dies of the signal");
    cr_assert_eq(count_files(), 1, "so does an interrupt");
    cr_assert_eq(failure_of(begin_and_kill).status, -SIGKILL, "dies");
    cr_assert(holds(target, "old"), "not even a kill leaves half a file under the name");
    cr_assert_eq(failure_of(begin_and_fork).status, 0, "a child's end does not take its parent's file");
    cr_assert(holds(target, "from the parent"), "the parent commits");
}

Test(base, file_behind_a_link_is_replaced_not_the_link, .init = open_folder, .fini = remove_folder)
{
    write_text(target, "old");
    char link[80];
    snprintf(link, sizeof link, "%s/link.exr", folder);
    cr_assert_eq(symlink(target, link), 0, "a link can be made");
    const char *temporary = file_begin(link);
    write_text(temporary, "new");
    file_commit(temporary);
    struct stat status;
    cr_assert(lstat(link, &status) == 0 && S_ISLNK(status.st_mode), "still a link");
    cr_assert(holds(target, "new"), "the file behind it is new");
}

static void begin_in_no_folder(void)
{
    file_begin("/no/such/folder/picture.png");
}
static void begin_on_a_folder(void)
{
    file_begin(folder);
}
static void commit_what_is_gone(void)
{
    const char *temporary = file_begin(target);
    unlink(temporary);
    file_commit(temporary);
}

Test(base, file_that_cannot_be_written_says_which_and_why, .init = open_folder, .fini = remove_folder)
{
    Failure missing = failure_of(begin_in_no_folder), is_folder = failure_of(begin_on_a_folder);
    cr_assert_eq(missing.status, 1, "%d", missing.status);
    cr_assert(failure_says(&missing, "/no/such/folder/picture.png: cannot be written: No such file"), "%s",
              missing.message);
    cr_assert_eq(is_folder.status, 1, "%d", is_folder.status);
    cr_assert(failure_says(&is_folder, folder), "%s", is_folder.message);
    Failure gone = failure_of(commit_what_is_gone);
    cr_assert_eq(gone.status, 1, "%d", gone.status);
    cr_assert(failure_says(&gone, target), "%s", gone.message);
}

Test(base, a_pipe_is_written_directly_though_it_has_no_path)
{
    int ends[2];
    cr_assert_eq(pipe(ends), 0);
    char *path = text_format("/proc/self/fd/%d", ends[1]), got[4] = "";
    const char *temporary = file_begin(path);
    FILE *file = fopen(temporary, "w");
    cr_assert(file && fputs("abc", file) >= 0 && fclose(file) == 0, "%s: %s", temporary, strerror(errno));
    file_commit(temporary);
    cr_assert_eq(read(ends[0], got, 3), 3);
    cr_assert_str_eq(got, "abc");
    free(path);
}

Test(base, device_is_written_not_replaced)
{
    struct stat before, after;
    cr_assert_eq(stat("/dev/full", &before), 0, "there is a /dev/full");
    const char *temporary = file_begin("/dev/full");
    cr_assert_str_eq(temporary, "/dev/full", "its writer must meet the error itself");
    FILE *file = fopen(temporary, "w");
    fputs("lost", file);
    cr_assert_neq(fclose(file), 0, "the full disk shows at the writer's close");
    file_commit(temporary);
    cr_assert(stat("/dev/full", &after) == 0 && S_ISCHR(after.st_mode) && before.st_ino == after.st_ino,
              "the device is still there");
}

Test(base, file_read_whole_or_null, .init = open_folder, .fini = remove_folder)
{
    size_t bytes = 0;
    FILE *file = fopen(target, "w");
    for (int i = 0; i < 100000; i++) // longer than any chunk
        fputc('a' + i % 26, file);
    fclose(file);
    char *text = file_read(target, &bytes);
    cr_assert_eq(bytes, 100000, "%zu bytes", bytes);
    cr_assert(text[99999] == 'a' + 99999 % 26 && text[100000] == '\0', "to its end, with a NUL");
    free(text);
    cr_assert_null(file_read("/no/such/file", NULL), "a missing file is NULL");
    cr_assert_eq(errno, ENOENT, "and errno says why");
    cr_assert_null(file_read(folder, NULL), "so is a folder");
    cr_assert_eq(errno, EISDIR, "and errno says why: %s", strerror(errno));
}

static void make_under_a_file(void)
{
    char *path = text_format("%s/below", target);
    folder_make(path);
}

Test(base, folder_with_parents, .init = open_folder)
{
    char *path = text_format("%s/a/b", folder);
    folder_make(path);
    folder_make(path); // twice is no error
    struct stat status;
    cr_assert(stat(path, &status) == 0 && S_ISDIR(status.st_mode), "%s", path);
    write_text(target, "a file");
    cr_assert_eq(failure_of(make_under_a_file).status, 1, "a file is no parent");
    rmdir(path);
    *strrchr(path, '/') = '\0';
    rmdir(path);
    free(path);
    remove_folder();
}

Test(base, hash_is_fnv_1a)
{
    // Test vectors of draft-eastlake-fnv: "", "a", "foobar".
    cr_assert_eq(hash_bytes(HASH_START, "", 0), UINT64_C(0xcbf29ce484222325), "empty");
    cr_assert_eq(hash_bytes(HASH_START, "a", 1), UINT64_C(0xaf63dc4c8601ec8c), "a");
    cr_assert_eq(hash_bytes(hash_bytes(HASH_START, "foo", 3), "bar", 3), UINT64_C(0x85944171f73967e8),
                 "in parts");
}
