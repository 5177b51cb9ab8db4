"""Parts of the clients that take pictures: a check of shadows, which prints lines as drag.py
does. pcl_visualizer.cxx does the same in C++."""

import sys

import gnomon

failures = 0


def tell(name, fault):
    """Print a check's result: a fault, or none."""
    global failures
    print(f"FAIL {name}: {fault}" if fault else f"ok   {name}", flush=True)
    failures += bool(fault)


def darker(before, after):
    """How many pixels of the second picture are clearly darker."""
    return int((before.astype(int) - after > 40).all(axis=2).sum())


def check_shadows(target, take_picture, caster, least):
    """Check that a caster's shadow of so many pixels comes and goes, and the picture comes back."""
    plain = take_picture()
    gnomon.add_shadows(target)
    shown = take_picture()
    count = darker(plain, shown)
    tell("a shadow shows", count < least and f"{count} pixels are darker, expected {least}")
    count = darker(shown, plain)
    tell("shadows make nothing brighter", count and f"{count} pixels are brighter")
    gnomon.vtkGnomonPropKeys.SetCasts(caster, False)
    count = darker(plain, take_picture())
    tell("a caster that does not cast has none", count and f"{count} pixels are darker")
    gnomon.vtkGnomonPropKeys.SetCasts(caster, True)
    count = int((shown != take_picture()).any(axis=2).sum())
    tell("a caster that casts again has it again", count and f"{count} pixels differ")
    gnomon.remove_shadows(target)
    count = int((plain != take_picture()).any(axis=2).sum())
    tell("without shadows, the picture is as it was", count and f"{count} pixels differ")


def end():
    sys.exit(failures > 0)
