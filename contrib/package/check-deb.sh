#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Install a package for Debian on a bare Debian 12, use it as an ordinary user, and remove it again.
#
#     contrib/package/check-deb.sh [--cache DIR] [--mirror URL] [--no-compiler] [--keep] DEB
#
# --cache DIR     keeps the bare Debian and the packages that were fetched for the next time; the checks work on a copy
# --mirror URL    of Debian (default: http://deb.debian.org/debian)
# --no-compiler   leaves out the project in C, for which a compiler and CMake are installed
# --keep          leaves the Debian on which the checks were made, and names its folder
#
# One line for each check. The first that fails ends the script with exit code 1 and the last lines of what was said.
# Needs root, debootstrap, a network, and 4 GB below $TMPDIR (the cache 0.6 GB). Nothing is changed outside of $TMPDIR and the cache.
set -uo pipefail
arguments=("$@")
here=$(dirname "$(realpath "$0")")
seconds_before=0

stop()
{
  echo "check-deb.sh: $*" >&2
  exit 1
}

cache='' mirror=http://deb.debian.org/debian compiler=yes keep='' deb='' work=${TREAD_CHECK_DEB_INSIDE:-}
while [ $# -gt 0 ]; do
  case $1 in
    --cache | --mirror)
      [ $# -ge 2 ] || stop "$1 needs a value"
      declare "${1#--}=$2"
      shift ;;
    --no-compiler) compiler='' ;;
    --keep) keep=yes ;;
    --help | -h)
      sed -n '3,/^set /{/^set /!s/^# \{0,1\}//p}' "$0"
      exit 0 ;;
    -*) stop "there is no option $1; --help lists them" ;;
    *)
      [ -z "$deb" ] || stop "one package at a time, not $deb and $1"
      deb=$1 ;;
  esac
  shift
done
[ -n "$deb" ] || stop "which package? contrib/package/check-deb.sh DEB; --help says more"
[ -r "$deb" ] || stop "$deb: no such file"
[ "$(id -u)" -eq 0 ] || stop "must be run as root, which installing packages needs"
command -v debootstrap > /dev/null || stop "debootstrap is missing; on Debian: apt-get install debootstrap"

# What is mounted, and processes that are left over, go away with a name space of its own, in which the script starts once more.
if [ -z "$work" ]; then
  work=$(mktemp -d "${TMPDIR:-/tmp}/tread-deb.XXXXXX") || stop "cannot write to ${TMPDIR:-/tmp}"
  if [ -n "$keep" ]; then
    trap 'echo "The Debian of the checks: $work/root"' EXIT
  else
    trap 'rm -rf --one-file-system "$work"' EXIT
  fi
  chmod 755 "$work" # an ordinary user works in there
  TREAD_CHECK_DEB_INSIDE=$work unshare --mount --propagation private --pid --fork --kill-child bash "$0" "${arguments[@]}"
  exit
fi

root=$work/root log=$work/log
[ -z "$cache" ] || { mkdir -p "$cache" && cache=$(realpath "$cache"); } || stop "cannot write to $cache"
base=${cache:-$work}/bookworm archives=${cache:-$work}/archives

# check WHAT COMMAND...: one line; the command, a function of this shell, says in `found` what it found.
check()
{
  local what=$1
  shift
  found=''
  if ! "$@" > "$log" 2>&1 < /dev/null; then
    printf 'FAIL  %s\n' "$what"
    tail -n 20 "$log" | sed 's/^/      /'
    exit 1
  fi
  printf 'ok    %-52s %s [%d s]\n' "$what" "${found:+$found }" $((SECONDS - seconds_before))
  seconds_before=$SECONDS
}

as_root()
{
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    ${http_proxy:+http_proxy="$http_proxy"} chroot "$root" "$@"
}

as_user()
{
  as_root su - rail -c "cd work && { $1; }"
}

# What the user's Python makes of the standard input; what it prints is found.
python()
{
  found=$(as_user 'python3 -')
  local code=$?
  echo "$found"
  return $code
}

install()
{
  as_root apt-get "$1" -q -y --no-install-recommends "${@:2}"
}

packages()
{
  # shellcheck disable=SC2016 # dpkg's own variables
  as_root dpkg-query -W -f '${Package} ${Version}\n' | LC_ALL=C sort
}

# All that is there but what any installation changes: records of apt and dpkg, logs and caches; and the user's own.
files()
{
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./sys -o -path ./dev -o -path ./tmp -o -path ./run -o -path ./home \
    -o -path ./root -o -path ./var/cache -o -path ./var/log -o -path ./var/lib/apt -o -path './var/lib/dpkg/*' ! -path './var/lib/dpkg/info*' \
    -o -path './etc/*-' \) -prune -o -print) | LC_ALL=C sort
}

lines() { wc -l < "$work/$1"; }

field() { dpkg-deb -f "$deb" "$1"; }

is_ours()
{
  found="$(($(stat -L -c %s "$deb") / 1000)) kB, version $(field Version)"
  [ "$(field Package)" = tread ]
}

