"""A distributed data set with shadows: mpirun -n 3 pvbatch paraview_shadows.py shadows.png"""

import sys

from paraview.simple import AddLight, Contour, CreateView, Plane, SaveScreenshot, Show, Wavelet

view = CreateView("RenderView", ShowShadows=1)
view.ViewSize, view.UseLight = [800, 600], 0
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [25, -45, 40], [0, 0, -3], [0, 0, 1]
sun = AddLight(view=view)
sun.Coords, sun.Type = "Scene", "Directional"
sun.Position, sun.FocalPoint = [20, -10, 40], [0, 0, 0]
Show(Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[230.0]), view)
Show(Plane(Origin=[-20, -20, -11], Point1=[20, -20, -11], Point2=[-20, 20, -11]), view)
SaveScreenshot(sys.argv[1], view)
