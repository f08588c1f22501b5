"""Run by Blender: imports each file named after "--" into an empty scene and prints how many triangles it holds."""
import sys

import bpy
import numpy

# The glTF importer of Blender 3.4 uses a name that numpy 1.24 no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool


def triangle_count(mesh):
    mesh.calc_loop_triangles()
    return len(mesh.loop_triangles)


for path in sys.argv[sys.argv.index("--") + 1:]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.endswith(".obj"):
        bpy.ops.wm.obj_import(filepath=path)
    elif path.endswith(".stl"):
        if hasattr(bpy.ops.wm, "stl_import"):  # from Blender 4.1 on
            bpy.ops.wm.stl_import(filepath=path)
        else:
            bpy.ops.import_mesh.stl(filepath=path)
    else:
        bpy.ops.import_scene.gltf(filepath=path)
    print("triangles", path, sum(triangle_count(o.data) for o in bpy.data.objects if o.type == "MESH"))
