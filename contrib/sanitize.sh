#!/bin/bash
# Checks of memory and undefined behaviour while the program runs, and files that are wrong for all readers.
# Continuous integration runs `readers`.
#   contrib/sanitize.sh readers       in build/, of which only what reads is compiled anew: some minutes
#   contrib/sanitize.sh tests         unit tests of seconds, all in build-sanitize/ under the sanitizers
#   contrib/sanitize.sh scenes [WORD] each shipped scene for some steps, likewise; only those whose path has the word
#   contrib/sanitize.sh checkpoints   runs resumed from forged checkpoints, likewise
#   contrib/sanitize.sh threads       data races in the half-space library, in build-threads/: a minute
#   contrib/sanitize.sh llvm READER   the fuzzer of LLVM, in build-llvm/: needs clang-14 and libclang-rt-14-dev
#   contrib/sanitize.sh               readers, tests, scenes, checkpoints and threads
# Whatever is found ends with an exit status that is not 0. doc/dev/records/sanitizers.md says what is covered.
# TREAD_JOBS     compilers and tests at a time (default: the number of processors)
# TREAD_EFFORT   factor on the numbers of files (default 1); TREAD_SEED other files (default 1)
set -euo pipefail
cd "$(dirname "$0")/.."
. contrib/environment.sh

export TREAD_SEED=${TREAD_SEED:-1}
jobs=${TREAD_JOBS:-$(env -u OMP_NUM_THREADS nproc)}
effort=${TREAD_EFFORT:-1}

# Reader and number of files, the longest first.
readers=(
  "parameters 250" "supports 120" "settings 50" "scene 50" "defect 4000" "simpack 4000" "miniprof 4000" "batch 250"
  "archive 10000" "two-columns 4000" "map 10000" "slices 4000" "deviation 4000" "guidance 10000"
  "gmsh 6000" "abaqus 6000" "ls-dyna 6000"
)

tests=(
  reference_hertz reference_track reference_gap material_elastic material_plastic geometry_profiles geometry_slice_faults geometry_surfaces geometry_facet_surface
  bodies_shapes mesh_file mesh_profile_block mesh_whole_rail solid_patch solid_rotation solid_lanes solid_plastic contact_coulomb_solver
  contact_patch_test contact_momentum contact_incline dynamics_conservation dynamics_levels dynamics_cells track_ranks
  analysis_spectrum analysis_contact_patch checkpoint_members
)

check_readers()
{
  configure_release build
  cmake --build build -j "$jobs" --target fuzz_readers
  for reader in "${readers[@]}"; do
    set -- $reader
    echo "$1 $(($2 * effort)) $TREAD_SEED"
  done | xargs -P "$jobs" -L 1 bash -c 'build/tests/fuzz/fuzz_readers "$@" > /dev/null' bash
}

build_sanitized()
{
  cmake --preset sanitize > /dev/null
  cmake --build build-sanitize -j "$jobs" --target "$@"
}

check_tests()
{
  build_sanitized unit_tests reference_tests
  local any
  any=$(IFS='|' && echo "${tests[*]}")
  ctest --test-dir build-sanitize --output-on-failure --no-tests=error -j "$jobs" -R "^($any)(\.|\$)"
}

check_scenes()
{
  configure_release build
  cmake --build build -j "$jobs" --target tread
  build_sanitized tread
  tests/scenes/sanitized.py build-sanitize/source/tread "$@"
}

check_checkpoints()
{
  build_sanitized fuzz_checkpoint
  build-sanitize/tests/fuzz/fuzz_checkpoint $((100 * effort)) "$TREAD_SEED" > /dev/null
}

check_threads()
{
  cmake --preset threads > /dev/null
  cmake --build build-threads -j "$jobs" --target reference_tests
  TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1" build-threads/tests/reference_tests reference_threads
}

# The rest of the program is that of build/.
check_llvm()
{
  configure_release build
  cmake --build build -j "$jobs" --target tread
  cmake -S . -B build-llvm -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++-14 -DTREAD_FUZZ_REST="$PWD/build" > /dev/null
  cmake --build build-llvm -j "$jobs" --target fuzz_readers_llvm
  # What it finds of use is kept there, for the next time.
  mkdir -p "build-llvm/corpus/$1"
  TREAD_READER=$1 build-llvm/tests/fuzz/fuzz_readers_llvm -seed="$TREAD_SEED" -max_total_time=$((60 * effort)) -timeout=20 -max_len=20000 \
    -artifact_prefix=build-llvm/ "build-llvm/corpus/$1" "tests/fuzz/corpus/$1" > /dev/null
}

case ${1:-all} in
  readers | tests | scenes | checkpoints | threads | llvm) "check_$1" "${@:2}" ;;
  all)
    check_readers
    check_tests
    check_scenes
    check_checkpoints
    check_threads
    ;;
  *)
    sed -n '2,/^set/{/^#/p}' "$0" >&2
    exit 1
    ;;
esac
