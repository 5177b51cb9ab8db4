#!/usr/bin/python3
"""Measure the drawings that exact shadows of several lights take with a moving camera.

    PYTHONPATH=... LD_LIBRARY_PATH=... one_drawing.py FOLDER [FRAMES]

FOLDER: scenes of `gnomon scenes --export NAME FOLDER`. Prints a line of CSV for each number of suns
and scene, with medians in plain frames, which are drawn in turns: `silhouette` and `nsm`, and three
ways to draw without the rays. `two drawings`: `silhouette`'s, of triangle numbers and of the
picture. `records`: that of `nsm`, where each pixel that `silhouette` leaves uncertain appends 16
bytes a light to a buffer, which is read back; it lacks the drawing that finishes the picture.
`contributions`: VTK's, into a half-float attachment a light and one of triangle numbers, which is
read back, and one that adds to the picture what a pixel's bits leave of these.
"""

import csv
import ctypes
import json
import math
import pathlib
import statistics
import sys
import time

import gnomon
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401: makes VTK's factories
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

# The share of pixels that a map of 1024 texels leaves uncertain, a sun.
UNCERTAIN = {"bunny": 0.048, "office": 0.032, "trees-side": 0.21, "terrain": 0.55}
SUNS = 2, 5
SIZE = 1024
WARM = 20  # frames
COLUMNS = "silhouette", "nsm", "two drawings", "records", "contributions"
MOST_RECORDS = 6_000_000

DRAW_FRAMEBUFFER, STORAGE, TEXTURE_2D, COLOUR_0 = 0x8CA9, 0x90D2, 0x0DE1, 0x8CE0
HALF_RGBA, FLOAT_RG, BYTES = (0x881A, 0x1908, 0x140B), (0x8230, 0x8227, 0x1406), (
    0x8232, 0x8D94, 0x1401)
BLEND, DEPTH_TEST, TRIANGLES, FIRST_UNIT = 0x0BE2, 0x0B71, 4, 8
ONE, SOURCE_ALPHA, REST_OF_ALPHA = 1, 0x302, 0x303
SHADERS = {"vertex": 0x8B31, "fragment": 0x8B30}
DYNAMIC_DRAW = 0x88E8
RECORDS_GLSL = """//VTK::System::Dec
#extension GL_ARB_shader_storage_buffer_object : require
#extension GL_ARB_shading_language_420pack : require
#extension GL_ARB_shader_bit_encoding : require
#extension GL_ARB_shader_image_load_store : require
layout(early_fragment_tests) in;
layout(std430, binding = 3) buffer Uncertain { uint count; uint pads[3]; uvec4 records[]; };
"""

egl = ctypes.CDLL("libEGL.so.1")
egl.eglGetProcAddress.restype = ctypes.c_void_p
Uint, Int, Pointer, Size = ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.c_ssize_t


def gl(name, *types, result=None):
    return ctypes.CFUNCTYPE(result, *types)(egl.eglGetProcAddress(name.encode()))


def image(name, size, stored, channels, number, data=None):
    """Store a 2D texture without levels, which stays bound."""
    gl("glBindTexture", Uint, Uint)(TEXTURE_2D, name)
    gl("glTexImage2D", Uint, Int, Int, Int, Int, Int, Uint, Uint, Pointer)(
        TEXTURE_2D, 0, stored, size, size, 0, channels, number, data)
    for filtering in 0x2800, 0x2801:
        gl("glTexParameteri", Uint, Uint, Int)(TEXTURE_2D, filtering, 0x2600)


def program_of(**sources):
    """Link a program of GLSL 1.50 from the sources of its shaders."""
    program = gl("glCreateProgram", result=Uint)()
    for kind, source in sources.items():
        shader = gl("glCreateShader", Uint, result=Uint)(SHADERS[kind])
        text = ctypes.c_char_p(("#version 150\n" + source).encode())
        gl("glShaderSource", Uint, Int, Pointer, Pointer)(shader, 1, ctypes.byref(text), None)
        gl("glCompileShader", Uint)(shader)
        gl("glAttachShader", Uint, Uint)(program, shader)
    gl("glLinkProgram", Uint)(program)
    linked = Int(0)
    gl("glGetProgramiv", Uint, Uint, Pointer)(program, 0x8B82, ctypes.byref(linked))
    if not linked.value:
        raise RuntimeError("the program that finishes the picture does not link")
    return program


