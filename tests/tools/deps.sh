#!/bin/sh
# Install the Debian packages of the named groups that are missing: deps.sh GROUP… (run, test, book; packages.txt says why each).
# Nothing happens when all are there. Elsewhere than on Debian it says which libraries are needed and goes on if pkg-config finds them.
set -eu
table=$(dirname "$0")/packages.txt
wanted=$(awk -F '\t' -v groups="$*" 'BEGIN { n = split(groups, g, " "); for (i = 1; i <= n; i++) in_group[g[i]] = 1 }
    !/^#/ && ($1 in in_group) && !seen[$2]++ { print $2 }' "$table")

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
    missing=
    for library in glfw3 OpenImageIO assimp gsl egl; do
        pkg-config --exists "$library" 2>/dev/null || missing="$missing $library"
    done
    case " $* " in *" test "*) pkg-config --exists criterion 2>/dev/null || missing="$missing criterion" ;; esac
    [ -z "$missing" ] && exit 0
    {
        echo "deps: this is no Debian, so nothing is installed. pkg-config does not find:$missing"
        echo "deps: install what follows by your own system's packages (the names are Debian 12's):"
        for package in $wanted; do
            awk -F '\t' -v package="$package" '$2 == package { printf "  %-20s %s\n", $2, $3; exit }' "$table"
        done
    } >&2
    exit 1
fi

# shellcheck disable=SC2086  # one argument a package is meant
installed=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' $wanted 2>/dev/null | awk '$1 == "ii" || $1 == "hi" { print $2 }' | sort -u)
missing=
for package in $wanted; do
    printf '%s\n' "$installed" | grep -qx "$package" || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

echo "These Debian packages are missing and will be installed by apt-get:"
for package in $missing; do
    awk -F '\t' -v package="$package" '$2 == package { printf "  %-20s %s\n", $2, $3; exit }' "$table"
done
as_root=
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 || {
        echo "deps: not root and there is no sudo. As root, run: apt-get install --no-install-recommends$missing" >&2
        exit 1
    }
    as_root=sudo
fi
# The package lists may be old or absent: fetch them, but where that fails what is already known may still do.
$as_root apt-get update -q </dev/null || echo "deps: apt-get update failed; trying with the lists that are there" >&2
known=
for package in $missing; do
    if apt-cache show "$package" >/dev/null 2>&1; then
        known="$known $package"
    else # a newer Debian without OSMesa, say: the build tells what it cannot do without
        echo "deps: apt-get knows no package $package: left out" >&2
    fi
done
[ -n "$known" ] || exit 1
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $known </dev/null
