#!/bin/sh
# The files of solutions/ hold answer and stub: #ifdef SOLUTION … #else … #endif. This cuts them apart.
#   exercises.sh stubs TO [FROM]      a tree of stubs: what a student begins with
#   exercises.sh solutions TO [FROM]  a tree of solutions
#   exercises.sh wrong ID NAME TO     a tree of solutions with the mistake tests/mutants/exercises/ID/NAME.diff in it
#   exercises.sh update [FROM TO]     (make exercises) bring exercises/ up to date; a file that is not exactly an earlier stub is somebody's work and is
#                                     left alone, named, and the status is 1. tests/data/stubs.txt (of another TO: TO.stubs.txt) holds the checksum of
#                                     every stub ever made.
#   exercises.sh compare [FROM TO]    fail where exercises/ does not hold the stubs as they are made now
set -eu
fail() { echo "exercises: $*" >&2; exit 1; }
command -v unifdef >/dev/null || fail "unifdef is not installed; make deps-test installs it"

# cut -U|-D IN OUT. Text without C's comments and quotes is read as text. What unifdef leaves must not know the word any more.
cut_file()
{
    case $2 in *.txt) as_text=-t ;; *) as_text= ;; esac
    mkdir -p "$(dirname "$3")"
    # shellcheck disable=SC2086
    unifdef -x2 $as_text "$1SOLUTION" -o "$3" "$2" 2>"$3.log" || fail "$2: $(head -n 1 "$3.log")"
    rm -f "$3.log"
    if grep -n '^[ 	]*#.*SOLUTION' "$3" >&2; then fail "$2: a marker is left; write exactly #ifdef SOLUTION, #else, #endif"; fi
}
sources() { (cd "$1" && find . -type f ! -name '.*' | sed 's,^\./,,' | LC_ALL=C sort); }

tree() # -U|-D FROM TO
{
    rm -rf "$3"
    mkdir -p "$3"
    for file in $(sources "$2"); do cut_file "$1" "$2/$file" "$3/$file"; done
}

update() # FROM TO CHECKSUMS
{
    known=$3 new=$(mktemp)
    trap 'rm -f "$new"' EXIT
    mkdir -p "$2"
    [ -e "$known" ] || echo "# The checksum of every stub that make exercises has ever made: a file that has one holds no work of yours." >"$known"
    kept=0
    for file in $(sources "$1"); do
        cut_file -U "$1/$file" "$new"
        sum=$(sha1sum <"$new" | cut -c1-40)
        if [ -e "$2/$file" ] && ! cmp -s "$new" "$2/$file"; then
            there=$(sha1sum <"$2/$file" | cut -c1-40)
            if ! grep -qxF "$there  $file" "$known"; then
                echo "exercises: $2/$file: not a stub of ours, so it is your work and stays as it is (move it away to get the new stub)" >&2
                kept=$((kept + 1))
                continue
            fi
        fi
        grep -qxF "$sum  $file" "$known" || echo "$sum  $file" >>"$known"
        if ! cmp -s "$new" "$2/$file" 2>/dev/null; then
            mkdir -p "$(dirname "$2/$file")"
            cp "$new" "$2/$file.new" && chmod 644 "$2/$file.new" && mv "$2/$file.new" "$2/$file"
            echo "exercises: $2/$file: made"
        fi
    done
    [ "$kept" -eq 0 ]
}

compare() # FROM TO
{
    stubs=$(mktemp -d)
    trap 'rm -rf "$stubs"' EXIT
    tree -U "$1" "$stubs"
    stale=0
    for file in $(sources "$1"); do
        cmp -s "$stubs/$file" "$2/$file" || { echo "exercises: $2/$file: is not the stub of $1/$file; make exercises" >&2; stale=1; }
    done
    [ "$stale" -eq 0 ]
}

wrong() # ID NAME TO
{
    whole=$(mktemp -d) diff=tests/mutants/exercises/$1/$2.diff
    trap 'rm -rf "$whole"' EXIT
    [ -e "$diff" ] || fail "$diff: there is none"
    cp -R solutions "$whole"
    patch -d "$whole" -p1 -s -N -r - <"$diff" >"$whole/log" 2>&1 || fail "$diff: does not apply to solutions/: $(head -n 1 "$whole/log")"
    tree -D "$whole/solutions" "$3"
}

case ${1:-} in
stubs) tree -U "${3:-solutions}" "${2:?a folder to write}" ;;
solutions) tree -D "${3:-solutions}" "${2:?a folder to write}" ;;
wrong) wrong "${2:?an exercise}" "${3:?a mistake}" "${4:?a folder to write}" ;;
update) if [ $# -ge 3 ]; then update "$2" "$3" "$3.stubs.txt"; else update solutions exercises tests/data/stubs.txt; fi ;;
compare) compare "${2:-solutions}" "${3:-exercises}" ;;
*) fail "stubs TO, solutions TO, wrong ID NAME TO, update or compare is needed" ;;
esac
