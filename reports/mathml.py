"""Converts equations in a small subset of LaTeX to MathML, which browsers draw without network access or scripts.

The subset contains letters, numbers and operators; `_`, `^` and `'`; groups in braces; Greek letters and symbols;
names of functions; \\frac, \\sqrt, \\mathbf, \\mathrm, \\text; accents; \\left and \\right. Unknown commands are
rejected.
"""
import re

from markupsafe import escape

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ",
    "eta": "η", "theta": "θ", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ",
    "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "ϕ", "varphi": "φ", "psi": "ψ", "omega": "ω",
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Pi": "Π", "Sigma": "Σ",
    "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω", "partial": "∂", "infty": "∞", "ell": "ℓ"
}
OPERATORS = {
    "cdot": "·", "times": "×", "pm": "±", "mp": "∓", "le": "≤", "ge": "≥", "approx": "≈",
    "to": "→", "in": "∈", "ne": "≠", "ldots": "…", "circ": "∘", "equiv": "≡", "propto": "∝"
}
LARGE = {"int": "∫", "sum": "∑", "prod": "∏"}
FUNCTIONS = ("sin", "cos", "tan", "arctan", "sinh", "cosh", "tanh", "coth", "exp", "log", "max",
             "min", "sym", "lin")
SPACES = {"quad": "1em", "qquad": "2em", ",": "0.17em", ";": "0.28em", " ": "0.25em"}
ACCENTS = {"bar": "¯", "tilde": "~", "dot": "˙", "hat": "^", "vec": "→"}
PLAIN = {"-": "−", "*": "∗"}
FENCES = {"(", ")", "[", "]", "|", ".", "{", "}"}
TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|\s+|.", re.S)


class Unknown(ValueError):
    """Raised for a command that this subset of LaTeX does not contain."""


def row(parts):
    return parts[0] if len(parts) == 1 else f"<mrow>{''.join(parts)}</mrow>"


def operator(sign, stretchy=False):
    fence = "" if stretchy or sign not in FENCES else ' stretchy="false"'
    return f"<mo{fence}>{escape(PLAIN.get(sign, sign))}</mo>"


def bold(letters):
    first = {"A": 0x1D400, "a": 0x1D41A}
    return "".join(chr(first["A"] + ord(c) - ord("A")) if c.isupper() else chr(
        first["a"] + ord(c) - ord("a")) for c in letters)


class Parser:
    def __init__(self, tex):
        self.tex = tex
        self.tokens = [t for t in TOKEN.findall(tex) if not t.isspace()]
        self.at = 0

    def fail(self, what):
        raise Unknown(f"{what} in the equation '{self.tex.strip()}'")

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, expected=None):
        token = self.peek()
        if not token or expected not in (None, token):
            self.fail(f"'{expected or 'more'}' is missing")
        self.at += 1
        return token

    def group(self):
        if self.peek() != "{":
            return self.atom()
        self.take("{")
        parts = self.until("}")
        self.take("}")
        return row(parts) if parts else "<mrow></mrow>"

    def words(self):
        self.take("{")
        found = ""
        while self.peek() != "}":
            found += self.take()
        self.take("}")
        return found

    def until(self, *ends):
        parts = []
        while self.peek() not in (*ends, ""):
            parts.append(self.scripted())
        return parts

    def scripted(self):
        large = self.peek()[1:] in LARGE
        base, below, above, primes = self.atom(), None, [], 0
        while self.peek() in ("_", "^", "'"):
            sign = self.take()
            if sign == "'":
                primes += 1
            elif sign == "_":
                below = self.group()
            else:
                above.append(self.group())
        if primes:
            base = f'<mrow>{base}<mo lspace="0" rspace="0">{"′" * primes}</mo></mrow>'
        if below is None and not above:
            return base
        under = large and "∑" in base
        kinds = ("munder", "mover", "munderover") if under else ("msub", "msup", "msubsup")
        kind = kinds[2 if below and above else 0 if below else 1]
        return f"<{kind}>{base}{below or ''}{row(above) if above else ''}</{kind}>"

    def atom(self):
        token = self.take()
        if token[0] == "\\":
            return self.command(token[1:])
        if token[0].isdigit():
            return f"<mn>{token}</mn>"
        if token.isalpha():
            return f"<mi>{token}</mi>"
        if token == "{":
            self.at -= 1
            return self.group()
        if token in "+-*/=<>,;:.()[]|!":
            return operator(token)
        return self.fail(f"'{token}' is not known")

    def command(self, name):
        if name in GREEK:
            return f"<mi>{GREEK[name]}</mi>"
        if name in OPERATORS:
            return operator(OPERATORS[name])
        if name in LARGE:
            return f"<mo>{LARGE[name]}</mo>"
        if name in FUNCTIONS:
            return f"<mi>{name}</mi>"
        if name in SPACES:
            return f'<mspace width="{SPACES[name]}"></mspace>'
        if name in ACCENTS:
            return f'<mover accent="true">{self.group()}<mo stretchy="false">' \
                   f"{ACCENTS[name]}</mo></mover>"
        if name == "frac":
            return f"<mfrac>{self.group()}{self.group()}</mfrac>"
        if name == "sqrt":
            return f"<msqrt>{self.group()}</msqrt>"
        if name in ("mathrm", "text"):
            return f"<mtext>{escape(self.words())}</mtext>"
        if name == "mathbf":
            return f'<mi mathvariant="normal">{bold(self.words())}</mi>'
        if name == "left":
            return self.fenced()
        return self.fail(f"\\{name} is not known")

    def fenced(self):
        first = self.take()
        parts = self.until("\\right")
        self.take("\\right")
        sides = ["" if s == "." else operator(s, stretchy=True) for s in (first, self.take())]
        return row([sides[0], *parts, sides[1]])


def convert(tex, display=False):
    parser = Parser(tex)
    parts = parser.until()
    kind = ' display="block"' if display else ""
    return f"<math{kind}>{''.join(parts)}</math>"
