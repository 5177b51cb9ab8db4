"""The program `gnomon` of a wheel: pip's script runs the C++ program in the package's folder."""

import os
import sys
from typing import NoReturn


def main() -> NoReturn:
    """Run the program with this process's arguments, in its place."""
    program = os.path.join(os.path.dirname(__file__), "bin", "gnomon")
    os.execv(program, [program, *sys.argv[1:]])
