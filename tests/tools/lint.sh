#!/bin/sh
# make lint: everything that reads the code without running it. lint.sh FILE… (C and C++ files); goes through all checks before it fails.
set -u
missing=
for tool in clang-format clang-tidy cppcheck; do command -v $tool >/dev/null || missing="$missing $tool"; done
[ -z "$missing" ] || { echo "lint: not installed:$missing; make deps-test installs them" >&2; exit 1; }
failed=
check()
{
    name=$1
    shift
    if "$@"; then echo "lint: $name: good"; else echo "lint: $name: FAILED" >&2; failed="$failed $name"; fi
}
sources=
for file in "$@"; do case $file in *.h) ;; *) sources="$sources $file" ;; esac; done

check format clang-format --dry-run -Werror "$@"
# What a student begins with is cut from a file that is formatted, which does not make it so.
stubs() { rm -rf build/lint_stubs && sh tests/tools/exercises.sh stubs build/lint_stubs && find build/lint_stubs -name '*.[ch]' -exec clang-format --dry-run -Werror --style=file:.clang-format {} +; }
check stubs-format stubs
# shellcheck disable=SC2046
check include-edges awk -f tests/tools/include_edges.awk "$@" $(find shaders -type f)
check line-counts sh tests/tools/line_counts.sh
check unused sh tests/tools/unused.sh
# shellcheck disable=SC2086
check cppcheck cppcheck --quiet --error-exitcode=1 --std=c11 --enable=warning,performance,portability --inline-suppr -j2 '-D_Noreturn=__attribute__((noreturn))' -Icommon -D_GNU_SOURCE \
    --suppress=missingIncludeSystem --suppress=unknownMacro:tests/* --suppress=nullPointerRedundantCheck:tests/* --suppress=nullPointerRedundantCheck:*.cpp $sources
tidy() { printf '%s\n' $sources | xargs -P 2 -n 4 clang-tidy -p . --quiet 2>&1 | grep -vE '^[0-9]+ warnings? (generated|and)|^Suppressed|^Use -header-filter' >build/tidy.log; ! grep -E 'error:|warning:' build/tidy.log; }
mkdir -p build
# shellcheck disable=SC2086
check clang-tidy tidy
[ -z "$failed" ] || { echo "lint: failed:$failed" >&2; exit 1; }
