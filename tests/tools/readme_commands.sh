#!/bin/sh
# Run what the READMEs print: every line of a ```sh block that starts with build/, make or awk; each must end with status 0, or with N where the line
# ends in `# exit N`. A block marked ```console is for reading (installing, opening windows). readme_commands.sh FILE…
set -u
list=$(mktemp) log=$(mktemp)
trap 'rm -f "$list" "$log"' EXIT
awk '/^```/ { inside = ($0 == "```sh"); next } inside && !/^ *(#|$)/ { print FILENAME "\t" $0 }' "$@" | awk '!seen[$0]++' >"$list"
tab=$(printf '\t')
failed=0 number=0
while IFS=$tab read -r file command <&3; do
    number=$((number + 1))
    expected=$(printf '%s\n' "$command" | sed -n 's/.*# exit \([0-9]\)$/\1/p')
    HEADLESS=${HEADLESS:-osmesa} timeout 120 sh -c "unset DISPLAY WAYLAND_DISPLAY; $command" </dev/null >"$log" 2>&1
    got=$?
    if [ "$got" -ne "${expected:-0}" ]; then
        failed=$((failed + 1))
        echo "readme: $file: status $got instead of ${expected:-0}: $command" >&2
        tail -n 3 "$log" | sed 's/^/    /' >&2
    fi
done 3<"$list"
echo "readme: $((number - failed)) of $number commands do what they say"
[ "$failed" -eq 0 ]
