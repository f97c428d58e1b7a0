#!/bin/sh
# Render a lesson's pictures: pictures.sh PROGRAM CHAPTER_FOLDER. The folder's pictures.txt has a line a picture, name.png<TAB>options of the program;
# a text that begins with build/ or for is a command instead, in which {} is the picture's path. At most 60 kB a picture.
set -u
program=$1 folder=$2
list=$folder/pictures.txt
[ -f "$list" ] || { echo "pictures: $folder has no pictures.txt"; exit 0; }
tab=$(printf '\t')
mkdir -p "$folder/pictures" || exit 1
while IFS=$tab read -r name options <&3; do
    case $name in '' | '#'*) continue ;; esac
    picture=$folder/pictures/$name
    case $options in
        build/* | for\ *) command=$(printf '%s' "$options" | sed "s,{},$picture,g") ;;
        *) command="$program $options --out $picture" ;;
    esac
    sh -c "$command" </dev/null || { echo "pictures: failed: $command" >&2; exit 1; }
    # Small: without metadata; where that does not do, 256 colours; where that does not do either, the picture must be rendered smaller.
    for how in "-strip" "-strip -colors 256" "-strip -colors 64"; do
        [ "$(wc -c <"$picture")" -gt 60000 ] || break
        # shellcheck disable=SC2086
        convert "$picture" $how -define png:compression-level=9 "$picture.small.png" && mv "$picture.small.png" "$picture" || exit 1
    done
    [ "$(wc -c <"$picture")" -le 60000 ] || { echo "pictures: $picture has more than 60 kB: give it a smaller --size" >&2; exit 1; }
    echo "  $picture $(wc -c <"$picture") bytes"
done 3<"$list"