bare_debian()
{
  if [ ! -d "$base" ]; then
    rm -rf "$base.part"
    debootstrap --variant=minbase bookworm "$base.part" "$mirror" || return
    rm -f "$base.part"/var/cache/apt/archives/*.deb
    mv "$base.part" "$base" || return
  fi
  cp -a "$base" "$root" || return
  mkdir -p "$archives/partial" || return
  mount -t proc proc "$root/proc" && mount -t sysfs -o ro sysfs "$root/sys" || return
  mkdir -p "$root/dev/shm"
  mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm" || return # through which ranks send their messages
  mount --bind "$archives" "$root/var/cache/apt/archives" || return
  printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d" # no service is started
  chmod 755 "$root/usr/sbin/policy-rc.d"
  echo "127.0.0.1 localhost $(hostname)" > "$root/etc/hosts" # as on any machine; without its name Open MPI looks for it for five seconds
  echo "deb $mirror bookworm main" > "$root/etc/apt/sources.list"
  cp "$deb" "$root/tmp/" || return
  as_root apt-get update -q || return
  as_root adduser --disabled-password --gecos '' rail || return
  as_root su - rail -c 'mkdir work' || return
  packages > "$work/packages.bare"
  files > "$work/files.bare"
  found="$(lines packages.bare) packages, $(lines files.bare) files"
}

# By themselves first, so that later all that installing and removing the package itself changes can be told from them.
dependencies()
{
  install satisfy "$(field Depends)" || return
  packages > "$work/packages.before"
  files > "$work/files.before"
  found="$(($(lines packages.before) - $(lines packages.bare))) packages"
}

install_deb()
{
  install install "/tmp/$(basename "$deb")" || return
  packages > "$work/packages.after"
  local more
  more=$(comm -13 "$work/packages.before" "$work/packages.after")
  if [ "$more" != "tread $(field Version)" ]; then
    echo "installed: ${more:-nothing}"
    return 1
  fi
  as_root dpkg-query -L tread > "$work/brought" || return
  files > "$work/files.installed"
  found="$(lines brought) files and folders, $(($(field Installed-Size) / 1024)) MB"
}

says_its_version()
{
  found=$(as_user 'tread --version') || return
  echo "tread --version: $found; the package: $(field Version)"
  [[ $found == "tread $(field Version)"* ]]
}

scene="/usr/share/tread/prm/smooth-rolling.prm -s 'Mesh/Finest cell (mm)=1.3' -s 'Mesh/Fine half width (mm)=9' -s 'Motion/Rolled distance (mm)=6'"
one_rank()
{
  as_user "tread $scene --output one"
}

# The load of the scene is 14.3 t; its dynamic part has not died down after 6 mm.
python_reads_it()
{
  python << 'END'
import tread
run = tread.Run("one")
assert tread.__file__.startswith("/usr/lib/python3/"), tread.__file__
assert run.summary["completed"] is True
force = run.history["normal_force_N"][-1]
assert abs(force / (14300 * 9.81) - 1) < 0.005, force
print(len(run.history["time_s"]), "rows, at the end", round(1e-3 * force, 1), "kN")
END
}

recommended()
{
  local all
  all=$(field Recommends)
  install satisfy "$all" || return
  found=$all
}

# Sums over the ranks are rounded otherwise.
two_ranks()
{
  as_user "mpirun -np 2 --oversubscribe tread $scene --output two" || return
  python << 'END'
import tread
one, two = (tread.Run(name).summary for name in ("one", "two"))
assert (one["ranks"], two["ranks"]) == (1, 2), (one["ranks"], two["ranks"])
difference = max(abs(two[name] / one[name] - 1) for name in ("normal_force_N", "traction_coefficient", "max_pressure_Pa"))
assert difference < 1e-9, difference
print(f"forces and pressure differ by {difference:.0e}")
END
}

picture()
{
  as_user '/usr/share/tread/contrib/plot/plot-run.py one && ls one/pictures/*.png' || return
  found="$(as_user 'ls one/pictures/*.png' | wc -l) pictures"
}

manual_page()
{
  install install man-db || return
  found=$(as_user 'man -w tread && man -w tread-study > /dev/null && man tread | grep -q -e --resume && man tread-study | grep -q -e --resume') || return
}

project_in_c()
{
  install install cmake make gcc libc6-dev || return
  cp -r "$here/../../tests/scenes/outside_project" "$root/tmp/" || return
  local version
  version=$(field Version)
  as_user "cmake -S /tmp/outside_project -B build -D TREAD_VERSION=${version%.*} && cmake --build build" || return
  found=$(as_user 'build/outside | head -n 1') || return
  echo "outside: $found"
  # Status, Kalker's coefficient C11 (4.12; 16 elements make 1.7 % of it), message.
  [[ $found == '0 4.'[12]*' []' ]] && found="C11 = ${found:2:5}"
}

# By the sums of the package.
unchanged()
{
  local changed
  changed=$(as_root dpkg --verify tread) || return
  echo "$changed"
  [ -z "$changed" ]
}

# Files that came with the tools of the checks are not the package's.
purge()
{
  files > "$work/files.tools"
  comm -13 "$work/files.installed" "$work/files.tools" > "$work/files.of-tools"
  as_root apt-get purge -q -y tread || return
  files > "$work/files.purged"
  comm -23 "$work/files.purged" <(LC_ALL=C sort -mu "$work/files.before" "$work/files.of-tools") > "$work/left"
  comm -13 "$work/files.purged" "$work/files.before" > "$work/lost"
  echo "left behind:"
  cat "$work/left"
  echo "taken away, though not of the package:"
  cat "$work/lost"
  [ ! -s "$work/left" ] && [ ! -s "$work/lost" ] && ! as_root dpkg-query -W tread && found="no file is left"
}

check "package $(basename "$deb")" is_ours
check "bare Debian 12" bare_debian
check "what the package depends on" dependencies
check "installation" install_deb
check "tread --version" says_its_version
check "a scene that was installed, on one rank" one_rank
check "import tread, and the history of the run" python_reads_it
check "what the package recommends" recommended
check "the same scene on two ranks" two_ranks
check "pictures of the run" picture
check "man tread" manual_page
[ -z "$compiler" ] || check "a project in C with the half-space library" project_in_c
check "all files of the package are as they were" unchanged
check "apt-get purge leaves nothing" purge
echo "All is well, in $SECONDS s."
