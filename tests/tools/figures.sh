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
    # As in pictures.sh: a lesson's picture has at most 60 kB; lines and letters lose nothing by 64 colours.
    case $what in *.png)
        [ "$(wc -c <"$folder/pictures/$what")" -le 60000 ] || convert "$folder/pictures/$what" -strip -colors 64 -define png:compression-level=9 "$folder/pictures/$what" || exit 1 ;;
    esac
done 3<"$list"
