#!/usr/bin/env bash
# view_person.sh AIRLIGHT SCENES: every tool of airlight view, used by hand, its record replayed.
source "$(dirname "$0")/view_hands.sh"

cat >scene.json <<'SCENE'
{
  "airlight": 1,
  "camera": { "position": [0, 1.5, 7], "look_at": [0, 1, 0], "vertical_fov": 45, "resolution": [160, 120] },
  "medium": { "homogeneous": { "extinction": 0.02 }, "gaussians": [ { "center": [1.2, 1.2, 0], "radius": 0.6, "extinction": 1.5 } ] },
  "lights": [ { "type": "point", "name": "lamp", "position": [0, 1, 0], "intensity": [12, 11, 10] } ],
  "surfaces": [ { "mesh": "ground.obj" } ]
}
SCENE
cp "$scenes/ground.obj" .

start scene.json -o saved.json --record edits.jsonl
picture                                   # 1
xdotool key 2
drag 20 70 100 40
picture                                   # 2
! same 1 2 || fail "a stroke changes nothing"
step "painted a stroke"
xdotool key ctrl+z
picture                                   # 3
same 1 3 || fail "undo does not bring the picture back"
xdotool key ctrl+y
picture                                   # 4
same 2 4 || fail "redo does not bring the stroke back"
step "undone and done again"
xdotool key 4
drag 60 60 100 40
picture                                   # 5
! same 4 5 || fail "erasing changes nothing"
step "erased"
xdotool key 1
drag 80 60 40 30                          # the lamp's ring is in the middle
wait_for "lamp that moved" grep -q '"edit": "light"' edits.jsonl
picture                                   # 6
! same 5 6 || fail "moving the lamp changes nothing"
step "dragged the lamp"
xdotool key b
picture                                   # 7
"$airlight" compare 7.png 6.png --tolerance 0.005 || fail "the backends differ"
! same 7 6 || fail "the backend was not switched"  # its name is in the file
xdotool key b
drag 20 100 60 90                         # turns the camera
picture                                   # 8
! same 6 8 || fail "the camera did not move"
step "switched the backend, turned the camera"
xdotool key ctrl+s
wait_for "saved scene" test -s saved.json
stop
"$airlight" edit scene.json edits.jsonl -o replayed.json
cmp saved.json replayed.json || fail "the record does not give the scene that was saved"
step "the record gives the saved scene"
start saved.json -o again.json --record again.jsonl --fog 0.02   # as it was: the same picture
recorded() { wait_for "$1 in the record" grep -q "$1" again.jsonl; }
recorded '"edit": "fog"'
picture                                   # 9
same 8 9 || fail "the saved scene is another"
step "loaded what was saved: the same picture"

# The panel: its rows are 23 pixels high, its sliders 150 wide from column 168 on. The window is made higher to see them.
xdotool windowsize --sync "$window" 500 560
xdotool key 3                             # the airbrush, for as long as the button is held
xdotool mousemove --window "$window" 30 200 mousedown 1
for y in 210 220 230 240; do sleep 0.15 && xdotool mousemove --window "$window" 40 "$y"; done
xdotool mouseup 1
recorded '"edit": "airbrush"'
picture                                   # 10
xdotool key ctrl+z
picture                                   # 11
! same 10 11 || fail "the airbrush changes nothing"
xdotool key ctrl+y
step "sprayed with the airbrush"
xdotool key 6
drag 4 4 156 556                          # all of the picture
xdotool key ctrl+c mousemove --window "$window" 110 150 key ctrl+v
recorded '"edit": "copy"'
recorded '"edit": "paste"'
picture                                   # 12
! same 10 12 || fail "pasting changes nothing"
step "copied what is in a rectangle, pasted it elsewhere"
xdotool key 2
slide 230 179 290                         # the radius of what is painted
drag 20 170 60 120
recorded '"edit": "paint"'
radius=$(sed -n 's/.*"edit": "paint".*"radius": \([0-9.]*\).*/\1/p' again.jsonl)
[ "${radius%.*}" -ge 1 ] || fail "the slider did not change the radius: $radius"
step "moved a tool's slider: a radius of $radius"
picture                                   # 13
xdotool key 1                             # which has no sliders
click 320 202                             # the costs go away, which moves the technique's header there
click 320 225
slide 200 271 290                         # its first number
recorded '"edit": "technique"'
picture                                   # 14
! same 13 14 || fail "a setting of the technique changes nothing"
step "moved a technique's slider: $(grep -o '"settings".*' again.jsonl | tail -n 1)"
xdotool windowsize --sync "$window" 500 120
picture                                   # 15
xdotool key ctrl+s
wait_for "saved scene" test -s again.json
stop
"$airlight" edit saved.json again.jsonl -o replayed.json
cmp again.json replayed.json || fail "the second record does not give the scene that was saved"
start again.json
picture                                   # 16
same 15 16 || fail "the scene saved after the sliders is another"
step "saved and loaded again: the same picture"
stop
echo "$count pictures"
