"""VTK objects that objects of other packages hold."""

from vtkmodules.vtkCommonCore import vtkObjectBase

# tvtk's, props' of vedo and Mayavi, lights' of Mayavi, plotters', figures' of Mayavi
_ATTRIBUTES = ("_vtk_obj", "actor", "source", "renderer", "scene")


def unwrap(holder):
    """Return the VTK object that an object holds; the object itself if it is one or holds none."""
    held = holder
    for _ in range(4):
        if isinstance(held, vtkObjectBase):
            return held
        parts = (getattr(held, name, None) for name in _ATTRIBUTES)
        held = next((part for part in parts if part is not None), None)
    return holder
