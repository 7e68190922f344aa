"""Errors of our formulations and of other programs that were run elsewhere, side by side."""
from reports import beside, plots
from reports.chart import Chart


def figure_of(site, ours, others, name):
    """ours: [(key, meshes)], others: {program: [data.Mesh]}: errors against unknowns and time."""
    chart = Chart(2, (470, 260))
    labels = ("unknowns", "time of the solution [ms]; open marks: taken elsewhere")
    for quantity in ("C_xx", "C_zz"):
        row = [chart.panel("", labels[0], f"relative error of {quantity}", whole=True)]
        row.append(chart.panel("", labels[1], like=row[0]))
        curves_of = [(key, meshes, site.styles.of(key)) for key, meshes in ours]
        curves_of += [(f"{program} (elsewhere)", meshes, beside.style(i))
                      for i, (program, meshes) in enumerate(others.items())]
        for label, meshes, look in curves_of:
            error = [plots.clipped(m.errors[quantity]) for m in meshes]
            row[0].plot([m.free for m in meshes], error, label=label, **look)
            row[1].plot([1e3 * m.clock.solve for m in meshes], error, label=label, **look)
        for one in row:
            one.level(0.01)
    return chart.image(site, name)
