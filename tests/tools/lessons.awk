# Rewrite what stands between `<!-- listing: … -->` or `<!-- table: … -->` and `<!-- end -->` in one lesson; lessons.sh says the forms.
# awk -v lesson=chapters/NN_name/README.md -f lessons.awk LESSON prints the new text; a piece that cannot be made is an error (status 1).
function fail(what) { printf "%s:%d: %s\n", lesson, FNR, what > "/dev/stderr"; failed = 1 }
# For the shell: in single quotes, with every quote of its own closed, escaped and opened again.
function quoted(text) { gsub(/'/, "'\\''", text); return "'" text "'" }

# --- listings: the lines between //[NAME and its //], without markers of other pieces and without their common indentation
function listing(file, name, definitions,    source, line, depth, inside, n, lines, i, indent, least, first, last, link, kind, found) {
    if (system("test -f " quoted(file)) != 0) { fail("no such file: " file); return }
    source = definitions == "" ? "cat " quoted(file) : "unifdef -x2 " definitions " " quoted(file)
    n = depth = inside = found = 0
    if (name == "all") inside = found = 1
    while ((source | getline line) > 0) {
        if (line ~ /^[ \t]*\/\/\[/) {
            depth++
            sub(/^[ \t]*\/\/\[[ \t]*/, "", line)
            sub(/[ \t]+$/, "", line)
            if (line == name) { found = 1; inside = depth }
        } else if (line ~ /^[ \t]*\/\/\]/) {
            if (name != "all" && depth == inside) inside = 0
            depth--
        } else if (inside) {
            lines[++n] = line
        }
    }
    if (close(source) != 0) { fail("cannot read " file " by: " source); return }
    if (!found) { fail(file " has no //[" name); return }
    if (depth != 0) { fail(file ": //[ and //] do not pair up"); return }
    least = 1000; first = 0
    for (i = 1; i <= n; i++) if (lines[i] ~ /[^ \t]/) {
        match(lines[i], /^ */)
        if (RLENGTH < least && lines[i] !~ /^#/) least = RLENGTH # directives stand at the border whatever is around them
        if (!first) first = i
        last = i
    }
    if (!first) { fail(file ": //[" name " is empty"); return }
    link = lesson
    gsub(/[^\/]*\//, "../", link)
    sub(/[^\/]*$/, "", link)
    kind = file ~ /\.(c|h|cpp)$/ ? "c" : file ~ /\.(sh|awk)$/ ? "sh" : "glsl"
    printf "[`%s`](%s%s)%s\n\n```%s\n", file, link, file, definitions == "" ? "" : " (without what is left out for speed)", kind
    for (i = first; i <= last; i++) print lines[i] ~ /^#/ ? lines[i] : substr(lines[i], least + 1)
    print "```"
}

# --- tables: columns of a CSV file's rows that fit every condition, then the machine they were measured on
function csv_split(line, fields,    n, c, i, text, quote) {
    n = 1; text = ""; quote = 0
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (quote && c == "\"" && substr(line, i + 1, 1) == "\"") { text = text "\""; i++ }
        else if (c == "\"") quote = !quote
        else if (c == "," && !quote) { fields[n++] = text; text = "" }
        else text = text c
    }
    fields[n] = text
    return n
}
# A column by its name; settings.KEY is the value of KEY in the column `settings` (a=1;b=2).
function value(name,    parts, n, i) {
    if (name in column) return fields[column[name]]
    if (name ~ /^settings\./ && ("settings" in column)) {
        n = split(fields[column["settings"]], parts, ";")
        for (i = 1; i <= n; i++) if (index(parts[i], substr(name, 10) "=") == 1) return substr(parts[i], length(name) - 9 + 2)
        return ""
    }
    unknown = name
    return ""
}
function number_text(text) {
    if (text ~ /^-?[0-9.]+([eE][-+]?[0-9]+)?$/ && text ~ /[.eE]/) return sprintf("%.3g", text)
    return text
}
function table(file, names, conditions, condition_count,    path, line, n, i, wanted, count, rows, fits, part, wished, sort, machine, title, header) {
    path = lesson
    sub(/[^\/]*$/, "", path)
    path = path file
    if (system("test -f " quoted(path)) != 0) { fail("no such file: " path "; make figures writes it"); return }
    count = split(names, wanted, ",")
    split("", column)
    unknown = ""; n = rows = header = 0; machine = ""
    while ((getline line < path) > 0) {
        sub(/\r$/, "", line)
        if (line ~ /^#/) {
            sub(/^# */, "", line)
            if (line ~ /^(renderer|cpu|threads|date|commit|command):/) machine = machine (machine == "" ? "" : "; ") line
            continue
        }
        split("", fields)
        n = csv_split(line, fields)
        if (!header) {
            header = 1
            for (i = 1; i <= n; i++) column[fields[i]] = i
            for (i = 1; i <= count; i++) {
                title = wanted[i]
                value(title)
                sub(/^settings\./, "", title)
                gsub(/_/, " ", title)
                printf "%s %s ", i == 1 ? "|" : "", title
                printf "|"
            }
            print ""
            for (i = 1; i <= count; i++) printf "%s---|", i == 1 ? "|" : ""
            print ""
            continue
        }
        fits = 1
        for (i = 1; i <= condition_count; i++) {
            part = conditions[i]
            match(part, /!~|~|=/)
            wished = substr(part, RSTART + RLENGTH)
            sort = substr(part, RSTART, RLENGTH)
            part = value(substr(part, 1, RSTART - 1))
            if (sort == "=" ? part != wished : (part ~ wished) != (sort == "~")) fits = 0
        }
        if (!fits) continue
        rows++
        for (i = 1; i <= count; i++) printf "%s %s |", i == 1 ? "|" : "", number_text(value(wanted[i]))
        print ""
    }
    close(path)
    if (unknown != "") fail(path " has no column " unknown)
    if (!rows) fail(path " has no row for this table")
    if (machine != "") printf "\n<sub>%s</sub>\n", machine
}

/^<!-- (listing|table): .* -->[ \t]*$/ {
    if (skipping) fail("the piece above has no <!-- end -->")
    print
    $0 = substr($0, 6)
    sub(/ *-->[ \t]*$/, "")
    n = split($0, word, " ")
    if (word[1] == "listing:" && n >= 3) {
        definitions = ""
        for (i = 4; i <= n; i++) {
            if (word[i] !~ /^-[DU][A-Za-z0-9_=]+$/) fail("not -DNAME=VALUE or -UNAME: " word[i])
            else definitions = definitions (definitions == "" ? "" : " ") word[i]
        }
        listing(word[2], word[3], definitions)
    } else if (word[1] == "table:" && n >= 3 && (n == 3 || word[4] == "where")) {
        split("", conditions)
        for (i = 5; i <= n; i++) conditions[i - 4] = word[i]
        table(word[2], word[3], conditions, n > 4 ? n - 4 : 0)
    } else {
        fail("not a form that lessons.sh knows: " $0)
    }
    skipping = FNR
    next
}
/^<!-- end -->[ \t]*$/ {
    if (!skipping) fail("<!-- end --> without a beginning")
    skipping = 0
}
!skipping { print }
END {
    if (skipping) fail("the piece that begins in line " skipping " has no <!-- end -->")
    exit failed
}
