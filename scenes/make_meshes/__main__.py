"""Makes the meshes of cathedral.json, fog_city.json, lattice_lamp.json and street_night.json: OBJ files in a folder a scene.

    python3 scenes/make_meshes [FOLDER]      # FOLDER is scenes/ unless said

Nothing but Python is needed. Metres, +Y up. Solids that meet run into each other, so that no light leaks between them, and no two
faces that can be seen lie in one plane; triangles that share an edge share its vertices, so that most edges cancel in a
silhouette.
"""
import pathlib
import sys

from cathedral import cathedral
from fog_city import fog_city
from lattice_lamp import lattice_lamp
from street_night import street_night

folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
for make in (cathedral, fog_city, lattice_lamp, street_night):
    for name, mesh in make().items():
        mesh.write(folder / make.__name__ / f"{name}.obj")
