#!/bin/sh
# Fail for what nothing uses: a shader that no C file opens and no shader includes, a public function of common/ or of a chapter's header that is called nowhere
# outside the file that defines it; and for GL's binding calls where direct state access has its own. unused.sh [FOLDER]
set -eu
cd "${1:-.}"
bad=0
c_files=$(find common chapters tests exercises solutions -name '*.[ch]' -o -name '*.cpp' 2>/dev/null | sort)
for shader in $(find shaders -type f | sort); do
    name=${shader#shaders/}
    # shellcheck disable=SC2086
    grep -qF "\"$name\"" $c_files $(find shaders -type f ! -path "$shader") 2>/dev/null || { echo "$shader: no program opens it, no shader includes it"; bad=1; }
done
words=$(mktemp)
trap 'rm -f "$words"' EXIT
# Every word followed by "(" (a call, definition or declaration) or taken as a value, a file a line.
# shellcheck disable=SC2086
awk '{ sub(/\/\/.*$/, ""); n = split($0, w, /[^A-Za-z0-9_]+/); for (i = 1; i <= n; i++) if (w[i] ~ /^[a-z]/ && !seen[FILENAME, w[i]]++) print w[i], FILENAME }' $c_files >"$words"
for header in $(find common chapters -name '*.h' ! -name '*_internal.h' ! -name gl_functions.h | sort); do
    # Declarations at the line's start that end a name with "("; static inline ones count too.
    for name in $(sed -n '/^[A-Za-z].*(/{/^typedef\|^#\|^BASE_NORETURN *$/!s/^[^(]*[ *]\([a-z][a-z0-9_]*\)(.*/\1/p;}' "$header" | sort -u); do
        stem=${header%.h}
        # Used: in any C file that does not belong to the module's own implementation, or inside it by more than its definition.
        uses=$(awk -v name="$name" -v stem="$stem" -v header="$header" '$1 == name && $2 != header && !($2 ~ "^" stem "(_[a-z_]*)?\\.(c|cpp)$") { n++ } END { print n + 0 }' "$words")
        if [ "$uses" -eq 0 ]; then
            # shellcheck disable=SC2086
            inside=$(cat "$header" "$stem".c "$stem"_*.c "$stem".cpp 2>/dev/null | sed 's,//.*,,' | grep -cw "$name" || true)
            [ "$inside" -gt 2 ] || { echo "$header: $name is used by nothing"; bad=1; }
        fi
    done
done
# Names whose direct-state-access twin exists; binding by name would disturb what another piece of code bound.
bound='Bind(Texture|Framebuffer|Renderbuffer|Buffer)\>|(Tex|Compressed)(Sub)?Image[123]D|TexStorage[123]D|TexParameter|GenTextures|GenBuffers|GenFramebuffers|GenVertexArrays|'
bound=$bound'[^d]Buffer(Sub)?Data\(|[^d]MapBuffer|FramebufferTexture[123]?D?\(|VertexAttribPointer|EnableVertexAttribArray|ActiveTexture|GenerateMipmap\(|ClearBuffer[a-z]*\(|CheckFramebufferStatus\('
# shellcheck disable=SC2086
if grep -nE "gl\.($bound)" $(find common chapters exercises solutions -name '*.[ch]' 2>/dev/null | sort) | grep -vE 'gl\.(BindFramebuffer\(|BindBuffer\(GL_DISPATCH_INDIRECT_BUFFER)'; then
    echo "use direct state access instead of the above"
    bad=1
fi
if [ -f common/gl_functions.h ] && grep -nE "^ *X\((Gen(Textures|Buffers|Framebuffers|VertexArrays)|BindTexture,|BindRenderbuffer|TexImage|TexParameter|VertexAttribPointer)" common/gl_functions.h; then
    bad=1
fi
exit $bad
