#!/bin/sh
# make report: run every chapter's sweep, stability table, plans and pictures at the limits, then write the page: report.sh BUILD OUT CHAPTERS NAME…
# Each row is a run of its own and a file of its own under OUT/rows/NAME-KEY/, written whole or not at all; KEY is a hash of the program, its shaders, the
# picture's size and the machine. So a run that was killed goes on where it stopped, and rows of another program are never mixed in.
#   QUICK=1: first scenes only, 128x128, 300 s in all; FULL=1: 512x512, no limit; else 256x256, 600 s a chapter. What does not fit is listed on the page, and the
#   next run goes on with it. REPORT_SECONDS sets another limit a chapter.
# CHAPTERS/NAME/report.txt tells what the programs cannot, a line each, fields parted by tabs:
#   family  NAME                                  techniques that share diagrams
#   brute   TECHNIQUE                             what every other is compared with
#   metric  NAME                                  metrics to draw (default: all)
#   same    KEY                                   a setting that poses another problem: techniques are compared at equal values of it only
#   order   TECHNIQUE METRIC EXPECTED [SCENE [REFERENCE]]   the order that theory expects; SCENE -: any
#   plan    OPTIONS                               a plan beside that of each default scene
#   full    OPTIONS                               the same under FULL=1 alone
#   limit   NAME OPTIONS                          a technique at its limit: all pairs of these pictures are compared (no comma in NAME), and with those of
#                                                 the family's other chapters
set -u -f
build=$1 out=$2 chapters=$3
shift 3
tab=$(printf '\t')
command -v jq >/dev/null && command -v gnuplot >/dev/null || { echo "report: jq and gnuplot are needed; make deps-book installs them" >&2; exit 1; }
size=256x256 seconds=600
if [ -n "${QUICK:-}" ]; then size=128x128 seconds=$((300 / ($# > 0 ? $# : 1))); fi
if [ -n "${FULL:-}" ]; then size=512x512 seconds=31536000; fi
seconds=${REPORT_SECONDS:-$seconds}
mkdir -p "$out" || exit 1
# One at a time. A row that a kill has left running holds the lock until it ends, so that it disturbs no measurement.
exec 9>"$out/.lock"
flock -n 9 || { echo "report: waiting for another make report (or its last row) to end" >&2; flock 9; }
trap 'echo "report: interrupted; make report goes on where it stopped" >&2; exit 130' INT TERM

# jobs: KIND<TAB>FILE<TAB>LABEL<TAB>OPTIONS, in the order of running: the first scene's sweep, the short tables, the other scenes' sweep.
jobs()
{
    awk -F '\t' -v quick="${QUICK:-}" -v full="${FULL:-}" '
        function name_of(text) { gsub(/[^A-Za-z0-9_]/, "-", text); return text }
        $1 == "default" && !(quick && scenes) { scene[++scenes] = $2 }
        FILENAME == ARGV[1] && $1 == "sweep" { row[++rows] = $2; technique[rows] = $3; own[rows] = $4; set[rows] = $5 }
        FILENAME == ARGV[1] && $1 == "stability" { case_row[++cases] = $2; case_name[cases] = $3 }
        FILENAME != ARGV[1] && ($1 == "plan" || ($1 == "full" && full)) { plan[++plans] = $2 }
        FILENAME != ARGV[1] && $1 == "limit" { limit[++limits] = $2; limit_set[limits] = $3 }
        function sweep(s, r) {
            for (r = 1; r <= rows; r++)
                if (own[r] == "-" || s == 1)
                    printf "sweep\tsweep-%s-%04d.csv\t%s %s %s\t%s--row %s\n", own[r] == "-" ? name_of(scene[s]) : name_of(own[r]), r,
                        technique[r], own[r] == "-" ? scene[s] : own[r], set[r], own[r] == "-" ? "--scene " scene[s] " " : "", row[r]
        }
        function plan_of(number, options) {
            printf "plan\tplan-%04d.csv\tplan %s\t%s\n", number, options, options
            printf "plan\tplan-%04d-everything.csv\tplan %s --everything\t%s --everything\n", number, options, options
        }
        END {
            sweep(1)
            for (c = 1; c <= cases; c++) printf "stability\tstability-%04d.csv\tstability %s\t--row %s\n", c, case_name[c], case_row[c]
            for (s = 1; s <= scenes; s++) plan_of(s, "--scene " scene[s])
            for (p = 1; p <= plans; p++) plan_of(scenes + p, plan[p])
            for (l = 1; l <= limits; l++) printf "limit\tlimit-%s.exr\tlimit %s\t%s\n", name_of(limit[l] " " limit_set[l]), limit[l], limit_set[l]
            for (s = 2; s <= scenes; s++) sweep(s)
        }' "$1" "$2"
}

# The rows of one plan: scene, options, everything, pass, ran, ms, skipped, of, counts, reason.
plan_rows='.scene as $scene | .passes[] | [$scene, $options, $everything, .name, .ran, .ms, .skipped, .of,
    (.counts | to_entries | map("\(.key)=\(.value)") | join(";")), .reason // ""] | @csv'

# work KIND FILE OPTIONS SECONDS: one row into FILE, whole or not at all.
work()
{
    into=$2 options=$3 limit=$4
    # shellcheck disable=SC2086 # options are words
    case $1 in
        sweep) timeout --foreground -k 5 "$limit" "$program" $options --size "$size" --sweep "$into" ;;
        stability)
            timeout --foreground -k 5 "$limit" "$program" $options --size "$size" --stability "$into"
            status=$?
            [ $status -eq 1 ] && [ -f "$into" ] || return $status # a case that fails has a row that says so
            ;;
        limit) timeout --foreground -k 5 "$limit" "$program" --size "$size" $options --out "$into" ;;
        plan)
            everything=no
            case " $options " in *' --everything '*) everything=yes ;; esac
            timeout --foreground -k 5 "$limit" "$program" --size "$size" $options --plan --json >"$into.json" || return
            jq -r --arg options "${options% --everything}" --arg everything $everything "$plan_rows" "$into.json" >"$into.tmp" && mv "$into.tmp" "$into"
            ;;
    esac
}

