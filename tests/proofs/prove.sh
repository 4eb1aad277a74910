#!/bin/sh
# prove.sh SOURCE_DIR SCRIPT: proves the goals of a Gappa script about the code that it mirrors.
#
# In a script's comments,
#   #: FILE      names the file of the code that follows;
#   #| CODE      must be in that file, white space aside. At @name@ the file has a number, which
#                replaces @name@ in the script.
#   #= CLAIM     begins a goal and its hints. All goals share the text before the first of them.
set -eu
sources=$1 script=$2
if ! command -v gappa >/dev/null; then
    echo "skipped: gappa is not installed"
    exit 77
fi
goals=$(mktemp -d)
trap 'rm -rf "$goals"' EXIT

awk -v sources="$sources" -v goals="$goals" '
function fail(message) {
    print FILENAME ": " message > "/dev/stderr"
    exit failed = 1
}
function bare(text) {
    gsub(/[ \t\r\n]/, "", text)
    return text
}
function open_source(name,    line, all) {
    all = ""
    while ((getline line < (sources "/" name)) > 0) {
        all = all line
    }
    close(sources "/" name)
    if (all == "") fail("cannot read " name)
    file = name
    code = bare(all)
}
# Takes the numbers between `pieces`, wherever these follow each other.
function find(pattern,    pieces, count, i, rest, found, taken, values) {
    count = split(pattern, pieces, "@")
    rest = code
    found = 0
    while ((start = index(rest, pieces[1])) > 0) {
        rest = substr(rest, start + length(pieces[1]))
        taken = rest
        for (i = 2; i < count; i += 2) {
            if (!match(taken, /^[0-9][0-9a-fx.]*(p[-+]?[0-9]+)?/)) break
            values[i] = substr(taken, 1, RLENGTH)
            taken = substr(taken, RLENGTH + 1)
            if (index(taken, pieces[i + 1]) != 1) break
            taken = substr(taken, length(pieces[i + 1]) + 1)
        }
        if (i < count) continue
        found = 1
        for (i = 2; i < count; i += 2) {
            if (pieces[i] in constants && constants[pieces[i]] != values[i])
                fail(pieces[i] " is " constants[pieces[i]] " and " values[i] " in " file)
            constants[pieces[i]] = values[i]
        }
    }
    if (!found) fail(file " no longer says " pattern)
}
{ lines[NR] = $0 }
/^#: / { open_source($2) }
/^#\| / { find(bare(substr($0, 4))) }
END {
    if (failed) exit 1
    for (n = 1; n <= NR; ++n) {
        line = lines[n]
        if (line ~ /^#= /) print substr(line, 4) > (goals "/" ++count ".claim")
        if (line ~ /^#/) continue
        for (name in constants) gsub("@" name "@", constants[name], line)
        if (count == 0)
            shared = shared line "\n"
        else
            goal[count] = goal[count] line "\n"
    }
    for (n = 1; n <= count; ++n) print shared goal[n] > (goals "/" n ".gappa")
    if (count == 0) fail("has no goals")
}' "$script"

failed=
for claim in "$goals"/*.claim; do
    if gappa -Wno-unbound-variable -Wno-null-denominator "${claim%.claim}.gappa"; then
        echo "proven: $(cat "$claim")"
    else
        echo "NOT PROVEN: $(cat "$claim")"
        failed=1
    fi
done
[ -z "$failed" ]
