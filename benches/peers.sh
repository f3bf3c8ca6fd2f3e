#!/usr/bin/env bash
# Measures this program beside what people use today, in one run: numpy with matplotlib, and pylinkage.
# They are installed into target/peers, and nowhere else; without Python there is nothing to compare with.
#
#     benches/peers.sh            the atlas of Hrones and Nelson in every format, against matplotlib in one process
#     benches/peers.sh --full     the images at 300 dpi too, and memory for ten times as many pages
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v python3 >/dev/null || ! python3 -c 'import venv' 2>/dev/null; then
    echo "python3 with venv is not there: the peers are not measured" >&2
    exit 0
fi
place=target/peers
if ! "$place/venv/bin/python" -c 'import matplotlib, numba, numpy, pylinkage' 2>/dev/null; then
    python3 -m venv "$place/venv"
    if ! "$place/venv/bin/pip" install --quiet numpy matplotlib numba pylinkage; then
        echo "the peers cannot be installed: they are not measured" >&2
        exit 0
    fi
fi
cargo build --release --locked
cargo bench --bench kernel --locked -- kernel >"$place/kernel.txt"
"$place/venv/bin/python" benches/peers.py "$@"
