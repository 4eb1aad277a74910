#!/bin/sh
# usage: abi_test.sh SOURCE_DIRECTORY
# abi_compare.sh tells what versions may be: on what the library was, changed in each way.
set -eu
cd "$1"
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
before=$room/before
sed '1s/.*/# 0.1.0/' scenes/library/abi.txt >"$before"
grep -q '^symbol raylane_version$' "$before"
grep -q '^member raylane::Bounds 12 upper raylane::Vec3$' "$before"
grep -q '^value raylane_status RAYLANE_OK 0$' "$before"
expect() { # 0 or 1, version: what $room/now may be
    status=0
    said=$(tests/abi_compare.sh "$before" "$room/now" "$2") || status=1
    [ "$status" -eq "$1" ] || { echo "$said: $3"; exit 1; }
}
cp "$before" "$room/now"
expect 0 0.1.0 same
sed '/^symbol raylane_version$/d' "$before" >"$room/now"
expect 1 0.1.1 "a symbol is gone"
expect 0 0.2.0 "a symbol is gone"
expect 0 1.0.0 "a symbol is gone"
sed 's/^member raylane::Bounds 12 /member raylane::Bounds 16 /' "$before" >"$room/now"
expect 1 0.1.0 "a member has moved"
sed 's/^value raylane_status RAYLANE_BAD_INPUT 2/value raylane_status RAYLANE_BAD_INPUT 3/' "$before" >"$room/now"
expect 1 0.1.0 "a value is another"
{ cat "$before"; echo "symbol raylane_more"; } >"$room/now"
expect 0 0.1.1 "a symbol is new"
# Behind 1.0 the second number is that of what is new, and the first of what is gone.
sed -i '1s/.*/# 1.2.0/' "$before"
expect 0 1.3.0 "a symbol is new"
sed '/^symbol raylane_version$/d' "$before" >"$room/now"
expect 1 1.3.0 "a symbol is gone"
expect 0 2.0.0 "a symbol is gone"
echo "versions are held to what binaries see"
