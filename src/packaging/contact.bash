# Completion of the command contact for bash; the options are requested from the program
_contact() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  case $before in
    --output-dir | --serve)
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      return
      ;;
    --heat)
      mapfile -t COMPREPLY < <(compgen -W "established moving-source" -- "$word")
      return
      ;;
    --contact-angle)
      mapfile -t COMPREPLY < <(compgen -W "established contact" -- "$word")
      return
      ;;
  esac
  case $word in
    -*)
      mapfile -t COMPREPLY < <(compgen -W "$(contact --help | grep -o -e "--[a-z][a-z0-9-]*" | sort -u) --serve --port" -- "$word")
      ;;
    *)
      if [ "$COMP_CWORD" -eq 1 ]; then
        mapfile -t COMPREPLY < <(compgen -W "2 3 convert explain report study table" -- "$word")
      else
        mapfile -t COMPREPLY < <(compgen -f -X '!*.@(inp|toml)' -- "$word")
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$word")
      fi
      ;;
  esac
}
complete -o filenames -F _contact contact
