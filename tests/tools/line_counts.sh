#!/bin/sh
# The design's line counts: a file has at most 400 lines; gl and shader together fewer than 600 (the list of GL's names is data and not counted), all of
# common/ fewer than 3500 without the scene generators. line_counts.sh [FOLDER]
set -eu
cd "${1:-.}"
awk '
function base_name(path) { sub(/^.*\//, "", path); return path }
{ lines[FILENAME]++ }
END {
    for (file in lines) {
        if (lines[file] > 400 && base_name(file) != "gl_functions.h") { print file ": " lines[file] " lines; a file has at most 400"; bad = 1 }
        if (file !~ /^common\//) continue
        name = base_name(file)
        if (name !~ /^scene_builtin/) common += lines[file]
        if (name ~ /^(gl|shader)[_.]/ && name != "gl_functions.h") thin += lines[file]
    }
    printf "lines: gl and shader %d of 599, common without scene generators %d of 3499\n", thin, common
    if (thin >= 600) { print "gl and shader have " thin " lines together; fewer than 600 are wanted"; bad = 1 }
    if (common >= 3500) { print "common has " common " lines; fewer than 3500 are wanted"; bad = 1 }
    exit bad
}' $(find common chapters shaders tests -type f \( -name '*.[ch]' -o -name '*.cpp' -o -name '*.sh' -o -name '*.awk' -o -name '*.glsl' -o -name '*.vert' \
    -o -name '*.geom' -o -name '*.frag' -o -name '*.comp' -o -name '*.tesc' -o -name '*.tese' \) | sort) </dev/null
