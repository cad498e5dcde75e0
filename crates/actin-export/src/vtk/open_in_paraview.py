"""Shows a run in ParaView: monomers as ellipsoids, rods as tubes, all records in time.

    cd runs/cantilever
    paraview --script=open_in_paraview.py       opens the run
    pvpython open_in_paraview.py a.png          writes a picture of the last record

The script reads run.pvd from its own folder. If ParaView does not set `__file__`, it reads run.pvd from the
working directory.
"""

import os
import sys

from paraview import simple

ROD_RADIUS_NM = 3.5


def collection():
    """Returns the path of run.pvd."""
    here = globals().get("__file__")
    folders = [os.path.dirname(os.path.abspath(here))] if here else []
    for folder in folders + [os.getcwd()]:
        path = os.path.join(folder, "run.pvd")
        if os.path.exists(path):
            return path
    raise RuntimeError("run.pvd not found next to this script or in the working directory: start ParaView in the run directory")


def monomers(run, view):
    """Shows monomers as ellipsoids; nodes of rods have zero semi-axes and are invisible."""
    shown = simple.Show(run, view, "GeometryRepresentation")
    shown.SetRepresentationType("3D Glyphs")
    shown.GlyphType = "Sphere"
    shown.GlyphType.Radius = 1.0
    shown.GlyphType.ThetaResolution = 24
    shown.GlyphType.PhiResolution = 16
    shown.Orient = 1
    shown.OrientationMode = "Quaternion"
    shown.SelectOrientationVectors = "orientation"
    shown.Scaling = 1
    modes = shown.GetProperty("ScaleMode").Available
    shown.ScaleMode = next(mode for mode in modes if "Vector Components" in mode)
    shown.SelectScaleArray = "semi_axes_nm"
    shown.ScaleFactor = 1.0
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.745, 0.098, 0.137]


def rods(run, view):
    """Shows rods as tubes."""
    tube = simple.Tube(registrationName="rods", Input=run)
    tube.Radius = ROD_RADIUS_NM
    tube.NumberofSides = 24
    shown = simple.Show(tube, view, "GeometryRepresentation")
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.118, 0.275, 0.706]


def look(view):
    """Shows the last record with lab z to the right and x upwards, seen slightly from above."""
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    view.OrientationAxesVisibility = 1
    view.CameraPosition = [0.35, 1.0, 0.15]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = [1.0, 0.0, 0.0]
    view.CameraParallelProjection = 1
    simple.ResetCamera(view)


run = simple.PVDReader(registrationName="run", FileName=collection())
run.UpdatePipeline()
view = simple.GetActiveViewOrCreate("RenderView")
monomers(run, view)
rods(run, view)
look(view)
simple.Render(view)
pictures = [word for word in sys.argv[1:] if word.endswith(".png")]
if pictures:
    simple.SaveScreenshot(pictures[0], view, ImageResolution=[1280, 720])
