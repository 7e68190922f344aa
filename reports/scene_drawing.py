"""What the page of a case shows of its scene: the drawing, its sections, the same in words."""
from dataclasses import dataclass

from reports.drawing import describe, draw, scene


@dataclass
class Drawing:
    """figure, sections: images of the site, the second None where no section has a shape; lines:
    [(heading, lines)]."""
    figure: object
    sections: object
    counts: str
    lines: list


def drawing(site, case):
    """Of the first parameter point, or None where the results hold no scene of it."""
    read = scene.read(case.points[0].scene)
    if read is None:
        return None
    beside = draw.draw_sections(read)
    return Drawing(site.image(draw.draw(read), f"{case.name}_scene", tight=False),
                   site.image(beside, f"{case.name}_sections", tight=False) if beside else None,
                   describe.counts(read), describe.describe(read))
