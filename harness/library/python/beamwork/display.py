"""Display in notebooks: small HTML tables with escaped text. Numbers have as many digits as are known."""
from __future__ import annotations

import html
import math
from collections.abc import Iterable
from typing import Any

_MOST_ROWS = 40


def escape(value: object) -> str:
    return html.escape(str(value), quote=True)


def significant(value: float | None, digits: int) -> str:
    if value is None or not math.isfinite(value):
        return ""
    return f"{value:.{max(1, digits)}g}"


def known(value: float | None, uncertainty: float | None) -> str:
    """Returns a value with the digits that its uncertainty allows, from 2 to 12, or with 7 digits if the uncertainty is
    unknown."""
    if value is None or not math.isfinite(value):
        return ""
    if value == 0 or uncertainty is None or not math.isfinite(uncertainty):
        return significant(value, 7)
    if uncertainty == 0:
        return significant(value, 12)
    lost = math.log10(abs(uncertainty / value))
    return significant(value, min(12, max(2, math.ceil(-lost) + 1)))


def percent(error: float | None) -> str:
    """Returns a relative error in percent with its sign and two digits."""
    if error is None or not math.isfinite(error):
        return ""
    return "0 %" if error == 0 else f"{100 * error:+.2g} %"


def of_unit(unit: str) -> str:
    return "" if unit == "1" else unit


def plain(value: Any) -> str:
    if value is None:
        return ""
    return significant(value, 7) if isinstance(value, float) else str(value)


def table(head: Iterable[str], rows: Iterable[Iterable[str]], title: str = "") -> str:
    """Returns an HTML table for a title, names of columns and rows of strings. The table shows at most 40 rows and the
    number of the other rows."""
    head, rows = list(head), list(rows)
    parts = ["<table>"]
    if title:
        parts.append(f"<caption style='text-align:left'>{escape(title)}</caption>")
    parts.append("<tr>" + "".join(f"<th>{escape(h)}</th>" for h in head) + "</tr>")
    for row in rows[:_MOST_ROWS]:
        parts.append("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>")
    if len(rows) > _MOST_ROWS:
        parts.append(f"<tr><td colspan='{len(head)}'>and {len(rows) - _MOST_ROWS} more</td></tr>")
    return "".join(parts) + "</table>"


def folded(title: str, content: str) -> str:
    return f"<details><summary>{escape(title)}</summary>{content}</details>"


def scene(about: dict[str, Any], text: str) -> str:
    parameters = [(p["name"], plain(p["value"]), of_unit(p["unit"]), p["summary"])
                  for p in about["parameters"]]
    quantities = [(q["name"], of_unit(q["unit"]), q["meaning"]) for q in about["quantities"]]
    title = f"{about['case']}: {about['summary']}" if about["summary"] else about["case"]
    shown = (table(("parameter", "value", "unit", "what"), parameters, title)
             if parameters else f"<p>{escape(title)}</p>")
    return (shown + folded(f"{len(quantities)} quantities",
                           table(("quantity", "unit", "what"), quantities)) +
            folded("scene file", f"<pre>{escape(text)}</pre>"))


def mistakes(told: Iterable[object]) -> str:
    return table(("mistakes", ), ((str(m), ) for m in told))


def result(shown: Any) -> str:
    rows = []
    for name, value in shown.values.items():
        error = shown.errors.get(name)
        off = None if error is None else abs(error * value)
        rows.append((name, known(value, off), of_unit(shown.units[name]), percent(error)))
    for name in shown.curves:
        rows.append((name, f"curve of {len(shown.curve(name).x)} points", shown.units[name], ""))
    return table(("quantity", "value", "unit", "error"), rows, str(shown))


def convergence(shown: Any) -> str:
    """Returns an HTML table with a row for each limit: the errors over the meshes, and the message."""
    meshes = sorted({r["elements"] for r in shown})
    errors = {(r["formulation"], r["quantity"], r["elements"]): r for r in shown}

    def cell(limit: dict[str, Any], elements: int) -> str:
        record = errors.get((limit["formulation"], limit["quantity"], elements))
        if record is None:
            return ""
        if record["status"] != "ok":
            return str(record["status"]).replace("_", " ")
        return percent(record["error"]) or known(record["value"], limit["limit_uncertainty"])

    rows = ([r["quantity"], r["formulation"]] + [cell(r, n) for n in meshes] +
            [known(r["limit"], r["limit_uncertainty"]), of_unit(r["unit"]),
             significant(r["order"], 3), r["verdict"]] for r in shown.limits)
    head = ["quantity", "formulation", *(f"n = {n}" for n in meshes), "limit", "unit", "order",
            "verdict"]
    return table(head, rows, shown.sentence)


def outcome(shown: Any) -> str:
    counted = ", ".join(f"{n} {word}" for word, n in shown.counts.items() if n)
    word = {"pass": "PASS", "fail": "FAIL"}.get(shown.outcome, shown.outcome)
    return f"{word}: {counted}"


def verdicts(shown: Any) -> str:
    title = outcome(shown)
    rows = ((r["case"], r["parameters"], r["formulation"], r["quantity"], r["verdict"],
             known(r["limit"], r["limit_uncertainty"]), percent(r["error"]))
            for r in shown.unexpected or shown)
    return table(("case", "parameters", "formulation", "quantity", "verdict", "limit", "error"),
                 rows, title + ("; not as expected:" if shown.unexpected else ""))
