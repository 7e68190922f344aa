# Completion of beamwork for bash, with and without the package bash-completion: the program itself says what may
# stand where the cursor is ('beamwork help --complete').

# The words of the line up to the cursor, as the program gets them: bash parts them at '=' and ':' too.
_beamwork_words() {
    local rest=${COMP_LINE:0:COMP_POINT} part blank i
    words=()
    for ((i = 0; i <= COMP_CWORD; i++)); do
        part=${COMP_WORDS[i]}
        blank=${rest%%[![:blank:]]*}
        rest=${rest#"$blank"}
        [[ ${#part} -le ${#rest} ]] || part=$rest
        rest=${rest#"$part"}
        if [[ -n $blank || ${#words[@]} -eq 0 ]]; then
            words+=("$part")
        else
            words[-1]+=$part
        fi
    done
}

# What bash leaves standing of the word at the cursor: all up to its last '=' or ':', where it breaks words there.
_beamwork_standing() { # word
    local breaks=${COMP_WORDBREAKS//[^=:]/}
    [[ -z $breaks || $1 == [\"\']* ]] && return
    standing=${1%"${1##*[$breaks]}"}
}

_beamwork() {
    local words standing= program word line files= folders= IFS=$' \t\n'
    COMPREPLY=()
    _beamwork_words
    program=${words[0]/#\~\//$HOME/}
    word=${words[-1]}
    _beamwork_standing "$word"
    words=("${words[@]//[\"\'\\]/}")
    while IFS= read -r line; do
        case $line in
        :files) files=1 ;;
        :folders) folders=1 ;;
        *)
            line=${line%%$'\t'*}
            line=${line#"$standing"}
            [[ $word == [\"\']* || $line != *[\'\"\ \(\)\;\&]* ]] || printf -v line %q "$line"
            COMPREPLY+=("$line")
            ;;
        esac
    done < <("$program" help --complete "${words[@]:1}" 2>/dev/null)
    if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=:] ]]; then
        compopt -o nospace 2>/dev/null
    fi
    if [[ -n $files$folders ]]; then
        word=${words[-1]}
        [[ $word != -*=* ]] || word=${word#*=}
        compopt -o filenames 2>/dev/null
        while IFS= read -r line; do
            COMPREPLY+=("$line")
        done < <(if [[ -n $files ]]; then compgen -f -- "$word"; else compgen -d -- "$word"; fi)
    fi
}
complete -F _beamwork beamwork
