// exercise: see exercise.h.
#include "exercise.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

Exercise exercise_open(int argc, char **argv)
{
    if (argc != 3)
        fail_request(
            "two arguments are needed: INPUT OUTPUT (make check writes the one and reads the other)");
    size_t bytes = 0;
    char *data = file_read(argv[1], &bytes);
    if (!data)
        fail_work("%s: %s", argv[1], strerror(errno));
    if (bytes % sizeof(float))
        fail_work("%s: %zu bytes are no whole number of float32", argv[1], bytes);
    Exercise exercise = {.count = bytes / sizeof(float), .output_file = argv[2]};
    exercise.input = memory_new(exercise.count, sizeof(float), "input");
    memcpy(exercise.input, data, bytes);
    free(data);
    return exercise;
}

int exercise_close(Exercise *exercise, const float *output, size_t count)
{
    const char *temporary = file_begin(exercise->output_file);
    FILE *file = fopen(temporary, "wb");
    bool written = file && fwrite(output, sizeof *output, count, file) == count;
    if (!file || fclose(file) || !written)
        fail_work("%s: cannot be written: %s", exercise->output_file, strerror(errno));
    file_commit(temporary);
    free(exercise->input);
    *exercise = (Exercise){0};
    return 0;
}

const char *exercise_folder(const char *source_file)
{
    static char folder[4096];
    const char *slash = strrchr(source_file, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - source_file) : 1,
             slash ? source_file : ".");
    return folder;
}
