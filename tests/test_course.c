// The learner's loop: next, check, hint, solution, progress, watch; and what cuts stubs and hands out. Never the tree's own exercises/, which is a student's.
#include <criterion/criterion.h>

#include "base.h"
#include "support_course.h"

#include <stdlib.h>
#include <string.h>

enum { SECONDS = 60 };
TestSuite(course, .init = course_folder_make, .fini = course_folder_remove, .timeout = SECONDS);

// Fails unless the command ends so and says each of these.
#define EXPECT(status, command, ...)                                                                         \
    do {                                                                                                     \
        const char *said_ = course_says(status, command);                                                    \
        cr_assert(course_has(said_, (const char *const[]){__VA_ARGS__, NULL}), "%s says: %s", command,       \
                  said_);                                                                                    \
    } while (0)

// --- stubs and solutions

Test(course, each_file_of_solutions_is_one_exercise_s)
{
    EXPECT(0,
           "find solutions -type f | sed 's,^solutions/,,' | sort >$T/files\n"
           "jq -r '.exercises[] | .folder + \"/\" + .files[]' exercises/manifest.json | sort >$T/listed\n"
           "diff $T/files $T/listed && echo same",
           "same");
}

// What to read is "FILE.md: HEADING" (without its number) or "FILE: WORD"; anything else is plain words. A chapter that is not here cannot be asked.
Test(course, what_is_to_be_read_is_there)
{
    EXPECT(0,
           "jq -r '.exercises[].read[]' exercises/manifest.json >$T/read; grep '/' $T/read | grep -v 'the "
           "commands$' | while "
           "IFS= read -r line; do\n"
           "file=${line%%:*} what=${line#*: }\n"
           "[ \"$file\" != \"$line\" ] || { echo \"NO COLON: $line\"; continue; }\n"
           "[ -e \"$file\" ] || { case $file in chapters/*|shaders/*) ;; *) echo \"NO FILE: $line\" ;; esac; "
           "continue; }\n"
           "case $file in *.md) sed -n 's/^##* \\([0-9]*\\. \\)\\{0,1\\}//p' $file | grep -qxF \"$what\" ;; "
           "*) grep -qwF \"$what\" $file ;; esac || echo \"NOT THERE: $line\"\n"
           "echo asked\ndone >$T/asked; grep -q asked $T/asked && ! grep -v asked $T/asked && echo right",
           "right");
}

Test(course, a_marker_that_is_not_closed_is_named)
{
    course_write("from/01_a/open.c", "#ifdef SOLUTION\nint right;\n#else\nint wrong;\n");
    EXPECT(1, "sh tests/tools/exercises.sh stubs $T/to $T/from", "from/01_a/open.c", "Premature EOF");
    course_write("from/01_a/open.c", "#ifdef SOLUTION_\nint right;\n#endif\n");
    EXPECT(1, "sh tests/tools/exercises.sh stubs $T/to $T/from", "from/01_a/open.c", "marker");
}

Test(course, both_trees_are_cut_from_one_file)
{
    course_write("from/01_a/both.comp",
                 "int a;\n#ifdef SOLUTION\nint right;\n#else\nint wrong;\n#endif\nint b;\n");
    course_write("from/01_a/text.txt", "// it's a quote\n#ifdef SOLUTION\nx = 1\n#else\nx =\n#endif\n");
    EXPECT(0, "sh tests/tools/exercises.sh stubs $T/a $T/from && cat $T/a/01_a/*",
           "int a;\nint wrong;\nint b;\n// it's a quote\nx =\n");
    EXPECT(0, "sh tests/tools/exercises.sh solutions $T/b $T/from && cat $T/b/01_a/*",
           "int a;\nint right;\nint b;\n// it's a quote\nx = 1\n");
}

