"""The package's types: stubs of the wrapped classes, annotations of the functions, mypy on both."""

import ast
import importlib.util
import inspect
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import gnomon
import vtkmodules

PACKAGE = os.path.dirname(gnomon.__file__)
EXAMPLES = Path(__file__).parents[2] / "examples"
VTK_HAS_TYPES = Path(vtkmodules.__file__).with_name("vtkCommonCore.pyi").exists()


def public_names(kind):
    """The names in a class, and in those of the package that it derives from."""
    return {name for each in kind.__mro__ if each.__module__.startswith("gnomon")
            for name in vars(each) if not name.startswith("_")}


examples_work = unittest.skipUnless(
    hasattr(gnomon, "vtkGnomonEGLRenderWindow"), "examples take the window of EGL"
)


def stubs():
    """The classes in the stubs, by name."""
    found = {}
    for module in ("GnomonLights", "GnomonPlugin"):
        with open(os.path.join(PACKAGE, module + ".pyi"), encoding="utf-8") as stub:
            for node in ast.parse(stub.read()).body:
                if isinstance(node, ast.ClassDef):
                    found[node.name] = node
    return found


def declared_names(found, node):
    """The names in a class of the stubs, and in those of the stubs that it derives from."""
    names = set().union(*(declared_names(found, found[base.id]) for base in node.bases
                          if base.id in found))
    for member in node.body:
        if isinstance(member, (ast.FunctionDef, ast.ClassDef)):
            names.add(member.name)
        elif isinstance(member, ast.AnnAssign):
            names.add(member.target.id)
    return names


class Stubs(unittest.TestCase):
    def test_the_package_says_that_it_has_types(self):
        self.assertTrue(os.path.exists(os.path.join(PACKAGE, "py.typed")))

    def test_stubs_name_what_the_classes_have(self):
        found = stubs()
        classes = {name for name in dir(gnomon) if name.startswith("vtk")}
        self.assertEqual(len(classes), 10 + hasattr(gnomon, "vtkGnomonEGLRenderWindow"))
        self.assertLessEqual(classes, set(found))
        for name in classes:
            self.assertEqual(declared_names(found, found[name]),
                             public_names(getattr(gnomon, name)), name)

    def test_methods_have_types_and_text(self):
        methods = [
            member
            for member in stubs()["vtkGnomonShadowPass"].body
            if isinstance(member, ast.FunctionDef)
        ]
        self.assertGreater(len(methods), 50)
        for method in methods:
            types = [argument.annotation for argument in method.args.args if argument.arg != "self"]
            self.assertNotIn(None, [*types, method.returns], method.name)
        route = next(method for method in methods if method.name == "SetRoute")
        self.assertEqual(ast.unparse(route.args), "self, _arg: int")
        self.assertIn("The route to take", ast.get_docstring(route))


class Functions(unittest.TestCase):
    def test_functions_have_types_and_text(self):
        self.assertEqual(len(gnomon.__all__), 14)
        for name in gnomon.__all__:
            function = getattr(gnomon, name)
            signature = inspect.signature(function)
            for parameter in signature.parameters.values():
                self.assertIsNot(parameter.annotation, parameter.empty, f"{name}, {parameter}")
                self.assertIn(f"    {parameter.name} : " if parameter.kind != parameter.VAR_KEYWORD
                              else f"    **{parameter.name}\n", inspect.cleandoc(function.__doc__)
                              .replace("\n", "\n    "), name)
            self.assertIsNot(signature.return_annotation, signature.empty, name)


@unittest.skipUnless(importlib.util.find_spec("mypy"), "there is no mypy")
class TypeChecker(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cache = tempfile.TemporaryDirectory()
        cls.settings = os.path.join(cls.cache.name, "mypy.ini")
        with open(cls.settings, "w", encoding="utf-8") as file:  # PyVista's types refuse its calls
            file.write("[mypy]\n[mypy-pyvista.*]\nfollow_imports = skip\n")

    @classmethod
    def tearDownClass(cls):
        cls.cache.cleanup()

    def check(self, *arguments):
        # Some releases of VTK have no stubs. What PYTHONPATH names would count as installed, and no
        # error in it would be told.
        environment = {**os.environ, "MYPYPATH": os.path.dirname(PACKAGE)}
        environment.pop("PYTHONPATH")
        run = subprocess.run(
            [sys.executable, "-m", "mypy", "--ignore-missing-imports", "--config-file",
             self.settings, "--cache-dir", self.cache.name, *arguments],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        return run.stdout

    @examples_work
    def test_the_example_and_the_package_pass(self):
        output = self.check(EXAMPLES / "shadows.py")  # and the package, which it imports
        self.assertIn("Success: no issues found", output)

    @unittest.skipIf(VTK_HAS_TYPES, "VTK's own types refuse what its classes take")
    @examples_work
    def test_examples_pass_strictly(self):
        output = self.check("--strict", "--allow-subclassing-any", "--follow-imports=silent",
                            *sorted(EXAMPLES.glob("*.py")))
        self.assertRegex(output, r"Success: no issues found in 1\d source files")

    def test_mistakes_do_not(self):
        program = "\n".join([
            "import gnomon",
            "from vtkmodules.vtkRenderingCore import vtkRenderer",
            *(f"gnomon.{name}" for name in dir(gnomon)),
            "gnomon.magic",
            "shadows = gnomon.vtkGnomonShadowPass()",
            "shadows.SetRoute(shadows.ROUTE_IMAGE)",
            "shadows.SetSettings(None)",
            "gnomon.vtkGnomonLightPlacement.ShineOnSphere(None, (0, 0, 0), 1.0)",
            "shadows.route, shadows.kernel_size, shadows.snap = 'image', 5, True",
            "shadows.SetRoute('image')",
            "gnomon.add_shadows(None, 3)",
            "gnomon.add_shadows(vtkRenderer(), 'silhouete')",
            "shadows.route = 'images'",
            "shadows.kernel_size = 'wide'",
        ])
        lines = self.check("-c", program).splitlines()
        errors = [line.partition(": error: ")[2] for line in lines if ": error: " in line]
        self.assertEqual(len(errors), 6, lines)
        self.assertIn("magic", errors[0])
        self.assertIn("SetRoute", errors[1])
        self.assertIn("add_shadows", errors[2])
        self.assertIn("silhouete", errors[3])
        self.assertIn("images", errors[4])
        self.assertIn('"int"', errors[5])


if __name__ == "__main__":
    unittest.main()
