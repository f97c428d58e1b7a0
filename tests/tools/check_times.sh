#!/bin/sh
# How long does make check take? check_times.sh SOLUTIONS: the course is handed out into a scratch folder, each solution is put there and checked as a
# student would: the first check of a fresh tree, which builds what checks need; each exercise's first, with no shader in the cache; and again, warm.
# Prints the table, and marks what is beyond 15 s the first time and 5 s warm; that is no failure, since a loaded machine is slower. A solution that does
# not pass there is one.
set -eu
solutions=$(realpath "${1:?a tree of solutions}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
chmod 755 "$folder"
sh tests/tools/handout.sh "$folder/tree" >/dev/null
cd "$folder/tree"
unset BUILD MAKEFLAGS MFLAGS MESA_SHADER_CACHE_DIR
cp -R "$solutions/." exercises/

# Seconds and seconds of processor time that a check took, as "1.3 0.5"; ends where the solution does not pass.
seconds()
{
    begin=$(date +%s%N)
    sh -c 'make check EX=$1; status=$?; times >"$2"; exit $status' sh "$1" "$folder/times" >"$folder/said" 2>&1 ||
        { cat "$folder/said"; echo "check_times: $1: the solution does not pass in a handout"; exit 1; } >&2
    end=$(date +%s%N)
    # times: the second line is of the children, as 0m1.23s, of the user and of the system.
    awk -v wall=$(((end - begin) / 1000000)) 'NR == 2 { split($0, t, /[ms ]+/); printf "%.1f %.1f", wall / 1000, t[1] * 60 + t[2] + t[3] * 60 + t[4] }' "$folder/times"
}
say() # LABEL FIRST CPU [WARM CPU]
{
    echo "$@" | awk '{ printf "  %-6s", $1
        printf "%6.1f s (%4.1f)", $2, $3
        if (NF > 3) printf "%8.1f s (%4.1f)", $4, $5
        if ($2 > 15) printf "   the first took more than 15 s"
        if (NF > 3 && $4 > 5) printf "   warm it took more than 5 s"
        print "" }'
}

ids=$(jq -r '.exercises[].id' exercises/manifest.json)
echo "check times on $(nproc) processors, load $(cut -d' ' -f1 /proc/loadavg); of a processor in brackets:"
fresh=$(seconds "$(echo "$ids" | head -n 1)")
# shellcheck disable=SC2086
say fresh $fresh
printf '  %-6s%8s%17s\n' '' first warm
for id in $ids; do
    rm -rf build/check build/mesa-cache
    first=$(seconds "$id")
    warm=$(seconds "$id")
    # shellcheck disable=SC2086
    say "$id" $first $warm
done
