#!/usr/bin/env bash
# Man pages and completions hold every option that --help prints, and bash completes with them.
set -euo pipefail
readonly build=$1
readonly reference=$build/reference
readonly program=$build/apps/cli/relamp
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
touch room.glb
wrong=0
complain() {
    echo "$*"
    wrong=1
}

# The part of each completion that is of one command.
bash_of() { grep -E "^ +$1\) words=" "$reference/relamp" | tr "'" ' '; }
zsh_of() { sed -n "/^        $1) _arguments/,/_files' ;;/p" "$reference/_relamp" | sed -E "s/^ +'\*?(-[a-z-]+)\[/ \1 /"; }
fish_of() { grep "__fish_seen_subcommand_from $1'" "$reference/relamp.fish" | sed -E 's/ -l / --/g; s/ -s / -/g'; }

options=0
for command in bench delight devices info relight verify view; do
    page=$reference/man/relamp-$command.1
    [[ -s $page ]] || complain "no man page of $command"
    [[ $command == view ]] && continue # its options are the viewer's own
    manual=$(sed 's/\\-/-/g; s/\\f[BRI]/ /g' "$page")
    for shell in bash zsh fish; do declare "in_$shell=$("${shell}_of" "$command")"; done
    for option in $("$program" "$command" --help | grep -oE '^  -[A-Za-z,-]+' | tr ',' ' '); do
        options=$((options + 1))
        for place in manual in_bash in_zsh in_fish; do
            grep --quiet -E -- "(^|[ ])$option( |$)" <<<"${!place}" || complain "$command $option: not in $place"
        done
    done
done
((options > 80)) || complain "--help printed only $options options"

source "$reference/relamp"
compopt() { :; } # which works only while a line is completed
completes() { # what is expected, the words of the line, of which the last is completed
    local expected=$1
    shift
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    _relamp
    [[ ${COMPREPLY[*]} == "$expected" ]] || complain "$*: completed to ${COMPREPLY[*]}, not $expected"
}
completes relight relamp rel
completes delight relamp help del
completes --solver relamp delight --so
completes 'gather pathtrace thesis' relamp delight --solver ''
completes pathtrace relamp delight --solver = p
completes 'gather pathtrace thesis' relamp delight --solver =
completes pathtrace relamp relight room --solver p
completes room.glb relamp delight ro
completes room.glb relamp delight room.glb --lights ro
completes '' relamp delight room.glb --threads ''

if command -v groff >/dev/null; then
    for page in "$reference"/man/*.1; do
        warnings=$(groff -man -Tutf8 -ww "$page" 2>&1 >/dev/null)
        [[ -z $warnings ]] || complain "$warnings"
    done
fi
for shell in zsh fish; do
    command -v "$shell" >/dev/null || continue
    file=$reference/_relamp
    [[ $shell == fish ]] && file=$reference/relamp.fish
    "$shell" -n "$file" || complain "$shell cannot read its completion"
done
exit $wrong
