#!/bin/bash
# The pages of doc/ as a site with search: contrib/manual.sh [OUTPUT] (default: build/manual).
# Warnings, such as a link to a page that does not exist, are errors.
set -euo pipefail
output=$(realpath -m "${1:-$(dirname "$0")/../build/manual}")
cd "$(dirname "$0")/.."

if ! /usr/bin/python3 -c "import sphinx, myst_parser, sphinx_rtd_theme" 2> /dev/null; then
  echo "manual.sh: Sphinx is missing; on Debian: apt-get install --no-install-recommends python3-sphinx python3-myst-parser python3-sphinx-rtd-theme" >&2
  exit 77 # tests take this as: skipped
fi

/usr/bin/python3 -m sphinx -q -W --keep-going -b html -c doc/manual -d "$output/.doctrees" . "$output"
echo "$output/index.html"
