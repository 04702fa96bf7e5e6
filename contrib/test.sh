#!/bin/bash
# Build all and run tests. Arguments go to ctest, e.g. contrib/test.sh -R contact
#   contrib/test.sh              all but the nightly ones: what continuous integration runs
#   contrib/test.sh --quick      unit tests of seconds and the checks of pages, for each edit: three minutes on two cores
#   contrib/test.sh --nightly    all
# TREAD_JOBS: compilers and tests at a time (default: the number of processors).
set -euo pipefail
cd "$(dirname "$0")/.."
. contrib/environment.sh

jobs=${TREAD_JOBS:-$(env -u OMP_NUM_THREADS nproc)}
case "${1:-}" in
  --quick) chosen=(-L quick); shift ;;
  --nightly) chosen=(); shift ;;
  '') chosen=(-LE nightly) ;;
  *) chosen=() ;; # by the arguments
esac

configure_release build
cmake --build build -j "$jobs"
# All that tests print is kept in build/Testing/Temporary/LastTest.log.
status=0
ctest --test-dir build --output-on-failure --test-output-size-passed 10000000 --no-tests=error -j "$jobs" "${chosen[@]}" "$@" || status=$?
if [ "$status" -ne 0 ]; then
  # What failed once more, alone: between the lines of all that passed it is hard to find.
  echo "What failed (all that tests print: build/Testing/Temporary/LastTest.log):"
  awk '/ Testing: /{test = $NF} / FAIL$|^(FAIL|ERROR): |^[A-Za-z.]*Error: /{print test ": " $0}' build/Testing/Temporary/LastTest.log
  exit "$status"
fi
