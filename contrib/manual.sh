#!/bin/bash
# The pages of doc/ as a site with search: contrib/manual.sh [OUTPUT] (default: build/manual).
# Warnings, such as a link to a page that does not exist, are errors.
# Each site is built anew in a folder beside OUTPUT and takes its place when it is complete: what an interrupted
# build leaves is never read again.
set -euo pipefail
output=$(realpath -m "${1:-$(dirname "$0")/../build/manual}")
cd "$(dirname "$0")/.."

if ! /usr/bin/python3 -c "import sphinx, myst_parser, sphinx_rtd_theme" 2> /dev/null; then
  echo "manual.sh: Sphinx is missing; on Debian: apt-get install --no-install-recommends python3-sphinx python3-myst-parser python3-sphinx-rtd-theme" >&2
  exit 77 # tests take this as: skipped
fi
# Nothing but an earlier site is replaced.
if [ -e "$output" ] && [ ! -e "$output/.buildinfo" ] && [ ! -e "$output/.doctrees" ] && [ -n "$(ls -A "$output")" ]; then
  echo "manual.sh: $output holds other files than an earlier site; name a new folder" >&2
  exit 1
fi

mkdir -p "$(dirname "$output")"
new=$(mktemp -d "$output.XXXXXX")
trap 'rm -rf "$new"' EXIT
trap 'exit 130' INT TERM
chmod 755 "$new"
/usr/bin/python3 -m sphinx -q -E -W --keep-going -b html -c doc/manual -d "$new/.doctrees" . "$new"
rm -rf "$output"
mv "$new" "$output"
echo "$output/index.html"
