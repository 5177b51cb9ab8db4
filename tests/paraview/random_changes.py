"""Draw 200 pictures, with random changes between them.

    mpirun -np 3 pvbatch random_changes.py shared DATA OUT     writes visibility, watches memory
    pvbatch random_changes.py alone DATA OUT                   makes the same changes, and compares

DATA is of prepare.py.
"""

import collections
import json
import os
import pathlib
import random
import sys

from paraview.simple import Hide, Render, Show, Sphere

import scenario

RENDERS = 200
REPEATED = 50  # pictures that are drawn again and again
PARTS = 3
SIZES = ((200, 150), (160, 120), (201, 149))
MOST_GROWTH_MEGABYTES = 8


def memory_megabytes():
    """Return the resident memory of each process of the job; of this one alone if it has no job."""
    job = pathlib.Path(f"/proc/{os.getppid()}/task/{os.getppid()}/children").read_text().split()
    own = str(os.getpid())
    used = []
    for process in job if own in job else [own]:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
        resident = next(line for line in status.splitlines() if line.startswith("VmRSS:"))
        used.append(int(resident.split()[1]) / 1024)
    return used


class Changes:
    """A view, and the changes that a seed makes to it."""

    def __init__(self, data, seed):
        self.random = random.Random(seed)
        self.view = scenario.make_view(size=SIZES[0])
        self.sphere = Sphere(Center=[0.1, 0.2, 0.9], Radius=0.25)
        self.displays = [
            scenario.show_parts(self.view, data, "atrium-random", PARTS),
            scenario.show_parts(self.view, data, "bunny-round-robin", PARTS),
        ]
        Render(self.view)  # the first one resets the camera
        for _, display in self.displays:
            display.CoordinateShiftScaleMethod = "Disable"
        self.lights = [
            scenario.add_light(self.view, "sun", (0.7, 1.1, 2.4)),
            scenario.add_light(self.view, "spot", (-0.9, 0.4, 2.6), cone=30.0),
            scenario.add_light(self.view, "point", (0.4, -0.5, 2.2)),
        ]
        self.view.LightSamples = 16
        self.move_camera()

    def place(self, low, high):
        uniform = self.random.uniform
        return [uniform(-2, 2), uniform(-2, 2), uniform(low, high)]

    def move_camera(self):
        scenario.set_camera(self.view, self.place(0.4, 3), (self.random.uniform(-0.5, 0.5), 0, 0.3))

    def move_light(self):
        self.random.choice(self.lights).Position = self.place(1.5, 4)

    def change_light(self):
        light = self.random.choice(self.lights)
        light.Type = self.random.choice(["Directional", "Positional"])
        light.ConeAngle = self.random.choice([25.0, 90.0])

    def switch_light(self):
        light = self.random.choice(self.lights)
        light.Enable = int(self.random.random() < 0.75)

    def change_light_size(self):
        self.view.LightSize = self.random.choice([0.0, 0.0, 0.05, 0.5])
        self.view.LightSamples = self.random.choice([4, 16])

    def move_data(self):
        _, display = self.random.choice(self.displays)
        display.Position = [self.random.uniform(-0.3, 0.3) for _ in range(3)]
        display.Orientation = [0, 0, self.random.uniform(-40, 40)]

    def hide_or_show(self):
        source, display = self.random.choice(self.displays)
        (Hide if self.random.random() < 0.25 else Show)(source, self.view)

    def change_representation(self):
        _, display = self.random.choice(self.displays)
        kinds = ["Surface", "Surface", "Surface", "Wireframe", "Points", "Surface With Edges"]
        display.Representation = self.random.choice(kinds)

    def switch_shadows(self):
        self.view.ShowShadows = int(self.random.random() < 0.9)

    def resize(self):
        self.view.ViewSize = list(self.random.choice(SIZES))

    CHANGES = (
        move_camera,
        move_camera,
        move_light,
        move_light,
        change_light,
        switch_light,
        change_light_size,
        move_data,
        hide_or_show,
        change_representation,
        switch_shadows,
        resize,
    )

    def state(self):
        """Return a function that makes the view show again what it shows."""
        of_light = ("Type", "ConeAngle", "Position", "Enable")
        of_display = ("Position", "Orientation", "Visibility", "Representation")
        of_view = ("CameraPosition", "CameraFocalPoint", "LightSize", "LightSamples")
        names = [(light, name) for light in self.lights for name in of_light]
        names += [(display, name) for _, display in self.displays for name in of_display]
        names += [(self.view, name) for name in of_view + ("ShowShadows", "ViewSize")]
        values = []
        for proxy, name in names:
            value = proxy.GetPropertyValue(name)
            values.append(value if isinstance(value, (int, float, str)) else list(value))

        def restore():
            for (proxy, name), value in zip(names, values):
                setattr(proxy, name, value)

        return restore

    def change(self):
        for _ in range(self.random.choice([0, 1, 1, 2, 3])):
            self.random.choice(self.CHANGES)(self)


