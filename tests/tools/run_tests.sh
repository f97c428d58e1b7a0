#!/bin/sh
# Run one Criterion program: run_tests.sh PROGRAM JUNIT.xml. Status 0 only when at least one test ran and all passed. The last lines are
# Criterion's synthesis and the place of the JUnit file; the synthesis is kept beside it for a run that ends with all of them.
set -u
program=$1 junit=$2
kept=${junit%.xml}.synthesis
log=${junit%.xml}.log
rm -f "$junit" "$kept"
# The whole run has a limit, since Criterion 2.4.1 heeds a test's own .timeout but not --timeout. Tests that pass are named in the log only.
timeout -k 10 "${TEST_SECONDS:-1200}" "$program" --xml="$junit" --verbose --color=never </dev/null 2>&1 | tee "$log" | sed -u '/^\[\(RUN \|PASS\|SKIP\)\]/d;/^\[----\] Criterion v/d;/^\[====\] Running/d'
# Not the program's exit status: a filter that matches nothing and a test that calls exit(0) end with 0 too. The report is judged.
count() { sed -n "s/.*<testsuites .*$1=\"\([0-9]*\)\".*/\1/p" "$junit" 2>/dev/null | head -n 1; }
tests=$(count tests) failures=$(count failures) errors=$(count errors)
synthesis=$(grep '^\[====\] Synthesis' "$log" | tail -n 1)
status=1
if [ -z "$tests" ] || [ -z "$synthesis" ]; then
    echo "run_tests: $program ended before it could report; see $log. Begun and not finished:" >&2
    awk '$1 == "[RUN" { run[$3] = 1 } $1 ~ /^\[(PASS|FAIL|SKIP)/ { sub(/:$/, "", $2); delete run[$2] } END { for (test in run) print "  " test }' "$log" >&2
elif [ "$tests" -eq 0 ]; then
    echo "run_tests: $program ran no test: that is a failure" >&2
elif [ "$failures" -ne 0 ] || [ "$errors" -ne 0 ]; then
    echo "run_tests: $((failures + errors)) of $tests tests did not pass" >&2
else
    # Both reports must agree; the JUnit count holds skipped tests too, and a run that skipped all of them ran none.
    passing=$(printf '%s\n' "$synthesis" | sed -n 's/.*Tested: \([1-9][0-9]*\) | Passing: \1 | Failing: 0 | Crashing: 0.*/\1/p')
    if [ -n "$passing" ]; then status=0; else echo "run_tests: $program: not every test passed, or none ran" >&2; fi
fi
{
    echo "$program: ${synthesis:-no synthesis: it did not finish}"
    echo "JUnit: $junit"
} | tee "$kept"
exit $status
