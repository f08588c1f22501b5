# What the checks share; each check sources it and is called with the path of the program.
# A check ends with 77, after one line that says why, where the foreign program it needs is missing.
set -euo pipefail

program=$(realpath "${1:?the path of the program is missing}")
checks=$(dirname "$(realpath "$0")")
# shellcheck disable=SC2034 # read by the checks
repository=$(realpath "$checks/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# shellcheck disable=SC2034 # read by the checks
one_tree_of_each_engine=(s4-improved xm12-fig5)

# The presets whose files foreign programs read. The mesh of the largest has some gigabytes and nothing that others have not.
presets() {
  "$program" presets --names | grep -v '^p09-640k$'
}

# need COMMAND: ends the check where the command is not installed.
need() {
  command -v "$1" > /dev/null || skip "$1"
}

skip() {
  echo "$1 is not installed (scripts/deps --checks installs it)"
  exit 77
}

# generate PRESET FILE...: writes the files, prints how many triangles the program says they have; then how many a .glb
# has, overlays included.
generate() {
  local preset=$1 outputs=() file
  shift
  for file in "$@"; do
    outputs+=(-o "$file")
  done
  local json solid overlay
  json=$("$program" generate "$preset" "${outputs[@]}" --json --quiet)
  solid=$(sed -n 's/.*"triangles": *\([0-9][0-9]*\).*/\1/p' <<< "$json")
  overlay=$(sed -n 's/.*"overlay_triangles": *\([0-9][0-9]*\).*/\1/p' <<< "$json")
  echo "$solid $((solid + overlay))"
}

# same_count WHAT EXPECTED ACTUAL: prints both numbers, fails where they differ or there is none.
same_count() {
  echo "$1: ${2:-no} triangles written, ${3:-none} read"
  [[ -n $2 && $2 == "$3" ]]
}