def draw_shared(changes, out):
    """Draw all pictures; return what makes the view show them again."""
    routes = collections.Counter()
    traced = 0
    states = []
    for number in range(RENDERS):
        changes.change()
        path = out / f"{number}.vti"
        path.unlink(missing_ok=True)
        is_still = changes.random.random() < 0.8
        keeps = is_still and changes.random.random() < 0.5
        changes.view.VisibilityFile = str(path) if keeps else ""
        if is_still:
            Render(changes.view)
        else:
            changes.view.SMProxy.InteractiveRender()
        report = scenario.report(changes.view)
        (out / f"{number}.json").write_text(json.dumps(report))
        routes[report["route"] if changes.view.ShowShadows else "switched off"] += 1
        traced += any(light["rays"] > 0 for light in report["lights"])
        states.append(changes.state())
    scenario.check("random changes", traced > RENDERS // 4, f"{dict(routes)}, {traced} with rays")
    return states


def watch_memory(changes, states):
    """Draw some pictures again and again. New ones cost memory in plain ParaView, too: each look
    has a shader program."""
    changes.view.VisibilityFile = ""
    used = []
    for _ in range(4):
        for restore in states[-REPEATED:]:
            restore()
            Render(changes.view)
        used.append(memory_megabytes())
    growth = [after - before for before, after in zip(used[1], used[-1])]
    figures = ", ".join(f"{of:.1f}" for of in growth)
    passes = max(growth) < MOST_GROWTH_MEGABYTES
    scenario.check("memory", passes, f"grows by {figures} MB in {2 * REPEATED} renders")


def draw_alone(changes, out):
    sums = scenario.Comparison(PARTS, needs_shadow=False)
    for number in range(RENDERS):
        changes.change()
        path = out / "alone.vti"
        path.unlink(missing_ok=True)
        is_still = changes.random.random() < 0.8
        keeps = is_still and changes.random.random() < 0.5
        theirs = out / f"{number}.vti"
        changes.view.VisibilityFile = str(path) if keeps else ""
        Render(changes.view)
        if keeps and changes.view.ShowShadows:
            if path.exists() != theirs.exists():
                sums.faults.append(f"{number}: only one wrote visibility")
            elif path.exists():
                report = json.loads((out / f"{number}.json").read_text())
                ours = scenario.read_visibility(str(theirs))
                sums.add(str(number), ours, scenario.read_visibility(str(path)), report)
    scenario.check("random changes show what one process shows", not sums.faults, str(sums))


def main():
    mode, data, out = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    out.mkdir(parents=True, exist_ok=True)
    scenario.load_plugin()
    changes = Changes(data, seed=5)
    if mode == "shared":
        watch_memory(changes, draw_shared(changes, out))
    else:
        draw_alone(changes, out)
    scenario.finish()


main()
