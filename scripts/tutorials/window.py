# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of YADE's 3D window: a broken specimen, coloured by the quantity of the first argument.

    xvfb-run -a -s "-screen 0 1024x768x24" env PYTHONPATH=build/python \\
        yade -x scripts/tutorials/window.py stress_yy PICTURE

YADE writes PICTURE00000.png and PICTURE00001.png. The last printed line names the complete picture.
Without the second argument, and without xvfb-run, the window stays open.
"""

import sys
import time

import flexpm  # isort: skip  (first: it adds the classes below to YADE)
from PyQt5.QtWidgets import QApplication
from yade import Gl1_LaguerreCell, Gl1_LobattoPhys, O, qt

shown = sys.argv[1] if len(sys.argv) > 1 else "stress_yy"
specimen = flexpm.Specimen.rectangle(0.02, 0.04, thickness=0.02, seed=1)
flexpm.run("uniaxial", specimen, stop_ratio=0.8)

# Grains: quantity of their colours. Bonds: cracks by mode, or forces, which intrPhys displays.
Gl1_LaguerreCell.colour = "shape" if shown == "forces" else shown
Gl1_LaguerreCell.textColor = (0, 0, 0)
Gl1_LobattoPhys.forces = shown == "forces"
qt.Renderer().intrPhys = True
qt.Renderer().bgColor = (1, 1, 1)

# The grains are in the plane of x and y.
view = qt.View()
view.screenSize = (480, 560)
view.viewDir, view.upVector = (0, 0, -1), (0, 1, 0)
view.ortho = True
view.fitAABB((-0.002, -0.005, 0), (0.034, 0.044, 0))

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
