#!/bin/bash
# Install on Debian 12 what tread needs to be built, run, tested and plotted.
# Does nothing when all of it is there. Needs root or sudo.
# The output of apt goes to a log that is shown only on failure.
set -u

packages=(
  g++ cmake make git                   # build
  libdeal.ii-dev                       # mesh, octree, output; brings MPI, p4est, Trilinos
  libfftw3-dev                         # half-space solver
  nlohmann-json3-dev                   # summary.json
  libcli11-dev                         # command line
  openmpi-bin                          # mpirun
  python3 python3-numpy python3-matplotlib # pictures
  python3-venv python3-wheel           # an environment in which pip may install contrib/python
  python3-vtk9 python3-h5py            # tests read the files for ParaView and run.h5 back
  mypy                                 # the test python.source reads the Python code with it
  python3-sphinx python3-myst-parser python3-sphinx-rtd-theme # manual: contrib/manual.sh
)

fail()
{
  echo "install-debian.sh: $*" >&2
  exit 1
}

command -v apt-get > /dev/null || fail "apt-get is missing: this script is for Debian 12; install by hand: ${packages[*]}"

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "All ${#packages[@]} packages are installed."
  exit 0
fi

as_root=(env DEBIAN_FRONTEND=noninteractive)
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null || fail "must be run as root (sudo is not installed); missing: ${missing[*]}"
  as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
fi

log=$(mktemp) || fail "cannot write to ${TMPDIR:-/tmp}"
trap 'rm -f "$log"' EXIT

run()
{
  local what=$1
  shift
  if ! "${as_root[@]}" "$@" < /dev/null > "$log" 2>&1; then
    tail -n 15 "$log" >&2
    fail "$what failed (last lines above)"
  fi
}

echo "Installing ${missing[*]} ..."
run "apt-get update" apt-get update -q
run "apt-get install" apt-get install -q -y --no-install-recommends -o DPkg::Lock::Timeout=300 "${missing[@]}"
echo "Installed in $SECONDS s."
