#!/bin/sh
# Fail where a sanitizer wrote a report into the folder: a leak does not fail a Criterion test by itself. sanitizer_logs.sh FOLDER
set -u
reports=$(find "$1" -type f -size +0c 2>/dev/null | sort)
if [ -n "$reports" ]; then
    for report in $reports; do
        echo "--- $report"
        sed -n 1,25p "$report"
    done >&2
    echo "sanitize: $(echo "$reports" | wc -l) reports in $1" >&2
    exit 1
fi
echo "sanitize: no report in $1"
