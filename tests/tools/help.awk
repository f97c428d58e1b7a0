# Print "target: … ## text" lines of a Makefile as a list.
BEGIN { print "make TARGET [VARIABLE=value]"; print "" }
match($0, /^[a-z_.-]+:/) && / ## / {
    target = substr($0, 1, RLENGTH - 1)
    sub(/^.* ## /, "")
    printf "  %-16s %s\n", target, $0
}
