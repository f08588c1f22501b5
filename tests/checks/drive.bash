# Drives the window as a person would, by mouse and keys: what tests and the script that makes its pictures share.
# Whoever sources it has a display of its own, xdotool and import, and sets
#   program  the path of ramify
#   work     a folder for files that are in the way afterwards
# and, for a program that is slower than others, how many times as long to wait:
patience=${patience-1}
log=$work/window.log
export XDG_CONFIG_HOME=$work/config

fail() {
  trap - ERR
  echo "$(basename "$0"): $1" >&2
  kill -0 "${process-0}" 2> /dev/null && echo "the program is still running, its window was ${window-not found yet}" >&2
  tail -n 5 "$log" "$work/errors" >&2 || true
  exit 1
}
# What ends this script otherwise, such as xdotool without a window, tells as much.
set -o errtrace
trap 'fail "line $LINENO: $BASH_COMMAND failed"' ERR

# start ARGUMENT...: opens the window and waits until its trees are on show.
start() {
  rm -rf "$XDG_CONFIG_HOME"
  : > "$log"
  LD_PRELOAD=${preloaded-} "$program" view --driven "$@" > "$log" 2> "$work/errors" &
  process=$!
  wait_for READY
  window=$(xdotool search --sync --name '^ramify$' | tail -1)
  xdotool windowfocus "$window"
}

# wait_for PATTERN [LINES]: until such a line comes after the first LINES of the log.
# Two minutes at least: a slow machine that runs another check beside takes more than half of one for the largest tree.
wait_for() {
  local i
  for ((i = 0; i < 2400 * patience; ++i)); do
    tail -n "+$((${2:-0} + 1))" "$log" | grep -q -- "^$1" && return
    kill -0 "$process" 2> /dev/null || fail "it ended while '$1' was awaited"
    sleep 0.05
  done
  fail "'$1' did not come"
}

lines() { wc -l < "$log"; }

# then_ready COMMAND...: runs it and waits until the trees have answered and rest, and nothing more is said: they
# may have come to rest in the middle of it.
then_ready() {
  local before now=
  before=$(lines)
  "$@"
  wait_for READY "$before"
  until [[ $now == "$(lines)" && $(grep -E '^(TREE|READY)' "$log" | tail -n 1) == READY ]]; do
    kill -0 "$process" 2> /dev/null || fail "it ended before its trees were at rest"
    now=$(lines)
    sleep "$(awk -v patience="$patience" 'BEGIN { print 0.2 * patience }')"
  done
}

# place NAME FRACTION [HEIGHT]: the point that far from the left of the widget and from its top, once it is there.
place() {
  local i
  for ((i = 0; i < 200 * patience; ++i)); do
    awk -v name="$1" -v part="${2:-0.5}" -v height="${3:-0.5}" '
      $1 == "RECT" && $2 == name { x = $3 + part * ($5 - $3); y = $4 + height * ($6 - $4); is_there = 1 }
      $1 == "GONE" && $2 == name { is_there = 0 }
      END { if (!is_there) exit 1; printf "%d %d\n", x, y }' "$log" && return
    sleep 0.05
  done
  fail "there is no widget '$1'"
}

point_at() {
  local at
  at=$(place "$@")
  # shellcheck disable=SC2086 # two words
  xdotool mousemove --window "$window" $at
  sleep 0.12
}

click() {
  point_at "$@"
  xdotool click 1
  sleep 0.15
}

# open_page NAME WIDGET: until the page has that widget; a busy window may miss a click.
open_page() {
  local i
  for ((i = 0; i < 5; ++i)); do
    click "page.$1"
    sleep 0.5
    awk -v name="$2" '$2 == name { is_there = $1 == "RECT" } END { exit !is_there }' "$log" && return
  done
  fail "the page $1 does not open"
}

# drag NAME FROM TO [STEPS [SECONDS]]: the mouse button held, in steps of so many seconds.
drag() {
  local step x0 x1 y steps=${4:-8} pause=${5:-0.12}
  read -r x0 y < <(place "$1" "$2")
  read -r x1 y < <(place "$1" "$3")
  xdotool mousemove --window "$window" "$x0" "$y" && sleep 0.12
  xdotool mousedown 1
  for ((step = 1; step <= steps; ++step)); do
    sleep "$pause"
    xdotool mousemove --window "$window" $((x0 + (x1 - x0) * step / steps)) "$y"
  done
  sleep 0.12
  xdotool mouseup 1
}

# drag_between NAME FROM TO: from one place of a widget to another, each as "FRACTION HEIGHT".
drag_between() {
  local x0 y0 x1 y1 step
  # shellcheck disable=SC2086 # two words
  read -r x0 y0 < <(place "$1" $2)
  # shellcheck disable=SC2086
  read -r x1 y1 < <(place "$1" $3)
  xdotool mousemove --window "$window" "$x0" "$y0" && sleep 0.12
  xdotool mousedown 1
  for ((step = 1; step <= 6; ++step)); do
    sleep 0.12
    xdotool mousemove --window "$window" $((x0 + (x1 - x0) * step / 6)) $((y0 + (y1 - y0) * step / 6))
  done
  sleep 0.12
  xdotool mouseup 1
}

key() {
  xdotool key --window "$window" "$1"
  sleep 0.15
}

# hold KEY: long enough for a text field on a loaded machine, which only looks at what is down.
hold() {
  xdotool keydown "$1"
  sleep 0.2
  xdotool keyup "$1"
  sleep 0.1
}

write_text() {
  xdotool type --delay 30 "$1"
  sleep 0.2
}

# find_parameter TEXT: filters the panel, so that the parameter is in sight.
find_parameter() {
  local i
  for ((i = 0; i < 5; ++i)); do
    click filter
    hold ctrl+a
    write_text "$1"
    [[ $(grep '^FILTER' "$log" | tail -1) == "FILTER $1" ]] && return
  done
  fail "the filter does not take '$1'"
}

photo() {
  import -window "$window" "$1.png"
}

quit() {
  local i code=0
  # A busy window may miss the key, or be gone before it is let go: then the display repeats it into the next window.
  for ((i = 0; i < 100 * patience; ++i)); do
    ((i % 20)) || xdotool key --window "$window" ctrl+q 2> /dev/null || true
    kill -0 "$process" 2> /dev/null || break
    sleep 0.25
  done
  xdotool keyup ctrl+q
  wait "$process" || code=$?
  [[ $code == 0 && ! -s $work/errors ]] || fail "it ended with $code: $(cat "$work/errors")"
}

save_as() {
  key ctrl+s
  hold ctrl+a
  write_text "$work/$1"
  hold Return
  wait_for "MESSAGE saved $work/$1"
}
