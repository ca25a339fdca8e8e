"""The site: ``uv run --group docs sphinx-build -W docs site``. Nothing is downloaded."""

import re
import sys
from pathlib import Path

from docutils.nodes import Element, SkipNode, math_block
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
import pages  # noqa: E402

project = "Place recognition and line extraction"
html_title = project
extensions = ["myst_nb"]
exclude_patterns = ["Thumbs.db"]
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_theme = "sphinx_book_theme"
html_theme_options = {
    "show_toc_level": 2,
    "use_download_button": False,
    "use_fullscreen_button": False,
    "navbar_persistent": [],  # one search is enough, and it is in the sidebar
}
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_dmath_double_inline = True  # prompts have $$ within a paragraph
nb_render_markdown_format = "myst"  # formulas in what cells print, too
smartquotes = False  # it makes a dash of --help
myst_heading_anchors = 3
nb_execution_mode = "off"  # pages.py has run the chapters
nb_merge_streams = True
html_math_renderer = "mathml"  # what browsers show themselves; MathJax would be fetched


def _formula(translator: HTML5Translator, node: Element) -> None:
    """Write a formula as MathML, in the spelling of TeX that docutils reads."""
    block = isinstance(node, math_block)
    tex = node.astext().strip().replace("\\dots", "\\ldots").replace("°", r"^\circ")
    # docutils would put the index of x̃_i below the x.
    tex = re.sub(r"(\\(?:tilde|bar|hat)\s*(?:\w|\{\w+\}))(?=[_^])", r"{{\1}{}}", tex)
    if block and "\\\\" in tex and "\\begin" not in tex:
        tex = f"\\begin{{aligned}}{tex}\\end{{aligned}}"
    mathml = tex2mathml(tex, as_block=block)
    translator.body.append(f'<div class="formula">{mathml}</div>' if block else mathml)
    raise SkipNode


def setup(app: Sphinx) -> None:
    """Write what is made from elsewhere before Sphinx looks for pages."""
    app.add_html_math_renderer("mathml", (_formula, None), (_formula, None))
    app.connect("config-inited", lambda app, config: pages.write(HERE))
