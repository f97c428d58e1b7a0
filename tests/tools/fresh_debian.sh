#!/bin/sh
# The proof of the two commands: make a Debian 12 that has git, make and a C compiler and nothing else in FOLDER, clone this repository into it and run
# `make run` and `make test` there. As root: fresh_debian.sh FOLDER. COPY=1 takes the working tree as it is instead of a clone. The mirror, its keys and any proxy are
# this machine's own apt configuration. FOLDER is kept (a second run uses it again, with a new clone and what was installed); delete it when done.
set -eu
[ $# -eq 1 ] || { echo "fresh_debian.sh FOLDER" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "fresh_debian: root is needed for debootstrap and chroot" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "fresh_debian: the Debian package debootstrap is needed" >&2; exit 2; }
# In a mount name space of its own: whatever is mounted below goes with this process.
if [ -z "${IN_OWN_MOUNTS:-}" ]; then
    IN_OWN_MOUNTS=1 exec unshare --mount sh "$0" "$1"
fi
suite=bookworm
repository=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
root=$(cd "$1" && pwd)

# The sources that serve Debian itself; others of this machine are none of the test's business.
sources=$(grep -lE "^[^#]*\b$suite\b" /etc/apt/sources.list /etc/apt/sources.list.d/*.sources /etc/apt/sources.list.d/*.list 2>/dev/null |
    xargs -r grep -lE '/debian/?( |$)' || true)
[ -n "$sources" ] || { echo "fresh_debian: apt's sources of this machine name no mirror of $suite" >&2; exit 1; }
# shellcheck disable=SC2086
mirror=$(cat $sources | sed -nE 's,^(URIs:|deb( \[[^]]*\])?) *([a-z+]+://[^ ]*/debian/?)( .*)?$,\3,p' | head -n 1)
[ -n "$mirror" ] || { echo "fresh_debian: no mirror found in $sources" >&2; exit 1; }

if [ ! -x "$root/usr/bin/gcc" ]; then
    echo "fresh_debian: debootstrap $suite"
    debootstrap --variant=minbase --include=git,make,gcc,ca-certificates "$suite" "$root" "$mirror" >"$root.log" 2>&1 || { tail -n 5 "$root.log" >&2; exit 1; }
fi
rm -f "$root"/etc/apt/sources.list "$root"/etc/apt/sources.list.d/*
# shellcheck disable=SC2086
for file in $sources; do cp "$file" "$root$file"; done
for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/* /etc/apt/auth.conf /etc/apt/auth.conf.d/* /etc/apt/preferences.d/*; do
    if [ -f "$file" ] && { grep -qE 'Acquire|^machine|^Pin' "$file"; }; then mkdir -p "$root$(dirname "$file")" && cp "$file" "$root$file"; fi
done
cp -r /etc/apt/trusted.gpg.d /etc/apt/keyrings "$root/etc/apt/" 2>/dev/null || true
cp -r /usr/share/keyrings/. "$root/usr/share/keyrings/" 2>/dev/null || true
cp -L /etc/resolv.conf /etc/hosts "$root/etc/" 2>/dev/null || true
# This machine may trust a certificate of its own network.
mkdir -p "$root/etc/ssl/certs" && cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/" 2>/dev/null || true

mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/tmp"

rm -rf "$root/root/workbook"
if [ -n "${COPY:-}" ]; then
    mkdir "$root/root/workbook"
    tar -C "$repository" --exclude=./build --exclude=./out --exclude=./.git -cf - . | tar -C "$root/root/workbook" -xf -
else
    git clone -q --no-hardlinks "$repository" "$root/root/workbook"
fi

inside()
{
    # shellcheck disable=SC2154  # the proxies of this machine, where there are any
    chroot "$root" /usr/bin/env -i HOME=/root USER=root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM=dumb \
        ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} ${no_proxy:+no_proxy="$no_proxy"} \
        sh -c "cd /root/workbook && $1" </dev/null
}
status=0
for command in "make run" "make test"; do
    log=$root.$(echo "$command" | tr ' ' '_').log
    echo "fresh_debian: $command (log: $log)"
    begun=$(date +%s)
    if inside "$command" >"$log" 2>&1; then result=0; else result=$?; status=1; fi
    tail -n "${LINES_SHOWN:-6}" "$log"
    echo "fresh_debian: $command: exit status $result after $(($(date +%s) - begun)) s, installs included"
done
exit $status
