# SPDX-License-Identifier: LGPL-2.1-or-later
# Completion of the program's command line in bash: options, parameter files, and parameters behind -s.
#
#     source contrib/completion/tread.bash        # in ~/.bashrc; an installed program needs no such line
#
# Options and parameters are asked of the program itself, once in a shell for each program.

# Global: bash-completion reads this file inside a function.
declare -gA _tread_options _tread_parameters

# The program's long options, one a line.
_tread_list_options()
{
  [[ -n ${_tread_options[$1]-} ]] ||
    _tread_options[$1]=$("$1" --help 2>/dev/null | grep -oE '^ +(-[a-z],)?--?[a-z][a-z-]*' | grep -oE -- '--[a-z-]+|-s')
  printf '%s\n' "${_tread_options[$1]}"
}

# The program's parameters as Section/Name=, one a line.
_tread_list_parameters()
{
  [[ -n ${_tread_parameters[$1]-} ]] ||
    _tread_parameters[$1]=$("$1" --print-parameters 2>/dev/null |
      sed -nE 's/^subsection (.*)/\1/; tsection; s/^ +set ([^=]*[^= ]) *=.*/\1/; tname; d; :section; h; d; :name; G; s/(.*)\n(.*)/\2\/\1=/p')
  printf '%s\n' "${_tread_parameters[$1]}"
}

# Paths that begin with what is typed: folders, and files with an ending ($1) if one is given.
_tread_paths()
{
  local path
  compopt -o filenames 2>/dev/null
  while IFS= read -r path; do
    [[ -d $path || ( $2 == files && $path == *"$1" ) ]] && COMPREPLY+=("$path")
  done < <(compgen -f -- "$3")
}

_tread_setting()
{
  local program=$1 typed=$2 quoted='' line
  [[ $typed == [\"\']* ]] && quoted=${typed:0:1} typed=${typed:1}
  [[ -z $quoted ]] && typed=${typed//\\/}
  compopt -o nospace 2>/dev/null
  while IFS= read -r line; do
    [[ $line == "$typed"* ]] || continue
    [[ -z $quoted ]] && printf -v line '%q' "${line%=}" && line+='='
    COMPREPLY+=("$line")
  done < <(_tread_list_parameters "$program")
}

_tread()
{
  local program=${COMP_WORDS[0]/#\~/$HOME} typed=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  case $before in
    -s) _tread_setting "$program" "$typed" ;;
    --output | --dynamic-force | --smooth-twin | --sleeper-stress) _tread_paths '' folders "$typed" ;;
    --batch | --positions | --wear) _tread_paths .csv files "$typed" ;;
    --other-side) _tread_paths .prm files "$typed" ;;
    --window) mapfile -t COMPREPLY < <(compgen -W 'rectangular Hann' -- "$typed") ;;
    --bottom) mapfile -t COMPREPLY < <(compgen -W 'fixed ballast' -- "$typed") ;;
    --up-to | --shift-to | --shift-step | --from | --to | --support | --cell-size) ;;
    *)
      if [[ $typed == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_tread_list_options "$program")" -- "$typed")
      else
        _tread_paths .prm files "$typed"
      fi
      ;;
  esac
}

complete -F _tread tread