def add_glsl(actor, tag, text):
    actor.GetShaderProperty().AddFragmentShaderReplacement(tag, True, text, False)


class Records:
    """A storage buffer to which uncertain pixels append."""

    def __init__(self, renderer, share, suns):
        self.buffer = Uint(0)
        gl("glGenBuffers", Int, Pointer)(1, ctypes.byref(self.buffer))
        gl("glBindBuffer", Uint, Uint)(STORAGE, self.buffer)
        gl("glBufferData", Uint, Size, Pointer, Uint)(
            STORAGE, 16 * (MOST_RECORDS + 1), None, DYNAMIC_DRAW)
        # Blocks of pixels, as those at shadows' edges and on slopes are.
        appends = "".join(
            f"if (fract(sin(dot(block, vec2({12.9898 + sun}, 78.233))) * 43758.5453) < {share})"
            f" {{ uint at = atomicAdd(count, 1u); if (at < {MOST_RECORDS}u) records[at] ="
            " uvec4(uint(gl_PrimitiveID), uint(gl_FragCoord.x) | uint(gl_FragCoord.y) << 16,"
            f" floatBitsToUint(gl_FragCoord.z), {sun}u); }}\n" for sun in range(suns))
        for actor in renderer.GetActors():
            add_glsl(actor, "//VTK::System::Dec", RECORDS_GLSL)
            add_glsl(actor, "//VTK::TCoord::Impl",
                     f"vec2 block = floor(gl_FragCoord.xy / 8.0);\n{appends}//VTK::TCoord::Impl")

    def begin(self):
        gl("glBindBufferBase", Uint, Uint, Uint)(STORAGE, 3, self.buffer)
        gl("glBufferSubData", Uint, Size, Size, Pointer)(STORAGE, 0, 4, ctypes.byref(Uint(0)))

    def end(self):
        count = Uint(0)
        read = gl("glGetBufferSubData", Uint, Size, Size, Pointer)
        gl("glFinish")()
        gl("glBindBuffer", Uint, Uint)(STORAGE, self.buffer)
        read(STORAGE, 0, 4, ctypes.byref(count))
        read_bytes = 16 * min(count.value, MOST_RECORDS)
        read(STORAGE, 16, read_bytes, ctypes.create_string_buffer(read_bytes))
        if read_bytes == 0:
            raise RuntimeError("no pixel left a record")


