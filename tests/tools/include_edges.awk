# Fail where a file of common/ includes a module that the design's table does not allow, a chapter another chapter, or a shader another chapter's:
# awk -f include_edges.awk FILE… . base.h is allowed everywhere; a header that a module keeps to itself (run_internal.h) only in its module.
BEGIN {
    allowed["base"] = " "
    allowed["gl"] = " "
    allowed["shader"] = " gl "
    allowed["linear"] = " "
    allowed["image"] = " "
    allowed["scene"] = " linear "
    allowed["raster"] = " gl shader scene linear image "
    allowed["airlight"] = " gl shader scene linear image raster "
    allowed["truth"] = " scene linear image "
    allowed["measure"] = " image "
    allowed["exercise"] = " "
    allowed["run"] = " gl shader linear image scene raster truth measure "
    bad = 0
}
function base_name(path) { sub(/^.*\//, "", path); return path }
# The module of a file of common/: its name up to the first _ or .
function module(path) { path = base_name(path); sub(/[_.].*$/, "", path); return path }
function report(what) { printf "%s:%d: %s\n", FILENAME, FNR, what; bad = 1 }
# The chapter of a path such as chapters/01_voxelization/grid.c or shaders/01_voxelization/a.comp; "" for common.
function chapter(path) { if (!match(path, /[0-9][0-9]_[a-z0-9_]*/)) return ""; return substr(path, RSTART, RLENGTH) }

/^[ \t]*#[ \t]*include[ \t]*"/ {
    name = $0
    sub(/^[^"]*"/, "", name)
    sub(/".*$/, "", name)
    if (FILENAME ~ /(^|\/)common\/[^\/]*\.(c|cpp|h)$/) {
        mine = module(FILENAME)
        other = module(name)
        if (!(mine in allowed))
            report("module " mine " stands in no table: add it to include_edges.awk with what it may include")
        else if (other != mine && other != "base" && !index(allowed[mine], " " other " "))
            report(mine " may not include " name)
        else if (other != mine && name ~ /_internal\.h$/)
            report(name " belongs to " other " alone")
    } else {
        if (chapter(name) != "" && chapter(name) != chapter(FILENAME) && FILENAME !~ /(^|\/)tests\//)
            report("a chapter may not include another one's " name)
        if (name ~ /_internal\.h$/ && module(name) != module(FILENAME))
            report(name " belongs to its module alone")
        if (FILENAME ~ /(^|\/)shaders\/common\// && name !~ /^common\//)
            report("shaders/common may include shaders/common only, not " name)
    }
}
END { exit bad }
