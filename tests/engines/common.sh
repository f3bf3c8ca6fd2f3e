# shellcheck shell=bash
# What the tests of engines have in common; to be sourced with the name of the engine, at the root of the repository. Sets
#   folder: an empty folder, which is removed at the end
#   COUPLER_ATLAS: the program
#   manifest, SHARDS, TOP, BY: what the engine sweeps; a shard takes one or two seconds
# and makes the expected shards and their best in $folder/expected, one after the other; not those for a test of something else, with
# `no-shards` after its name.
set -euo pipefail
engine=$1

# Under CI=true the tests must run.
skip() {
    echo "skipped: $engine, for $1"
    [ "${CI:-}" != true ]
    exit
}

folder=$(mktemp -d)
clean_up=()
at_exit() {
    for command in "${clean_up[@]}"; do
        eval "$command" || true
    done
    # What has just been ended may still write there.
    rm -rf "$folder" || { sleep 1 && rm -rf "$folder"; }
}
trap at_exit EXIT

cargo build --release --locked --quiet
built=${CARGO_TARGET_DIR:-target}
COUPLER_ATLAS=$(realpath "$built/release/coupler-atlas")
export COUPLER_ATLAS SHARDS=8 TOP=30 BY=-straight_length

manifest=$folder/atlas.toml
cat > "$manifest" << 'MANIFEST'
[atlas]
title = "Four-bars"
[[family]]
id = "four-bars"
linkage = "four-bar"
sampling = { samples = 36 }
measures = ["straight_length", "length"]
where = "is_crank_rocker"
let = { crank = 1 }
grid = { frame = { from = 2, to = 5, count = 16 }, coupler = { from = 2, to = 5, count = 10 }, rocker = { from = 2, to = 5, count = 10 }, along = { from = -1, to = 2, count = 7 }, across = [0, 0.5, 1, 2] }
[[family]]
id = "watt"
linkage = "watt"
sampling = { samples = 36 }
grid = { p = [3, 4], r = [2, 2.5], a = [1, 1.5, 2] }
MANIFEST

if [ "${2:-}" != no-shards ]; then
    for ((shard = 0; shard < SHARDS; shard++)); do
        "$COUPLER_ATLAS" sweep "$manifest" --shard "$shard/$SHARDS" -o "$folder/expected" --no-points --top "$TOP" --by "$BY" --quiet
    done
    "$COUPLER_ATLAS" gather "$folder/expected" --toml "$folder/expected/best.toml" > "$folder/expected/best.csv"
    [ "$(wc -l < "$folder/expected/best.csv")" = $((TOP + 1)) ]
fi

# Compares shards and their best with the expected ones, byte for byte.
compare() {
    for file in best.csv best.toml; do
        cmp "$folder/expected/$file" "$1/$file"
    done
    for family in four-bars watt; do
        diff -r "$folder/expected/$family" "$1/$family"
    done
    echo "$engine: $2"
}

# Waits until a command succeeds, at most so many seconds.
wait_until() {
    local seconds=$1
    shift
    for ((tenth = 0; tenth < seconds * 10; tenth++)); do
        "$@" && return
        sleep 0.1
    done
    echo "$engine: waited $seconds s for: $*" >&2
    return 1
}

# The processes of the program that make a shard.
find_program() { pgrep -f "^$COUPLER_ATLAS sweep .*--shard $1/" > "$folder/pids"; }

# A virtual environment with the packages, in target, so that they are fetched once.
make_environment() {
    command -v python3 > /dev/null || skip "there is no python3 here"
    local place=$PWD/$built/engines/$engine
    case $built in /*) place=$built/engines/$engine ;; esac
    [ -x "$place/bin/python" ] || python3 -m venv "$place" > /dev/null 2>&1 || skip "python3 has no venv (on Debian: apt install python3-venv)"
    "$place/bin/python" -m pip install --quiet --disable-pip-version-check "$@" > "$folder/pip.log" 2>&1 || {
        tail -3 "$folder/pip.log"
        skip "$* cannot be fetched"
    }
    # For the script that sources this one.
    # shellcheck disable=SC2034
    python=$place/bin/python
}
