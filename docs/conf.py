"""Sphinx builds the manual; what code knows (keywords, schema, curves) is made by the code."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from generate import write_pages

project = "podeep"
author = "The podeep developers"
copyright = "2026, the podeep developers"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_build", "figures"]
html_theme = "alabaster"
html_title = "podeep"
html_theme_options = {"description": "Piles and casings in soil", "page_width": "1100px"}
nitpicky = True

write_pages(Path(__file__).parent / "generated")