Test(course, a_student_s_work_is_never_overwritten)
{
#define UPDATE "sh tests/tools/exercises.sh update $T/from $T/to"
    const char *first = "#ifdef SOLUTION\nint right;\n#else\nint first;\n#endif\n";
    const char *second = "#ifdef SOLUTION\nint right;\n#else\nint second;\n#endif\n";
    course_write("from/01_a/one.c", first);
    course_write("from/01_a/two.c", first);
    EXPECT(0, UPDATE " && sh tests/tools/exercises.sh compare $T/from $T/to", "one.c: made", "two.c: made");
    // A student solves one; then both stubs change: the other is replaced, the solved one is named and stays to the last byte.
    course_write("to/01_a/one.c", "int mine;");
    course_write("from/01_a/one.c", second);
    course_write("from/01_a/two.c", second);
    EXPECT(1, UPDATE, "to/01_a/one.c", "stays", "two.c: made");
    EXPECT(0, "cat $T/to/01_a/one.c", "int mine;");
    EXPECT(0, "cat $T/to/01_a/two.c", "int second;");
    EXPECT(1, "sh tests/tools/exercises.sh compare $T/from $T/to", "one.c", "make exercises");
    // An old stub is no work, nor is a missing file.
    course_write("to/01_a/one.c", "int first;\n");
    EXPECT(0, UPDATE " && rm $T/to/01_a/two.c && " UPDATE, "one.c: made", "two.c: made");
    EXPECT(0, UPDATE " && sh tests/tools/exercises.sh compare $T/from $T/to && echo same", "same");
    // What was another file's stub is work here.
    course_write("from/01_a/two.c", "#ifdef SOLUTION\n#else\nint third;\n#endif\n");
    course_write("to/01_a/two.c", "int third;\nint first;\n");
    EXPECT(1, UPDATE, "two.c");
}

// --- the loop

Test(course, from_next_to_solved)
{
    course_tree("stubs");
    EXPECT(0, COURSE "next", "01.1  The dominant axis", "15 minutes", "Goal", "Read",
           "tree/01_voxelization/dominant_axis.c", "make check EX=01.1", "0 of ");
    EXPECT(1, COURSE "check", "01.1", "WRONG", "49 of 64 numbers are wrong", "triangle 0", "got 2, wanted 0",
           "its input: (", "because  an axis is", "0 of 3 checks pass", "make hint EX=01.1");
    EXPECT(1, COURSE "solution 01.1", "not solved yet");
    course_tree("solutions");
    EXPECT(0, COURSE "check 01.1", "ok       random", "01.1 is solved", "make solution EX=01.1",
           "Next: 01.2");
    EXPECT(0, COURSE "next", "01.2  A surface one voxel thick", "1 of ");
    EXPECT(0, COURSE "solution 01.1", "solutions/01_voxelization/dominant_axis.c", "vec3_cross");
    EXPECT(0, COURSE "progress", "[x] 01.1", "[ ] 01.2", "1 of ");
    // Broken again: it is the next one once more, and the solution stays earned.
    course_tree("stubs");
    EXPECT(1, COURSE "check 01.1", "WRONG");
    EXPECT(0, COURSE "progress", "[!] 01.1", "passed once");
    EXPECT(0, COURSE "next", "01.1  The dominant axis");
    EXPECT(0, COURSE "solution 01.1", "vec3_cross");
}

Test(course, hints_come_one_by_one_and_are_counted)
{
    course_tree("stubs");
    EXPECT(0, COURSE "hint 01.2", "Hint 1", "Forget the box", "a nudge");
    EXPECT(0, COURSE "hint 01.2", "Hint 2", "one side of");
    EXPECT(0, COURSE "progress", "2 hints");
    EXPECT(0, COURSE "hint 01.2", "Hint 3", "That was all");
    EXPECT(0, COURSE "hint 01.2", "Hint 3", "That was all");
    EXPECT(0, COURSE "progress", "3 hints");
    const char *first = course_says(0, COURSE "hint 01.3");
    cr_assert(!strstr(first, "Hint 2"), "%s", first);
}

Test(course, a_grid_comes_with_a_map_and_a_picture)
{
    course_tree("stubs");
    EXPECT(0, COURSE "check 01.2; test -s $T/out/01.2_oblique.png", "y=11  ", "- missing",
           "the layer z = ", "out/01.2_oblique.png");
}

Test(course, a_known_mistake_earns_its_sentence)
{
    EXPECT(1, "sh tests/tools/exercises.sh wrong 01.1 tie_to_the_first $T/tree && " COURSE "check 01.1",
           "WRONG    ties", "At a tie your first axis wins");
    EXPECT(1, "sh tests/tools/exercises.sh wrong 01.5 per_cent $T/tree && " COURSE "check 01.5",
           "you predicted 0.1", "These are per cent");
    course_tree("stubs");
    const char *stub = course_says(1, COURSE "check 01.1");
    cr_assert(!strstr(stub, "threshold"), "the stub is taken for a mistake: %s", stub);
}

// --- what a student meets on the way

static void put_stub(const char *file, const char *from, const char *to)
{
    char *command = text_format("sed -i 's/%s/%s/' $T/tree/01_voxelization/%s", from, to, file);
    course_tree("stubs");
    course_says(0, command);
    free(command);
}

