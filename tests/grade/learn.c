// learn: what to do next, how far one is, hints, and the solution of what has been solved. See course.h.
#include "course.h"

#include <stdlib.h>
#include <string.h>

static int solved_count(const Course *course)
{
    int count = 0;
    for (int i = 0; i < course->manifest.count; i++)
        count += progress_flag(course, &course->manifest.entries[i], "passes");
    return count;
}

static void say_bar_of(const Course *course)
{
    printf("  ");
    say_bar(solved_count(course), course->manifest.count);
    printf(" %d of %d solved\n", solved_count(course), course->manifest.count);
}

int course_next(const Course *course)
{
    const Entry *entry = progress_next(course);
    if (!entry) {
        say_bar_of(course);
        puts("  Nothing is left: every exercise here passes.");
        return 0;
    }
    printf("%s  %s\n", entry->id, entry->title);
    if (entry->kind == EXERCISE_PRACTICE)
        printf("%*spractice, no points, about %d minutes\n\n", 6, "", entry->minutes);
    else
        printf("%*s%s, %g points, about %d minutes\n\n", 6, "", entry_kind_name(entry), entry_points(entry),
               entry->minutes);
    say_wrapped(2, "Goal", entry->goal);
    for (int i = 0; i < entry->read_count; i++)
        say_wrapped(2, i ? " " : "Read", entry->read[i]);
    for (int i = 0; i < entry->file_count; i++) {
        char *path = course_path(course, entry, i);
        say_wrapped(2, i ? " " : "Open", path);
        free(path);
    }
    char *check =
        text_format("make check EX=%s    (make watch EX=%s checks whenever you save)", entry->id, entry->id);
    char *hint = text_format("make hint EX=%s     (%d of 3 read)", entry->id, progress_hints(course, entry));
    say_wrapped(2, "Check", check);
    say_wrapped(2, "Stuck?", hint);
    free(hint);
    free(check);
    putchar('\n');
    say_bar_of(course);
    return 0;
}

int course_progress(const Course *course)
{
    double points = 0, of = 0;
    for (int i = 0; i < course->manifest.count; i++) {
        const Entry *entry = &course->manifest.entries[i];
        bool passes = progress_flag(course, entry, "passes"), was = progress_flag(course, entry, "solved");
        int hints = progress_hints(course, entry);
        double worth = entry_points(entry);
        points += passes ? worth : 0;
        of += worth;
        printf("  %s %-6s%-37s %-9s",
               passes ? "[x]"
               : was  ? "[!]"
                      : "[ ]",
               entry->id, entry->title, entry_kind_name(entry));
        if (worth > 0)
            printf("%3g points", worth);
        else
            printf("%10s", "");
        printf(hints ? "  %d hint%s\n" : "\n", hints, hints > 1 ? "s" : "");
    }
    putchar('\n');
    say_bar_of(course);
    if (of > 0)
        printf("  %g of %g points\n", points, of);
    bool broken = false;
    for (int i = 0; i < course->manifest.count; i++) {
        const Entry *entry = &course->manifest.entries[i];
        broken =
            broken || (progress_flag(course, entry, "solved") && !progress_flag(course, entry, "passes"));
    }
    if (broken)
        puts("  [!] passed once and did not at the last check");
    return 0;
}

int course_hint(Course *course, const Entry *entry)
{
    static const char *const rungs[] = {"a nudge", "the idea", "the outline"};
    int read = progress_hints(course, entry), last = read < 3 ? read : 2;
    // One at a time; once all are read, all of them.
    printf("%s  %s\n\n", entry->id, entry->title);
    for (int i = read < 3 ? read : 0; i <= last; i++) {
        char *label = text_format("Hint %d", i + 1);
        say_wrapped(2, label, entry->hints[i]);
        free(label);
    }
    putchar('\n');
    if (last < 2)
        printf("  That was %s. The next one is %s: make hint EX=%s\n", rungs[last], rungs[last + 1],
               entry->id);
    else
        printf("  That was all: %s, %s and %s.\n", rungs[0], rungs[1], rungs[2]);
    progress_set_hints(course, entry, last + 1);
    progress_write(course);
    return 0;
}

// The answers between #ifdef SOLUTION and #else, each with the line before it and its place.
static void say_answers(const char *path, char *text)
{
    bool inside = false;
    char *before = NULL, *rest = text;
    for (char *line; (line = strsep(&rest, "\n"));) {
        if (!strncmp(line, "#ifdef SOLUTION", 15)) {
            inside = true;
            printf("  %s:\n", path);
            if (before && *before && !strpbrk(before, ";{}")) // a function's or condition's own line
                printf("    %s\n", before);
        } else if (!strncmp(line, "#else", 5) || !strncmp(line, "#endif", 6)) {
            inside = false;
        } else if (inside) {
            printf("    %s\n", line);
        }
        before = line;
    }
}

int course_solution(const Course *course, const Entry *entry)
{
    if (!progress_flag(course, entry, "solved")) {
        printf("%s is not solved yet. When make check EX=%s passes, our solution is yours to compare.\n",
               entry->id, entry->id);
        printf("Until then: make hint EX=%s\n", entry->id);
        return 1;
    }
    for (int i = 0; i < entry->file_count; i++) {
        char *path = text_format("%s/%s/%s", course->solutions, entry->folder, entry->files[i]);
        char *text = file_read(path, NULL);
        if (!text) {
            puts("This tree was handed out without solutions: ask for them where you have it from.");
            free(path);
            return 1;
        }
        say_answers(path, text);
        free(text);
        free(path);
    }
    return 0;
}
