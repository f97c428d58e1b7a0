// course: the commands behind make next, progress, check, hint, solution, watch and record.
//   course [--tree DIR] [--build DIR] [--data DIR] [--out DIR] [--work DIR] [--solutions DIR] [--progress FILE] [--manifest FILE] COMMAND [ID]
#include "course.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static Course course_open(int argc, char **argv)
{
    const char *manifest = "exercises/manifest.json", *build = getenv("BUILD");
    Course course = {.tree = "exercises",
                     .build = build ? build : "build",
                     .data = "tests/data",
                     .out = "out",
                     .solutions = "solutions",
                     .progress_file = ".progress"};
    static const char *const names[] = {"tree",      "build",    "data",     "out",
                                        "solutions", "progress", "manifest", "work"};
    const char **values[] = {&course.tree,      &course.build,         &course.data, &course.out,
                             &course.solutions, &course.progress_file, &manifest,    &course.work};
    enum { COUNT = sizeof names / sizeof *names };
    struct option options[COUNT + 1] = {0};
    for (int i = 0; i < COUNT; i++)
        options[i] = (struct option){names[i], required_argument, NULL, i};
    for (int option; (option = getopt_long(argc, argv, "+", options, NULL)) != -1;) {
        if (option < 0 || option >= COUNT)
            exit(2); // getopt has said which
        *values[option] = optarg;
    }
    if (!course.work)
        course.work = text_format("%s/check", course.build); // lives as long as the program
    course.manifest = manifest_open(manifest, "tests/grade/manifest.schema.json");
    progress_read(&course);
    return course;
}

static const Entry *entry_named(const Course *course, const char *command, const char *id)
{
    const Entry *entry = id && *id ? manifest_find(&course->manifest, id) : progress_next(course);
    if (entry)
        return entry;
    if (!id || !*id)
        fail_request("make %s EX=…: every exercise passes, so say which one is meant", command);
    char *list = text_format("%s", "");
    for (int i = 0; i < course->manifest.count; i++) {
        char *longer = text_format("%s %s", list, course->manifest.entries[i].id);
        free(list);
        list = longer;
    }
    fail_request("EX=%s: no such exercise; there are%s", id, list);
}

int main(int argc, char **argv)
{
    umask(022); // children of root's are another user, who must read what is made here
    Course course = course_open(argc, argv);
    const char *command = optind < argc ? argv[optind] : "",
               *id = optind + 1 < argc ? argv[optind + 1] : NULL;
    static const struct {
        const char *name;
        int (*run)(Course *course, const Entry *entry);
    } of_one[] = {{"check", course_check}, {"hint", course_hint}, {"watch", course_watch}};
    int status = -1;
    for (size_t i = 0; i < sizeof of_one / sizeof *of_one; i++)
        if (!strcmp(command, of_one[i].name))
            status = of_one[i].run(&course, entry_named(&course, command, id));
    if (!strcmp(command, "next"))
        status = course_next(&course);
    else if (!strcmp(command, "progress"))
        status = course_progress(&course);
    else if (!strcmp(command, "solution"))
        status = course_solution(&course, entry_named(&course, command, id));
    else if (!strcmp(command, "record"))
        status = course_record(&course, entry_named(&course, command, id));
    if (status < 0)
        fail_request("'%s': next, progress, check, hint, solution, watch or record is needed", command);
    manifest_close(&course.manifest);
    json_decref(course.progress);
    return status;
}
