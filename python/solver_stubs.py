#!/usr/bin/env python3
"""Writes oneac/_solvers.pyi, the types of the solvers' functions, from the list of solvers.

  solver_stubs.py FOLDER      which holds the package oneac
"""
import sys
from pathlib import Path

HEAD = '''# Made by solver_stubs.py from the list of solvers.
from numpy.typing import ArrayLike

from ._results import Poses

# The names stand here: what `from ._solvers import *` brings is read from them.
__all__ = [
'''


def stub_of(solver):
    arguments = "x1: ArrayLike, x2: ArrayLike" + (", A: ArrayLike" if solver.affine else "")
    doc = solver.doc.replace("\\", "\\\\").replace('"""', "'''")
    indented = "\n".join(("    " + line).rstrip() for line in doc.split("\n"))
    return f'\ndef {solver.name}({arguments}) -> Poses:\n    r"""{indented.strip()}\n    """\n'


def main():
    folder = Path(sys.argv[1])
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(folder))
    from oneac import _oneac

    solvers = _oneac.solvers()
    names = "".join(f'    "{solver.name}",\n' for solver in solvers)
    text = HEAD + names + "]\n" + "".join(stub_of(solver) for solver in solvers)
    (folder / "oneac" / "_solvers.pyi").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
