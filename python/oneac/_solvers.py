"""A function per solver of the list, by its name."""

from . import _oneac

__all__ = [solver.name for solver in _oneac.solvers()]

globals().update({name: getattr(_oneac, name) for name in __all__})
