#!/bin/sh
# Print compile_commands.json: compile_commands.sh 'CC FLAGS' 'CXX FLAGS' SOURCE…
set -eu
c=$1 cxx=$2
shift 2
escape() { printf '%s' "$1" | sed 's/[\\"]/\\&/g'; }
folder=$(escape "$PWD")
separator='['
for source in "$@"; do
    case $source in *.cpp) command=$cxx ;; *) command=$c ;; esac
    case $source in common/truth*) command="$command -DTRUTH_SOURCE_HASH='\"0\"'" ;; esac
    printf '%s\n{"directory": "%s", "file": "%s", "command": "%s -c %s"}' "$separator" "$folder" "$source" "$(escape "$command")" "$source"
    separator=,
done
printf '\n]\n'
