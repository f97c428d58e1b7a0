#!/bin/sh
# make run: render every chapter headless and write a page that shows the pictures: render_all.sh BUILD OUT CHAPTER…
# Every step on a chapter's first default scene, the last step on its other ones, and the truth beside the last step where it takes seconds.
# OUT/NN_name/SCENE-STEP.png (a file's name without its folder and ending), OUT/index.html.
set -u
build=$1 out=$2
shift 2
tab=$(printf '\t')
mkdir -p "$out" || exit 1
page=$out/index.html.tmp
started=$(date +%s) pictures=0 failed=0
escape() { printf '%s' "$1" | sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }

cat >"$page" <<'END'
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>The Voxel Light Workbook: pictures</title>
<style>
  :root { color-scheme: light dark; --ink: #1d2126; --paper: #fbfaf7; --quiet: #6a717b; --line: #d9d6ce; }
  @media (prefers-color-scheme: dark) { :root { --ink: #e5e3dd; --paper: #17191c; --quiet: #979ca4; --line: #33373d; } }
  body { font: 16px/1.5 Georgia, serif; color: var(--ink); background: var(--paper); max-width: 76rem; margin: 3rem auto; padding: 0 1.5rem; }
  h1 { font-weight: normal; font-size: 2rem; margin: 0; }
  h2 { font-weight: normal; font-size: 1.4rem; margin: 3rem 0 0; padding-top: 1rem; border-top: 1px solid var(--line); }
  p { max-width: 44rem; }
  .pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.5rem; margin-top: 1rem; }
  figure { margin: 0; }
  img { width: 100%; height: auto; display: block; background: #000; }
  figcaption b { font-weight: bold; }
  figcaption { margin-top: .5rem; font-size: .95rem; }
  code, .error { font: 12px/1.4 ui-monospace, monospace; color: var(--quiet); display: block; overflow-wrap: anywhere; margin-top: .25rem; }
  a { color: inherit; }
  footer { margin-top: 3rem; color: var(--quiet); font-size: .85rem; }
</style>
<h1>The Voxel Light Workbook</h1>
<p>Each picture below was made just now, on this machine, by the command under it. Where a truth was computed for the same view, its picture stands
beside the technique's and the numbers say how far apart the two are.</p>
END

# picture CHAPTER FILE CAPTION OPTION…: one progress line, one figure.
picture()
{
    chapter=$1 file=$2 caption=$3
    shift 3
    begun=$(date +%s)
    command=$build/$chapter
    for word in "$@"; do
        case $word in *[!A-Za-z0-9_./,=:+-]*) word="'$word'" ;; esac
        command="$command $word"
    done
    if "$build/$chapter" "$@" </dev/null >"$out/log.tmp" 2>&1; then
        pictures=$((pictures + 1))
        echo "  $file  ($(($(date +%s) - begun)) s)"
        {
            printf '<figure><a href="%s"><img src="%s" alt="%s" loading="lazy"></a>' "${file#"$out"/}" "${file#"$out"/}" "$(basename "$file" .png)"
            printf '<figcaption>%s<code>%s</code>%s</figcaption></figure>\n' "$caption" "$(escape "$command")" "${error_line:-}"
        } >>"$page"
        return 0
    fi
    failed=$((failed + 1))
    echo "  $file  FAILED: $(tail -n 1 "$out/log.tmp")" >&2
    return 1
}

for chapter in "$@"; do
    mkdir -p "$out/$chapter"
    list=$out/$chapter/list.txt
    if ! "$build/$chapter" --list </dev/null >"$list"; then
        echo "make run: $build/$chapter --list failed" >&2
        failed=$((failed + 1))
        continue
    fi
    title=$(awk -F '\t' '$1 == "chapter" { print $3; exit }' "$list")
    echo "$chapter: $title"
    printf '<h2>%s: %s</h2>\n<div class="pictures">\n' "$(escape "${chapter%%_*}")" "$(escape "$title")" >>"$page"
    last=$(awk -F '\t' '$1 == "step" { name = $3 } END { print name }' "$list")
    number=0
    for scene in $(awk -F '\t' '$1 == "default" { print $2 }' "$list"); do
        number=$((number + 1))
        stem=${scene##*/} stem=$out/$chapter/${stem%.*} # a scene may be a file
        scene_shows=$(awk -F '\t' -v scene="$scene" '$1 == "scene" && $2 == scene { print $3; exit }' "$list")
        while IFS=$tab read -r kind index step shows <&3; do
            [ "$kind" = step ] || continue
            [ "$number" -eq 1 ] || [ "$step" = "$last" ] || continue
            file=$stem-$(printf '%s' "$step" | tr ' /' '--').png
            caption="<b>$(escape "$scene"), step $index: $(escape "$step").</b> $(escape "$shows")"
            if [ "$number" -gt 1 ]; then caption="<b>$(escape "$scene"): $(escape "$step").</b> $(escape "$scene_shows")"; fi
            error_line=
            if [ "$number" -eq 1 ] && [ "$step" = "$last" ] && [ -x "$build/compare" ]; then
                # Linear floats for the numbers; a chapter without a truth picture says so with status 2 and the page goes without.
                got=$stem-last.exr truth=$stem-truth.exr
                if timeout 60 "$build/$chapter" --scene "$scene" --out "$got" --truth "$truth" </dev/null >"$out/log.tmp" 2>&1 &&
                    numbers=$("$build/compare" "$got" "$truth" 2>/dev/null); then
                    numbers=$(printf '%s\n' "$numbers" | awk -F , 'NR == 1 { split($0, name) } NR == 2 { for (i = 3; i <= NF; i++) printf "%s %.3g  ", name[i], $i }')
                    error_line="<span class=\"error\">against the truth: $(escape "$numbers")</span>"
                fi
            fi
            picture "$chapter" "$file" "$caption" --scene "$scene" --step "$step" --out "$file" || continue
            if [ -n "$error_line" ]; then
                error_line=
                file=$stem-truth.png
                picture "$chapter" "$file" "<b>$(escape "$scene"): the truth.</b> The same view by an independent method." --scene "$scene" --truth "$file"
            fi
        done 3<"$list"
    done
    echo '</div>' >>"$page"
done
seconds=$(($(date +%s) - started))
cpu=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)
{
    printf '<footer>%s pictures in %s s, HEADLESS=%s, %s' "$pictures" "$seconds" "${HEADLESS:-osmesa}" "$(escape "${cpu:-unknown CPU}")"
    printf ', %s' "$(date -u +%Y-%m-%d)"
    echo '</footer></html>'
} >>"$page"
rm -f "$out/log.tmp"
mv "$page" "$out/index.html" || exit 1
echo "$pictures pictures in $seconds s. Look at them: open $out/index.html in a browser."
[ "$failed" -eq 0 ] || { echo "make run: $failed pictures could not be made" >&2; exit 1; }
[ "$pictures" -gt 0 ] || [ $# -eq 0 ] || { echo "make run: no picture was made" >&2; exit 1; }
