#!/bin/sh
# Measure a chapter and draw its figures: figures.sh BUILD CHAPTER. Writes figures.csv (error against run time), stability.csv and pictures/*.png beside the
# lesson. chapters/CHAPTER/figures.txt says how, a line each, fields separated by a tab:
#   sweep<TAB>options of the program          stability<TAB>options of the program
#   NAME.png<TAB>options of build/figure, such as --metric missing --scene bunny
set -u
build=$1 chapter=$2
folder=chapters/$chapter
list=$folder/figures.txt
[ -f "$list" ] || { echo "figures: $folder has no figures.txt"; exit 0; }
tab=$(printf '\t')
mkdir -p "$folder/pictures" || exit 1
while IFS=$tab read -r what options <&3; do
    case $what in
        '' | '#'*) continue ;;
        sweep) command="$build/$chapter $options --sweep $folder/figures.csv" ;;
        stability) command="$build/$chapter $options --stability $folder/stability.csv" ;;
        *.png) command="$build/figure $folder/figures.csv $options $folder/pictures/$what" ;;
        *) echo "figures: $list: sweep, stability or NAME.png begins a line, not $what" >&2; exit 1 ;;
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
