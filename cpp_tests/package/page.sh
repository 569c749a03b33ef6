#!/bin/sh
# Does what a page of the book says, as written, where ~/roundel is the installed tree.
# Blocks whose first line is a comment with a file's name are that file; then the blocks of commands run
# in order, but those that install. What they print has to hold the solution of the page's problem.
#
# usage: page.sh PAGE PREFIX WORK
set -eu
page=$1 prefix=$2 work=$3

rm -rf "$work"
mkdir -p "$work/home"
ln -s "$prefix" "$work/home/roundel"
cd "$work"
awk '
    /^```./ { inside = 1; first = 1; file = $0 == "```sh" ? "commands" ++count ".sh" : ""; next }
    /^```/ { inside = 0; next }
    inside && first && file == "" && /^(\/\/|#|\/\*) [A-Za-z]+\.[a-z]+( \*\/)?$/ { file = $2 }
    inside { first = 0 }
    inside && file != "" { print > file }
' "$page"

for commands in commands?.sh; do
    if ! grep -q 'cmake --install' "$commands"; then
        env HOME="$work/home" sh -eu "$commands"
    fi
done >output
cat output
grep -q '0\.2 0' output
