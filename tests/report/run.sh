#!/bin/sh
# Tests bench/report.py: its data, and its page in headless Chromium.
#
#   tests/report/run.sh [BUILD]    a Release build with Python's module; default build/release. Screenshots go
#                                  to build/report.
#
# Needs python3-numpy, python3-pil, python3-pytest, node, npm and chromium.
set -eu
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build/release}")
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT

PYTHONPATH=$build/python /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/report
/usr/bin/python3 tests/report/fixture.py "$room"
/usr/bin/python3 bench/report.py "$room" --build "$build"
node tests/report/page_check.mjs build/report/node_modules "$room/report.html" "$room" build/report
