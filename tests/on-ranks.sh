#!/bin/bash
# on-ranks.sh MPIRUN ARGUMENT...: run a test on several ranks. Each mpirun has a folder of its own for its session: in the one that they
# share otherwise, one start in some hundred fails, when another makes or removes that folder at the same time (Open MPI 4.1).
. "$(dirname "$0")/../contrib/environment.sh"
OMPI_MCA_orte_tmpdir_base=$(mktemp -d) || exit 1
export OMPI_MCA_orte_tmpdir_base
trap 'rm -rf "$OMPI_MCA_orte_tmpdir_base"' EXIT
"$@"
