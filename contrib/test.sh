#!/bin/bash
# Build all and run the tests. Arguments go to ctest, e.g. contrib/test.sh -R contact
# TREAD_JOBS: compilers and tests at a time (default: the number of processors).
set -euo pipefail
cd "$(dirname "$0")/.."
. contrib/environment.sh

jobs=${TREAD_JOBS:-$(env -u OMP_NUM_THREADS nproc)}

configure_release build
cmake --build build -j "$jobs"
# All that tests print is kept in build/Testing/Temporary/LastTest.log.
ctest --test-dir build --output-on-failure --test-output-size-passed 10000000 --no-tests=error -j "$jobs" "$@"
