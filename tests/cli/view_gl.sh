#!/usr/bin/env bash
# view_gl.sh AIRLIGHT SCENES: the pictures of OpenGL in airlight view, which the window draws from the textures that they were made in, are
# those that airlight render writes.
source "$(dirname "$0")/view_hands.sh"

# A sun, which has no ring that would be drawn over the picture.
cat >scene.json <<'SCENE'
{
  "airlight": 1,
  "camera": { "position": [0, 1.5, 7], "look_at": [0, 1, 0], "vertical_fov": 45, "resolution": [160, 120] },
  "medium": { "homogeneous": { "extinction": 0.02 }, "gaussians": [ { "center": [1.2, 1.2, 0], "radius": 0.6, "extinction": 1.5 } ] },
  "lights": [ { "type": "directional", "direction": [-1, -1, -0.5], "irradiance": [2, 1.8, 1.5] } ],
  "surfaces": [ { "mesh": "ground.obj" } ]
}
SCENE
cp "$scenes/ground.obj" .
logged() { wait_for "\"$1\" in the log" grep -q "$1" log; }
# What the window shows at the picture's place: NAME.png
shown() {
  xdotool key shift+p
  wait_for "window" test -s "${written}_window_1.png"
  oiiotool "${written}_window_1.png" --cut 160x120+0+0 -o "$1.png"
  rm "${written}_window_1.png"
}
# Pictures of eight bits are no more than so many levels apart.
near() {  # A B LEVELS WHAT
  local apart
  apart=$(oiiotool "$1" "$2" --absdiff --printstats | awk '/Stats Max/ { for (i = 3; i < 6; ++i) if ($i > most) most = $i; printf "%.0f", 255 * most }')
  [ "$apart" -le "$3" ] || fail "$4: $apart levels of 255 apart"
  step "$4: at most $apart levels of 255 apart"
}

start scene.json -o drawn.json --backend gl --exposure 1.25
logged 'GL: gl, .*drawn directly'
step "$(grep -o 'GL: gl, .*' log)"
shown first
xdotool key 2
picture                                   # 1
drag 20 70 100 40
picture                                   # 2
! same 1 2 || fail "a stroke changes nothing"
shown direct
! cmp -s first.png direct.png || fail "the window shows no stroke"
xdotool key ctrl+s
wait_for "saved scene" test -s drawn.json
"$airlight" render drawn.json --backend gl -o rendered.png --exposure 1.25
near direct.png rendered.png 1 "the window and airlight render"
near 2.png rendered.png 1 "the picture and airlight render"
xdotool key b
logged 'CPU: cpu, '
picture                                   # 3
! same 2 3 || fail "the backend was not switched"
xdotool key b
picture                                   # 4
same 2 4 || fail "back on OpenGL the picture is another"
step "switched to the CPU and back"
slide 250 65 200                          # the exposure
shown darker
! cmp -s direct.png darker.png || fail "the exposure changes nothing"
step "changed the exposure"
# The difference of CPU and GL, the first in its list, is as good as black; below its label, where it is grey until both are there.
xdotool windowsize --sync "$window" 500 300
xdotool key v
click 230 65
click 230 90
xdotool mousemove --window "$window" 80 60
difference() {
  xdotool key shift+p
  sleep 0.1
  test -s "${written}_window_1.png" && mv "${written}_window_1.png" window.png || return 1
  oiiotool window.png --cut 79x100+80+190 -o difference.png
  ! idiff -q grey.png difference.png
}
oiiotool --pattern constant:color=0.1,0.1,0.1 79x100 3 -d uint8 -o grey.png
oiiotool --pattern constant:color=0,0,0 79x100 3 -d uint8 -o black.png
wait_for "difference" difference
near difference.png black.png 8 "ten times the difference of the backends"
stop

start scene.json -o read.json --backend gl --gl-context osmesa --exposure 1.25
logged 'GL: gl, .*OSMesa$'
shown read
near read.png first.png 1 "read back and drawn directly"
stop

export MESA_GL_VERSION_OVERRIDE=3.3       # the window has OpenGL, but no 4.5
start scene.json -o none.json --backend gl
logged 'GL: the window system has no OpenGL 4.5 core context'
step "$(grep 'GL: ' log)"
xdotool key b
picture                                   # 5
stop
