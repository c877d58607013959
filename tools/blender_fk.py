"""Prints the joint positions from Blender's own importer of a glTF file, to compare with ours; not part of the tests.

    blender --background --factory-startup --python tools/blender_fk.py -- FILE.glb RATE FRAMES > places.csv

Prints "place,FRAME,NAME,X,Y,Z" for each bone and each frame at RATE frames per second, starting at the file's time 0, in metres, Y up.
"""
import sys

import bpy
import numpy

numpy.bool = bool  # Blender 3.4's importer uses this name, which NumPy removed in 1.24

path, rate, frames = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = int(rate)
bpy.ops.import_scene.gltf(filepath=path, bone_heuristic="TEMPERANCE")
armatures = [item for item in scene.objects if item.type == "ARMATURE"]
empties = [item for item in scene.objects if item.type == "EMPTY"]
for frame in range(int(frames)):
    scene.frame_set(frame)
    places = [(bone.name, armature.matrix_world @ bone.matrix) for armature in armatures for bone in armature.pose.bones]
    places += [(item.name, item.matrix_world) for item in empties]
    for name, matrix in places:
        x, y, z = matrix.translation  # Blender's Z is up
        print("place,%d,%s,%.7f,%.7f,%.7f" % (frame, name, x, z, -y))
