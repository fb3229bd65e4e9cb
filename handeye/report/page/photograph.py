"""A photograph on the page."""

from handeye.core.markup import Markup, data_address, element
from handeye.report.photographs import Photograph


def shown(photograph: Photograph, **attributes: str | None) -> Markup:
    """A photograph with its caption as a figure, or in its place why there is none."""
    if photograph.webp is None:
        return element("p", photograph.missing, class_="missing")
    image = element(
        "img",
        src=data_address("image/webp", photograph.webp),
        alt=photograph.shows,
        width=photograph.width,
        height=photograph.height,
    )
    return element("figure", image, element("figcaption", photograph.shows), **attributes)
