#!/bin/sh
# Sizes that can be read: a file has at most 400 lines in all. Of code (blank lines and lines that are only comment are not counted, nor is the list of GL's
# names) gl and shader together have fewer than 600 lines, all of common/ without the scene generators fewer than 6600. line_counts.sh [FOLDER]
set -eu
cd "${1:-.}"
awk '
function base_name(path) { sub(/^.*\//, "", path); return path }
{ lines[FILENAME]++ }
!/^[ \t]*($|\/\/)/ { code[FILENAME]++ }
END {
    for (file in lines) {
        if (lines[file] > 400 && base_name(file) != "gl_functions.h") { print file ": " lines[file] " lines; a file has at most 400"; bad = 1 }
        if (file !~ /^common\//) continue
        name = base_name(file)
        if (name !~ /^scene_builtin/ && name != "gl_functions.h") common += code[file]
        if (name ~ /^(gl|shader)[_.]/ && name != "gl_functions.h") thin += code[file]
    }
    printf "lines of code: gl and shader %d of 599, common without scene generators %d of 6599\n", thin, common
    if (thin >= 600) { print "gl and shader have " thin " lines of code together; fewer than 600 are wanted"; bad = 1 }
    if (common >= 6600) { print "common has " common " lines of code; fewer than 6600 are wanted"; bad = 1 }
    exit bad
}' $(find common chapters shaders tests $(ls -d solutions 2>/dev/null || true) -type f \( -name '*.[ch]' -o -name '*.cpp' -o -name '*.sh' -o -name '*.awk' -o -name '*.glsl' -o -name '*.vert' \
    -o -name '*.geom' -o -name '*.frag' -o -name '*.comp' -o -name '*.tesc' -o -name '*.tese' \) | sort) </dev/null
