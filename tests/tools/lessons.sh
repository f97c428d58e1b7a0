#!/bin/sh
# Bring the lessons in step with what they show: lessons.sh write|check FILE… ; check changes nothing and fails where a lesson is stale.
#
# In a lesson, between the marker and the next `<!-- end -->` stands what this script puts there:
#   <!-- listing: FILE NAME -->                 the lines of FILE (from the repository's root) between `//[NAME` and its `//]`; NAME all: the whole file
#   <!-- listing: FILE NAME -DEVERYTHING=1 -->  the same after `unifdef`, so that what is left out for speed does not clutter it
#   <!-- table: FILE.csv COLUMN,COLUMN -->      columns of a CSV file beside the lesson (settings.KEY is one of its settings), then its machine line
#   <!-- table: FILE.csv COLUMN,COLUMN where COLUMN=VALUE … -->   only the rows that fit; COLUMN~REGEX and
#                                               COLUMN!~REGEX: that match, that do not
# Also: every picture that a lesson shows exists and has at most 60 kB, and every picture that lies there is shown.
set -u
mode=${1:-}
[ $# -gt 1 ] || { echo "lessons.sh write|check FILE…" >&2; exit 2; }
shift
new=$(mktemp)
trap 'rm -f "$new"' EXIT
failed=0
for lesson in "$@"; do
    [ -f "$lesson" ] || { echo "lessons: $lesson: no such lesson" >&2; failed=1; continue; }
    if ! awk -v lesson="$lesson" -f "$(dirname "$0")/lessons.awk" "$lesson" >"$new"; then
        failed=1
    elif ! cmp -s "$new" "$lesson"; then
        if [ "$mode" = write ]; then
            cat "$new" >"$lesson" && echo "lessons: $lesson rewritten"
        else
            echo "lessons: $lesson is stale; make lessons rewrites it:" >&2
            diff "$lesson" "$new" | sed -n 1,10p >&2
            failed=1
        fi
    fi
    folder=$(dirname "$lesson")
    shown=$(grep -o '](pictures/[^) ]*' "$lesson" | sed 's/^](//' | sort -u)
    for picture in $shown; do
        if [ ! -f "$folder/$picture" ]; then
            echo "lessons: $lesson shows $picture, which is not there; make pictures or make figures makes it" >&2
            failed=1
        elif [ "$(wc -c <"$folder/$picture")" -gt 60000 ]; then
            echo "lessons: $folder/$picture has more than 60 kB" >&2
            failed=1
        fi
    done
    for picture in "$folder"/pictures/*; do
        [ -f "$picture" ] || continue
        printf '%s\n' "$shown" | grep -qxF "pictures/$(basename "$picture")" || { echo "lessons: $lesson does not show $picture" >&2; failed=1; }
    done
done
exit $failed
