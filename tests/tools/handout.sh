#!/bin/sh
# make handout DIR=… [EX="01.1 01.2"]: what a student gets, into a new folder: the chapters, the stubs, and what runs and checks them. No history, no
# solutions, no mutants, no tests of the course's own, no graders: handout.sh FOLDER [ID…]
set -eu
fail() { echo "handout: $*" >&2; exit 1; }
to=${1:-}
[ -n "$to" ] || fail "DIR=folder is needed: where to write it"
[ ! -e "$to" ] || fail "$to: is there already; name a folder that is not"
shift
for tool in jq unifdef; do command -v $tool >/dev/null || fail "$tool is not installed; make deps-test installs it"; done
all=$(jq -r '.exercises[].id' exercises/manifest.json)
for id; do printf '%s\n' "$all" | grep -qxF "$id" || fail "EX=$id: no such exercise; there are $(echo $all)"; done
# shellcheck disable=SC2086
[ $# -gt 0 ] || set -- $all

new=$to.new
rm -rf "$new" && mkdir -p "$new/tests" "$new/exercises"
trap 'rm -rf "$new"' EXIT
cp -R Makefile README.md LICENSE Dockerfile .devcontainer .gitignore .clang-format chapters common shaders "$new"
# The learner's commands, with what they are made of, and the tools that make runs.
mkdir -p "$new/tests/grade" "$new/tests/tools" "$new/tests/data"
for file in tests/grade/*; do
    case ${file##*/} in grade.c | judge* | margins* | prove* | results* | submission*) ;; *) cp "$file" "$new/tests/grade" ;; esac
done
cp -R tests/triangle.c "$new/tests"
cp -R tests/data/triangle "$new/tests/data"
for tool in deps.sh packages.txt help.awk render_all.sh compare.c figure.c; do cp "tests/tools/$tool" "$new/tests/tools"; done
# The exercises that were asked for: their stubs, entries and recorded outputs.
ids=$(printf '%s\n' "$@" | jq -R . | jq -s .)
jq --argjson ids "$ids" '.exercises |= map(select(.id as $id | $ids | index($id)) | .builds_on |= map(select(. as $id | $ids | index($id))))' \
    exercises/manifest.json >"$new/exercises/manifest.json"
sh tests/tools/exercises.sh stubs "$new.stubs"
jq -r '.exercises[] | .folder + "/" + .files[]' "$new/exercises/manifest.json" | while read -r file; do
    mkdir -p "$new/exercises/$(dirname "$file")"
    cp "$new.stubs/$file" "$new/exercises/$file"
done
rm -rf "$new.stubs"
for id; do cp -R "tests/data/$id" "$new/tests/data"; done
mv "$new" "$to"
echo "handout: $to: $# exercises; there: make next"
