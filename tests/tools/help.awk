# Print "target: … ## text" lines of a Makefile as a list, but for the targets named in `without`.
BEGIN { count = split(without, names, " "); for (i = 1; i <= count; i++) left_out[names[i]] = 1; print "make TARGET [VARIABLE=value]"; print "" }
match($0, /^[a-z_.-]+:/) && / ## / {
    target = substr($0, 1, RLENGTH - 1)
    if (target in left_out) next
    sub(/^.* ## /, "")
    printf "  %-16s %s\n", target, $0
}
