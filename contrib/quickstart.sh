#!/bin/bash
# From a fresh clone to a first result: install what is missing, build the program and the half-space
# library (for contrib/contact-inp.py), roll a wheel over a smooth rail, draw the pictures.
# TREAD_JOBS: compilers and ranks at a time (default: the number of processors; ranks: at most 2).
set -euo pipefail
cd "$(dirname "$0")/.."
. contrib/environment.sh

results=results/smooth-rolling
jobs=${TREAD_JOBS:-$(env -u OMP_NUM_THREADS nproc)}

install_what_is_missing
echo "Building into build/ ..."
configure_release build
cmake --build build --target tread tread_half_space -j "$jobs"

launch=()
if [ "$jobs" -ge 2 ]; then
  launch=(mpirun -np 2 --use-hwthread-cpus --bind-to none)
fi
"${launch[@]}" build/source/tread prm/smooth-rolling.prm --output "$results"

contrib/plot/plot-run.py "$results" --contact contrib/contact-data/contact_F127_mu030_dx010.csv.gz
echo "For ParaView:"
ls "$results"/*.pvd
echo "Done in $((SECONDS / 60)) min $((SECONDS % 60)) s."
