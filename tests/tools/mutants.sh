#!/bin/sh
# Every diff of tests/mutants/code must turn the test that it names in its first line (`# must fail: suite/test`) red, and that test must be
# green without it: mutants.sh [DIFF…]. The tree itself is not touched:
#   build/mutants/whole  a copy of it, where the programs of those tests are built and each test is seen green once
#   build/mutants/one-N  a copy of that copy for each diff, so that a diff costs one file compiled and one program linked
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
cd "$root" || exit 1
[ $# -gt 0 ] || set -- tests/mutants/code/*.diff
[ -e "$1" ] || { echo "mutants: none in tests/mutants/code"; exit 0; }
mutants=$root/build/mutants whole=$root/build/mutants/whole
rm -rf "$mutants" && mkdir -p "$whole/build" || exit 1
# Objects of build/ come with their times, so that only what has changed since is compiled.
cp -a Makefile common chapters shaders tests "$whole" || exit 1
for part in exercises solutions; do if [ -d $part ]; then cp -a $part "$whole"; fi; done
for part in obj libcommon.a libtechniques.a libexercise.a flags members mesa-cache; do
    if [ -e "build/$part" ]; then cp -a "build/$part" "$whole/build/"; fi
done
unset MAKEFLAGS MFLAGS BUILD
unset WERROR # a mistake may well leave a variable unused: it is the test that must see it

# suite/test of a diff's first line; nothing where that does not name one.
named_by() { sed -n '1s/^# must fail: *\([^ /]*\/[^ ]*\) *$/\1/p' "$1"; }

# What to make for a test: its program; all chapters' programs too where it runs them. A macro may make a test: its suite then says the file.
targets_of()
{
    suite=${1%%/*} test=${1#*/}
    for form in "^(Parameterized)?Test\(${suite}, *${test}[,)]" "Test\(${suite}, *[a-z0-9_#]*[,)]"; do
        file=$(grep -lE "$form" tests/test_*.c tests/slow_*.c 2>/dev/null | head -n 1)
        [ -z "$file" ] || break
    done
    [ -n "$file" ] || file=tests/test_$suite.c
    echo "build/only/$(basename "$file" .c)"
    # it names the build folder, or includes a header that runs programs from there
    if grep -qsE 'BUILD|build/|(_plan|stability_table|report_files)\.h' "$file"; then echo all; fi
}

# verdict FOLDER SUITE/TEST LOG: runs that test there: green, red or what went wrong.
verdict()
{
    program=$(targets_of "$2" | head -n 1)
    if ! [ -x "$1/$program" ]; then echo "$program is not built, see $mutants/make.log"; return; fi
    (cd "$1" && BUILD=build MESA_SHADER_CACHE_DIR="$whole/build/mesa-cache" timeout -k 5 "${MUTANT_SECONDS:-120}" \
        "$program" --filter "$2" </dev/null >"$3" 2>&1)
    if [ $? -eq 124 ]; then echo "does not end"; return; fi
    # Not the XML report, which counts the tests that the filter leaves out, too.
    tested=$(sed -n 's/.*Synthesis: Tested: \([0-9]*\) .*/\1/p' "$3" | tail -n 1)
    passing=$(sed -n 's/.*Synthesis: .*| Passing: \([0-9]*\) |.*/\1/p' "$3" | tail -n 1)
    if [ "${tested:-0}" -lt 1 ]; then echo "no such test"
    elif [ "$passing" -eq "$tested" ]; then echo green
    else echo red
    fi
}

# judge NUMBER DIFF SUITE/TEST: red, or why it is not.
judge()
{
    one=$mutants/one-$1
    if [ -z "$3" ]; then echo "does not say '# must fail: suite/test' in its first line"; return; fi
    got=$(verdict "$whole" "$3" "$one.log")
    if [ "$got" != green ]; then echo "without it $3 is not green: $got"; return; fi
    cp -a "$whole" "$one" || { echo "the tree cannot be copied"; return; }
    (cd "$one" && patch -p1 -s -N -r -) <"$2" >"$one.log" 2>&1 || { echo "does not apply: $(head -n 1 "$one.log")"; return; }
    # shellcheck disable=SC2046 # a list of words
    (cd "$one" && make BUILD=build $(cd "$root" && targets_of "$3")) >"$one.log" 2>&1 ||
        { echo "does not build: $(grep -m 1 -E 'error|No rule' "$one.log")"; return; }
    verdict "$one" "$3" "$one.log"
}

report()
{
    named=$(named_by "$2")
    got=$(judge "$1" "$2" "$named")
    if [ "$got" = red ]; then
        echo "mutants: $2: $named is red, as it must be"
        echo "$2" >>"$mutants/found_out"
    else
        echo "mutants: $2: FAILED: $got" >&2
    fi
    rm -rf "$mutants/one-$1"
}

# A program that cannot be built is told of by each diff that needs it.
targets=$(for diff in "$@"; do named=$(named_by "$diff"); [ -z "$named" ] || targets_of "$named"; done | sort -u)
# shellcheck disable=SC2086
[ -z "$targets" ] || (cd "$whole" && make -k -j"$(nproc)" BUILD=build $targets) >"$mutants/make.log" 2>&1

number=0
: >"$mutants/found_out"
for diff in "$@"; do # as many at a time as there are cores
    number=$((number + 1))
    report $number "$diff" &
    if [ $((number % $(nproc))) -eq 0 ]; then wait; fi
done
wait
found=$(wc -l <"$mutants/found_out")
echo "mutants: $found of $number found out"
[ "$found" -eq "$number" ]
