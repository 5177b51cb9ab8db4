"""Write type stubs (PEP 561) of the wrapped modules of the package gnomon.

VTK's wrappers state the types of each method in its docstring. A stub repeats them, with the text
that editors show. VTK's own vtkmodules.generate_pyi is not in every release, and leaves classes of
other modules without an import.

python3 python_stubs.py FOLDER MODULE... writes FOLDER/MODULE.pyi; the package is on the path.
"""

import ast
import builtins
import importlib
import inspect
import re
import sys
from pathlib import Path

import gnomon
from gnomon.attributes import Attribute

BUILTINS = {"None", *(name for name, value in vars(builtins).items() if isinstance(value, type))}
CONTAINERS = {(ast.Tuple, False): "Sequence", (ast.List, False): "MutableSequence",
              (ast.Tuple, True): "Tuple", (ast.List, True): "List"}


class Stub:
    """The stub of one module."""

    def __init__(self, module):
        self.module = module
        self.imports = {"typing": set()}
        body = [line for _, value in sorted(vars(module).items()) if inspect.isclass(value)
                for line in ["", "", *self.lines_of_class(value)]]
        self.lines = [f'"""Types of {module.__name__}."""', ""]
        for source, names in sorted(self.imports.items()):
            if names:
                self.lines.append(f"from {source} import {', '.join(sorted(names))}")
        self.lines += body

    def lines_of_class(self, kind):
        bases = [self.name_of(base.__name__) for base in kind.__bases__]
        lines = [f"class {kind.__name__}({', '.join(bases)}):"]

        def add(more):
            lines.extend("    " + line if line else "" for line in more)

        add(docstring(inspect.getdoc(kind) if kind.__doc__ else ""))
        members = {name: value for name, value in vars(kind).items() if not name.startswith("_")}
        subclass = getattr(gnomon, kind.__name__, kind)  # the package's, of some classes
        members |= {name: value for name, value in vars(subclass).items()
                    if isinstance(value, Attribute)}
        for name, value in members.items():
            if inspect.isclass(value):
                add(self.lines_of_class(value))
        for name, value in members.items():
            if inspect.isclass(value):
                continue
            if inspect.isroutine(value) and not inspect.isdatadescriptor(value):
                add(self.lines_of_method(name, value))
            elif inspect.isdatadescriptor(value):
                add([f"{name}: {self.type_of_property(kind, value)}"])
                add(docstring(value.__doc__) if isinstance(value, Attribute) else [])
            else:
                add([f"{name}: {type(value).__name__}"])
        if len(lines) == 1:
            add(["..."])
        return lines

    def type_of_property(self, kind, value):
        """Return its own type, or the type of its getter, which the property's text names."""
        if getattr(value, "type_name", None):
            self.imports["typing"] |= {"Literal"} & set(re.findall(r"\w+", value.type_name))
            return value.type_name
        getter = re.search(r"\bGet\w+", value.__doc__ or "")
        method = getattr(kind, getter[0], None) if getter else None
        signatures = self.signatures(getter[0], method.__doc__ or "") if method else []
        return signatures[0].rpartition(" -> ")[2].rstrip(":") if signatures else self.any()

    def signatures(self, name, text):
        found = []
        for line in re.sub(r"\n[ \t]+", " ", text.partition("\n\n")[0]).split("\n"):
            if line.startswith(name + "("):
                signature = self.signature(line)
                if signature not in found:
                    found.append(signature)
        return found

    def lines_of_method(self, name, method):
        text = (method.__doc__ or "").partition("\n\n")[2]
        signatures = self.signatures(name, method.__doc__ or "")
        if not signatures:
            signatures = [f"def {name}(self, *arguments: {self.any()}) -> {self.any()}:"]
        lines = []
        for signature in signatures:
            if len(signatures) > 1:
                self.imports["typing"].add("overload")
                lines.append("@overload")
            if "(self" not in signature:
                lines.append("@staticmethod")
            text_lines = docstring(inspect.cleandoc(text)) or ["..."]
            lines += [signature, *("    " + line if line else "" for line in text_lines)]
        return lines

    def signature(self, line):
        definition = ast.parse(f"def {line}: ...").body[0]
        for argument in definition.args.args:
            if argument.annotation:
                argument.annotation = ast.Name(self.type_of(argument.annotation, False))
        if definition.returns:
            definition.returns = ast.Name(self.type_of(definition.returns, True))
        return ast.unparse(definition).split("\n")[0]

    def type_of(self, annotation, is_returned):
        if isinstance(annotation, ast.Constant):
            return str(annotation.value)
        if isinstance(annotation, ast.Name):
            name = self.name_of(annotation.id)
            if is_returned or name in BUILTINS or name == "Any":
                return name
            self.imports["typing"].add("Optional")
            return f"Optional[{name}]"  # a pointer, which may be null
        container = CONTAINERS.get((type(annotation), is_returned))
        if container is None:
            return ast.unparse(annotation) if self.is_nested(annotation) else self.any()
        self.imports["typing"].add(container)
        of = self.type_of(annotation.elts[0], is_returned)
        repeated = len(annotation.elts) if container == "Tuple" else 1
        return f"{container}[{', '.join([of] * repeated)}]"

    def is_nested(self, annotation):
        """True if an annotation names an enumeration within one of the module's classes."""
        outer = annotation.value if isinstance(annotation, ast.Attribute) else None
        return isinstance(outer, ast.Name) and hasattr(self.module, outer.id)

    def name_of(self, name):
        """The name of a type, imported where it is another module's."""
        if name in BUILTINS or hasattr(self.module, name):
            return name
        for source, module in sorted(sys.modules.items()):
            is_known = source.startswith(("vtkmodules.vtk", "gnomon.Gnomon"))
            if is_known and getattr(getattr(module, name, None), "__module__", "") == source:
                self.imports.setdefault(source, set()).add(name)
                return name
        return self.any()

    def any(self):
        self.imports["typing"].add("Any")
        return "Any"


def docstring(text):
    text = text.strip().replace("\\", "\\\\").replace('"""', "'''")
    if not text:
        return []
    first, *others = text.split("\n")
    return [f'"""{first}"""'] if not others else [f'"""{first}', *others, '"""']


def main(folder, *modules):
    for name in modules:
        module = importlib.import_module(f"gnomon.{name}")
        Path(folder, f"{name}.pyi").write_text("\n".join(Stub(module).lines) + "\n")


main(*sys.argv[1:])