Test(course, errors_stand_at_the_student_s_own_line)
{
    put_stub("dominant_axis.c", "return 2;", "return two;");
    EXPECT(1, COURSE "check 01.1", "does not compile", "01_voxelization/dominant_axis.c:17:12: error", "two");
    put_stub("nearest.comp", "winner.i. = -1.0;", "winner[i] = lost;");
    EXPECT(1, COURSE "check 01.4", "01_voxelization/nearest.comp:33: ", "lost");
    course_tree("stubs");
    EXPECT(1, "rm $T/tree/01_voxelization/winding.c; " COURSE "check 01.3", "winding.c is missing");
}

Test(course, a_program_that_crashes_or_writes_too_little_is_told_of)
{
    put_stub("winding.c", "(void)a, (void)b, (void)p;", "abort();");
    EXPECT(1, COURSE "check 01.3", "was ended by signal 6", "gdb", "01.3.given/simple.in");
    put_stub("winding.c", "windings, points)", "windings, points - 1)");
    EXPECT(1, COURSE "check 01.3", "its output has 252 bytes, not 256");
    put_stub("winding.c", "return 0;", "return -1000000; } int nan_(void) { return 0;");
    EXPECT(1, COURSE "check 01.3", "numbers are wrong");
}

Test(course, answers_come_with_a_prediction)
{
    course_tree("stubs");
#define FILE_OF "$T/tree/01_voxelization/what_resolution_buys.txt"
    EXPECT(1, COURSE "check 01.5",
           "what_resolution_buys.txt:13:", "\"predicted missing_32 =\" has no number yet");
    EXPECT(1, "sed -i 's/^missing_32 =/missing_32 = 0.7577/' " FILE_OF "; " COURSE "check 01.5",
           "\"predicted missing_32 =\" has no number");
    EXPECT(1,
           "sed -i 's/^predicted missing_32 =/predicted missing_32 = much/' " FILE_OF "; " COURSE
           "check 01.5",
           "is no number");
    EXPECT(1, "sed -i 's/= much/= 0.1 \\/\\/ a guess/' " FILE_OF "; " COURSE "check 01.5",
           "ok       missing_32", "you predicted 0.1");
}

Test(course, wrong_requests_say_what_would_be_right)
{
    course_tree("stubs");
    EXPECT(2, COURSE "check 01.9", "EX=01.9: no such exercise", "01.1 01.2");
    EXPECT(2, COURSE "chekc", "check, hint");
    course_write("progress", "{ half");
    EXPECT(1, COURSE "next", "progress:", "move it away");
    EXPECT(0, "cat $T/progress", "{ half");
}

Test(course, watch_checks_on_every_save)
{
    course_tree("stubs");
    EXPECT(0,
           COURSE "watch 01.1 >$T/log 2>&1 &\n"
                  "watch=$!\n"
                  "wait_for() { for i in $(seq 200); do [ \"$(grep -c Watching $T/log)\" -ge $1 ] && return; "
                  "sleep 0.1; done; false; }\n"
                  "wait_for 1 && cp $B/solutions/01_voxelization/dominant_axis.c $T/new.c\n"
                  "touch $T/tree/01_voxelization/another.c\n" // no concern of this exercise
                  "mv $T/new.c $T/tree/01_voxelization/dominant_axis.c && wait_for 2\n" // as an editor saves
                  "kill $watch; wait $watch 2>/dev/null; grep -c Watching $T/log; cat $T/log",
           "2\n01.1", "0 of 3 checks pass", "01.1 is solved");
}

// --- what is handed out

