"""Figures of results. Each function returns a Figure of matplotlib."""
from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from .display import of_unit


def _panels(count: int, **options: Any) -> tuple[Any, list[Any]]:
    try:
        from matplotlib.figure import Figure  # pylint: disable=import-outside-toplevel
    except ImportError:
        raise ImportError("beamwork: plot() needs matplotlib") from None
    columns = min(3, count)
    rows = math.ceil(count / columns)
    figure = Figure(figsize=(2 + 3.2 * columns, 0.6 + 2.8 * rows), layout="constrained")
    axes = [figure.add_subplot(rows, columns, i + 1, **options) for i in range(count)]
    return figure, axes


def _labelled(name: str, unit: str) -> str:
    return f"{name} [{of_unit(unit)}]" if of_unit(unit) else name


def result(shown: Any, names: Sequence[str]) -> Any:
    """Draws curves of quantities against time, path or frequency."""
    chosen = list(names or shown.curves)
    if not chosen:
        raise ValueError("the result has no curve to plot; give a quantity 'take: curve' or 'take: history'")
    figure, axes = _panels(len(chosen))
    about = {q["quantity"]: q for q in shown.document["quantities"]}
    for ax, name in zip(axes, chosen):
        curve = shown.curve(name)
        ax.plot(curve.x, curve.y, ".-" if len(curve.x) < 30 else "-")
        x = about.get(name, {})
        ax.set_xlabel(_labelled(str(x.get("x_name") or "x"), str(x.get("x_unit") or "1")))
        ax.set_ylabel(_labelled(name, shown.units[name]))
    figure.suptitle(str(shown), fontsize="medium")
    return figure


def shapes(shown: Any, scale: float) -> Any:
    """Draws the centre lines of all states. scale: factor of the displacements."""
    figure, (ax, ) = _panels(1, projection="3d")
    rest = shown.position[0]
    for state, (kind, value) in enumerate(zip(shown.kinds, shown.values)):
        place = rest + scale * (shown.position[state] - rest)
        for member, (begin, end) in enumerate(zip(shown.first[:-1], shown.first[1:])):
            ax.plot(*place[begin:end].T, color="0.6" if state == 0 else f"C{state - 1}",
                    label=f"{kind} {value:.4g}" if member == 0 and 0 < state < 8 else None)
    ax.set_aspect("equal")
    if len(shown.kinds) > 1:
        ax.legend(fontsize="small")
    return figure


def convergence(shown: Any, names: Iterable[str]) -> Any:
    """Draws the size of the relative error over the number of elements for each quantity and formulation."""
    known = [r for r in shown if isinstance(r["error"], float) and r["error"] and math.isfinite(r["error"])]
    chosen = list(names or dict.fromkeys(r["quantity"] for r in known))
    if not chosen:
        raise ValueError("no quantity has a reference value, so there are no errors to plot")
    figure, axes = _panels(len(chosen))
    for ax, name in zip(axes, chosen):
        for label in dict.fromkeys(r["formulation"] for r in known):
            own = [r for r in known if r["formulation"] == label and r["quantity"] == name]
            ax.loglog([r["elements"] for r in own], [abs(r["error"]) for r in own], "o-", label=label)
        ax.set_xlabel("elements per member")
        ax.set_ylabel("relative error")
        ax.set_title(name, fontsize="medium")
    axes[0].legend(fontsize="small")
    return figure


def verdicts(shown: Any) -> Any:
    """Draws the number of each verdict for each formulation."""
    figure, (ax, ) = _panels(1)
    names = list(dict.fromkeys(r["formulation"] for r in shown))
    begin = [0] * len(names)
    for verdict in dict.fromkeys(r["verdict"] for r in shown):
        counts = [len(shown.where(formulation=name, verdict=verdict)) for name in names]
        ax.barh(names, counts, left=begin, label=verdict)
        begin = [b + c for b, c in zip(begin, counts)]
    ax.set_xlabel("verdicts")
    ax.legend(fontsize="small")
    return figure


def records(shown: Any, x: str, y: str, by: str | Sequence[str], log: bool) -> Any:
    """Draws column y over column x, with a line for each combination of values of the columns `by`."""
    keys = [by] if isinstance(by, str) else list(by)
    figure, (ax, ) = _panels(1)
    for key in (x, y, *keys):
        shown.column(key)  # raises KeyError for an unknown name
    groups: dict[tuple[Any, ...], list[Any]] = {}
    for record in shown:
        if record[x] is not None and record[y] is not None:
            groups.setdefault(tuple(record[key] for key in keys), []).append(record)
    for label, own in groups.items():
        values = [abs(r[y]) if log else r[y] for r in own]
        ax.plot([r[x] for r in own], values, "o-", label=", ".join(map(str, label)))
    if log:
        ax.set_yscale("log")
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    if keys:
        ax.legend(fontsize="small")
    return figure
