# Sourced by quickstart.sh, test.sh and the tests on several ranks: settings for Open MPI and the libraries under deal.II.
# contrib/python/tread/runs.py has the same; the test python.package compares them.

# One thread a rank: the ranks are what uses the cores.
export DEAL_II_NUM_THREADS=1 OMP_NUM_THREADS=1

# Containers run as root, and often forbid the system call of single-copy messages.
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
export OMPI_MCA_btl_vader_single_copy_mechanism=none
# Open MPI looks 0.2 s for network cards that one machine has no use for; memory that the ranks share is fastest.
export OMPI_MCA_pml=ob1

# configure_release DIRECTORY: a Release build directory, kept if it is there.
configure_release()
{
  mkdir -p "$1" || return 1
  if ! cmake -S . -B "$1" -DCMAKE_BUILD_TYPE=Release > "$1/configure.log" 2>&1; then
    cat "$1/configure.log" >&2
    echo "cmake failed (see above); the log is $1/configure.log" >&2
    return 1
  fi
}

# install_what_is_missing: on Debian, unless the user brings a deal.II.
install_what_is_missing()
{
  if [ -n "${DEAL_II_DIR:-}" ]; then
    echo "Using deal.II in $DEAL_II_DIR; nothing is installed."
  elif command -v apt-get > /dev/null; then
    contrib/install-debian.sh
  fi
}
