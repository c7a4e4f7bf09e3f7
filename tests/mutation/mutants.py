"""Finds what can be changed in the equations of C++ sources: one mutant per line.

An equation line is one that computes: it holds a sign, an index or a constant, and is no comment,
declaration of a tolerance, loop head or directive. Which of its changes is tried follows from a
hash of the line, so that the set is the same on every machine.
"""
import hashlib
import re
from dataclasses import dataclass

NO_EQUATION = re.compile(
    r"^\s*(#|//|\*|for \(|while \(|static_assert|(static )?constexpr|template|using|namespace|throw|"
    r"class |struct |case |\})")
ARRAY = re.compile(r"^\s*(const )?(double|int|bool|Lanes|Term)\*? \w+\[.*\]( = \{\})?;")
# Pairs of names that are indices in disguise: entries of the affinity, components, sine and cosine.
NAMES = [("a1", "a2"), ("a3", "a4"), (".x()", ".y()"), (".tx", ".tz"), (".nx", ".nz"),
         ("cos_alpha", "sin_alpha"), (".x1", ".x2"), ("h1", "h3"), ("h7", "h9")]


@dataclass(frozen=True)
class Mutant:
    path: str      # relative to the sources' root
    line: int      # from 1
    kind: str      # sign, index or constant
    before: str
    after: str

    @property
    def key(self):
        """Names the mutant by content, not by line number: stable while other lines move."""
        return f"{self.path}: {self.before.strip()}  =>  {self.after.strip()}"

    @property
    def rank(self):
        return hashlib.sha256(self.key.encode()).hexdigest()


def changed(code, match, text, group=0):
    return code[:match.start(group)] + text + code[match.end(group):]


def signs(code):
    other = {"+": "-", "-": "+"}
    for match in re.finditer(r"(?<=[\w\)\]]) ([+-])=?(?= |$)", code):
        yield changed(code, match, other[match.group(1)], 1)
    for match in re.finditer(r"(?:(?<=[({])|(?<=[,=*{] )|(?<=return ))-(?=[\w(])", code):
        yield changed(code, match, "")


def indices(code):
    bump = {d: str(int(d) - 1 if d != "0" else 1) for d in "0123456789"}
    for match in re.finditer(r"(?<=\w)\((\d), (\d)\)", code):
        i, j = match.groups()
        yield changed(code, match, f"({j}, {i})" if i != j else f"({i}, {bump[j]})")
    for match in re.finditer(r"(?<=[\w>])[\[(](\d)[\])]", code):
        yield changed(code, match, bump[match.group(1)], 1)
    for one, two in NAMES:
        for a, b in ((one, two), (two, one)):
            ahead = r"\b" if a[0] != "." else ""
            behind = r"\b" if a[-1] != ")" else ""
            for match in re.finditer(ahead + re.escape(a) + behind, code):
                yield changed(code, match, b)


def constants(code):
    for match in re.finditer(r"(?<![\w.])(\d+\.\d*)(?![\w.])", code):
        yield changed(code, match, f"{float(match.group(1)) + 1.0}", 1)


def mutant_of(path, number, line):
    code = line.split("//")[0].rstrip()
    rest = line[len(code):]
    if NO_EQUATION.match(code) or ARRAY.match(code) or not re.search(r"[=*/+-]|return", code):
        return None
    options = [(kind, text) for kind, find in
               (("sign", signs), ("index", indices), ("constant", constants)) for text in find(code)]
    if not options:
        return None
    # Rooms inside a module do not count: a file that moves keeps its mutants.
    place = re.sub(r"/src/.*/", "/src/", path)
    digest = hashlib.sha256(f"{place}{code}".encode()).digest()
    kinds = sorted({kind for kind, _ in options})
    kind = kinds[digest[0] % len(kinds)]
    texts = [text for k, text in options if k == kind]
    return Mutant(path, number, kind, line, texts[digest[1] % len(texts)] + rest)


def mutants_of(root, paths):
    """All mutants, in an order that scatters them over the files."""
    found = {}
    for path in paths:
        for number, line in enumerate((root / path).read_text().split("\n"), 1):
            mutant = mutant_of(path, number, line)
            if mutant:
                found.setdefault(mutant.key, mutant)
    return sorted(found.values(), key=lambda mutant: mutant.rank)
