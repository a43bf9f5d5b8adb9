# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of the models."""

#: Grains that parts hold: deformable and rigid blocks.
BLOCK_MODELS = ("flexible", "rigid")
#: Grains of inner particles: normals between grains from the discs' centres, or of the edge.
INNER_MODELS = ("inner", "inner-un")
#: Models of flexpm's own solver.
GRAIN_MODELS = (*BLOCK_MODELS, *INNER_MODELS)
#: YADE's own models on the discs of a specimen.
SPHERE_MODELS = ("jcfpm", "cohfrict")
MODELS = (*GRAIN_MODELS, *SPHERE_MODELS)
