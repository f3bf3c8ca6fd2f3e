#!/usr/bin/env bash
# Draws the first page of README.md with a program that was unpacked, installed or pulled, as someone would who has just read it: in an empty
# folder, with nothing of this machine's environment, no Rust among it:
#
#   tests/engines/newcomer.sh FOLDER COMMAND [ARGUMENT]…
#
# makes FOLDER, and runs there `COMMAND ARGUMENT… render mine.toml`.
set -euo pipefail
folder=$(realpath --canonicalize-missing "$1")
shift

fail() { echo "newcomer: $1" >&2; exit 1; }
mkdir "$folder"
sed -n '/^atlas\.title/,/^```/p' "$(dirname "$0")/../../README.md" | grep -v '^```' > "$folder/mine.toml"
[ "$(wc -l < "$folder/mine.toml")" -ge 4 ] || fail "README.md has no manifest to begin with"
cd "$folder"
began=$SECONDS
run=(env -i PATH=/usr/bin:/bin HOME="$folder/home" "$@")
! env -i PATH=/usr/bin:/bin sh -c 'command -v cargo || command -v rustc' > /dev/null || echo "newcomer: Debian's Rust is on this machine, and not used"
"${run[@]}" render mine.toml --quiet
for file in mine/mine/mine-001.svg mine/mine/mine-001.png mine/mine/cells.csv mine/index.html mine/run.json; do
    [ -s "$file" ] || fail "$* has not written $file"
done
[ "$(head -c 8 mine/mine/mine-001.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "mine-001.png is no picture"
"${run[@]}" check mine.toml --against mine > /dev/null || fail "the atlas is not what the program makes"
[ $((SECONDS - began)) -le 120 ] || fail "the first page took more than two minutes"
echo "newcomer: a page in $((SECONDS - began)) s, by ${1##*/}"