Test(course, a_handout_holds_no_answer)
{
    EXPECT(0, "sh tests/tools/handout.sh $T/all", "exercises; there: make next");
    EXPECT(0,
           "cd $T/all && ls -A && ! find . -name .git -o -name solutions -o -name mutants -o -path "
           "'./tests/grade/judge*' "
           "-o -name grade.c | grep . && "
           "! grep -rl 'ifdef SOLUTION' . --include='*.c' --include='*.comp' --include='*.txt' | grep -v "
           "tests/ | grep .",
           "exercises\n", "Makefile\n");
    // Each line of each answer that says something and stands nowhere in what the chapters show anyway.
    EXPECT(0,
           "for file in solutions/*/*; do awk '/^#ifdef SOLUTION/ { inside = 1; next } /^#(else|endif)/ { "
           "inside = 0 } inside' $file; done |\n"
           "sed 's/^ *//; s/ *$//' | awk 'length($0) >= 12' | sort -u >$T/answers\n"
           "find chapters common shaders -type f | xargs cat | sed 's/^ *//; s/ *$//' | sort -u >$T/shown\n"
           "comm -23 $T/answers $T/shown >$T/secret\n"
           "find $T/all -type f ! -path '*/chapters/*' | xargs cat | sed 's/^ *//; s/ *$//' | sort -u "
           ">$T/given\n"
           "wc -l <$T/secret; comm -12 $T/secret $T/given | sed 's/^/LEAK: /' | tee $T/leaks; ! grep -q . "
           "$T/leaks && [ $(wc -l <$T/secret) -gt 40 ]",
           "");
    EXPECT(0,
           "sh tests/tools/handout.sh $T/two 01.2 01.4 && jq -c '[.exercises[] | .id, .builds_on]' "
           "$T/two/exercises/manifest.json; ls $T/two/exercises/*",
           "[\"01.2\",[],\"01.4\",[]]", "thin_surface.c", "nearest.comp");
    EXPECT(1, "sh tests/tools/handout.sh $T/two", "is there already");
    EXPECT(1, "sh tests/tools/handout.sh $T/three 01.77", "EX=01.77: no such exercise");
    EXPECT(1, "sh tests/tools/handout.sh", "DIR=folder is needed");
}

// Root's children are a user that may not enter a folder such as /root; and a clone made under umask 077 is for its owner alone.
Test(course, a_clone_in_a_closed_folder_can_be_worked_in)
{
    EXPECT(0,
           "mkdir $T/home && sh tests/tools/handout.sh $T/home/clone 01.1 01.3 01.4 && chmod 700 $T/home && "
           "chmod -R "
           "go= $T/home/clone",
           "3 exercises");
#define HOME "cd $T/home/clone && $B/course --build $B --work $T/home/clone/work --progress $T/progress "
    EXPECT(1, HOME "check 01.1", "0 of 3 checks pass");
    EXPECT(1,
           "sed -i 's/return 2;/return two;/' $T/home/clone/exercises/01_voxelization/dominant_axis.c; " HOME
           "check 01.1",
           "    exercises/01_voxelization/dominant_axis.c:17:12: error");
    EXPECT(0,
           "cp $B/solutions/01_voxelization/nearest.comp $T/home/clone/exercises/01_voxelization/ && " HOME
           "check 01.4",
           "01.4 is solved");
    // Nothing is left behind, and the command that it names can be run.
    EXPECT(0,
           "sed -i 's/(void)a, (void)b, (void)p;/abort();/' "
           "$T/home/clone/exercises/01_voxelization/winding.c; export TMPDIR=$T; " HOME
           "check 01.3 >$T/said; cat $T/said; $(sed -n 's/^ *\\(.*program .*in .*out\\)$/\\1/p' $T/said); [ "
           "$? = 134 ] && "
           "! ls -d $T/check_* 2>/dev/null",
           "was ended by signal 6");
}

// The commands work there, on the objects that are built here.
Test(course, a_handout_can_be_worked_in)
{
    EXPECT(0,
           "sh tests/tools/handout.sh $T/handout 01.1 01.4 && cp -R $B/stubs/01_voxelization/dominant_axis.c "
           "$T/keep.c",
           "2 exercises");
#define THERE "cd $T/handout && $B/course --build $B --work $T/work --progress $T/progress "
    EXPECT(0, THERE "next", "01.1", "exercises/01_voxelization/dominant_axis.c");
    EXPECT(1, THERE "check 01.4", "0 of 3 checks pass");
    EXPECT(0, THERE "hint 01.4", "Hint 1");
    EXPECT(0,
           "cp $B/solutions/01_voxelization/nearest.comp $T/handout/exercises/01_voxelization/ && " THERE
           "check 01.4",
           "01.4 is solved");
    EXPECT(1, THERE "solution 01.4", "handed out without solutions");
    EXPECT(1, "mv $T/handout/exercises/01_voxelization/dominant_axis.c $T; " THERE "check 01.1",
           "Take it from the tree");
    EXPECT(2, "cd $T/handout && make exercises", "make exercises needs solutions and tests", "make next");
    EXPECT(2, "cd $T/handout && make record EX=01.1 | wc -l; make record", "make record needs solutions");
    const char *help = course_says(0, "cd $T/handout && make help");
    cr_assert(strstr(help, "  check ") && !strstr(help, "  record "), "%s", help);
    EXPECT(0, THERE "progress", "[x] 01.4", "8 of 8 points");
}
