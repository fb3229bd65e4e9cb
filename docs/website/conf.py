"""Settings of Sphinx, which builds the site of the documentation."""

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

from handeye.al.highlight import ArmLexer

project = "handeye"
root_doc = "index"
extensions = ["myst_parser"]
myst_heading_anchors = 4
smartquotes = False
suppress_warnings = ["misc.highlighting_failure"]  # the pages show wrong programs on purpose
html_theme = "furo"
html_title = "handeye"
html_show_copyright = html_show_sphinx = html_copy_source = html_use_index = False
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
templates_path = ["templates"]
html_additional_pages = {"search": "search.html"}
TEXTS = (
    "begin", "cell", "diagnostic", "full", "mal", "ml", "partial", "plan", "run", "strict", "sym", "told", "trig",
)  # fmt: skip
"""First words of blocks without colours: outputs, and languages that have no lexer."""


def setup(app: Sphinx) -> None:
    app.add_lexer("al", ArmLexer)
    for name in TEXTS:
        app.add_lexer(name, TextLexer)
    app.connect("builder-inited", without_sphinx_search)


def without_sphinx_search(app: Sphinx) -> None:
    """Leave out the search of Sphinx, which drops numbers: it would search for `error` only if asked for `error 23`."""
    app.builder.search = False