class Contributions:
    """Attachments beside the picture's: one a sun, and one of triangle numbers."""

    def __init__(self, renderer, _share, suns):
        self.names, self.bits, self.corners = (Uint * (suns + 1))(), Uint(0), Uint(0)
        self.numbers = (ctypes.c_float * (2 * SIZE * SIZE))()
        self.hidden = bytes(pixel // 64 % 2**suns for pixel in range(SIZE)) * SIZE
        gl("glGenTextures", Int, Pointer)(suns + 1, self.names)
        gl("glGenTextures", Int, Pointer)(1, ctypes.byref(self.bits))
        gl("glGenVertexArrays", Int, Pointer)(1, ctypes.byref(self.corners))
        for i, name in enumerate(self.names):
            image(name, SIZE, *(HALF_RGBA if i < suns else FLOAT_RG))
        self.program = program_of(
            vertex="void main() { gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0,"
            " 4.0 * float(gl_VertexID >> 1) - 1.0, 0.0, 1.0); }",
            fragment="uniform usampler2D bits; out vec4 colour; "
            + "".join(f"uniform sampler2D ofSun{sun}; " for sun in range(suns))
            + "void main() { ivec2 pixel = ivec2(gl_FragCoord.xy); colour = vec4(0.0);"
            " uint hidden = texelFetch(bits, pixel, 0).r;\n"
            + "".join(f"colour.rgb += float(1u - (hidden >> {sun}u & 1u)) *"
                      f" texelFetch(ofSun{sun}, pixel, 0).rgb;\n" for sun in range(suns)) + "}")
        outputs = "".join(
            f"gl_FragData[{sun + 1}] = vec4(max(0.0, dot(normalVCVSOutput, -lightDirectionVC{sun}))"
            f" * lightColor{sun} * diffuseColor, 1.0);\n" for sun in range(suns))
        for actor in renderer.GetActors():
            add_glsl(actor, "//VTK::Light::Impl",
                     f"//VTK::Light::Impl\n{outputs}gl_FragData[{suns + 1}] ="
                     " vec4(1.0, float(gl_PrimitiveID), 0.0, 1.0);\n")
            # VTK selects the first buffer alone at the camera.
            actor.GetMapper().AddObserver(
                "UpdateShaderEvent", lambda *_: self.select(len(self.names) + 1))
        renderer.AddObserver("StartEvent", self.attach)
        renderer.AddObserver("EndEvent", self.finish)

    def select(self, count):
        first = range(COLOUR_0, COLOUR_0 + count)
        gl("glDrawBuffers", Int, Pointer)(count, (Uint * count)(*first))

    def attach(self, *_):
        for i, name in enumerate(self.names):
            gl("glFramebufferTexture2D", Uint, Uint, Uint, Uint, Int)(
                DRAW_FRAMEBUFFER, COLOUR_0 + 1 + i, TEXTURE_2D, name, 0)

    def finish(self, *_):
        gl("glFinish")()
        gl("glBindTexture", Uint, Uint)(TEXTURE_2D, self.names[-1])
        gl("glGetTexImage", Uint, Int, Uint, Uint, Pointer)(
            TEXTURE_2D, 0, *FLOAT_RG[1:], self.numbers)
        self.select(1)
        self.add()

    def add(self):
        """Add the contributions that bits leave. VTK's state stays as it was."""
        before = {name: Int(0) for name in (0x8B8D, 0x85B5)}  # program, vertex array
        for name, value in before.items():
            gl("glGetIntegerv", Uint, Pointer)(name, ctypes.byref(value))
        gl("glUseProgram", Uint)(self.program)
        images = [*((f"ofSun{i}", name) for i, name in enumerate(self.names[:-1])), ("bits", None)]
        for unit, (name, texture) in enumerate(images, FIRST_UNIT):
            gl("glActiveTexture", Uint)(0x84C0 + unit)
            if texture is None:
                image(self.bits, SIZE, *BYTES, self.hidden)
            else:
                gl("glBindTexture", Uint, Uint)(TEXTURE_2D, texture)
            at = gl("glGetUniformLocation", Uint, Pointer, result=Int)(self.program, name.encode())
            gl("glUniform1i", Int, Int)(at, unit)
        gl("glEnable", Uint)(BLEND)
        gl("glDisable", Uint)(DEPTH_TEST)
        gl("glBlendFunc", Uint, Uint)(ONE, ONE)
        gl("glBindVertexArray", Uint)(self.corners)
        gl("glDrawArrays", Uint, Int, Int)(TRIANGLES, 0, 3)
        gl("glBindVertexArray", Uint)(before[0x85B5].value)
        gl("glUseProgram", Uint)(before[0x8B8D].value)
        gl("glBlendFuncSeparate", Uint, Uint, Uint, Uint)(
            SOURCE_ALPHA, REST_OF_ALPHA, ONE, REST_OF_ALPHA)
        gl("glEnable", Uint)(DEPTH_TEST)
        for unit in range(FIRST_UNIT + len(images) - 1, FIRST_UNIT - 1, -1):
            gl("glActiveTexture", Uint)(0x84C0 + unit)
            gl("glBindTexture", Uint, Uint)(TEXTURE_2D, 0)
        gl("glActiveTexture", Uint)(0x84C0)

    def begin(self):
        pass

    def end(self):
        if 1.0 not in self.numbers[SIZE * SIZE:SIZE * SIZE + SIZE]:
            raise RuntimeError("no pixel of the middle row has a number")


class Variant:
    """One scene in a window of its own, drawn in one way."""

    def __init__(self, folder, scene, suns, technique, extra):
        described = json.loads((folder / f"{scene}.json").read_text())
        self.renderer = vtkRenderer()
        for model in described["models"]:
            self.renderer.AddActor(self.prop(folder, model))
        self.camera, seen = self.renderer.GetActiveCamera(), described["camera"]
        self.camera.SetPosition(seen["position"])
        self.camera.SetFocalPoint(seen["target"])
        self.camera.SetViewUp(seen["up"])
        self.camera.SetViewAngle(seen["fov"])
        for sun in range(suns):
            light, turn = vtkLight(), 2 * math.pi * sun / suns + 0.4
            light.SetPosition(math.cos(turn), 0.9, math.sin(turn))
            light.SetIntensity(1.2 / suns)
            self.renderer.AddLight(light)
        self.window = gnomon.vtkGnomonEGLRenderWindow()
        self.window.SetSize(SIZE, SIZE)
        self.window.SetMultiSamples(0)
        self.window.AddRenderer(self.renderer)
        self.shadows = technique and gnomon.add_shadows(self.renderer, technique, light=None)
        if self.shadows:
            self.shadows.SetInteractive(self.shadows.INTERACTIVE_ON)
            self.shadows.SetMeasureStages(True)
        self.extra, self.times, self.drawings = None, [], []
        for _ in range(3):  # VTK looks for shader code from the third frame on
            self.draw()
        self.extra = extra and extra(self.renderer, UNCERTAIN[scene], suns)

    @staticmethod
    def prop(folder, model):
        reader, mapper, actor = vtkXMLPolyDataReader(), vtkPolyDataMapper(), vtkActor()
        reader.SetFileName(str(folder / model["file"]))
        mapper.SetInputConnection(reader.GetOutputPort())
        actor.SetMapper(mapper)
        matrix = vtkMatrix4x4()
        matrix.DeepCopy(model.get("matrix", [float(i % 5 == 0) for i in range(16)]))
        actor.SetUserMatrix(matrix)
        actor.GetProperty().SetColor(*model["color"])
        return actor

    def draw(self):
        self.window.MakeCurrent()
        self.camera.Azimuth(0.4)
        self.renderer.ResetCameraClippingRange()
        start = time.perf_counter()
        if self.extra:
            self.extra.begin()
        self.window.Render()
        if self.extra:
            self.extra.end()
        self.window.WaitForCompletion()
        self.times.append(1e3 * (time.perf_counter() - start))
        if self.shadows:
            self.drawings.append(sum(
                stage["milliseconds"] for stage in gnomon.report(self.shadows)["stages"]
                if stage["name"].startswith(("receivers", "visibility: read", "shading"))))


def measure(folder, scene, suns, frames):
    ways = {"silhouette": ("silhouette", None), "nsm": ("nsm", None),
            "records": ("nsm", Records), "contributions": (None, Contributions)}
    plains, ratios = [], {}
    for name, (technique, extra) in ways.items():
        # Two windows at a time: the images of more would push each other out of the caches.
        plain = Variant(folder, scene, suns, None, None)
        variant = Variant(folder, scene, suns, technique, extra)
        for _ in range(WARM + frames):
            plain.draw()
            variant.draw()
        plains.append(statistics.median(plain.times[-frames:]))
        ratios[name] = statistics.median(variant.times[-frames:]) / plains[-1]
        if name == "silhouette":
            ratios["two drawings"] = statistics.median(variant.drawings[-frames:]) / plains[-1]
        plain.window.Finalize()
        variant.window.Finalize()
    return [suns, scene, f"{statistics.median(plains):.1f}",
            *(f"{ratios[name]:.2f}" for name in COLUMNS)]


def main():
    table = csv.writer(sys.stdout)
    table.writerow(["suns", "scene", "plain ms", *COLUMNS])
    for suns in SUNS:
        for scene in UNCERTAIN:
            table.writerow(measure(pathlib.Path(sys.argv[1]), scene, suns,
                                   int(sys.argv[2]) if len(sys.argv) > 2 else 12))
            sys.stdout.flush()


if __name__ == "__main__":
    main()
