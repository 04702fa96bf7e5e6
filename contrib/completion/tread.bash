# SPDX-License-Identifier: LGPL-2.1-or-later
# Completion of the program's command line in bash: commands, options, parameter files, and parameters behind -s.
#
#     source contrib/completion/tread.bash        # in ~/.bashrc; an installed program needs no such line
#
# Options and parameters are asked of the program itself, once in a shell for each program.

# Global: bash-completion reads this file inside a function.
declare -gA _tread_helps _tread_parameters

# The program's commands, one a line.
_tread_list_commands()
{
  sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p' <<< "${_tread_helps[$1]}"
}

# Ask it once what it says of itself, or of a command ($2). In this shell: what a subshell keeps is lost.
_tread_ask()
{
  [[ -n ${_tread_helps[$*]-} ]] || _tread_helps[$*]=$("$@" --help 2>/dev/null)
}

# The long options of the program, or of a command, one a line.
_tread_list_options()
{
  grep -oE '^ +(-[a-z],)?--?[a-z][a-z-]*' <<< "${_tread_helps[$*]}" | grep -oE -- '--[a-z-]+|-s'
}

# The program's parameters as Section/Name=, one a line.
_tread_list_parameters()
{
  [[ -n ${_tread_parameters[$1]-} ]] ||
    _tread_parameters[$1]=$("$1" parameters 2>/dev/null |
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
  local program=${COMP_WORDS[0]/#\~/$HOME} typed=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=''
  COMPREPLY=()
  _tread_ask "$program"
  ((COMP_CWORD > 1)) && command=$(_tread_list_commands "$program" | grep -Fx -- "${COMP_WORDS[1]}")
  case $before in
    -s) _tread_setting "$program" "$typed" ;;
    --output | --smooth-twin) _tread_paths '' folders "$typed" ;;
    --other-side) _tread_paths .prm files "$typed" ;;
    --window) mapfile -t COMPREPLY < <(compgen -W 'rectangular Hann' -- "$typed") ;;
    --bottom) mapfile -t COMPREPLY < <(compgen -W 'fixed ballast' -- "$typed") ;;
    --up-to | --shift-to | --shift-step | --from | --to | --support | --cell-size) ;;
    *)
      if [[ $typed == -* ]]; then
        _tread_ask "$program" $command
        mapfile -t COMPREPLY < <(compgen -W "$(_tread_list_options "$program" $command)" -- "$typed")
        return
      fi
      ((COMP_CWORD == 1)) && mapfile -t COMPREPLY < <(compgen -W "$(_tread_list_commands "$program")" -- "$typed")
      case $command in
        batch | positions) _tread_paths .csv files "$typed" ;;
        dynamic-force | sleeper-stress) _tread_paths '' folders "$typed" ;;
        wear) _tread_paths .csv files "$typed" && _tread_paths .prm files "$typed" ;;
        *) _tread_paths .prm files "$typed" ;;
      esac
      ;;
  esac
}

complete -F _tread tread
