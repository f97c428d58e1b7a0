#!/bin/sh
# Measure a chapter and draw its figures: figures.sh BUILD CHAPTER. Writes figures.csv (error against run time), stability.csv and pictures/*.png beside the
# lesson. chapters/CHAPTER/figures.txt says how, a line each, fields separated by a tab:
#   sweep<TAB>options of the program          stability<TAB>options of the program
#   NAME.png<TAB>options of build/figure, such as --metric missing --scene bunny
#   passes<TAB>NAME.csv<TAB>options           what each pass costs, a row a line: its ms in the last of two frames (or as many as the options say) of --plan
#                                             along --path light, where everything is built anew and shaders are warm. Rows of one NAME.csv follow each other
#   speed<TAB>NAME.csv<TAB>SCENES<TAB>options
#                                             a sweep with these options of each of the scenes (BUILD/sweeps keeps them), and what build/speed makes of them all
#   table<TAB>NAME.csv<TAB>COMMAND            what the command prints
set -u
build=$1 chapter=$2
folder=chapters/$chapter
list=$folder/figures.txt
[ -f "$list" ] || { echo "figures: $folder has no figures.txt"; exit 0; }
tab=$(printf '\t')
mkdir -p "$folder/pictures" || exit 1
rows=$(mktemp) plan=$(mktemp)
trap 'rm -f "$rows" "$plan"' EXIT

# passes NAME.csv OPTIONS: one row more of that table. Its columns are the passes of all its rows, spaces written as _, as they come; machine: the sweep's.
passes()
{
    name=$1
    shift
    # shellcheck disable=SC2086,SC2048 # options are words
    timeout 120 "$build/$chapter" --path light --frames 2 $* --plan --json >"$plan" </dev/null || return
    settings=$(printf '%s\n' "$*" | awk '{ for (i = 1; i < NF; i++) if ($i == "--set") text = text (text == "" ? "" : ";") $(i + 1); print text }')
    jq -r --arg name "$name" --arg settings "$settings" \
        '.scene as $scene | ((.passes[] | [.name, .ms]), ["all", .total_ms]) | [$name, $scene, $settings, (.[0] | gsub(" "; "_")), .[1]] | @tsv' \
        "$plan" >>"$rows" || return
    {
        sed -n '/^#/!q; s/^# command: .*/# command: make figures/; p' "$folder/figures.csv"
        awk -F '\t' -v name="$name" '
            $1 == name {
                row = $2 "," $3
                if (!(row in seen)) { seen[row] = 1; order[++count] = row }
                if (!($4 in column)) { column[$4] = 1; pass[++passes] = $4 }
                ms[row, $4] = $5
            }
            END {
                printf "scene,settings"
                for (p = 1; p <= passes; p++) printf ",%s", pass[p]
                print ""
                for (r = 1; r <= count; r++) {
                    row = order[r]
                    printf "%s", row
                    for (p = 1; p <= passes; p++) printf (ms[row, pass[p]] > 0 ? ",%.4f" : ","), ms[row, pass[p]]
                    print ""
                }
            }' "$rows"
    } >"$folder/$name.tmp" && mv "$folder/$name.tmp" "$folder/$name"
}

# speed NAME.csv SCENES OPTIONS
speed()
{
    mkdir -p "$build/sweeps" || return
    made=
    for scene in $2; do
        sweep=$build/sweeps/${chapter}_${1%.csv}_$scene.csv
        echo "  $build/$chapter --scene $scene $3 --sweep $sweep"
        # shellcheck disable=SC2086 # options are words
        "$build/$chapter" --scene "$scene" $3 --sweep "$sweep" </dev/null || return
        made="$made $sweep"
    done
    # shellcheck disable=SC2086
    "$build/speed" $made "$folder/$1"
}

while IFS=$tab read -r what options <&3; do
    case $what in
        '' | '#'*) continue ;;
        passes)
            echo "  passes of $options"
            passes "${options%%"$tab"*}" "${options#*"$tab"}" || { echo "figures: failed: $options" >&2; exit 1; }
            continue
            ;;
        speed)
            rest=${options#*"$tab"}
            speed "${options%%"$tab"*}" "${rest%%"$tab"*}" "${rest#*"$tab"}" || { echo "figures: failed: $options" >&2; exit 1; }
            continue
            ;;
        table)
            command=${options#*"$tab"}
            echo "  $command"
            { sed -n "/^#/!q; s|^# command: .*|# command: $command|; p" "$folder/figures.csv"; sh -c "$command" </dev/null; } >"$folder/${options%%"$tab"*}" || { echo "figures: failed: $command" >&2; exit 1; }
            continue
            ;;
        sweep) command="$build/$chapter $options --sweep $folder/figures.csv" ;;
        stability) command="$build/$chapter $options --stability $folder/stability.csv" ;;
        *.png) command="$build/figure $folder/figures.csv $options $folder/pictures/$what" ;;
        *) echo "figures: $list: sweep, stability, passes, speed, table or NAME.png begins a line, not $what" >&2; exit 1 ;;
    esac
    echo "  $command"
    sh -c "$command" </dev/null || { echo "figures: failed: $command" >&2; exit 1; }
    # a figure of many curves: fewer colours, until it is as small as a lesson's pictures must be
    picture=$folder/pictures/$what
    for colors in 256 64 16; do
        [ "${what%.png}" != "$what" ] && [ "$(wc -c <"$picture")" -gt 60000 ] || break
        convert "$picture" -strip -colors $colors -define png:compression-level=9 "$picture.small.png" && mv "$picture.small.png" "$picture" || exit 1
    done
done 3<"$list"
