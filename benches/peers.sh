#!/usr/bin/env bash
# Compares the speed of this program with that of common alternatives, in one run: numpy and numba, matplotlib, and pylinkage. Both sides are the
# best of many short batches.
# They are installed into target/peers only; without Python the comparison is skipped.
#
#     benches/peers.sh            the atlas of Hrones and Nelson in every format, against matplotlib in one process
#     benches/peers.sh --full     also the images at 300 dpi, and the memory for ten times as many pages
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v python3 >/dev/null || ! python3 -c 'import venv' 2>/dev/null; then
    echo "python3 with venv is not installed: skipped" >&2
    exit 0
fi
place=target/peers
if ! "$place/venv/bin/python" -c 'import matplotlib, numba, numpy, pylinkage, scipy' 2>/dev/null; then
    python3 -m venv "$place/venv"
    if ! "$place/venv/bin/pip" install --quiet numpy matplotlib numba pylinkage scipy; then
        echo "the peers cannot be installed: skipped" >&2
        exit 0
    fi
fi
cargo build --release --locked
cargo bench --bench kernel --locked -- kernel >"$place/kernel.txt"
"$place/venv/bin/python" benches/peers.py "$@"
