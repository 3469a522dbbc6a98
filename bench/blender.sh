# What cycles.sh and ambient_occlusion.sh share; to be sourced.

repository=$(cd "$(dirname "$0")/.." && pwd)

fail() {
    echo "$(basename "$0"): $1" >&2
    exit 1
}

# Says what is missing of Blender, the program $1 and the scan $2.
check_inputs() {
    command -v blender >/dev/null || fail "Blender is missing; install it with: apt-get install blender"
    [ -x "$1" ] || fail "$1 is no program; build it with ./relamp.sh build, or name it as last argument"
    [ -f "$2" ] || fail "$2 is no file"
}

# Runs a script of bench/ inside Blender; all it says goes to the file $1.
in_blender() {
    local -r log=$1 script=$2
    blender -b --factory-startup --python-exit-code 1 --python "$repository/bench/$script" -- "${@:3}" >"$log" 2>&1 || {
        tail -n 5 "$log" >&2
        fail "Blender stopped; all it said is in $log"
    }
}
