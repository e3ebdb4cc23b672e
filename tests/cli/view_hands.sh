# Of the scripts that use airlight view as a person would, with real keys and a real mouse, on a display of its own: AIRLIGHT SCENES. They wait
# for what the viewer writes, never for a time; 60 s without it are a failure.
set -euo pipefail
airlight=$(realpath "$1") scenes=$(realpath "$2")
work=$(mktemp -d)
server= viewer=
finish() {
  [ -z "$viewer" ] || kill "$viewer" 2>/dev/null || true
  [ -z "$server" ] || kill "$server" 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
fail() { echo "FAILED: $*" >&2; cat "$work/log" >&2; exit 1; }
step() { echo "ok: $*"; }

exec 3<>"$work/number"
Xvfb -displayfd 3 -screen 0 1024x768x24 >"$work/server.log" 2>&1 &
server=$!
wait_for() {  # WHAT COMMAND...
  local what=$1 tries=0
  shift
  until "$@" >/dev/null 2>&1; do
    tries=$((tries + 1))
    [ "$tries" -lt 600 ] || fail "no $what"
    sleep 0.1
  done
}
wait_for "display" test -s "$work/number"
DISPLAY=:$(head -n 1 "$work/number")
export DISPLAY

start() {  # SCENE [-o OUTPUT ...]
  written=$(basename "${3:-$1}" .json)
  "$airlight" view "$@" --size 160x120 --threads 2 >"$work/log" 2>&1 &
  viewer=$!
  wait_for "window" xdotool search --onlyvisible --name "airlight $1"
  window=$(xdotool search --onlyvisible --name "airlight $1" | head -n 1)
  wait_for "focus" focused
}
focused() { xdotool windowfocus "$window" && [ "$(xdotool getwindowfocus)" = "$window" ]; }
stop() {
  kill "$viewer"
  wait "$viewer" || [ $? -eq 130 ] || fail "the viewer ended with $?"
  viewer=
}
count=0
# The picture as it is now, when it is whole: $work/N.png
picture() {
  count=$((count + 1))
  xdotool key p
  wait_for "picture $count" test -s "$work/${written}_picture_1.png"
  mv "$work/${written}_picture_1.png" "$work/$count.png"
}
drag() {  # X Y X Y: with the left button, in a few moves
  xdotool mousemove --window "$window" "$1" "$2" mousedown 1
  for k in 1 2 3 4; do xdotool mousemove --window "$window" $(($1 + ($3 - $1) * k / 4)) $(($2 + ($4 - $2) * k / 4)); done
  xdotool mouseup 1
}
# The window has been drawn since: it writes what it shows.
drawn() {
  xdotool key shift+p
  wait_for "window" test -s "$work/${written}_window_1.png"
  rm "$work/${written}_window_1.png"
}
click() {  # X Y: in the panel, which looks at the mouse when it is drawn
  xdotool mousemove --window "$window" "$1" "$2" && drawn
  xdotool mousedown 1 && drawn
  xdotool mouseup 1 && drawn
}
slide() {  # X Y X: the same with a slider
  xdotool mousemove --window "$window" "$1" "$2" && drawn
  xdotool mousedown 1 && drawn
  xdotool mousemove --window "$window" "$3" "$2" && drawn
  xdotool mouseup 1 && drawn
}
same() { cmp -s "$work/$1.png" "$work/$2.png"; }

cd "$work"