# table TO FILE…: the rows of many tables as one, with the comments of the first; the command is that of the whole.
table()
{
    to=$1
    shift
    [ $# -gt 0 ] || return 0
    {
        sed -n '/^#/!q; s/^# command: .*/# command: make report/; p' "$1"
        grep -v '^#' "$1" | head -n 1
        for part in "$@"; do grep -v '^#' "$part" | sed 1d; done
    } >"$to.tmp" && mv "$to.tmp" "$to"
}

failed=0 left=0 names=
for chapter in "$@"; do
    program=$build/$chapter folder=$out/$chapter told=$chapters/$chapter/report.txt
    mkdir -p "$folder" || exit 1
    [ -f "$told" ] || told=/dev/null
    if ! "$program" --list </dev/null >"$folder/list.txt"; then
        echo "report: $program --list failed" >&2
        failed=$((failed + 1))
        continue
    fi
    names="$names $chapter"
    key=$({
        cat "$program"
        find shaders/common "shaders/$chapter" -type f 2>/dev/null | LC_ALL=C sort | while read -r shader; do cat "$shader"; done
        echo "$size ${LP_NUM_THREADS:-} ${HEADLESS:-}"
        nproc
        sed -n '/^model name/{p;q}' /proc/cpuinfo
    } | sha1sum | cut -c1-12)
    rows=$out/rows/$chapter-$key
    mkdir -p "$rows" || exit 1
    jobs "$folder/list.txt" "$told" >"$rows/jobs.txt"
    count=$(grep -c . "$rows/jobs.txt") number=0
    begun=$(date +%s)
    : >"$rows/status.txt"
    : >"$rows/limits.txt"
    sweep='' stability='' plan='' limits=''
    while IFS=$tab read -r kind file label options <&3; do
        number=$((number + 1))
        spent=$(($(date +%s) - begun))
        if [ ! -f "$rows/$file" ]; then
            if [ $spent -ge "$seconds" ]; then
                left=$((left + 1))
                printf 'left\t%s\tthe %s s of this run are over; the next run goes on with it\n' "$label" "$seconds" >>"$rows/status.txt"
                continue
            fi
            printf '[%d/%d] %s: %s (%d s%s)\n' "$number" "$count" "$chapter" "$label" "$spent" "${FULL:- of at most $seconds}"
            work "$kind" "$rows/$file" "$options" $((seconds - spent)) </dev/null >"$rows/log.txt" 2>&1
            status=$?
            if [ $status -ne 0 ] || [ ! -f "$rows/$file" ]; then
                rm -f "$rows/$file"
                state=failed why="status $status: $(tail -n 1 "$rows/log.txt" | tr '\t' ' ')"
                if [ $status -eq 124 ] || [ $status -eq 137 ]; then
                    why="stopped after $((seconds - spent)) s"
                    # A row that had most of the time and did not end will not end next time either; one that came late will.
                    [ $((2 * spent)) -lt "$seconds" ] || state=left
                fi
                printf '%s\t%s\t%s\n' "$state" "$label" "$why" >>"$rows/status.txt"
                if [ $state = left ]; then left=$((left + 1)); else failed=$((failed + 1)); fi
                echo "report: $chapter: $label: $state: $why" >&2
                continue
            fi
        fi
        case $kind in
            sweep) sweep="$sweep $rows/$file" ;;
            stability) stability="$stability $rows/$file" ;;
            plan) plan="$plan $rows/$file" ;;
            limit) limits="$limits $rows/$file"; printf '%s\t%s\t%s\n' "${label#limit }" "$file" "$options" >>"$rows/limits.txt" ;;
        esac
    done 3<"$rows/jobs.txt"
    find "$folder" -maxdepth 1 -type f ! -name list.txt -delete # what an earlier run drew, perhaps at another size
    # shellcheck disable=SC2086
    cp "$rows/status.txt" "$rows/limits.txt" $limits "$folder" || exit 1
    # shellcheck disable=SC2086
    table "$folder/sweep.csv" $sweep
    # shellcheck disable=SC2086
    table "$folder/stability.csv" $stability
    if [ -n "$plan" ]; then
        # shellcheck disable=SC2086
        { echo scene,options,everything,pass,ran,ms,skipped,of,counts,reason; cat $plan; } >"$folder/plan.csv.tmp" && mv "$folder/plan.csv.tmp" "$folder/plan.csv"
    fi
done
[ -n "$names" ] || { echo "report: no chapter" >&2; exit 1; }
# shellcheck disable=SC2086
"$build/report" "$out" "$chapters" $names || exit 1
[ $left -eq 0 ] || echo "report: $left rows are left for the next run; the page lists them"
[ $failed -eq 0 ] || { echo "report: $failed rows could not be measured; the page lists them" >&2; exit 1; }
