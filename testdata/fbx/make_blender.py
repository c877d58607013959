"""Writes the binary FBX files of this folder with Blender, and next to them a CSV with Blender's own bone positions.

    blender --background --factory-startup --python testdata/fbx/make_blender.py

Six bones, three of them rolled, with two takes. The CSV contains, for each frame of the first take, each bone's head and its
orientation as a quaternion (w, x, y, z), in metres and Blender's space (Z up).
"""
import math
import os

import bpy
from mathutils import Euler, Vector

FOLDER = os.path.dirname(os.path.abspath(__file__))
BONES = [  # name, parent, head, tail, roll in degrees
    ("Hips", None, (0.0, 0.0, 0.95), (0.0, 0.02, 1.15), 0),
    ("Spine", "Hips", (0.0, 0.02, 1.15), (0.0, 0.0, 1.45), 12),
    ("Head", "Spine", (0.0, -0.01, 1.5), (0.0, 0.0, 1.75), 0),
    ("LeftArm", "Spine", (0.18, 0.0, 1.42), (0.45, 0.03, 1.38), 35),
    ("LeftForeArm", "LeftArm", (0.45, 0.03, 1.38), (0.7, -0.02, 1.36), -70),
    ("LeftHand", "LeftForeArm", (0.7, -0.02, 1.36), (0.86, -0.03, 1.34), 0),
]
VARIANTS = {  # name: whether with both takes, options of the exporter
    "plain": (True, dict()),
    "metres_z_up": (False, dict(apply_unit_scale=False, axis_forward="Y", axis_up="Z")),
    "bones_x_scaled": (False, dict(primary_bone_axis="X", secondary_bone_axis="Y", apply_scale_options="FBX_SCALE_UNITS")),
    "x_up": (False, dict(axis_forward="-Z", axis_up="X")),
}


def armature():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    data = bpy.data.armatures.new("Body")
    body = bpy.data.objects.new("Body", data)
    bpy.context.scene.collection.objects.link(body)
    bpy.context.view_layer.objects.active = body
    bpy.ops.object.mode_set(mode="EDIT")
    for name, parent, head, tail, roll in BONES:
        bone = data.edit_bones.new(name)
        bone.head, bone.tail, bone.roll = head, tail, math.radians(roll)
        if parent:
            bone.parent = data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="POSE")
    body.location, body.rotation_euler = (0.1, -0.2, 0.05), Euler((0.0, 0.0, 0.4))
    return body


def animate(body, take, frames, phase):
    body.animation_data_create()
    action = bpy.data.actions.new(take)
    action.use_fake_user = True
    body.animation_data.action = action
    for frame in range(1, frames + 1):
        for i, bone in enumerate(body.pose.bones):
            bone.rotation_mode = "QUATERNION"
            t = phase + 0.3 * frame + i
            angles = (0.5 * math.sin(t), 0.7 * math.cos(1.3 * t), 0.4 * math.sin(0.7 * t + 1))
            bone.rotation_quaternion = Euler(angles).to_quaternion()
            bone.keyframe_insert("rotation_quaternion", frame=frame)
        hips = body.pose.bones["Hips"]
        hips.location = Vector((0.02 * frame, 0.01 * math.sin(frame), 0.03 * phase))
        hips.keyframe_insert("location", frame=frame)
    return action


def write_places(body, path, frames):
    with open(path, "w") as out:
        out.write("frame,bone,x,y,z,qw,qx,qy,qz\n")
        for frame in range(1, frames + 1):
            bpy.context.scene.frame_set(frame)
            for bone in body.pose.bones:
                world = body.matrix_world @ bone.matrix
                turn = world.to_quaternion()
                numbers = [*world.to_translation(), *turn]
                out.write(f"{frame - 1},{bone.name}," + ",".join(f"{number:.7f}" for number in numbers) + "\n")


for name, (both, options) in VARIANTS.items():
    body = armature()
    scene = bpy.context.scene
    scene.render.fps, scene.frame_start, scene.frame_end = 25, 1, 6
    if both:
        animate(body, "second", 4, 2.0)
    first = animate(body, "first", 6, 0.0)
    path = os.path.join(FOLDER, f"blender_{name}")
    bpy.ops.export_scene.fbx(filepath=path + ".fbx", object_types={"ARMATURE"}, add_leaf_bones=False, bake_anim=True,
                             bake_anim_use_all_actions=True, bake_anim_use_nla_strips=False, # Curves that do not move are left out, so that the files are small.
                             bake_anim_simplify_factor=0.01,
                             bake_anim_force_startend_keying=False, **options)
    body.animation_data.action = first
    if name == "plain":
        write_places(body, os.path.join(FOLDER, "blender.csv"), 6)
