// The scripts of tests/tools: each finds the fault that it is there for, and the tree itself has none.
// Every test works in a temporary folder of its own; the scripts are run as they are, from the repository's root.
#include <criterion/criterion.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "base.h"

// Run by sh with $T set to the test's folder. The exit status; what it printed (both streams) in *printed, which the test's end frees.
static char folder[] = "/tmp/workbook_tools_XXXXXX";
static char *printed;

static int shell(const char *script)
{
    char *command = text_format("exec 2>&1; T=%s; ROOT=$PWD; %s", folder, script);
    FILE *pipe = popen(command, "r");
    cr_assert_not_null(pipe, "no shell");
    size_t length = 0;
    free(printed);
    printed = memory_new(1, 1, "text");
    for (int c; (c = fgetc(pipe)) != EOF;) {
        printed = memory_grow(printed, length + 2, 1, "text");
        printed[length++] = (char)c;
        printed[length] = '\0';
    }
    int status = pclose(pipe);
    free(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void says(const char *what)
{
    cr_assert(strstr(printed, what) != NULL, "it should say: %s\nit says: %s", what, printed);
}

static void begin(void)
{
    cr_assert_not_null(mkdtemp(folder), "no temporary folder");
}

static void end(void)
{
    char *command = text_format("rm -rf %s", folder);
    cr_expect_eq(system(command), 0, "the temporary folder stays");
    free(command);
    free(printed);
    printed = NULL;
}

TestSuite(tools, .init = begin, .fini = end);

// --- the tree

Test(tools, lessons_show_what_the_code_is)
{
    int status = shell("sh tests/tools/lessons.sh check chapters/README.md chapters/*/README.md");
    cr_assert_eq(status, 0, "%s", printed);
}

Test(tools, modules_include_only_what_the_design_lets_them)
{
    int status = shell("awk -f tests/tools/include_edges.awk common/*.[ch] common/*.cpp chapters/*/*.[ch] "
                       "$(find shaders -type f)");
    cr_assert_eq(status, 0, "%s", printed);
}

Test(tools, files_and_modules_stay_small)
{
    int status = shell("sh tests/tools/line_counts.sh");
    cr_assert_eq(status, 0, "%s", printed);
}

// --- include edges

Test(tools, a_forbidden_include_is_found)
{
    int status = shell("mkdir -p $T/common; cd $T; printf '#include \"base.h\"\\n#include \"scene.h\"\\n' > "
                       "common/gl_extra.c;"
                       "awk -f $ROOT/tests/tools/include_edges.awk common/gl_extra.c");
    cr_assert_eq(status, 1, "gl includes scene and nothing is said");
    says("common/gl_extra.c:2: gl may not include scene.h");
}

Test(tools, a_module_without_a_place_in_the_table_is_found)
{
    int status = shell("mkdir -p $T/common; cd $T; printf '#include \"base.h\"\\n' > common/novel.c;"
                       "awk -f $ROOT/tests/tools/include_edges.awk common/novel.c");
    cr_assert_eq(status, 1, "a module that stands in no table passes");
}

Test(tools, a_chapter_that_includes_another_is_found)
{
    int status =
        shell("mkdir -p $T/chapters/02_b; cd $T; echo '#include \"../01_a/grid.h\"' > chapters/02_b/main.c;"
              "awk -f $ROOT/tests/tools/include_edges.awk chapters/02_b/main.c");
    cr_assert_eq(status, 1, "chapter 02 includes chapter 01 and nothing is said");
}

Test(tools, an_allowed_include_passes)
{
    int status = shell("mkdir -p $T/common; cd $T; printf '#include \"scene.h\"\\n#include \"base.h\"\\n' > "
                       "common/truth_more.c;"
                       "awk -f $ROOT/tests/tools/include_edges.awk common/truth_more.c");
    cr_assert_eq(status, 0, "truth may include scene: %s", printed);
}

// --- figures

Test(tools, a_figure_shows_the_rows_that_are_asked_for)
{
    const char *make =
        "F=$(cd $ROOT && realpath ${BUILD:-build})/figure; cd $T; { echo "
        "chapter,technique,scene,width,height,settings,ms_technique,ms_min,ms_max,ms_frame,reference,metric,"
        "error;"
        "for t in brute swift; do for r in truth converged; do echo 09_a,$t,box,8,8,n=1,2,1,3,2,$r,e,0.5; "
        "done; done; }"
        " >s.csv; figure() { $F s.csv --metric e \"$@\" $T/a.svg >$T/said 2>&1; };"
        "has() { grep -q \"$1\" a.svg || { echo no $1; exit 1; }; }; hasnt() { if grep -q \"$1\" a.svg; then "
        "echo $1; exit 1; fi; };"
        "figure; has 'brute, reference truth'; has 'swift, reference converged';"
        "figure --technique 's*'; has swift; hasnt brute;"
        "figure --reference truth; has brute; has swift; hasnt converged; hasnt 'reference truth';"
        "! figure --reference nobody && grep -q nobody said";
    cr_assert_eq(shell(make), 0, "%s", printed);
}

Test(tools, make_run_renders_scenes_that_are_files)
{
    const char *make =
        "cd $T; mkdir build; cat >build/09_a <<'END'\n#!/bin/sh\nif [ $1 = --list ]; then\n"
        "printf "
        "'chapter\\t09_a\\tA\\nstep\\t1\\tonly\\tall\\ndefault\\tbox\\ndefault\\tsome/where/a.gltf\\n'; "
        "exit; fi\n"
        "while [ $# -gt 1 ]; do [ $1 != --out ] || echo picture >$2; shift; done\nEND\n"
        "chmod +x build/09_a; sh $ROOT/tests/tools/render_all.sh build out 09_a && "
        "test -s out/09_a/box-only.png -a -s out/09_a/a-only.png && grep -q 09_a/a-only.png out/index.html";
    cr_assert_eq(shell(make), 0, "%s", printed);
}

// --- line counts: 400 is allowed, 401 is not

Test(tools, a_file_of_401_lines_is_found)
{
    const char *make =
        "mkdir -p $T/common $T/chapters $T/shaders $T/tests; yes '//' | head -n %d > $T/common/scene.c;"
        "sh tests/tools/line_counts.sh $T";
    char *at_limit = text_format(make, 400), *beyond = text_format(make, 401);
    cr_expect_eq(shell(at_limit), 0, "400 lines are allowed: %s", printed);
    cr_expect_eq(shell(beyond), 1, "401 lines pass");
    free(at_limit);
    free(beyond);
}

Test(tools, gl_and_shader_beyond_600_lines_of_code_are_found)
{
    const char *make =
        "mkdir -p $T/common $T/chapters $T/shaders $T/tests; { yes '// why'; } | head -n 50 > $T/common/gl.c;"
        "yes 'x;' | head -n 300 >> $T/common/gl.c; yes 'x;' | head -n %d > $T/common/shader.c;"
        "sh tests/tools/line_counts.sh $T";
    char *below = text_format(make, 299), *at = text_format(make, 300);
    cr_expect_eq(shell(below), 0, "599 lines of code and 50 of comment are allowed: %s", printed);
    cr_expect_eq(shell(at), 1, "600 lines of code pass");
    free(below);
    free(at);
}

Test(tools, common_beyond_6600_lines_of_code_is_found)
{
    const char *make =
        "mkdir -p $T/common $T/chapters $T/shaders $T/tests; cd $T; for i in $(seq 16); do yes 'x;' | head "
        "-n 399 "
        "> common/run_$i.c; done; yes 'x;' | head -n %d > common/run.c; yes 'x;' | head -n 400 > "
        "common/scene_builtin.c; sh $ROOT/tests/tools/line_counts.sh $T";
    char *below = text_format(make, 215), *at = text_format(make, 216); // 16 · 399 + 215 = 6599
    cr_expect_eq(shell(below), 0, "6599 lines of code and the scene generators are allowed: %s", printed);
    cr_expect_eq(shell(at), 1, "6600 lines of code pass");
    free(below);
    free(at);
}

// --- what nothing uses

Test(tools, unused_shaders_and_functions_are_found)
{
    int status =
        shell("mkdir -p $T/common $T/chapters $T/tests $T/shaders/common; cd $T; echo 'void b_lonely(void);' "
              "> common/b.h;"
              "echo '#include \"b.h\"\nvoid b_lonely(void) {}' > common/b.c; echo > shaders/common/left.frag;"
              "echo 'void f(void) { gl.BindTexture(1, 2); }' > common/c.c; sh $ROOT/tests/tools/unused.sh");
    cr_assert_eq(status, 1, "nothing was found");
    says("shaders/common/left.frag");
    says("b_lonely is used by nothing");
    says("gl.BindTexture");
}

Test(tools, used_shaders_and_functions_pass)
{
    int status = shell("mkdir -p $T/common $T/chapters $T/tests $T/shaders/common; cd $T; echo 'void "
                       "b_busy(void);' > common/b.h;"
                       "echo 'void b_busy(void) {}' > common/b.c; echo > shaders/common/right.frag;"
                       "echo 'void f(void) { b_busy(); open(\"common/right.frag\"); }' > common/c.c; sh "
                       "$ROOT/tests/tools/unused.sh");
    cr_assert_eq(status, 0, "%s", printed);
}

// --- lessons

#define LESSON                                                                                               \
    "mkdir -p $T/chapters/01_x $T/shaders; cd $T; printf 'a\\n  //[piece\\n  kept();\\n#if !EVERYTHING\\n  " \
    "fast();\\n#endif\\n  //]\\nb\\n' > "                                                                    \
    "shaders/s.glsl; printf '# machine\\n# cpu: "                                                            \
    "C\\nname,settings,error\\nexact,n=64;m=1,0.12345\\nexact,n=32;m=1,7\\n' > chapters/01_x/f.csv;"         \
    "printf '%%s\\n' '<!-- listing: shaders/s.glsl piece -->' '<!-- end -->' '<!-- listing: shaders/s.glsl " \
    "piece -DEVERYTHING=1 -->' '<!-- end -->' "                                                              \
    "'<!-- table: f.csv name,settings.n,error where settings.n=64 -->' '<!-- end -->' > "                    \
    "chapters/01_x/README.md; "                                                                              \
    "L=\"sh $ROOT/tests/tools/lessons.sh\"; R=chapters/01_x/README.md; "

static char *lesson_script(const char *rest)
{
    return text_format(LESSON "%s", rest);
}

Test(tools, a_stale_listing_is_found_and_rewritten)
{
    char *script = lesson_script("$L check $R && exit 10; $L write $R || exit 11; $L check $R || exit 12;"
                                 "sed -i s/kept/changed/ shaders/s.glsl; $L check $R && exit 13; exit 0");
    cr_assert_eq(shell(script), 0,
                 "10: stale and not found, 11: not rewritten, 12: stale after rewriting, 13: a changed "
                 "source is not found:\n%s",
                 printed);
    free(script);
}

Test(tools, listings_are_cut_and_tables_are_read)
{
    char *script = lesson_script("$L write $R; cat $R; sed -i 's/settings.n=64/name~^e settings.n!~^6/' $R; "
                                 "$L write $R; cat $R");
    cr_assert_eq(shell(script), 0, "%s", printed);
    says("```glsl\nkept();\n#if !EVERYTHING\nfast();\n#endif\n```"); // markers and indentation are gone
    says("```glsl\nkept();\n```");                                   // and what is left out for speed
    says("| name | n | error |\n|---|---|---|\n| exact | 64 | 0.123 |\n\n<sub>cpu: C</sub>");
    says("|---|---|---|\n| exact | 32 | 7 |\n\n"); // by patterns
    free(script);
}

Test(tools, a_listing_that_cannot_be_cut_is_an_error)
{
    char *script = lesson_script("sed -i 's/\\[piece/[other/' shaders/s.glsl; $L write $R");
    cr_assert_eq(shell(script), 1, "a missing piece passes");
    says("README.md:1: shaders/s.glsl has no //[piece");
    free(script);
}

Test(tools, a_picture_that_is_missing_heavy_or_not_shown_is_found)
{
    char *script =
        lesson_script("$L write $R; echo '![x](pictures/a.png)' >> $R; $L check $R && exit 10; mkdir "
                      "chapters/01_x/pictures;"
                      "head -c 60000 /dev/zero > chapters/01_x/pictures/a.png; $L check $R || exit 11;"
                      "head -c 60001 /dev/zero > chapters/01_x/pictures/a.png; $L check $R && exit 12;"
                      "echo > chapters/01_x/pictures/a.png; echo > chapters/01_x/pictures/b.png; $L check $R "
                      "&& exit 13; exit 0");
    cr_assert_eq(shell(script), 0,
                 "10: missing passes, 11: 60 kB are refused, 12: more pass, 13: one not shown passes:\n%s",
                 printed);
    free(script);
}

// --- the runner: not the program's word, its report decides

#define PROGRAM(tests, failures, tested, passing)                                                            \
    "cat > $T/program <<'END'\n#!/bin/sh\nfor a in \"$@\"; do case $a in --xml=*) x=${a#--xml=};; esac; "    \
    "done\n"                                                                                                 \
    "echo '<testsuites name=\"Criterion Tests\" tests=\"" tests "\" failures=\"" failures                    \
    "\" errors=\"0\" disabled=\"0\">' > $x\n"                                                                \
    "echo '[====] Synthesis: Tested: " tested " | Passing: " passing " | Failing: " failures                 \
    " | Crashing: 0'\nEND\n"                                                                                 \
    "chmod +x $T/program; sh tests/tools/run_tests.sh $T/program $T/junit.xml"

Test(tools, a_run_that_passes_passes)
{
    cr_assert_eq(shell(PROGRAM("3", "0", "3", "3")), 0, "%s", printed);
    says("Synthesis: Tested: 3 | Passing: 3");
    says("/junit.xml\n");
}

Test(tools, a_run_without_a_test_is_a_failure)
{
    cr_assert_eq(shell(PROGRAM("0", "0", "0", "0")), 1, "no test ran and the status is 0");
}

Test(tools, a_failure_is_a_failure_whatever_the_exit_status)
{
    cr_assert_eq(shell(PROGRAM("3", "1", "3", "2")), 1, "one of three failed and the status is 0");
}

Test(tools, a_program_that_ends_early_is_a_failure)
{
    cr_assert_eq(shell("sh tests/tools/run_tests.sh true $T/junit.xml"), 1,
                 "a program that reports nothing passes");
}

Test(tools, a_sanitizer_report_is_a_failure)
{
    cr_assert_eq(shell("mkdir $T/log; sh tests/tools/sanitizer_logs.sh $T/log"), 0, "an empty folder: %s",
                 printed);
    cr_assert_eq(shell("echo leak > $T/log/report.1; sh tests/tools/sanitizer_logs.sh $T/log"), 1,
                 "a report passes");
}

// --- installing: stand-ins for dpkg-query and apt-get, so that nothing is installed

#define PACKAGE_TOOLS                                                                                        \
    "mkdir $T/bin; printf '#!/bin/sh\\nshift 3; for p; do case $p in libgsl-dev) ;; *) echo \"ii  $p\";; "   \
    "esac; done\\n' > $T/bin/dpkg-query;"                                                                    \
    "printf '#!/bin/sh\\necho apt-get \"$@\"\\n' > $T/bin/apt-get; printf '#!/bin/sh\\n' > "                 \
    "$T/bin/apt-cache;"                                                                                      \
    "printf '#!/bin/sh\\nexec \"$@\"\\n' > $T/bin/sudo; chmod +x $T/bin/*; PATH=$T/bin:$PATH; export PATH; "

Test(tools, deps_names_each_missing_package_and_why_before_it_installs_it)
{
    cr_assert_eq(shell(PACKAGE_TOOLS "sh tests/tools/deps.sh run"), 0, "%s", printed);
    says("libgsl-dev           statistics");
    const char *install = strstr(printed, "apt-get install");
    cr_assert(install && strstr(printed, "statistics") < install,
              "the reason comes before the installing: %s", printed);
    says("--no-install-recommends libgsl-dev\n"); // and nothing else is installed
}

Test(tools, deps_does_nothing_where_all_is_there)
{
    cr_assert_eq(shell(PACKAGE_TOOLS
                       "sed -i s/libgsl-dev/none/ $T/bin/dpkg-query; sh tests/tools/deps.sh run test book"),
                 0, "%s", printed);
    cr_assert_str_eq(printed, "", "it says something or installs something");
}

Test(tools, deps_elsewhere_than_on_debian_names_the_libraries)
{
    // A PATH with the few tools that the script itself needs, and a pkg-config that knows nothing.
    int status = shell("mkdir $T/bin; for tool in sh awk dirname cat grep; do ln -s \"$(command -v $tool)\" "
                       "$T/bin/$tool; done;"
                       "printf '#!/bin/sh\\nexit 1\\n' > $T/bin/pkg-config; chmod +x $T/bin/pkg-config; "
                       "PATH=$T/bin sh tests/tools/deps.sh run");
    cr_assert_eq(status, 1, "libraries are missing and it goes on: %s", printed);
    says("assimp");
    cr_assert_eq(
        shell("printf '#!/bin/sh\\nexit 0\\n' > $T/bin/pkg-config; PATH=$T/bin sh tests/tools/deps.sh run"),
        0, "all libraries are there and it stops: %s", printed);
}

// --- mutants: a small tree whose "compiler" is cp, with one test that sees a change of `value` and one that sees nothing

#define MUTANT_TREE                                                                                          \
    "mkdir -p $T/tests/tools $T/tests/mutants/code $T/common $T/chapters $T/shaders; cp "                    \
    "tests/tools/mutants.sh $T/tests/tools; cd $T;"                                                          \
    "printf 'build/only/%%: common/value\\n\\tmkdir -p build/only; cp tests/program "                        \
    "build/only/test_m\\n' > Makefile; echo 1 > common/value;"                                               \
    "printf 'Test(m, sees) {}\\nTest(m, blind) {}\\n' > tests/test_m.c;"                                     \
    "cat > tests/program <<'END'\n#!/bin/sh\npassing=1; [ \"$2\" = m/sees ] && [ \"$(cat common/value)\" "   \
    "!= 1 ] && passing=0\n"                                                                                  \
    "echo '<testsuites name=\"x\" tests=\"1\" failures=\"0\">' > one.xml\necho \"[====] Synthesis: Tested: " \
    "1 | Passing: $passing | Failing: 0\"\nEND\n"                                                            \
    "chmod +x tests/program; mutant() { printf '# must fail: %s\\n--- a/common/value\\n+++ "                 \
    "b/common/value\\n@@ -1 +1 @@\\n-%s\\n+2\\n' $1 $2 > "                                                   \
    "tests/mutants/code/$1.diff; }; mkdir tests/mutants/code/m; "

static int mutant(const char *test, const char *line)
{
    char *tree = text_format("%s", MUTANT_TREE),
         *script = text_format("%s mutant %s %s; sh tests/tools/mutants.sh tests/mutants/code/%s.diff", tree,
                               test, line, test);
    int status = shell(script);
    free(tree);
    free(script);
    return status;
}

Test(tools, a_mutant_that_its_test_sees_is_found_out)
{
    cr_assert_eq(mutant("m/sees", "1"), 0, "%s", printed);
    says("1 of 1 found out");
}

Test(tools, a_mutant_that_its_test_does_not_see_is_a_failure)
{
    cr_assert_eq(mutant("m/blind", "1"), 1, "%s", printed);
    says("FAILED: green");
}

Test(tools, a_mutant_that_does_not_apply_is_a_failure)
{
    cr_assert_eq(mutant("m/sees", "5"), 1, "%s", printed);
    says("does not apply");
}
