"""Numbers with their units, short."""


def number(value):
    """Four digits; large ones in groups of three."""
    if 1e4 <= abs(value) < 1e8:
        return f"{float(f'{value:.4g}'):,.0f}".replace(",", "\u202f")
    return f"{value + 0:.4g}"


def length(value):
    """In m, small ones in mm."""
    return f"{number(value)} m" if abs(value) >= 0.5 or value == 0 else f"{number(1e3 * value)} mm"


def vector(values, unit):
    """The size along an axis, else all three components."""
    along = [v for v in values if v]
    said = number(abs(along[0])) if len(along) == 1 else f"({', '.join(map(number, values))})"
    return f"{said} {unit}"
