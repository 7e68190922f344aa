"""Maps of stability: step across, stiffness down, for each integrator a panel; what happened has a
colour and a letter, so that the map can be read without colours."""
from markupsafe import escape

from reports.figures import FONT, Image
from reports.integrators.stored import ordered

# fate: letter, colour, colour of the letter, meaning
LOOK = {
    "exact": ("E", "#009e73", "#111418", "energy and momenta kept to round-off"),
    "bounded": ("B", "#8fd3f4", "#111418", "its energy does not grow"),
    "grows": ("G", "#e69f00", "#111418", "its energy grows by more than 1 %"),
    "stops": ("S", "currentColor", "var(--paper,#fff)", "a step finds no solution"),
}
WIDE, TALL, LEFT, TOP, BELOW, GAP = 46, 26, 84, 26, 46, 22
MOST = 4  # panels in a row


def text(x, y, words, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}"{more and " "}{more}>{escape(words)}</text>'


def short(value):
    """A power of ten as 1e6."""
    return (f"{value:g}" if value < 1e4 else f"{value:.0e}").replace("e+0", "e").replace("e+", "e")


def field(x, y, fate, words):
    letter, fill, ink, _ = LOOK[fate]
    return (f'<g><title>{escape(words)}</title><path fill="{fill}" stroke="var(--paper,#fff)" '
            f'd="M{x:.1f} {y:.1f}h{WIDE}v{TALL}h-{WIDE}z"/>' +
            text(x + WIDE / 2, y + TALL / 2 + 5, letter, f'fill="{ink}"') + "</g>")


def panel(scheme, found, steps, stiffenings, left, top):
    """One integrator."""
    out = text(left + WIDE * len(steps) / 2, top - 9, scheme, 'font-size="12"')
    for j, stiffening in enumerate(stiffenings):
        for i, step in enumerate(steps):
            x, y = left + WIDE * i, top + TALL * j
            run = found.get((scheme, step, stiffening))
            if run is None:
                out += text(x + WIDE / 2, y + TALL / 2 + 4, "–", 'fill-opacity=".5"')
                continue
            words = f"{scheme}, step {step:g} s, EA × {short(stiffening)}: {run.fate}"
            out += field(x, y, run.fate, words + (f", {run.reason}" if run.reason else ""))
    bottom = top + TALL * len(stiffenings)
    out += "".join(text(left + WIDE * (i + 0.5), bottom + 15, f"{step:.3g}")
                   for i, step in enumerate(steps))
    return out + text(left + WIDE * len(steps) / 2, bottom + 31, "step [s]", 'font-size="11.5"')


def fates(problems):
    """{(scheme, step, stiffening): run}: what was run with equal steps and became something."""
    return {(r.scheme, r.step, p.stiffening): r for p in problems for r in p.runs
            if r.fate and not r.tolerance}


def draw(problems, legend=True):
    """The Image of a structure's map. problems: its stiffenings; legend: letters are explained
    below it."""
    found = fates(problems)
    schemes = ordered({s for s, _, _ in found})
    steps, stiffenings = sorted({h for _, h, _ in found}), sorted({x for _, _, x in found})
    columns = max(1, min(MOST, len(schemes), 900 // (WIDE * len(steps) + GAP)))
    step = (WIDE * len(steps) + GAP, TALL * len(stiffenings) + TOP + BELOW)
    rows = -(-len(schemes) // columns)
    out = ""
    for k, scheme in enumerate(schemes):
        left, top = LEFT + step[0] * (k % columns), TOP + step[1] * (k // columns)
        out += panel(scheme, found, steps, stiffenings, left, top)
        if k % columns == 0:
            out += "".join(text(left - 8, top + TALL * (j + 0.5) + 4, f"EA × {short(s)}",
                                'text-anchor="end"') for j, s in enumerate(stiffenings))
    height = step[1] * rows + 6
    there = list(LOOK) if legend else []
    for k, fate in enumerate(there):
        letter, fill, ink, meaning = LOOK[fate]
        y = height + 20 * k
        out += (f'<path fill="{fill}" d="M{LEFT} {y}h18v15h-18z"/>' +
                text(LEFT + 9, y + 12, letter, f'fill="{ink}"') +
                text(LEFT + 26, y + 12, f"{fate}: {meaning}", 'text-anchor="start"'))
    height += 20 * len(there) + 4
    width = LEFT + max(step[0] * columns, 320 if there else 0)
    name = "".join(c if c.isalnum() else "_" for c in f"map_{problems[0].name}")
    return Image(f"{name}.svg",
                 f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
                 f'fill="currentColor" font-size="11" text-anchor="middle" '
                 f'font-family="{FONT}">{out}</svg>')
