# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of YADE's 3D window: a broken cylinder, cut by a plane through its axis.

    xvfb-run -a -s "-screen 0 1024x768x24" env PYTHONPATH=build/python \\
        yade -x scripts/tutorials/window_solid.py stress_zz PICTURE

The first argument is the quantity that colours the grains; ``cracks`` hides the grains. YADE writes
PICTURE00000.png and PICTURE00001.png. The last printed line names the complete picture. Without the
second argument, and without xvfb-run, the window stays open.
"""

import sys
import time

import flexpm  # isort: skip  (first: it adds the classes below to YADE)
from PyQt5.QtWidgets import QApplication
from yade import Gl1_LaguerreCell, O, qt

shown = sys.argv[1] if len(sys.argv) > 1 else "stress_zz"
core = flexpm.Specimen.cylinder(0.012, 0.024, seed=1)
flexpm.run("uniaxial", core, model="rigid", stop_ratio=0.5)

# Grains in front of the plane through the axis and x are hidden.
Gl1_LaguerreCell.colour = shown
Gl1_LaguerreCell.cutNormal, Gl1_LaguerreCell.cutOffset = (0, -1, 0), 0.0
Gl1_LaguerreCell.textColor = (0, 0, 0)
window = qt.Renderer()
window.intrPhys, window.bgColor = True, (1, 1, 1)
if shown == "cracks":
    window.shape = False
    Gl1_LaguerreCell.cutNormal = (0, 0, 0)

# The height is along z; the viewer is in front, to the right and above.
view = qt.View()
view.screenSize = (480, 560)
view.upVector = (0, 0, 1)
view.viewDir = (-0.3, 0.9, -0.3)
view.ortho = True
view.axes = False
view.fitAABB((-0.008, -0.006, -0.001), (0.014, 0.006, 0.026))

# A script that makes pictures must process the events of the window.
if len(sys.argv) > 2:
    camera = qt.SnapshotEngine(fileBase=sys.argv[2], iterPeriod=1)
    O.engines = [*O.engines, camera]
    O.run(2)
    while O.running:
        QApplication.processEvents()
        time.sleep(0.01)
    low, high = Gl1_LaguerreCell.range
    print(f"drawn {camera.snapshots[-1]}, range {low:.4g} to {high:.4g}")
